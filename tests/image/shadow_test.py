"""Compares shadow maps and deep shadow maps with closed forms and with traced shadows, and tests MakeShadow."""
import pathlib
import subprocess
import sys
import tempfile

from pictures import pixels

tomales, root = str(pathlib.Path(sys.argv[1]).absolute()), pathlib.Path(sys.argv[2]).absolute()
failures = []


def check(good, what):
    print(("ok      " if good else "FAILED  ") + what)
    if not good:
        failures.append(what)


# A square of side 1 at height 1 stands under a lamp at height 4, so its shadow on the floor has side 4/3.
SQUARE = """
  Attribute "identifier" "name" "floor"
  Surface "matte"
  Patch "bilinear" "P" [-4 0 -4  4 0 -4  -4 0 4  4 0 4]
  Opacity {opacity}
  Attribute "visibility" "int camera" [{seen}]
  Patch "bilinear" "P" [-0.5 1 -0.5  0.5 1 -0.5  -0.5 1 0.5  0.5 1 0.5]
"""
MAP = """FrameBegin 1
Format 256 256 1 PixelSamples 2 2 PixelFilter "box" 1 1 {hider}
Display "{folder}/map.z" "{type}" "z"
Projection "perspective" "fov" 60
Translate 0 0 4 Rotate -90 1 0 0
WorldBegin {world} WorldEnd FrameEnd
MakeShadow "{folder}/map.z" "{folder}/map.shd"
"""
VIEW = """FrameBegin 2
Format 128 128 1 PixelSamples 2 2 Display "{folder}/out.exr" "openexr" "rgb"
Projection "orthographic" ScreenWindow -1 1 -1 1
Translate 0 0 4 Rotate -90 1 0 0
WorldBegin
LightSource "shadowdistant" "lamp" "point from" [0 1 0] "point to" [0 0 0] "string shadowname" "{folder}/map.shd"
{world} WorldEnd FrameEnd
"""


def lit(kind, opacity, hider="", of_map=""):
    """Returns the floor seen from above, lit by a light without falloff through a map of that type."""
    with tempfile.TemporaryDirectory() as folder:
        rib = pathlib.Path(folder) / "a.rib"
        rib.write_text(MAP.format(folder=folder, type=kind, hider=hider, world=SQUARE.format(opacity=opacity, seen=1).replace("matte", of_map or "matte")) +
                       VIEW.format(folder=folder, world=SQUARE.format(opacity=opacity, seen=0)))
        subprocess.run([tomales, "render", str(rib), "-q"], check=True)
        return pixels(pathlib.Path(folder) / "out.exr")


def mean(picture, channel=0):
    return sum(p[channel] for p in picture.values()) / len(picture)


area = (4 / 3) ** 2 / 4  # The picture is 2 x 2, so this is its share.
for name, hider in (("min", ""), ("midpoint", 'Hider "hidden" "string depthfilter" "midpoint"')):
    shadow = 1 - mean(lit("shadow", "1 1 1", hider))
    check(abs(shadow - area) < 0.02 * area, f"area of the shadow of a square, depthfilter {name}: {shadow:.5f}, closed form {area:.5f}")
shadow = 1 - mean(lit("shadow", "1 1 1", of_map="null"))
check(abs(shadow - area) < 0.02 * area, f"Surface \"null\" hides nothing from a map: {shadow:.5f}")
deep = lit("deepshad", "0.75 0.5 0.25")
for channel, opacity in enumerate((0.75, 0.5, 0.25)):
    shadow = 1 - mean(deep, channel)
    check(abs(shadow - area * opacity) < 0.02 * area, f"deep map, opacity {opacity}: {shadow:.5f}, closed form {area * opacity:.5f}")
    inside = deep[64, 64][channel]
    check(abs(inside - (1 - opacity)) < 1e-5, f"light under opacity {opacity}: {inside:.6f}")
floor = lit("shadow", "1 1 1")
check(min(floor[x, y][0] for x in range(128) for y in range(128) if x < 15 or y < 15) > 0.999, "the floor does not shadow itself")

# A bare floor lies at a slant to the lamp. No filter of a deep map may let it shadow itself.
BARE = """Surface "matte" Patch "bilinear" "P" [-8 0 -8  8 0 -8  -8 0 8  8 0 8]"""
for filter in ('"gaussian" 2 2', '"triangle" 4 4', '"catmull-rom" 4 4'):
    with tempfile.TemporaryDirectory() as folder:
        rib = pathlib.Path(folder) / "a.rib"
        rib.write_text(MAP.format(folder=folder, type="deepshad", hider="", world=BARE).replace('"box" 1 1', filter).replace("Rotate -90", "Rotate -30") +
                       VIEW.format(folder=folder, world=BARE))
        subprocess.run([tomales, "render", str(rib), "-q"], check=True)
        darkest = min(p[0] for p in pixels(pathlib.Path(folder) / "out.exr").values())
        check(darkest > 0.999, f"darkest pixel of a floor that nothing shadows, deep map filtered by {filter}: {darkest:.5f}")

with tempfile.TemporaryDirectory() as folder:
    subprocess.run([tomales, "render", str(root / "scenes/displays/shadows.rib"), "-q"],
                   check=True, cwd=folder)
    mapped, deep, traced = (pixels(pathlib.Path(folder) / f"{n}_shadow.exr") for n in ("mapped", "deep", "traced"))
    different = sum(1 for k in traced if max(abs(a - b) for a, b in zip(deep[k], traced[k])) > 0.1) / len(traced)
    check(different < 0.02, f"deep map against traced shadows: {100 * different:.2f} % of the pixels differ by more than 0.1")
    check(any(mapped[k] != deep[k] for k in mapped), "the depth map does not see the glass")

with tempfile.TemporaryDirectory() as folder:
    rib = pathlib.Path(folder) / "a.rib"
    rib.write_text('MakeShadow "nothing.z" "map.shd"\n' + VIEW.format(folder=folder, world=SQUARE.format(opacity="1 1 1", seen=0)))
    run = subprocess.run([tomales, "render", str(rib)], capture_output=True, text=True, cwd=folder)
    check(run.returncode == 3 and "nothing.z" in run.stderr and "traced instead" in run.stderr, "a missing map is named, and shadows are traced")
    traced = 1 - mean(pixels(pathlib.Path(folder) / "out.exr"))
    check(abs(traced - 0.25) < 0.01, f"the traced shadow of parallel light: {traced:.5f}, closed form 0.25")
sys.exit(bool(failures))
