"""Compares photons that are counted at visible points (--gi progressive, and caustics of --gi reference) with closed forms."""
import math
import pathlib
import re
import sys

from program import Suite

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "image"))
from pictures import pixels  # noqa: E402

t = Suite()
# The eye looks straight at a floor at z = 5. A white matte surface makes it as bright as its E/pi.
ABOVE = """Display "{name}.exr" "file" "rgb"
Format 16 16 1
Projection "orthographic"
ScreenWindow -{half} {half} -{half} {half}
WorldBegin
LightSource "indirectlight" "bounce"
{world}
WorldEnd
"""
PHOTONS_ALONE = 'Attribute "visibility" "int camera" [0] "int diffuse" [0] "int specular" [0] "int transmission" [0]\n'


def square(half, z, faces_eye=True):
    corners = [(-half, -half), (half, -half), (half, half), (-half, half)]
    return f'Polygon "P" [{" ".join(f"{x} {y} {z}" for x, y in (corners if faces_eye else corners[::-1]))}]\n'


def mean(name, scene, *arguments):
    t.write(name + ".rib", scene)
    t.expect_run(name, [name + ".rib", *arguments], 0)
    values = [c for p in pixels(t.folder / (name + ".exr")).values() for c in p[:3]]
    return sum(values) / len(values)


def near(what, got, expected, share):
    t.expect(abs(got - expected) <= share * expected, f"{what}: {got:.4f}, expected {expected:.4f} within {100 * share:g} %")


def fresnel(cosine, index):
    """Returns the reflectance for unpolarised light."""
    inside = math.sqrt(1 - (1 - cosine**2) / index**2)
    s, p = (cosine - index * inside) / (cosine + index * inside), (inside - index * cosine) / (inside + index * cosine)
    return (s * s + p * p) / 2


# A pane lets (1 - R) / (1 + R) through, with all reflections between its sides.
pane = (f'LightSource "distantlight" "sun" "intensity" [2] "from" [0 0 0] "to" [{math.sqrt(0.75)} 0 0.5]\nSurface "matte"\n' + square(1.5, 5) +
        PHOTONS_ALONE + 'Attribute "photon" "shadingmodel" ["glass"]\n' + square(2.2, 4.85, False) + square(2.2, 4.9))
R = fresnel(0.5, 1.5)
through = 2 * 0.5 * (1 - R) / (1 + R)
for method in "reference", "progressive":
    got = mean("pane_" + method, ABOVE.format(name="pane_" + method, half=1, world=pane), "--gi", method, "--indirect-only", "--samples", "1", "--bounces", "1", "--photons", "400000")
    near(f"a pane of glass, {method}", got, through, 0.005)

# Under an even sky of radiance 1, a floor has E/pi = 1, whether or not a mirror hides part of the sky.
furnace = ('Attribute "light" "shadows" ["on"]\nLightSource "environmentlight" "sky" "intensity" [1]\nSurface "matte"\n' + square(0.2, 5) +
           'Attribute "visibility" "int camera" [0]\nAttribute "photon" "shadingmodel" ["{model}"]\nSurface "mirror"\n'
           "Translate 0 0 3.5\nSphere 1 -1 1 360\n")
for model, method in ("matte", "reference"), ("chrome", "reference"), ("chrome", "progressive"):
    name = f"furnace_{model}_{method}"
    got = mean(name, ABOVE.format(name=name, half=0.18, world=furnace.format(model=model)),
               "--gi", method, "--samples", "64", "--light-samples", "64", "--photons", "800000")
    near(f"a furnace with a mirror that is {model} for photons, {method}", got, 1, 0.03)

# A lamp in a closed sphere gives I / R^2 everywhere. All bounces together give albedo / (1 - albedo) times that.
CLOSED = """Display "{name}.exr" "file" "rgb"
Format 16 16 1
Projection "perspective" "fov" [60]
WorldBegin
LightSource "pointlight" "lamp" "intensity" [3] "from" [0 0 0]
LightSource "indirectlight" "bounce"
Attribute "trace" "tessellation" [4]
Surface "matte" Color 0.5 0.5 0.5
Sphere 2 -2 2 360
WorldEnd
"""
near("all bounces in a closed sphere", mean("closed", CLOSED.format(name="closed"), "--gi", "progressive", "--indirect-only", "--photons", "600000"),
     0.5 * 3 / 4, 0.015)
near("one bounce in it", mean("one", CLOSED.format(name="one"), "--gi", "progressive", "--indirect-only", "--photons", "600000", "--bounces", "1"),
     0.5 * 0.5 * 3 / 4, 0.015)


# The bits are the same for any threads and buckets. Without a mirror there is no photon. A bound on the noise can end the photons.
def bytes_of(name, text, *arguments):
    mean(name, text.format(name=name), *arguments)
    return pixels(t.folder / (name + ".exr"))


for method in "reference", "progressive":
    scene = ABOVE.replace("{half}", "1").replace("{world}", pane)
    usual = ("--gi", method, "--samples", "1", "--photons", "150000")
    t.expect(bytes_of("one_thread", scene, *usual, "-t", "1") == bytes_of("threads", scene, *usual, "-t", "3", "--bucket-size", "8"),
             f"{method} has the same bits for any threads and buckets")
for shader, model, told in ("glass", "matte", True), ("glass", "glass", False), ("matte", "matte", False):
    ball = f'Attribute "identifier" "name" "ball"\nAttribute "photon" "shadingmodel" "{model}"\nSurface "{shader}"\nSphere 0.2 -0.2 0.2 360\nWorldEnd'
    t.write("ball.rib", CLOSED.format(name="ball").replace("WorldEnd", ball))
    said = t.run("ball.rib", "--gi", "progressive", "--photons", "1000").stderr
    t.expect(('"ball": its shader traces rays, and photons take it for matte' in said) == told, f"{shader} that is {model} for photons is {'' if told else 'not '}told of ({said})")
few, many = (bytes_of(n, CLOSED, "--gi", "reference", "--samples", "2", "--photons", n[1:]) for n in ("p1000", "p2000"))
t.expect(few == many, "the reference sends no photons where nothing mirrors them")
t.write("ends.rib", CLOSED.format(name="ends"))
said = t.run("ends.rib", "-v", "--gi", "progressive", "--photons", "100000000", "--photon-noise", "0.05").stderr
told = re.search(r"(\d+) photons were counted at \d+ points; the noise of what they bring is ([\d.]+) % \[photons-counted\]", said)
t.expect(told and int(told[1]) < 2e6 and float(told[2]) < 5, f"photons end when their noise is low ({said})")
t.finish()
