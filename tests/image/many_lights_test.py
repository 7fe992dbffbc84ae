"""Compares many lamps, of which each point runs only a few (Option "trace" "lightcut"), with closed forms, with all lamps, and over threads and
crops."""
import pathlib
import subprocess
import sys
import tempfile

from pictures import pixels

tomales = sys.argv[1]
failures = []
SIZE, SIDE, HEIGHT = 24, 20, 1.5
HEAD = """Format {size} {size} 1
PixelSamples 1 1
PixelFilter "box" 1 1
ShadingRate 0.25
Display "out.exr" "file" "rgb"
Projection "orthographic"
ScreenWindow -3 3 -3 3
{option}
Rotate -90 1 0 0
Translate 0 -5 0
WorldBegin
Attribute "light" "shadows" "on"
"""
FLOOR = 'Surface "matte"\nReverseOrientation\nPatch "bilinear" "P" [-9 0 -9 9 0 -9 -9 0 9 9 0 9]\n'
BALLS = "".join(f"TransformBegin Translate {x} 0.4 {z} Sphere 0.4 -0.4 0.4 360 TransformEnd\n" for x in (-2, 0, 2) for z in (-1.5, 1))


def expect(condition, message):
    print(("ok      " if condition else "FAILED  ") + message)
    if not condition:
        failures.append(message)


def places():
    return [(6 * (i + 0.5) / SIDE - 3, HEIGHT, 6 * (j + 0.5) / SIDE - 3) for i in range(SIDE) for j in range(SIDE)]


def points(extra=""):
    return "".join(f'LightSource "pointlight" {k} "float intensity" [{0.01 + 0.0001 * (k % 50)}] "point from" [{x} {y} {z}] {extra}\n'
                   for k, (x, y, z) in enumerate(places()))


def areas():
    h = 0.05
    return "".join(f'AttributeBegin\nAreaLightSource "arealight" {k} "float intensity" [{3 + 0.01 * (k % 50)}] "float samples" [4] "float visible" [0]\n'
                   f'Patch "bilinear" "P" [{x - h} {y} {z - h} {x + h} {y} {z - h} {x - h} {y} {z + h} {x + h} {y} {z + h}]\nAttributeEnd\nIlluminate {k} 1\n'
                   for k, (x, y, z) in enumerate(places()))


def render(folder, lamps, world, *options, option="", name="out.exr"):
    text = HEAD.format(size=SIZE, option=option) + lamps + world + "WorldEnd\n"
    (folder / "scene.rib").write_text(text)
    done = subprocess.run([tomales, "render", "scene.rib", "-q", "-o", name, *options], cwd=folder, capture_output=True, text=True)
    expect(done.returncode == 0 and not done.stderr, f"renders without a message {done.stderr[:300]}")
    return pixels(folder / name)


def mean_error(a, b):
    return sum(abs(a[p][0] - b[p][0]) / (b[p][0] + 0.001) for p in b) / len(b)


def mean(picture):
    return sum(v[0] for v in picture.values()) / len(picture)


with tempfile.TemporaryDirectory() as name:
    folder = pathlib.Path(name)
    few, all_of_them = 'Option "trace" "int lightcut" [24]', 'Option "trace" "int lightcut" [0]'

    drawn = render(folder, points(), FLOOR, option=few)
    errors, light = [], []
    for (px, py), color in drawn.items():
        x, z = 6 * (px + 0.5) / SIZE - 3, 3 - 6 * (py + 0.5) / SIZE
        exact = sum((0.01 + 0.0001 * (k % 50)) * y / ((lx - x) ** 2 + y * y + (lz - z) ** 2) ** 1.5 for k, (lx, y, lz) in enumerate(places()))
        errors.append(color[0] / exact - 1)
    bias = sum(errors) / len(errors)
    spread = (sum((e - bias) ** 2 for e in errors) / len(errors)) ** 0.5
    expect(abs(bias) < 3 * spread / len(errors) ** 0.5 + 0.001, f"the mean is that of the sum over all lamps: {100 * bias:.2f} % off, spread {100 * spread:.2f} %")
    expect(0.0001 < spread < 0.04, f"24 of {SIDE * SIDE} lamps are within 4 % at each pixel: {100 * spread:.2f} %")

    for lamps, kind in ((points(), "point lights"), (areas(), "area lights")):
        for surface in ("matte", "plastic"):
            world = FLOOR.replace("matte", surface) + BALLS
            truth = render(folder, lamps, world, option=all_of_them)
            drawn = render(folder, lamps, world, option=few)
            expect(abs(mean(drawn) / mean(truth) - 1) < 0.005, f"{kind} on {surface}: the mean of the picture stays ({100 * (mean(drawn) / mean(truth) - 1):.2f} %)")
            expect(0 < mean_error(drawn, truth) < 0.05, f"{kind} on {surface}: {100 * mean_error(drawn, truth):.2f} % from all lamps")
            # Half of the lamps come after the floor and shine only on the balls. Floor and balls draw lamps from the same tree.
            middle = lamps.rindex("AttributeBegin" if "Area" in lamps else "LightSource", 0, lamps.index(f'light" {SIDE * SIDE // 2} "'))
            split = lamps[:middle] + FLOOR.replace("matte", surface) + lamps[middle:] + BALLS
            half, drawn = render(folder, split, "", option=all_of_them), render(folder, split, "", option=few)
            expect(mean(half) < 0.8 * mean(truth), f"{kind} on {surface}: later lamps do not light the floor")
            expect(abs(mean(drawn) / mean(half) - 1) < 0.005, f"{kind} on {surface}: nor when some are drawn ({100 * (mean(drawn) / mean(half) - 1):.2f} % off)")
            expect(0 < mean_error(drawn, half) < 0.05, f"{kind} on {surface}: {100 * mean_error(drawn, half):.2f} % from all that light it")

    world = FLOOR + BALLS
    one = render(folder, areas(), world, "-t", "1", option=few)
    expect(one == render(folder, areas(), world, "-t", "3", option=few + ' Option "limits" "bucketsize" [8 8]'), "threads and buckets leave no trace")
    crop = render(folder, areas(), world, "--crop", "0.25,0.75,0.25,0.75", option=few)
    inside = [p for p, v in crop.items() if v[0] != 0]
    expect(len(inside) > 50 and all(crop[p] == one[p] for p in inside), "a crop has the same bits")

    few_lamps = "".join(points().splitlines(True)[:48])
    expect(render(folder, few_lamps, world, option=few) == render(folder, few_lamps, world, option=all_of_them), "few lamps all run")
    truth = render(folder, points(), world, option=all_of_them)
    groups = render(folder, points(), world, option=few + '\nDisplayChannel "color seventh" "string source" ["lightgroup:7"]\nDisplay "+g.exr" "openexr" "seventh"')
    expect(groups == truth, "where the light of a group is asked for, all lamps run")
    marked = render(folder, points('"string __category" ["street"] "float __nonspecular" [1]'), world, option=few)
    expect(abs(mean(marked) / mean(truth) - 1) < 0.005, "lamps of a category and without highlights are drawn from too")

print(f"{len(failures)} failed")
sys.exit(bool(failures))
