"""Measures what metal and gloss cost at the noise of plastic, on a knot under a sky, and counts fireflies in the gallery.

    tests/bench/gloss.py build/release/tomales [another tomales ...]
    tests/bench/gloss.py build/release/tomales [another tomales ...] --materials for the balls of scenes/shading/materials.rib, all of one surface
    tests/bench/gloss.py build/release/tomales --gallery [PART ...] with parts of the scenes' paths

Noise is the root mean square of the difference of two light seeds on the knot, divided by sqrt(2) and by the mean colour there.
Colours above 1 count as 1. Time at equal noise is CPU seconds times the square of the noise, as a multiple of plastic's. For the
gallery, this counts the pixels that are brighter than 10 times the median of their 5 x 5 neighbours. It lists those that are also
more than twice as bright as with another light seed, because those are not thin bright objects.
"""
import math
import pathlib
import re
import resource
import shutil
import statistics
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.append(str(ROOT / "tests/image"))
from gallery import FINISHED, furnish, pictures_of  # noqa: E402
from pictures import pixels  # noqa: E402

SCENE = """Display "knot.exr" "openexr" "rgb"
Format 192 144 1
PixelSamples 4 4
PixelFilter "box" 1 1
Projection "perspective" "fov" [40]
Translate 0 0 6
Rotate -120 1 0 0
WorldBegin
{lights}
Attribute "visibility" "int diffuse" [1] "int specular" [1] "int transmission" [1]
Surface "{floor}"
Color [0.5 0.5 0.5]
Polygon "P" [-6 -6 -1.2  6 -6 -1.2  6 6 -1.2  -6 6 -1.2]
Color [0.9 0.6 0.3]
Surface {surface}
ReadArchive "knot.rib"
WorldEnd
"""
SKY = 'LightSource "environmentlight" 1 "float samples" [64]\nLightSource "indirectlight" 2'
SURFACES = {"plastic": '"plastic"', "metal": '"disney" "metallic" [1] "roughness" [0.3]',
            "metal, 8 reflections": '"disney" "metallic" [1] "roughness" [0.3] "reflections" [8]',
            "gloss, 8 reflections": '"disney" "roughness" [0.3] "reflections" [8]',
            "mirror": '"shinymetal" "texturename" ["raytrace"] "roughness" [0.1]', "glass": '"glass"'}


def knot(around=240, across=32, radius=0.35):
    """Returns a trefoil as RIB."""
    def middle(t):
        r = 2 + math.cos(3 * t)
        return (r * math.cos(2 * t) / 2, r * math.sin(2 * t) / 2, math.sin(3 * t) / 1.6)

    def unit(v):
        length = math.sqrt(sum(x * x for x in v))
        return tuple(x / length for x in v)

    def cross(a, b):
        return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])
    points, normals, faces = [], [], []
    for i in range(around):
        t, step = 2 * math.pi * i / around, 1e-3
        a, m, b = middle(t - step), middle(t), middle(t + step)
        along = unit(tuple(y - x for x, y in zip(a, b)))
        side = unit(cross(along, tuple(x + y - 2 * z for x, y, z in zip(a, b, m))))
        up = cross(side, along)
        for j in range(across):
            v = 2 * math.pi * j / across
            normals.append(tuple(math.cos(v) * x + math.sin(v) * y for x, y in zip(up, side)))
            points.append(tuple(x + radius * n for x, n in zip(m, normals[-1])))
            faces += [(k % around) * across + n % across for k, n in ((i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1))]

    def numbers(rows):
        return " ".join(f"{x:.5f}" for row in rows for x in row)
    return (f"PointsPolygons [{' '.join(['4'] * (around * across))}] [{' '.join(map(str, faces))}] "
            f'"P" [{numbers(points)}] "N" [{numbers(normals)}]\n')


def render(program, folder, *arguments):
    """Renders and returns CPU seconds."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    code = subprocess.run([program, "render", *arguments, "-q"], cwd=folder).returncode
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    assert code in (0, 3), arguments
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def noise(a, b, mask):
    """Returns the noise in the pixels that `mask` lists. Colours above 1 count as 1."""
    pairs = [(min(x, 1), min(y, 1)) for p in mask for x, y in zip(a[p][:3], b[p][:3])]
    return math.sqrt(sum((x - y) ** 2 for x, y in pairs) / len(pairs) / 2) / (sum(x + y for x, y in pairs) / len(pairs) / 2)


def compare(programs, folder, mask, scenes, *options):
    """Prints a row for each scene of {surface: text}, the first of which others are compared with. Of two runs, the least CPU time counts."""
    print(f"{'surface':24}" + "".join(f"{'CPU s':>10}{'noise':>9}{'equal':>8}" for _ in programs))
    first = {}
    for name, text in scenes.items():
        (folder / "scene.rib").write_text(text)
        cost = {program: [] for program in programs}
        for k in (1, 2):
            for n, program in enumerate(programs):
                cost[program].append(render(program, folder, "scene.rib", "--light-seed", str(k), "-o", f"{n}-{k}.exr", *options))
        line = f"{name:24}"
        for n, program in enumerate(programs):
            found = noise(pixels(folder / f"{n}-1.exr"), pixels(folder / f"{n}-2.exr"), mask)
            effort = min(cost[program]) * found ** 2
            line += f"{min(cost[program]):10.1f}{100 * found:8.2f}%{effort / first.setdefault(program, effort):8.2f}"
        print(line, flush=True)


def knots(programs, folder):
    (folder / "knot.rib").write_text(knot())
    (folder / "mask.rib").write_text(SCENE.format(lights="", floor="null", surface='"constant"'))
    render(programs[0], folder, "mask.rib", "-o", "mask.exr")
    mask = [p for p, v in pixels(folder / "mask.exr").items() if v[0] > 0.8]
    compare(programs, folder, mask, {name: SCENE.format(lights=SKY, floor="matte", surface=surface) for name, surface in SURFACES.items()})


def materials(programs, folder):
    def balls(text, surface, *, lights=True):
        table, rest = text.split("TransformBegin # back row")
        rest = re.sub(r"^ *(Color|Displacement|Attribute \"displacementbound\") .*", "", re.sub(r'Surface .*', f"Surface {surface}", rest), flags=re.M)
        if not lights:
            table = re.sub(r"AttributeBegin\n    Attribute \"visibility\" \"int camera\" .*?AttributeEnd|LightSource.*?$|Illuminate.*?$|Imager.*?$", "", table, flags=re.M | re.S)
            table = table.replace('"matte"', '"null"').replace("[0.75 0.25 0.12]", "[1 1 1]")
        return f"{table}TransformBegin # back row{rest}"
    text = (ROOT / "scenes/shading/materials.rib").read_text().replace("../../docs", str(ROOT / "docs"))
    small = ("--format", "240x150", "--one-picture")
    (folder / "mask.rib").write_text(balls(text, '"constant"', lights=False))
    render(programs[0], folder, "mask.rib", "-o", "mask.exr", *small)
    mask = [p for p, v in pixels(folder / "mask.exr").items() if v[0] > 0.8]
    compare(programs, folder, mask, {name: balls(text, surface) for name, surface in SURFACES.items()}, *small)


def fireflies(picture, other):
    def bright(pixels_of, p):
        return sum(pixels_of[p][:3])

    def stands_out(p):
        around = [bright(picture, (p[0] + dx, p[1] + dy)) for dx in range(-2, 3) for dy in range(-2, 3) if (p[0] + dx, p[1] + dy) in picture]
        return bright(picture, p) > 10 * statistics.median(around) > 1e-4
    found = {p: round(bright(picture, p), 3) for p in picture if stands_out(p)}
    return len(found), {p: value for p, value in found.items() if bright(picture, p) > 2 * bright(other, p)}


def gallery(program, parts):
    finished = {ROOT / f"scenes/{name}/{name}.rib" for name in FINISHED}
    for path in sorted({*(ROOT / "scenes").glob("*/*.rib"), *finished}):
        if parts and not any(part in str(path) for part in parts):
            continue
        for picture in pictures_of(path, ROOT):
            with tempfile.TemporaryDirectory() as name:
                folder = pathlib.Path(name)
                shutil.copytree(path.parent, folder, dirs_exist_ok=True)
                furnish(program, ROOT, picture.text, folder)
                (folder / "maps.rib").write_text(picture.maps)
                (folder / "scene.rib").write_text(picture.text)
                if picture.maps:
                    render(program, folder, "maps.rib")
                for seed in "12":
                    render(program, folder, "scene.rib", "--light-seed", seed, "-o", f"{seed}.exr", "--format", "192x144", "--one-picture", *picture.options)
                    shutil.rmtree(folder / "maps", ignore_errors=True)  # Photon maps would be used as they are.
                bright, chance = fireflies(*(pixels(folder / f"{seed}.exr") for seed in "12"))
            print(f"{picture.name}: {bright}, of which by chance {len(chance)} {chance or ''}", flush=True)


programs = [str(pathlib.Path(p).resolve()) for p in sys.argv[1:] if p != "--materials"]
if "--gallery" in sys.argv:
    gallery(programs[0], sys.argv[3:])
else:
    with tempfile.TemporaryDirectory() as place:
        (materials if "--materials" in sys.argv else knots)(programs, pathlib.Path(place))
