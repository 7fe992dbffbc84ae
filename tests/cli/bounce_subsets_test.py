"""Tests that an object whose rays see nothing (Attribute "grouping" "tracesubset") takes no light from later bounces of other objects."""
import pathlib
import sys

from program import Suite

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "image"))
from pictures import pixels  # noqa: E402

t = Suite()
SPHERE = """Format 16 16 1
PixelSamples 2 2
Display "{name}.exr" "openexr" "rgb"
Projection "perspective" "fov" [90]
WorldBegin
LightSource "indirectlight" "gi" "float samples" [256] "float bounces" [5]
LightSource "pointlight" "bulb" "intensity" [1]
Surface "matte" "Ka" [0] "Kd" [1]
Color [0.8 0.8 0.8]
{objects}
WorldEnd
"""
DISK = 'AttributeBegin\nAttribute "grouping" "tracesubset" ["nothing"]\nTranslate 0 0 0.8\nDisk 0 0.1 360\nAttributeEnd\n'
BALL = "Sphere 1 -1 1 360\n"


def edge(name, objects):
    """Returns the mean of the pixels of the border, which show the sphere."""
    t.write(name + ".rib", SPHERE.format(name=name, objects=objects))
    t.expect_run(name, [name + ".rib", "--gi", "gather"], 0, "gather-bounces")
    seen = [p[0] for (x, y), p in pixels(t.folder / (name + ".exr")).items() if x in (0, 15) or y in (0, 15)]
    return sum(seen) / len(seen)


first, last = edge("first", DISK + BALL), edge("last", BALL + DISK)
t.expect(abs(first - last) < 0.03 * last, f"the sphere is as bright if that object comes first: {first:.4f}, {last:.4f}")
t.finish()
