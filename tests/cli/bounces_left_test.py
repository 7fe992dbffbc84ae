"""Tests the message about the light that further bounces would add: in a closed white sphere each bounce has the same share of
the one before."""
import re

from program import Suite

SPHERE = """Format 8 8 1
PixelSamples 2 2
Display "sphere.exr" "openexr" "rgb"
Projection "perspective" "fov" [90]
WorldBegin
LightSource "indirectlight" "gi" "float samples" [256] "float bounces" [%d]
LightSource "pointlight" "bulb" "intensity" [1]
Surface "matte" "Ka" [0] "Kd" [1]
Color [%g %g %g]
Sphere 1 -1 1 360
WorldEnd
"""
t = Suite()


def told(bounces, albedo, *options):
    """Returns the percentage that is left according to the message, or None if there is no message."""
    t.write("sphere.rib", SPHERE % (bounces, albedo, albedo, albedo))
    said = t.expect_run(f"{bounces} bounces, albedo {albedo}", ["sphere.rib", *options], 0).stderr
    found = re.search(r"after (\d+) bounces ([0-9.]+) % .*gather-bounces", said)
    if found:
        t.expect(int(found[1]) == bounces, f"  of {bounces}")
    return float(found[2]) if found else None


for bounces, albedo in ((4, 0.8), (7, 0.8), (5, 0.6)):
    left, truth = told(bounces, albedo), 100 * albedo**bounces
    t.expect(left is not None and abs(left - truth) < 0.1 * truth, f"  what is left is the albedo to the power of bounces: {left} %, {truth:.1f}")
t.expect(told(1, 0.8) is None, "  one bounce alone tells no ratio")
t.expect(told(30, 0.3) is None, "  nothing is left where light has settled")
t.finish()
