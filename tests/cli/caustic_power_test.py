"""Compares the light that mirrors and lenses throw onto a dark floor with closed forms: by --gi reference, --gi progressive and caustic maps.

tests/cli/counted_photons_test.py does so for a pane of glass.
"""
import math
import pathlib
import sys

from program import Suite

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "image"))
from pictures import pixels  # noqa: E402

t = Suite()
SIZE = 32
# The eye looks straight down on a receiver at z = 0 and sees nothing else. The receiver is so dark that light from it to the mirrors and back does not
# matter.
DARK = 0.001
SCENE = """Display "{name}.exr" "file" "rgb"
Format {size} {size} 1
PixelSamples 8 8
PixelFilter "box" 1 1
ShadingRate 0.25
Projection "orthographic"
ScreenWindow -{half} {half} -{half} {half}
Translate 0 0 50
Scale 1 1 -1
WorldBegin
LightSource "indirectlight" "gi"
{lamp}
AttributeBegin
Attribute "photon" "string causticmap" ["receiver"]
Surface "matte"
Color {dark} {dark} {dark}
{receiver}
AttributeEnd
Attribute "visibility" "int camera" [0]
Attribute "trace" "float tessellation" [1]
{thing}
WorldEnd
"""
METHODS = {"reference": ("--samples", "1", "--photons", "{photons}"), "progressive": ("--photons", "{photons}"), "atlas": ("--samples", "16", "--photons", "{photons}")}
SUN = 'LightSource "distantlight" "sun" "intensity" [2] "from" [{} 0 {}] "to" [0 0 0]'
CHROME = 'Attribute "photon" "string shadingmodel" ["chrome"]\nSurface "mirror"\nColor {0} {0} {0}\n'


def square(half, z=0):
    """Returns a square that faces both down and up."""
    return f'Polygon "P" [{" ".join(f"{x * half} {y * half} {z}" for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1)))}]\n'


def picture(name, method, half, lamp, receiver, thing, photons):
    """Returns E/pi by place, (x, y) of each pixel's middle, and the area of a pixel."""
    t.write(f"{name}.rib", SCENE.format(name=name, size=SIZE, half=half, lamp=lamp, dark=DARK, receiver=receiver, thing=thing))
    t.expect_run(f"{name} by {method}", [f"{name}.rib", "--gi", method, "--bounces", "1", "--indirect-only", "--ray-geometry", "full",
                                         *(a.format(photons=photons) for a in METHODS[method])], 0)
    edge = 2 * half / SIZE
    return {((x + 0.5) * edge - half, half - (y + 0.5) * edge): p[0] / DARK for (x, y), p in pixels(t.folder / f"{name}.exr").items()}, edge**2


def near(what, got, expected, share):
    t.expect(abs(got - expected) <= share * expected, f"{what}: {got:.5f}, expected {expected:.5f} within {100 * share:g} % ({100 * (got / expected - 1):+.2f} %)")


def parabolic_mirror(method):
    """A mirror z = 1 - r^2 / 4, for r < 1, sends all parallel light from below to its focus at z = 0; the receiver lies a little above."""
    share, above = 0.9, 0.1
    thing = CHROME.format(share) + f"Translate 0 0 {1 - above}\nRotate 180 1 0 0\nParaboloid 1 0 0.25 360\n"
    light, area = picture("paraboloid", method, 0.25, SUN.format(0, -1), square(0.25), thing, 500000)
    near(f"light of a parabolic mirror near its focus, {method}", sum(light.values()) * area, share * 2 * (math.pi - 0.5**2), 0.005)


def half_sphere(method):
    """A lamp in the middle of a mirroring half-sphere has its mirror image at the same place, so its light counts twice."""
    share, intensity, height = 0.8, 3, 1
    lamp = f'LightSource "pointlight" "lamp" "intensity" [{intensity}] "from" [0 0 {height}]'
    thing = CHROME.format(share) + f"Translate 0 0 {height}\nSphere 0.7 0 0.7 360\n"
    light, _ = picture("half_sphere", method, 1, lamp, square(1.5), thing, 600000)
    expected = {(x, y): share * intensity * height / (x * x + y * y + height**2) ** 1.5 for x, y in light}
    near(f"light of a half-sphere that mirrors, {method}", sum(light.values()), sum(expected.values()), 0.005)


def ring(method):
    """All parallel light that meets a mirroring ring falls to the floor: light that enters it above and is reflected inside, and
    light that it blocks outside."""
    radius, height, slope = 0.5, 0.4, 1.5
    cosine = 1 / math.hypot(1, slope)
    apart = height * slope
    through = 2 * radius**2 * math.acos(apart / (2 * radius)) - apart / 2 * math.sqrt(4 * radius**2 - apart**2)
    thing = CHROME.format(1) + f"Cylinder {radius} 0 {height} 360\n"
    light, area = picture("ring", method, 1.6, SUN.format(slope, 1), square(2), thing, 1000000)
    expected = 2 * (cosine * (math.pi * radius**2 - through) + 2 * radius * height * slope * cosine)
    near(f"light of a ring that mirrors, {method}", sum(light.values()) * area, expected, 0.005)


def bent(way, normal, eta):
    """Returns the direction of a ray behind a surface of glass, and the share of light that is reflected. The normal faces the ray."""
    cosine = -way[0] * normal[0] - way[1] * normal[1]
    inside = math.sqrt(1 - eta**2 * (1 - cosine**2))
    s, p = (eta * cosine - inside) / (eta * cosine + inside), (cosine - eta * inside) / (cosine + eta * inside)
    return tuple(eta * w + (eta * cosine - inside) * n for w, n in zip(way, normal)), (s * s + p * p) / 2


def mirrored(way, normal):
    along = way[0] * normal[0] + way[1] * normal[1]
    return tuple(w - 2 * along * n for w, n in zip(way, normal))


def share_inside(distance, half):
    """Returns the share of a circle that lies in a square around the same middle."""
    if distance <= half:
        return 1
    return max(0, 1 - 4 / math.pi * math.acos(half / distance))


def ball_on_square(radius, above, half, index):
    """Returns the share of the light falling straight down on a ball of glass that reaches a square below it, after up to eight
    reflections."""
    steps, found = 4000, 0

    def shed(share, place, way):
        nonlocal found
        if way[1] < 0:
            found += share / steps * share_inside(abs(radius * place[0] - (above + radius * place[1]) / way[1] * way[0]), half)

    for k in range(steps):
        sine = math.sqrt((k + 0.5) / steps)
        place = sine, math.sqrt(1 - sine * sine)
        way, reflected = bent((0, -1), place, 1 / index)
        shed(reflected, place, mirrored((0, -1), place))
        share = 1 - reflected
        for _ in range(8):
            along = way[0] * place[0] + way[1] * place[1]
            place = tuple(p - 2 * along * w for p, w in zip(place, way))
            shed(share * (1 - reflected), place, bent(way, tuple(-p for p in place), index)[0])
            way, share = mirrored(way, place), share * reflected
    return found


def ball(method):
    radius, above, half = 0.5, 0.6, 0.5
    thing = f'Attribute "photon" "string shadingmodel" ["glass"]\nAttribute "trace" "int maxspeculardepth" [10]\nSurface "glass"\nTranslate 0 0 {above}\nSphere {radius} {-radius} {radius} 360\n'
    light, area = picture("ball", method, half, SUN.format(0, 1), square(1), thing, 500000)
    near(f"light of a ball of glass, {method}", sum(light.values()) * area, 2 * math.pi * radius**2 * ball_on_square(radius, above, half, 1.5), 0.005)


for method in METHODS:
    for scene in (parabolic_mirror, half_sphere, ring, ball):
        scene(method)
t.finish()
