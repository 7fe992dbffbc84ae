"""Tests scenes/rsl: a scene with nine shaders of five kinds in the RenderMan Shading Language beside it."""
import json
import pathlib
import shutil
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "image"))
from pictures import pixels  # noqa: E402
from program import Suite  # noqa: E402

t = Suite()
source = pathlib.Path(__file__).resolve().parent.parent.parent / "scenes" / "rsl"
shaders = sorted(source.glob("*.sl"))
for file in [*shaders, source / "still_life.rib"]:
    shutil.copy(file, t.folder)
t.expect(len(shaders) == 9, f"nine shaders ({len(shaders)})")
result = t.expect_run("compile of all of them", ["compile", *(file.name for file in shaders)], 0)
t.expect(not result.stdout + result.stderr, f"without a message ({result.stderr[:300]})")
small = ["still_life.rib", "--format", "160x120", "--pixel-samples", "2x2"]
result = t.expect_run("the scene", [*small, "-o", "small.exr"], 0)
t.expect(not result.stdout + result.stderr, f"is rendered without a message ({result.stderr[:300]})")
seen = pixels(t.folder / "small.exr")


def mean(x0, y0, x1, y1, picture=seen):
    part = [picture[x, y] for x in range(x0, x1) for y in range(y0, y1)]
    return [sum(p[c] for p in part) / len(part) for c in range(3)]


red, green, blue = mean(84, 34, 110, 54)
t.expect(red > 1.3 * green > 1.3 * blue > 0, "the wall is of red brick")
red, green, blue = mean(70, 66, 92, 84)
t.expect(red > 1.3 * green > 1.3 * blue > 0, "the pot of copper")
stone = mean(36, 46, 52, 62)
t.expect(stone[0] < 1.5 * stone[2] and stone[0] > red, "the ball of a stone without colour, the brightest of all")


def without(request, replacement):
    t.write("less.rib", (t.folder / "still_life.rib").read_text().replace(request, replacement))
    t.expect_run("the scene without " + request, ["less.rib", *small[1:], "-o", "less.exr"], 0)
    return pixels(t.folder / "less.exr")


plain = without('Imager "vignette"', "")
t.expect(abs(seen[80, 60][0] - plain[80, 60][0]) < 0.01 * plain[80, 60][0], "the imager leaves the middle as it is")
for x, y in ((1, 1), (158, 1), (1, 118), (158, 118)):
    t.expect(0.3 < sum(seen[x, y][:3]) / sum(plain[x, y][:3]) < 0.7, f"and darkens the corner {x}, {y}")
clear = without('Atmosphere "dust"', '# "dust"')
t.expect(sum(mean(20, 20, 60, 36)) > 1.2 * sum(mean(20, 20, 60, 36, clear)), "light shows in the air")
parts = {c["name"]: c for c in json.loads(t.run("info", "--json", "small_parts.exr").stdout)["channels"]}
t.expect(set(parts) == {"brick", "which", "vein"}, f"outputs of the shaders are a picture of their own ({sorted(parts)})")
t.expect(abs(parts["brick"]["mean"] - 0.384) < 0.01 and parts["brick"]["max"] <= 1.001, f"with the bricks' share of the picture ({parts['brick']['mean']:.3f})")
t.expect(0.003 < parts["vein"]["mean"] < 0.01 and 0.2 < parts["which"]["mean"] < 0.3, "and what else they tell")
again = t.run(*small, "-o", "again.exr", "-t", "1")
t.expect_run("the same bits on one thread", ["compare", "small.exr", "again.exr"], 0, "different_pixels               0")
t.finish()
