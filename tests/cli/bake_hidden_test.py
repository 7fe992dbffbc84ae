"""Tests that bake3d() stores points that the camera does not see, as Attribute "cull" asks."""
import math
import pathlib
import struct
import sys

from program import Suite

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "image"))
from pictures import pixels  # noqa: E402

t = Suite()
t.write("bakes.sl", 'surface bakes() { bake3d("points.ptc", "", P, normalize(N), "_area", area(P)); Ci = Cs * abs(normalize(N).normalize(I)); Oi = Os; }')
SCENE = """Display "{name}.exr" "file" "rgb"
Format 64 64 1
PixelSamples 2 2
Projection "perspective" "fov" [40]
WorldBegin
Attribute "dice" "rasterorient" [0]
{cull}
Sides {sides}
Surface "bakes"
Translate 0 0 4
{shapes}
WorldEnd
"""
BALL = "Sphere 1 -1 1 360\n"
WALL = 'AttributeBegin\nAttribute "cull" "hidden" [1]\nSurface "constant"\nPolygon "P" [-2 -2 -2  2 -2 -2  2 2 -2  -2 2 -2]\nAttributeEnd\n'


def baked(name, cull="", sides=2, shapes=BALL, arguments=()):
    """Returns the area of all points, and the bytes of the file."""
    t.write(name + ".rib", SCENE.format(name=name, cull=f'Attribute "cull" {cull}' if cull else "", sides=sides, shapes=shapes))
    t.expect_run(name, [name + ".rib", *arguments], 0)
    t.expect_run(f"{name}, as PLY", ["convert", "points.ptc", "points.ply"], 0)
    header, body = (t.folder / "points.ply").read_bytes().split(b"end_header\n", 1)
    width = header.count(b"property float")
    values = struct.unpack(f"<{len(body) // 4}f", body)
    return sum(values[width - 1::width]), (t.folder / "points.ptc").read_bytes()


def near(what, got, expected):
    t.expect(abs(got - expected) < 0.02 * expected, f"{what}: {got:.3f}, expected {expected:.3f}")


all_of_it = 4 * math.pi
# From four radii away the eye sees (1 - 1/4) / 2 of a ball.
seen, _ = baked("seen")
t.expect(0.25 * all_of_it < seen < 0.38 * all_of_it, f"without it, what samples of the eye meet alone: {seen:.2f}")
whole, bytes_of_whole = baked("whole", '"hidden" [0]')
near("all of a ball, however little of it is seen", whole, all_of_it)
near("all of a ball behind a wall", baked("behind", '"hidden" [0]', shapes=WALL + BALL)[0], all_of_it)
near("what faces the eye of a one-sided ball", baked("one_sided", '"hidden" [0]', 1)[0], 0.375 * all_of_it)
near("all of a one-sided ball", baked("facing_away", '"hidden" [0] "backfacing" [0]', 1)[0], all_of_it)
TRIM = "TrimCurve [1] [2] [0 0 1 2 3 4 4] [0] [4] [5] [.5 1.5 1.5 .5 .5] [.5 .5 1.5 1.5 .5] [1 1 1 1 1]\n"
SHEET = 'NuPatch 3 2 [0 0 1 2 2] 0 2 3 2 [0 0 1 2 2] 0 2 "P" [-1 -1 0  0 -1 0  1 -1 0  -1 0 0  0 0 0  1 0 0  -1 1 0  0 1 0  1 1 0]\n'
near("all of a trimmed sheet of four patches behind a wall", baked("trimmed", '"hidden" [0]', shapes=WALL + "ShadingRate .1\n" + TRIM + SHEET)[0], 3)
far_below = "Translate 0 -9 0 " + BALL
t.expect(not baked("outside", '"hidden" [0]', shapes=BALL + far_below)[0] > 1.01 * all_of_it, "but nothing outside the picture")

t.expect(pixels(t.folder / "seen.exr") == pixels(t.folder / "whole.exr"), "the picture has the same bits")
for arguments in (("--bucket-size", "8"), ("-t", "3")):
    t.expect(baked("again", '"hidden" [0]', arguments=arguments)[1] == bytes_of_whole, f"and so have the points, with {' '.join(arguments)}")
# A micropolygon on the border of two buckets is shaded in both.
square = 'Polygon "P" [-1 -1 0  1 -1 0  1 1 0  -1 1 0]\n'
near("each micropolygon once, in small buckets", baked("once", shapes=square, arguments=("--bucket-size", "8"))[0], 4)
t.finish()
