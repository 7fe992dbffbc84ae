"""Tests highlights of indirect light by paths along the lobe (--gi reference): a filter light dims them, and a normal that turns away from
the eye gets no more than the integral of the lobe."""
import math
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "image"))
from pictures import pixels  # noqa: E402
from program import Suite  # noqa: E402

t = Suite()
# Everything around shines with radiance 1.
DOME = 'AttributeBegin Color 1 1 1 Surface "constant" Sphere 50 -50 50 360 AttributeEnd\n'
SCENE = """Format 24 24 1 PixelFilter "box" 1 1 PixelSamples 1 1 Projection "perspective" "fov" [20] Display "x.exr" "openexr" "rgb"
WorldBegin
%s
AttributeBegin %s AttributeEnd
WorldEnd
"""


def mean(name, lights, body, *arguments):
    t.write(name + ".rib", SCENE % (lights + DOME, body))
    t.expect_run(name, [name + ".rib", "-o", name + ".exr", *arguments], 0)
    values = [p[0] for p in pixels(t.folder / (name + ".exr")).values()]
    return sum(values) / len(values)


BALL = 'Surface "plastic" "Kd" [0] "Ks" [1] "roughness" [0.3] Translate 0 0 4 Sphere 2 -2 2 360'
FILTERED = ('LightSource "indirectlight" "source" "samples" [64] Illuminate "source" 0\n'
            'LightSource "filterlight" "filter" "source" ["source"] "brightness" [%g]\n')
dark, half, full = (mean(f"brightness-{b:g}", FILTERED % b, BALL, "--gi", "reference") for b in (0, 0.5, 1))
t.expect(dark == 0, f"  a filter of brightness 0 leaves no highlight ({dark:.4f})")
t.expect(0 < full and abs(half / full - 0.5) < 0.01, f"  and one of 0.5 leaves half of it ({half / full:.4f})")

# The normal leans away from the eye: m.V = -0.2 / sqrt(1.04) everywhere.
ROUGHNESS, LEAN = 0.3, 0.2
t.write("turned.sl", f"""surface turned() {{
  normal n = faceforward(normalize(N), I);
  vector V = -normalize(I);
  normal m = normalize(normalize(n - (n . V) * V) - {LEAN} * V);
  Ci = specular(m, V, {ROUGHNESS});
  Oi = 1;
}}
""")
exponent, root = 8 / ROUGHNESS, math.sqrt(1 + LEAN * LEAN)
V = (1 / root, 0, -LEAN / root)  # in a frame whose third axis is m
total, steps = 0.0, 400
for i in range(steps):
    for k in range(2 * steps):
        c, phi = (i + .5) / steps, math.pi * (k + .5) / steps
        s = math.sqrt(1 - c * c)
        h = (s * math.cos(phi) + V[0], s * math.sin(phi), c + V[2])
        if h[2] > 0:
            total += (h[2] / math.hypot(*h)) ** exponent
expected = total * math.pi / steps / steps / math.pi
turned = mean("turned", "", 'Surface "turned" Translate 0 0 4 Rotate 40 1 0 0 Patch "bilinear" "P" [-4 -4 0 4 -4 0 -4 4 0 4 4 0]',
              "--gi", "reference", "--light-samples", "64")
t.expect(abs(turned / expected - 1) < 0.05, f"  a normal that turns away: {turned:.5f} of {expected:.5f}")
t.finish()
