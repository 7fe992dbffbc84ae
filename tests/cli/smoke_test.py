"""Compares the translated smoke of docs/rsl_plugins, under real lights and shadow rays, with closed forms of single scattering in a slab of even
smoke."""
import json
import math
import os
import pathlib
import subprocess

from program import Suite

t = Suite()
t.trust_shaders(".")
source = pathlib.Path(__file__).resolve().parent.parent.parent
subprocess.run([os.environ["CXX"], "-O1", "-std=c++17", "-shared", "-fPIC", "-I", source, source / "docs/rsl_plugins/smoke.cpp", "-o", t.folder / "smoke.so"], check=True)
DEPTH, DENSITY = 4, 0.9
SIGMA = DENSITY * (lambda x: x * x * (3 - 2 * x))(0.3 / 0.7)  # Smoke without octaves has this extinction: density * smoothstep(0, .7, .3).


def mean(name, lights, things="", height=0, top=1e6, lightsteps=0):
    """Returns the mean radiance that smoke in front of a black wall sends, at one height, to an eye in parallel projection."""
    t.write(name + ".rib", f"""Display "{name}.exr" "file" "rgba"
Format 16 16 1
PixelSamples 1 1
Projection "orthographic"
ScreenWindow -0.01 0.01 {height - 0.01} {height + 0.01}
Option "searchpath" "string shader" ["."]
WorldBegin
Atmosphere "smoke" "float density" [{DENSITY}] "float octaves" [0] "float top" [{top}] "float steps" [200] "float lightsteps" [{lightsteps}] "color smokecolor" [1 1 1]
{lights}
AttributeBegin
Attribute "visibility" "int transmission" [1]
Surface "null"
{things}
AttributeEnd
Surface "constant" Color [0 0 0]
Patch "bilinear" "P" [-2 -2 {DEPTH} 2 -2 {DEPTH} -2 2 {DEPTH} 2 2 {DEPTH}]
WorldEnd
""")
    t.expect(not t.expect_run(name + " renders", [name + ".rib"], 0).stderr, "without a word")
    channels = json.loads(t.run("info", "--json", name + ".exr").stdout)["channels"]
    return next(c for c in channels if c["name"] == "R")["mean"]


def is_near(value, expected, what, tolerance=0.002):
    t.expect(abs(value - expected) < tolerance * expected, f"{what}: {value:.5f}, by the closed form {expected:.5f}")


down = 'LightSource "shadowdistant" 1 "from" [0 1 0] "to" [0 0 0] "intensity" [2] "string shadowname" ["raytrace"]'
is_near(mean("slab", down), 2 * (1 - math.exp(-SIGMA * DEPTH)), "a slab in parallel light")
roof = 'Surface "matte" Sides 2 Patch "bilinear" "P" [-5 3 0 5 3 0 -5 3 2 5 3 2]'
is_near(mean("roof", down, roof), 2 * (math.exp(-SIGMA * 2) - math.exp(-SIGMA * DEPTH)), "half of it under a roof, whose shadow it shows")
# Above y = 0 the smoke thins out up to its top, 2, by the smoothstep. Its mean is a half, so light crosses as much smoke as even smoke up to 1.
is_near(mean("deep", down, height=-1, top=2, lightsteps=40), 2 * (1 - math.exp(-SIGMA * DEPTH)) * math.exp(-2 * SIGMA), "light is dimmed on its way down")
lamp = 'LightSource "pointlight" 1 "from" [0 50 2] "intensity" [2500]'
# At distance 50 the inverse square is 1 within 0.2 %.
is_near(mean("lamp", lamp), 1 - math.exp(-SIGMA * DEPTH), "a lamp far away", 0.05)
t.finish()
