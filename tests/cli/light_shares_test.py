"""Tests that gather --by-light keeps the bounced light of each light, so that shade --edit dims and colours lights with all their
bounced light."""
import pathlib
import sys

from program import Suite

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "image"))
from pictures import pixels  # noqa: E402

ROOM = """Display "room.exr" "openexr" "rgba"
Format 40 40 1
PixelSamples 2 2
Projection "perspective" "fov" [60]
Translate 0 0 1.4
WorldBegin
LightSource "indirectlight" "gi" "float samples" [128] "float bounces" [3]
Attribute "light" "shadows" ["on"]
LightSource "pointlight" "key" "from" [0.5 0.6 -0.3] "intensity" [%s] "lightcolor" [%s]
LightSource "spotlight" "rim" "from" [-0.8 0.8 0] "to" [0.5 -1 0] "intensity" [1] "coneangle" [%s]
Attribute "identifier" "name" ["walls"]
Surface "matte"
Color [0.7 0.6 0.5]
Polygon "P" [-1 -1 -1 1 -1 -1 1 -1 1 -1 -1 1]
Polygon "P" [-1 -1 1 1 -1 1 1 1 1 -1 1 1]
Color [0.7 0.1 0.1]
Polygon "P" [-1 -1 -1 -1 -1 1 -1 1 1 -1 1 -1]
Attribute "identifier" "name" ["ball"]
Surface "plastic"
Translate 0.3 -0.6 0.3
Sphere 0.4 -0.4 0.4 360
WorldEnd
"""
suite = Suite()


def picture(name):
    return pixels(suite.folder / name)


def off(name, truth):
    """Returns the mean difference of two pictures as a share of the second."""
    a, b = picture(name), picture(truth)
    return sum(abs(x - y) for p in b for x, y in zip(a[p][:3], b[p][:3])) / sum(sum(v[:3]) for v in b.values())


def shade(picture, *options):
    return ["shade", "room.dfb", "-o", picture, *options]


suite.write("room.rib", ROOM % ("1", "1 1 1", "0.5"))
suite.run("hide", "room.rib", "-o", "room.dfb", "-q")
suite.expect_run("light is gathered by lights", ["gather", "room.dfb", "-o", "room.icf", "--by-light"], 0)
suite.run("gather", "room.dfb", "-o", "plain.icf", "-q")
suite.run("render", "room.rib", "-o", "render.exr", "-q")
for cache in ("room", "plain"):
    suite.run(*shade(f"{cache}.exr", "--irradiance", f"{cache}.icf", "-q"))
    suite.expect(picture(f"{cache}.exr") == picture("render.exr"), f"shaded with {cache}.icf the picture has the bits of render")

suite.write("dim.rib", 'LightSource "pointlight" "key" "intensity" [0.2] "lightcolor" [1 0.5 0.1]\n')
suite.write("dim_room.rib", ROOM % ("0.2", "1 0.5 0.1", "0.5"))
suite.run("render", "dim_room.rib", "-o", "truth.exr", "-q")
dimmed = suite.expect_run("a dimmed and coloured light", shade("dim.exr", "--irradiance", "room.icf", "--edit", "dim.rib"), 0)
suite.expect("light-stale" not in dimmed.stderr, "brings what it bounces along, so nothing is stale")
suite.expect(off("dim.exr", "truth.exr") < 0.015, f"as if gathered anew: {100 * off('dim.exr', 'truth.exr'):.2f} % off")
suite.expect_run("without shares it is stale", shade("stale.exr", "--irradiance", "plain.icf", "--edit", "dim.rib"), 0, "light-stale")
suite.expect(off("stale.exr", "truth.exr") > 0.1, f"and wrong: {100 * off('stale.exr', 'truth.exr'):.0f} % off")

# Light that is gathered after the edit already belongs to the edited lamp, whether or not the file keeps the rest.
suite.write("bright.rib", 'LightSource "pointlight" "key" "intensity" [5]\n')
suite.write("bright_room.rib", ROOM % ("5", "1 1 1", "0.5"))
suite.run("render", "bright_room.rib", "-o", "bright_truth.exr", "-q")
suite.run("gather", "room.dfb", "-o", "half.icf", "--by-light", "--crop", "0,0.5,0,1", "-q")
suite.expect_run("records of one half", shade("half.exr", "--irradiance", "half.icf", "--edit", "bright.rib"), 0)
suite.expect(off("half.exr", "bright_truth.exr") < 0.015,
             f"the other half is gathered while it is shaded: {100 * off('half.exr', 'bright_truth.exr'):.2f} % off")
suite.run("gather", "room.dfb", "-o", "mended.icf", "--irradiance", "room.icf", "--crop", "0,0.5,0,1", "--edit", "dim.rib", "-q")
mended = suite.expect_run("one half gathered anew", shade("mended.exr", "--irradiance", "mended.icf", "--edit", "dim.rib"), 0)
suite.expect("light-stale" not in mended.stderr and off("mended.exr", "truth.exr") < 0.015,
             f"and the other as dim as the lamp: {100 * off('mended.exr', 'truth.exr'):.2f} % off")

# Two pictures of one light each add up to the picture of both.
for name, other in (("key", "spotlight\" \"rim"), ("rim", "pointlight\" \"key")):
    suite.write(f"{name}.rib", f'LightSource "{other}" "intensity" [0]\n')
    suite.run(*shade(f"{name}.exr", "--irradiance", "room.icf", "--edit", f"{name}.rib", "-q"))
key, rim, both = picture("key.exr"), picture("rim.exr"), picture("room.exr")
worst = max(abs(key[p][c] + rim[p][c] - both[p][c]) for p in both for c in range(3))
suite.expect(worst < 2e-5, f"the pictures of one light each add up to that of both ({worst:.1e})")

# The bounced light of a lamp does not follow it to another place, but goes out with it there.
suite.write("away.rib", 'LightSource "pointlight" "key" "from" [-0.5 0.6 -0.3] "intensity" [0]\n')
suite.expect_run("a light that is moved and put out", shade("away.exr", "--irradiance", "room.icf", "--edit", "away.rib"), 0, "light-stale", '"key"')
suite.expect(picture("away.exr") == rim, "brings nothing")

suite.write("cone.rib", 'LightSource "spotlight" "rim" "coneangle" [0.3]\n')
suite.expect_run("another cone is no factor", shade("cone.exr", "--irradiance", "room.icf", "--edit", "cone.rib"), 0, "light-stale", '"rim"')
suite.run("gather", "room.dfb", "-o", "part.icf", "--irradiance", "room.icf", "--crop", "0,0.5,0,1", "--edit", "cone.rib", "-q")
suite.expect_run("nor in one half", shade("part.exr", "--irradiance", "part.icf", "--edit", "cone.rib"), 0, "light-stale", '"rim"')
suite.run("gather", "room.dfb", "-o", "cone.icf", "--edit", "cone.rib", "-q")
fresh = suite.run(*shade("cone.exr", "--irradiance", "cone.icf", "--edit", "cone.rib"))
suite.expect("light-stale" not in fresh.stderr, "records that were gathered with the edit are not stale")
suite.expect_run("records without shares do not get some", ["gather", "room.dfb", "-o", "more.icf", "--irradiance", "plain.icf", "--by-light"], 0, "light-shares")
suite.expect_run("nor do maps", ["gather", "room.dfb", "-o", "more.icf", "--gi", "radiosity", "--by-light"], 0, "light-shares")
suite.finish()
