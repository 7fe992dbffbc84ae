"""Tests that occlusion() and indirectdiffuse() of RSL are interpolated between records where the scene allows it, and are right."""
import json
import math
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "image"))
from pictures import pixels  # noqa: E402
from program import Suite  # noqa: E402

t = Suite()
SIZE = 96
HEIGHT = 1.5
# The camera sees a floor from -2 to 2 from above, with x to the right and y up. A glowing square of side 2 hangs before it. The eye looks through the
# square and does not see it.
SCENE = """Format %d %d 1
PixelFilter "box" 1 1
PixelSamples 2 2
ScreenWindow -2 2 -2 2
Translate 0 0 10
WorldBegin
%s
AttributeBegin
Attribute "visibility" "int camera" [0]
Surface "constant"
Color [1 .5 .25]
Patch "bilinear" "P" [-1 -1 -%g  1 -1 -%g  -1 1 -%g  1 1 -%g]
AttributeEnd
Patch "bilinear" "P" [-2 2 0  2 2 0  -2 -2 0  2 -2 0]
WorldEnd
"""


def corner(x, y):
    """Returns the share of light that a rectangle at HEIGHT brings to the point below one of its corners (Howell, B-3)."""
    a, b = x / HEIGHT, y / HEIGHT
    root_a, root_b = math.sqrt(1 + a * a), math.sqrt(1 + b * b)
    return (a / root_a * math.atan(b / root_a) + b / root_b * math.atan(a / root_b)) / (2 * math.pi)


def covered(x, y):
    return sum(corner(u, v) for u in (1 - x, 1 + x) for v in (1 - y, 1 + y))


TRUTH = {(i, j): covered(4 * (i + .5) / SIZE - 2, 2 - 4 * (j + .5) / SIZE) for i in range(SIZE) for j in range(SIZE)}


def render(name, shader, attributes="", *arguments):
    """Returns the picture and the number of rays."""
    t.write("floor.sl", f"surface floor() {{ normal n = faceforward(normalize(N), I); {shader} Oi = 1; }}\n")
    text = SCENE % (SIZE, SIZE, attributes + '\nSurface "floor"', *[HEIGHT] * 4)
    t.write("floor.rib", text)
    t.expect_run(name, ["floor.rib", "-o", "floor.exr", "--stats", "stats.json", *arguments], 0)
    return pixels(t.folder / "floor.exr"), json.loads((t.folder / "stats.json").read_text())["rays"]["gather"]


def expect(name, picture, rays, few, mean, most, channel=0, scale=1):
    """Compares with TRUTH. `few` says whether fewer than four rays per pixel are expected for records."""
    off = [abs(picture[k][channel] - scale * TRUTH[k]) for k in TRUTH]
    bias = sum(picture[k][channel] - scale * TRUTH[k] for k in TRUTH) / len(TRUTH)
    t.expect(abs(bias) < 0.002 and sum(off) / len(off) < mean and max(off) < most,
             f"  {name} (bias {bias:.4f}, mean error {sum(off) / len(off):.4f}, most {max(off):.4f})")
    t.expect(few == (rays < 30 * SIZE * SIZE), f"  by {rays / SIZE ** 2:.1f} rays a pixel")


BOUNCED = "Ci = indirectdiffuse(P, n, 300);"
OCCLUDED = "Ci = occlusion(P, n, 300);"
ALLOWED, FORBIDDEN = 'Attribute "irradiance" "float maxerror" [1]', 'Attribute "irradiance" "float maxerror" [0]'

picture, rays = render("bounced light", BOUNCED)
expect("is interpolated by default", picture, rays, True, 0.004, 0.03)
t.expect(all(abs(picture[k][2] - picture[k][0] / 4) < 1e-3 for k in TRUTH), "  and has the square's colour")
expect("maxerror 0 traces it at every point", *render("  without an error", BOUNCED, FORBIDDEN), False, 0.01, 0.08)
expect("so does --max-error 0", *render("  for the truth", BOUNCED, "", "--max-error", "0"), False, 0.01, 0.08)
expect("an occlusion of its own is interpolated with it", *render("  with occlusion", "float o; Ci = indirectdiffuse(P, n, 300, \"occlusion\", o); Ci = color(o, 0, 0);"),
       True, 0.006, 0.05)
expect("of few rays has no blotches", *render("  few samples", "Ci = indirectdiffuse(P, n, 16);"), True, 0.006, 0.04)
expect("is asked under a condition too", *render("  a condition", "if (u < 2) Ci = indirectdiffuse(P, n, 300); else Ci = 1;"), True, 0.004, 0.03)

expect("is traced unless the scene allows an error", *render("occlusion", OCCLUDED), False, 0.01, 0.08)
expect("maxerror allows one", *render("  with maxerror", OCCLUDED, ALLOWED), True, 0.008, 0.06)
expect("maxvariation allows one", *render("  with maxvariation", 'Ci = occlusion(P, n, 300, "maxvariation", .02);'), True, 0.006, 0.05)
expect("and forbids it", *render("  with maxvariation 0", 'Ci = occlusion(P, n, 300, "maxvariation", 0);', ALLOWED), False, 0.01, 0.08)
expect("a cone is not the hemisphere", *render("  of a cone", 'Ci = occlusion(P, n, 300, "coneangle", 1.55, "maxvariation", .02);'), False, 0.01, 0.08)
moved = render("  from another place", 'Ci = indirectdiffuse(P + .001 * n, n, 300);')
expect("elsewhere than P is traced", *moved, False, 0.01, 0.08)
black, _ = render("  past the limit of depth", BOUNCED, 'Attribute "trace" "int maxdiffusedepth" [0]')
t.expect(max(p[0] for p in black.values()) == 0, "  records are as dark as rays")

# A shot keeps the records, and a message says where an edit has made them old.
LIT = 'LightSource "pointlight" "bulb" "from" [0 0 -1] "intensity" [1]'
WALL = ('AttributeBegin\nAttribute "visibility" "int camera" [0]\nSurface "matte"\n'
        'Patch "bilinear" "P" [2 -2 0  2 2 0  2 -2 -3  2 2 -3]\nAttributeEnd\n')
t.write("floor.sl", f"surface floor() {{ normal n = faceforward(normalize(N), I); {BOUNCED} Oi = 1; }}\n")
t.write("shot.rib", SCENE.replace("AttributeBegin", WALL + "AttributeBegin", 1) % (24, 24, LIT + '\nSurface "floor"', *[HEIGHT] * 4))
t.write("brighter.rib", 'LightSource "pointlight" "bulb" "from" [0 0 -1] "intensity" [9]\n')
t.expect_run("hide", ["hide", "shot.rib", "-o", "shot.dfb"], 0)
t.expect_run("gather", ["gather", "shot.dfb", "-o", "shot.icf", "--max-error", "2"], 0)
said = t.expect_run("shade", ["shade", "shot.dfb", "--irradiance", "shot.icf", "-o", "shot.exr", "--stats", "stats.json"], 0).stderr
t.expect("icf-without-light" not in said and json.loads((t.folder / "stats.json").read_text())["rays"]["gather"] == 0, f"  takes the records as they were gathered ({said[:200]})")
t.expect_run("an edited light", ["shade", "shot.dfb", "--irradiance", "shot.icf", "--edit", "brighter.rib", "-o", "shot.exr"], 0, "light-stale", "bulb")

one, _ = render("on one thread", BOUNCED, "", "-t", "1", "--bucket-size", "16")
two, _ = render("on two", BOUNCED, "", "-t", "2", "--bucket-size", "13")
t.expect(one == two, "  the bits are the same")
t.finish()
