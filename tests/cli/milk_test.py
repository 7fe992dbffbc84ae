"""Tests docs/rsl_plugins/milk.cpp, which marches through the volume photon map. Light of any number of bounces in a ball is compared with closed
forms."""
import json
import math
import os
import pathlib
import subprocess

from program import Suite

t = Suite()
t.trust_shaders(".")
source = pathlib.Path(__file__).resolve().parent.parent.parent
subprocess.run([os.environ["CXX"], "-O1", "-std=c++17", "-shared", "-fPIC", "-I", source, source / "docs/rsl_plugins/milk.cpp", "-o", t.folder / "milk.so"], check=True)


def ball(name, light, scattering, absorption):
    """Returns the radiance that the middle of a ball of radius 1 sends to the eye, and its opacity, in red."""
    medium = f'"color scattering" [{scattering} {scattering} {scattering}] "color absorption" [{absorption} {absorption} {absorption}]'
    t.write(name + ".rib", f"""Display "{name}.exr" "file" "rgba"
Format 32 32 1
PixelSamples 2 2
Projection "orthographic"
ScreenWindow -0.6 0.6 -0.6 0.6
Option "searchpath" "string shader" ["."]
Translate 0 0 4
WorldBegin
{light}
Attribute "photon" "string shadingmodel" ["transparent"]
Interior "fog" "float distance" [1e30] {medium}
Surface "milk" "string map" ["{name}/scene.volume.bkm"] {medium}
Sides 1
Sphere 1 -1 1 360
WorldEnd
""")
    t.expect_run(name + " renders", [name + ".rib", "--gi", "atlas", "--atlas", name, "--photons", "200000", "--bounces", "100", "-q"], 0)
    channels = {c["name"]: c["mean"] for c in json.loads(t.run("info", "--json", name + ".exr").stdout)["channels"]}
    return channels["R"], channels["A"]


def is_near(value, expected, what, tolerance):
    t.expect(abs(value - expected) < tolerance * expected, f"{what}: {value:.4f}, by the closed form {expected:.4f}")


# This is a furnace: a medium that only scatters hides as much light as it sends.
sent, hidden = ball("furnace", 'LightSource "environmentlight" 1 "intensity" [1]', 2, 0)
is_near(sent / hidden, 1, "in a furnace of radiance 1, over what it hides", 0.03)
# The eye is within the built-in medium, with half a unit of it before a black wall. The light comes from the map.
t.write("within.rib", """Display "within.exr" "file" "rgb"
Format 8 8 1
Projection "orthographic"
ScreenWindow -0.5 0.5 -0.5 0.5
WorldBegin
Atmosphere "medium" "scattering" [2 2 2] "map" ["furnace/scene.volume.bkm"]
Surface "constant"
Color [0 0 0]
Translate 0 0 0.5
Polygon "P" [-1 -1 0 -1 1 0 1 1 0 1 -1 0]
WorldEnd
""")
t.expect_run("a medium by its photons", ["within.rib"], 0)
is_near(json.loads(t.run("info", "--json", "within.exr").stdout)["channels"][0]["mean"], 1 - math.exp(-1), "seen from within", 0.03)
# The medium is so thin that light is scattered once. A beam of E = pi has the fluence pi everywhere and the mean radiance 1/4, of which half is
# scattered.
sent, hidden = ball("thin", 'LightSource "distantlight" 1 "from" [1 0 0] "to" [0 0 0] "intensity" [1]', 0.01, 0.01)
is_near(sent / hidden, 0.125, "thin smoke in a beam, over what it hides", 0.05)
# The closed form is the mean of 1 - exp(-0.02 chord) over the window of 1.2 by 1.2.
n = 200
at = [1.2 * (i + 0.5) / n - 0.6 for i in range(n)]
is_near(hidden, sum(1 - math.exp(-0.04 * math.sqrt(1 - x * x - y * y)) for x in at for y in at) / n**2, "and it hides", 0.01)
t.finish()
