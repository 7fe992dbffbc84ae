"""Tests that the openings of a sky behind a window are found: less noise, the same light, one message, and the same bits by way
of a shot. The search can be switched off."""
import pathlib
import re
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "image"))
from pictures import pixels  # noqa: E402
from program import Suite  # noqa: E402

t = Suite()


def room(option="", portals="", depth=4):
    """Returns a room of 4 x 3 x `depth` around the eye, with a window of 1 x 1 in the far wall."""
    walls = [((-2, -1.5, -1), (2, -1.5, -1), (2, 1.5, -1), (-2, 1.5, -1))] * (depth > 0)
    walls += [((-2, -1.5, -1), (-2, -1.5, 4), (-2, 1.5, 4), (-2, 1.5, -1)), ((2, -1.5, -1), (2, -1.5, 4), (2, 1.5, 4), (2, 1.5, -1)),
              ((-2, -1.5, -1), (2, -1.5, -1), (2, -1.5, 4), (-2, -1.5, 4)), ((-2, 1.5, -1), (2, 1.5, -1), (2, 1.5, 4), (-2, 1.5, 4))] * (depth > 0)
    for (x, X), (y, Y) in (((-2, 2), (-1.5, -0.5)), ((-2, 2), (0.5, 1.5)), ((-2, 0.5), (-0.5, 0.5)), ((1.5, 2), (-0.5, 0.5))):
        walls.append(((x, y, 4), (X, y, 4), (X, Y, 4), (x, Y, 4)))
    polygons = "\n".join(f'Polygon "P" [{" ".join(str(v) for p in w for v in p)}]' for w in walls)
    return f"""Format 48 36 1 PixelSamples 2 2 PixelFilter "box" 1 1 Projection "perspective" "fov" [80] Display "room.exr" "openexr" "rgb" {option} WorldBegin
TransformBegin Translate 1 0 4 CoordinateSystem "window" TransformEnd
Attribute "light" "shadows" "on" LightSource "environmentlight" "sky" "intensity" [3] "samples" [32] {portals}
Sides 2 Surface "matte"
{polygons}
WorldEnd
"""


def picture(scene, *arguments):
    t.write("room.rib", scene)
    said = t.run("room.rib", "-o", "room.exr", *arguments).stderr
    return {at: value[0] for at, value in pixels(t.folder / "room.exr").items()}, said


def noise(values, truth):
    return sum((v - truth[at]) ** 2 for at, v in values.items()) ** 0.5 / len(values)


truth, _ = picture(room(), "--light-samples", "4096")
found, said = picture(room())
off, silent = picture(room('Option "trace" "int openings" [0]'))
named, quiet = picture(room(portals='"string portals" ["window"]'))
t.expect(re.search(r'note: light "sky": rays have found an opening of (1|1\.0\d|0\.99\d) x (1|1\.0\d|0\.99\d) at \((1|1\.0\d|0\.99\d), .*, 4\); .*\[light-openings\]', said) is not None,
         f"the opening is told: {said}")
t.expect("light-openings" not in silent + quiet, "nothing is told where it is switched off, or where a portal is named")
mean = [sum(p.values()) for p in (truth, found, off)]
t.expect(abs(mean[1] / mean[0] - 1) < 0.02, f"the light is the same: {mean}")
errors = [noise(p, truth) for p in (found, off, named)]
t.expect(errors[0] < 0.4 * errors[1], f"there is less noise: {errors}")
# The border of the found opening is not exactly the border of the window, so some samples meet the wall.
t.expect(errors[0] < 2 * errors[2], f"not much more than with a named portal: {errors}")
_, open_air = picture(room(depth=0))
t.expect("light-openings" not in open_air, "a wall in the open has none")

t.write("room.rib", room())
t.run("room.rib", "-o", "whole.exr", "--gi", "gather", "-t", "1")
t.run("hide", "room.rib", "-o", "shot.dfb", "--gi", "gather")
t.run("gather", "shot.dfb", "-o", "shot.icf", "--gi", "gather")
t.run("shade", "shot.dfb", "--irradiance", "shot.icf", "-o", "shot.exr")
t.expect(pixels(t.folder / "whole.exr") == pixels(t.folder / "shot.exr"), "by way of a shot the picture is the same")
t.run("room.rib", "-o", "part.exr", "--gi", "none", "--crop", "0.25,0.5,0.25,0.75", "-t", "2", "--bucket-size", "16")
t.run("room.rib", "-o", "all.exr", "--gi", "none")
part, whole = pixels(t.folder / "part.exr"), pixels(t.folder / "all.exr")
inside = [(x, y) for x in range(12, 24) for y in range(9, 27)]
t.expect(any(part[at][0] > 0 for at in inside) and all(whole[at] == part[at] for at in inside), "a crop has the pixels of the whole")
t.finish()
