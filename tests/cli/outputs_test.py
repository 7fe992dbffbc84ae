"""Tests which files a command writes and what their headers say: -o, --crop and --overwrite with five Displays, finished frames, and interrupted
frames."""
import hashlib
import itertools
import math
import pathlib
import re
import signal
import subprocess
import sys

from program import Suite

sys.path.append(str(pathlib.Path(__file__).parents[1] / "image"))
import exr  # noqa: E402
from pictures import pixels

t = Suite()
WORLD = """Format 64 48 1
Projection "perspective" "fov" [40]
Clipping 0.5 100
ScreenWindow -1.2 1 -0.7 0.8
Rotate 10 0 1 0
Translate 0.1 0 4
WorldBegin
LightSource "distantlight" 1
Surface "ours"
Color [1 0.5 0.2]
Attribute "identifier" "name" ["ball"]
Sphere 0.8 -0.8 0.8 360
WorldEnd
"""
MAP = """FrameBegin 1
Display "ball.map" "shadow" "z"
Format 32 32 1
Projection "perspective" "fov" [40]
Translate 0 0 4
WorldBegin
Sphere 0.8 -0.8 0.8 360
WorldEnd
FrameEnd
"""
DISPLAYS = """Display "beauty.exr" "file" "rgba"
Display "+beauty_n.exr" "file" "N"
DisplayChannel "varying normal N"
Display "+depth.exr" "file" "z"
Display "+ids.exr" "file" "cryptoobject"
Display "+deep.exr" "deepexr" "rgba"
"""
t.write("ours.sl", "surface ours() { Oi = Os; Ci = Cs * diffuse(faceforward(normalize(N), I)); }")
t.write("shot.rib", MAP + "FrameBegin 2\n" + DISPLAYS + WORLD + "FrameEnd\n")
t.write("beauty.rib", DISPLAYS + WORLD)
PICTURES = ["beauty.exr", "beauty_n.exr", "depth.exr", "ids.exr", "deep.exr"]


def contents():
    return {p.name: hashlib.md5(p.read_bytes()).hexdigest() for p in t.folder.iterdir() if p.suffix in (".exr", ".map")}


def header(name):
    """Returns {attribute: its text as oiiotool prints it}."""
    text = subprocess.run(["oiiotool", "--info", "-v", str(t.folder / name)], capture_output=True, text=True).stdout
    return dict(re.findall(r'^ +([\w:/]+): "?(.*?)"?$', text, re.M))


def window(name):
    return exr.window(t.folder / name)


first = t.expect_run("five Displays and a map", ["shot.rib"], 0)
whole = contents()
t.expect("warning" not in first.stderr, f"without a warning ({first.stderr})")
t.expect(sorted(whole) == sorted(PICTURES + ["ball.map"]), f"are all there ({sorted(whole)})")
t.expect(any(name.startswith("cryptomatte/") for name in header("ids.exr")), "one of them is Cryptomatte")
t.run("hide", "beauty.rib", "-o", "beauty.dfb")
CROP = ["--crop", "0.25,0.5,0.25,0.75"]
for command, output, crop, one in itertools.product((["render", "shot.rib"], ["shade", "beauty.dfb"]), (None, "look.exr", "beauty.exr"), (False, True), (False, True)):
    if one and not output:
        continue
    before = contents()
    line = [*command, *(["-o", output] if output else []), *(CROP if crop else []), *(["--one-picture"] if one else []), "-q"]
    what = " ".join(line)
    t.expect_run(what, line, 0)
    after = contents()
    changed = {name for name in before if before[name] != after[name]}
    named = {output, output.replace(".exr", "_n.exr")} if output else set()  # The name beauty_n.exr becomes look_n.exr.
    named |= {output.replace(".exr", f"_{p}") for p in PICTURES[2:]} if output else set()
    if output and one:
        named = {output}
    if not output and not crop:
        named = set(PICTURES)
    t.expect(changed <= named, f"    changes nothing but what it names ({changed - named})")
    t.expect(output is None or not crop or window(output)[2:] == (16, 24), "    and -o is what it says")
    t.expect(output != "look.exr" or one or {"look_n.exr", "look_depth.exr", "look_ids.exr", "look_deep.exr"} <= set(after), "    others go beside it")
    for made in set(after) - {*PICTURES, "ball.map"}:
        (t.folder / made).unlink()
    t.run("shot.rib", "-q")
    t.expect(contents() == whole, "    and a render without options has the same bits as the first")
t.expect(window("ball.map")[2:] == (32, 32), "a map for later frames keeps its own size")
said = t.expect_run("a crop beside a whole picture", ["shot.rib", *CROP], 0, '"depth.exr" holds more than the crop', "depth_crop.exr", "output-kept")
t.expect(window("beauty_crop.exr") == (16, 12, 16, 24) and contents()["beauty.exr"] == whole["beauty.exr"], "goes to a file of its own")
t.expect_run("--overwrite", ["shot.rib", *CROP, "--overwrite", "-q"], 0)
t.expect(window("beauty.exr") == (16, 12, 16, 24), "takes its place")
t.expect_run("a crop over a smaller one", ["shot.rib", "--crop", "0,0.75,0,0.75", "-q"], 0)
t.expect(window("beauty.exr") == (0, 0, 48, 36), "takes its place too")
t.expect_run("--overwrite alone", ["shot.rib", "--overwrite"], 1, "--crop")
t.run("shot.rib", "-q")

# The Displays of two frames have names of their own, and --frames chooses one frame.
def frame(number):
    return f"FrameBegin {number}\n" + DISPLAYS.replace('.exr"', f'{number}.exr"') + WORLD + "FrameEnd\n"


t.write("shots.rib", MAP + frame(2) + frame(3))
t.run("shots.rib", "-q")
both, third = contents(), [name.replace(".exr", "3.exr") for name in PICTURES]
t.expect({*third, *(name.replace(".exr", "2.exr") for name in PICTURES)} <= set(both), "frames of names of their own are all there")
for output, crop, one in itertools.product((None, "look.#.exr", "look.exr", "beauty3.exr"), (False, True), (False, True)):
    if one and not output:
        continue
    line = ["shots.rib", "--frames", "3", *(["-o", output] if output else []), *(CROP if crop else []), *(["--one-picture"] if one else []), "-q"]
    t.expect_run(" ".join(line), line, 0)
    after = contents()
    changed = {name for name in both if both[name] != after[name]}
    t.expect(changed <= ({"beauty3.exr"} if output == "beauty3.exr" else set()), f"    changes nothing but what it names ({changed})")
    made = {name for name in after if name not in both}
    picture = (output or "beauty3_crop.exr").replace("#", "3")
    t.expect(picture in made | changed or not (output or crop) or (output == "beauty3.exr" and not crop), f"    and makes {picture} ({sorted(made)})")
    t.expect(one or not made or len(made | changed | {picture}) == 5, f"    others go beside it ({sorted(made)})")
    for name in made:
        (t.folder / name).unlink()
    t.run("shots.rib", "--frames", "3", "-q")
    t.expect(contents() == both, "    and the frame without options has the same bits as the first")
t.expect_run("a frame that the scene does not have", ["shots.rib", "--frames", "4"], 2, "no-frame")
t.expect(contents() == both, "changes nothing")
for name in set(both) - {*PICTURES, "ball.map"}:
    (t.folder / name).unlink()

# Pictures that a later Make request reads are maps too. Here they are six faces of a room, and each side has a colour.
FACES = ["px", "nx", "py", "ny", "pz", "nz"]
face = lambda n, name: f"""FrameBegin {n}
Display "{name}.exr" "file" "rgb"
Format 16 16 1
Projection "perspective" "fov" [90]
WorldBegin
Color [{n / 8} 0.5 0.25]
Surface "constant"
Patch "bilinear" "P" [-9 -9 4  9 -9 4  -9 9 4  9 9 4]
WorldEnd
FrameEnd
"""
room = "".join(face(n + 1, name) for n, name in enumerate(FACES))
quoted = ' '.join(f'"{name}.exr"' for name in FACES)
room += f'MakeCubeFaceEnvironment {quoted} "room.env" 90 "box" 1 1\n'
t.write("room.rib", room + face(7, "beauty"))
t.run("room.rib", "-q")
made = (t.folder / "room.env").read_bytes()
for line in (["-o", "look.exr"], ["--format", "20x12"], ["-o", "look.exr", "--crop", "0,0.5,0,0.5", "--one-picture"]):
    for name in FACES + ["room"]:
        (t.folder / (name + (".env" if name == "room" else ".exr"))).unlink()
    t.expect_run(f"a room by six faces, {' '.join(line)}", ["room.rib", *line], 0)
    t.expect((t.folder / "room.env").read_bytes() == made, "    has the same map")
    t.expect(all(window(name + ".exr")[2:] == (16, 16) for name in FACES), "    of whole faces")
t.expect(window("look.exr")[2:] == (8, 8), "and -o is the picture alone")
for left in [f"{name}.exr" for name in FACES] + ["room.env", "look.exr"]:
    (t.folder / left).unlink()
t.run("shot.rib", "-q")

# By the matrices in headers, points of the world are projected to where they are seen: in all kinds of pictures, as one command makes them, as three
# do, and in a crop.
for name in PICTURES:
    said = header(name)
    t.expect(float(said["near"]) == 0.5 and float(said["far"]) == 100, f"{name} has the clipping planes")
    for key, value in (("scene", "shot.rib"), ("frame", "2"), ("settings", "")):
        t.expect(said.get(f"tomales:{key}", "") == value, f"{name} tells {key}")
    t.expect(said["tomales:version"] == sys.argv[2], f"{name} tells the version")
POINTS = [(-0.3, 0.25, 0.3), (0.45, 0.2, -0.3), (0.1, -0.3, 0.9), (-0.4, -0.25, -0.6)]
balls = "".join(f"TransformBegin Translate {x} {y} {z} Sphere 0.04 -0.04 0.04 360 TransformEnd\n" for x, y, z in POINTS)
for kind, projection in (("perspective", 'Projection "perspective" "fov" [40]'), ("parallel", 'Projection "orthographic"')):
    text = re.sub(r'Display "(\+?)', rf'Display "\1{kind}_', DISPLAYS) + WORLD.replace('Projection "perspective" "fov" [40]', projection).replace("Format 64 48 1", "Format 320 200 1.25")
    t.write(f"{kind}.rib", text.replace('"ours"', '"constant"').replace("Sphere 0.8 -0.8 0.8 360\n", balls).replace("0.1 0 4", "-0.7 0.1 4 Rotate 20 1 0.3 0"))


def times(p, matrix):
    """Returns a point by a matrix as OpenEXR has them: row vectors are multiplied from the left."""
    row = [sum(v * matrix[4 * i + k] for i, v in enumerate((*p, 1))) for k in range(4)]
    return [v / row[3] for v in row[:3]]


def expect_projected(what, names, depths):
    depth = {at: value[0] for at, value in pixels(t.folder / depths).items() if 0 < value[0] < 50}
    for name in names:
        said = header(name)
        ndc, camera, screen = ([float(v) for v in said[key].split(",")] if key in said else None for key in ("worldToNDC", "worldToCamera", "worldToScreen"))
        worst = 0
        for p in POINTS:
            x, y = (a * b for a, b in zip(times(p, ndc), (320, 200)))
            seen = [at for at in depth if abs(at[0] + 0.5 - x) < 12 and abs(at[1] + 0.5 - y) < 12]
            if not seen:
                worst = math.inf
                continue
            middle = [sum(at[k] + 0.5 for at in seen) / len(seen) for k in (0, 1)]
            away = abs(times(p, camera)[2] - min(depth[at] for at in seen) - 0.04)  # of the ball's nearest point
            worst = max(worst, math.dist(middle, (x, y)), 100 * away)
            if screen:
                u, v = times(p, screen)[:2]
                worst = max(worst, math.dist((160 + 160 * u, 100 - 100 * v), (x, y)))
        t.expect(worst < 0.5, f"{what}, {name}: matrices lead to {len(POINTS)} points, {worst:.2f} pixels off at most")
    t.expect(any("worldToScreen" in header(name) for name in names), "    and one has worldToScreen")


for kind in ("perspective", "parallel"):
    names = [f"{kind}_{name}" for name in PICTURES]
    t.run(f"{kind}.rib", "-q")
    expect_projected("render", names, f"{kind}_depth.exr")
    t.run("hide", f"{kind}.rib", "-o", f"{kind}.dfb", "-q")
    for name in names:
        (t.folder / name).unlink()
    t.run("shade", f"{kind}.dfb", "-q")
    expect_projected("hide and shade", names, f"{kind}_depth.exr")
    for name in names:
        (t.folder / name).unlink()
    t.run(f"{kind}.rib", "--crop", "0.02,0.98,0.03,0.97", "-q")
    t.expect(window(names[0])[:2] != (0, 0), "(a crop)")
    expect_projected("a crop", names, f"{kind}_depth.exr")
t.run("beauty.rib", "-o", "set.exr", "--gi", "gather", "--samples", "16", "-q")
settings = header("set.exr")["tomales:settings"]
t.expect(settings == "--gi gather --samples 16", f"settings of the command line are told ({settings})")

# Finished frames are left out. The contents of their files show that they are finished.
SKIP = ["shot.rib", "--skip-finished"]


def rendered(what, line, expected):
    stamps = {name: (t.folder / name).stat().st_mtime_ns for name in PICTURES}
    t.expect_run(what, line, 0, *([] if expected else ["frame 2 is finished"]))
    new = {name for name in PICTURES if (t.folder / name).stat().st_mtime_ns != stamps[name]}
    t.expect(new == (set(PICTURES) if expected else set()), f"{'is' if expected else 'is not'} rendered ({new})")


rendered("a frame that is finished", SKIP, False)
rendered("with another seed", [*SKIP, "--seed", "7"], True)
rendered("with that seed again", [*SKIP, "--seed", "7"], False)
rendered("with more threads", [*SKIP, "--seed", "7", "-t", "3"], False)
t.write("ours.sl", "surface ours() { Oi = Os; Ci = Cs * 0.5; }")
rendered("with a shader that has changed", [*SKIP, "--seed", "7"], True)
(t.folder / "looks").mkdir()
t.write("looks/ours.sl", '#include "half.h"\nsurface ours() { Oi = Os; Ci = Cs * HALF; }')
t.write("looks/half.h", "#define HALF 0.5")
LOOKS = [*SKIP, "--seed", "7", "--shaders", "looks"]
rendered("with a shader of another folder", LOOKS, True)
rendered("with that shader again", LOOKS, False)
t.write("looks/half.h", "#define HALF 0.25 ")
rendered("with a header of it that has changed", LOOKS, True)
t.write("looks/ours.sl", 'surface ours(string dirt = "dirt.tif") { Oi = Os; Ci = color texture("paper.tif") * float texture(dirt); }')


def paint(name):
    t.run("beauty.rib", "-o", name, "--one-picture", "--format", "16x12", "-q")


paint("paper.tif")
paint("dirt.tif")
rendered("with textures", LOOKS, True)
for what in ("paper", "dirt"):
    rendered(f"with that {what}", LOOKS, False)
    paint(f"{what}.tif")
    rendered(f"with a {what} that has changed, which the shader names", LOOKS, True)
t.write("looks/ours.sl", 'surface ours(string dirt = "dirt") { Oi = Os; Ci = texture(concat(dirt, ".tif")); }')
for _ in range(2):
    rendered("with a texture whose name is computed", LOOKS, True)
t.expect_run("which is told", LOOKS, 0, "files whose names shaders compute", "frame-unknown")
t.write("shot.rib", MAP + "FrameBegin 2\n" + DISPLAYS + WORLD.replace("0.8 360", "0.8 350") + "FrameEnd\n")
rendered("with geometry that has changed", [*SKIP, "--seed", "7"], True)
t.write("shot.rib", MAP + "FrameBegin 2\n" + DISPLAYS + WORLD.replace("0.1 0 4", "0.2 0 4") + "FrameEnd\n")
rendered("with a camera that has moved", [*SKIP, "--seed", "7"], True)
(t.folder / "depth.exr").write_bytes((t.folder / "depth.exr").read_bytes()[:200])
t.expect_run("a file that is damaged", [*SKIP, "--seed", "7"], 0)
t.expect(window("depth.exr")[2:] == (64, 48), "is rendered again")
t.expect_run("a format without headers", ["beauty.rib", "-o", "look.png", "--one-picture", "--skip-finished"], 0, "no header that tells", "frame-unknown")

t.run("beauty.rib", "-o", "one.exr", "--one-picture", "-t", "1", "-q")
t.run("beauty.rib", "-o", "two.exr", "--one-picture", "-t", "2", "--bucket-size", "9", "--memory-limit", "100M", "--texture-memory", "50M", "-q")
t.expect(contents()["one.exr"] == contents()["two.exr"], "a file has the same bytes by any name, for any threads, buckets and limits of memory")

# An interrupted frame does not take the place of a finished one.
t.run("beauty.rib", "-o", "long.exr", "--one-picture", "-q")
before = contents()["long.exr"]
line = ["beauty.rib", "-o", "long.exr", "--one-picture", "--format", "900x700", "--pixel-samples", "12x12", "--progress"]
process = subprocess.Popen([t.program, *line], cwd=t.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
for _ in range(4):
    process.stdout.readline()
process.send_signal(signal.SIGTERM)
_, errors = process.communicate(timeout=200)
t.expect(process.returncode == 143 and "long.partial.exr" in errors, f"an interrupted frame tells its file ({process.returncode}, {errors[:300]})")
t.expect(contents()["long.exr"] == before, "the finished one is kept")
t.expect(window("long.partial.exr")[2:] == (900, 700), "and what is finished is beside it")
share = float(header("long.partial.exr")["tomales:finished"])
t.expect(0 < share < 1, f"whose header tells the share of it ({share})")
t.expect(header("long.exr")["tomales:finished"] == "1.000", "and that a whole picture is whole")
one = (t.folder / "one.exr").read_bytes()
(t.folder / "one.exr").write_bytes(one.replace(b"1.000", b"0.500", 1))
t.expect(header("one.exr")["tomales:finished"] == "0.500", "(a partial picture by the name of a whole one)")
t.run("beauty.rib", "-o", "one.exr", "--one-picture", "--skip-finished", "-q")
t.expect((t.folder / "one.exr").read_bytes() == one, "a partial picture is not taken for a finished one")
t.finish()
