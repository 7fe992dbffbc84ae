"""Tests what the renderer knows about lights: a lamp looks as bright as its shader makes it, and plugins that bring indirect
light are recognised."""
import os
import pathlib
import subprocess
import sys

from program import Suite

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "image"))
from pictures import pixels  # noqa: E402

t = Suite()
t.trust_shaders(".")
source = pathlib.Path(os.environ.get("TOMALES_HEADERS", pathlib.Path(__file__).resolve().parent.parent.parent))


def build(name, code):
    t.write(name + ".cpp", "#include <reyes/shader.h>\n" + code)
    subprocess.run([os.environ["CXX"], "-O1", "-std=c++17", "-shared", "-fPIC", "-I", source, t.folder / (name + ".cpp"), "-o", t.folder / (name + ".so")],
                   check=True)


# --- The lamp has radiance (power, 0, 0). With `stripes` its left half is striped, and `beam` is a power of the cosine to its normal.
build("redlamp", """namespace {
rsl::FloatParam power("power", 5, ""), stripes("stripes", 0, ""), beam("beam", 0, "");
void shade(const TmGrid* g) {
  for (int i : rsl::Batch(g)) {
    const float cosine = -rsl::dot(rsl::normalize(rsl::get(g->L, i)), rsl::get(g->Nl, i));
    const float share = g->Pl.x[i] < 0 ? 1 - stripes(g, i) : 1;
    rsl::set(g->Cl, i, power(g, i) * share * std::pow(std::max(cosine, 0.0f), beam(g, i)) * rsl::Color{1, 0, 0});
  }
}
const rsl::Shader lamp(TM_LIGHT, "redlamp", "", TM_LIGHT_AREA | TM_LIGHT_SHADOWED, shade, {&power, &stripes, &beam});
}
TM_SHADER_LIBRARY(lamp)
""")
LAMP = """Format 16 16 1
PixelSamples 1 1
PixelFilter "box" 1 1
Projection "orthographic"
ScreenWindow -1 1 -1 1
WorldBegin
AttributeBegin
AreaLightSource "redlamp" "lamp" {params}
Translate 0 0 {lamp_z}
Rotate {turn} 0 1 0
Surface "matte"
Color 0 0 0
Polygon "P" [-2 -2 0 -2 2 0 2 2 0 2 -2 0]
AttributeEnd
{mirror}
WorldEnd
"""
MIRROR = """AttributeBegin
Surface "mirror" "Kr" [1] "Ks" [0]
Translate 0 0 5
Polygon "P" [-2 -2 0 -2 2 0 2 2 0 2 -2 0]
AttributeEnd
"""


def seen(what, params="", turn=0, mirrored=False):
    """Returns the lamp as the eye sees it. If mirrored, it is behind the eye and seen in a mirror."""
    t.write("lamp.rib", LAMP.format(params=params, lamp_z=-5 if mirrored else 5, turn=turn if not mirrored else 180 - turn, mirror=MIRROR if mirrored else ""))
    t.expect_run(what + " renders", ["lamp.rib", "-o", "lamp.exr"], 0)
    return pixels(str(t.folder / "lamp.exr"))


def red(picture, x):
    return picture[x, 8][:3]


def near(color, expected):
    return all(abs(a - b) < 1e-4 * max(1, expected[0]) for a, b in zip(color, expected))


for mirrored, place in ((False, "to the camera"), (True, "in a mirror")):
    whole = seen(f"a red lamp {place}", mirrored=mirrored)
    t.expect(near(red(whole, 3), (5, 0, 0)) and near(red(whole, 12), (5, 0, 0)), f"it glows red {place}: {red(whole, 3)}")
    striped = seen(f"a striped lamp {place}", '"float stripes" [0.75]', mirrored=mirrored)
    t.expect(near(red(striped, 3), (1.25, 0, 0)) and near(red(striped, 12), (5, 0, 0)), f"its radiance varies over it {place}: {red(striped, 3)}, {red(striped, 12)}")
    slanted = seen(f"a slanted beam {place}", '"float beam" [2]', 60, mirrored=mirrored)
    t.expect(near(red(slanted, 8), (1.25, 0, 0)), f"and with the direction {place}: {red(slanted, 8)}")

# --- A request of an indirect light is reported only if the renderer does not follow it.
ROOM = """Format 16 16 1
Projection "perspective" "fov" [60]
Translate 0 0 1.5
WorldBegin
LightSource "pointlight" "key" "from" [0 0.5 0] "intensity" [1]
{light}
Surface "matte"
Color 0.5 0.5 0.5
Sides 2
{thing}
WorldEnd
"""
SPHERE = "Sphere 2 -2 2 360"


def room(light, thing=SPHERE, *arguments):
    t.write("room.rib", ROOM.format(light=light, thing=thing))
    result = t.expect_run(f"{light[:60]!r} {' '.join(arguments)} renders", ["room.rib", "-o", "room.exr", *arguments], 0)
    picture = pixels(str(t.folder / "room.exr"))
    return result.stderr, sum(c[0] for c in picture.values()) / len(picture), picture


said, atlas, _ = room('LightSource "indirectlight" "gi" "float samples" [16] "string radiance" ["atlas"] "string atlas" ["maps"]', SPHERE, "--photons", "5000")
t.expect("not supported" not in said and (t.folder / "maps").is_dir(), "an atlas that the light names is used, and nothing else said")
t.run("photons", "room.rib", "-o", "photons", "--photons", "5000")
t.run("irradiance", "photons", "-o", "clouds")
said, points, _ = room('LightSource "indirectlight" "gi" "float samples" [16] "string radiance" ["points"] "string atlas" ["clouds"]')
t.expect("not supported" not in said, "so are points")

# --- A plugin brings indirect light, which its capability declares.
build("bounced", """namespace {
void shade(const TmGrid* g) {
  const rsl::Batch b(g);
  const rsl::Vec3Array N = b.facingNormals();
  rsl::Vec3Array E(g), red(g), green(g), blue(g);
  TmVec3 dominant[3] = {red, green, blue};
  g->call->indirectDiffuse(g->host, g, N, E, dominant);
  for (int i : b) b.illuminate(i, N[i], g->sample == 0 ? E[i] : rsl::Color{});
}
const rsl::Shader bounced(TM_LIGHT, "bounced", "", TM_LIGHT_INDIRECT, shade, {});
}
TM_SHADER_LIBRARY(bounced)
""")
_, direct, _ = room("")
_, once, by_scene = room('LightSource "bounced" "gi"')
t.expect(once > 1.2 * direct, f"it brings light without --gi: {once:.4f} beside {direct:.4f}")
_, asked, by_option = room('LightSource "bounced" "gi"', SPHERE, "--gi", "gather")
t.expect(by_option == by_scene, f"and not twice with it: {asked:.4f}")

# --- The indirect light that --gi adds is for all objects.
t.write("sphere.rib", SPHERE + "\n")
_, whole, _ = room("", SPHERE, "--gi", "gather", "--samples", "64")
_, procedural, _ = room("", 'Procedural "DelayedReadArchive" ["sphere.rib"] [-2 2 -2 2 -2 2]', "--gi", "gather", "--samples", "64")
t.expect(abs(whole - procedural) < 0.01 * whole > 0.01 * direct, f"for those of procedurals too: {procedural:.4f}, {whole:.4f}")
# --- A small lamp with a cone is a spotlight: it is as strong within the cone, dark outside, and half as strong in the middle of its soft edge.
BEAM = """Format 64 1 1
PixelSamples 4 4
PixelFilter "box" 1 1
Projection "orthographic"
ScreenWindow -1 1 -0.01 0.01
WorldBegin
{lamp}
Surface "matte" "Ka" [0]
Color 1 1 1
Translate 0 0 5
Polygon "P" [-2 -2 0 -2 2 0 2 2 0 2 -2 0]
WorldEnd
"""
CONE = '"coneangle" [0.5] "conedeltaangle" [0.2] "beamdistribution" [1]'
AREA = f'''AttributeBegin
Translate 0 0 4
AreaLightSource "arealight" "lamp" "intensity" [100] "visible" [0] "samples" [64] {CONE} "vector axis" [0 0 1]
Attribute "visibility" "int camera" [0] "int transmission" [0]
Sphere 0.02 -0.02 0.02 360
AttributeEnd
Illuminate "lamp" 1'''
POINT = f'LightSource "spotlight" "lamp" "intensity" [{100 * 0.02 ** 2}] "point from" [0 0 4] "point to" [0 0 5] {CONE}'
beams = []
for name, lamp in (("ball", AREA), ("point", POINT)):
    t.write(name + ".rib", BEAM.format(lamp=lamp))
    t.expect_run(f"a beam of a {name}", [name + ".rib", "-o", name + ".exr"], 0)
    seen = pixels(t.folder / (name + ".exr"))
    beams.append([seen[x, 0][0] for x in range(64)])
worst = max(abs(a - b) for a, b in zip(*beams)) / max(beams[1])
t.expect(worst < 0.03 and max(beams[1]) > 0 and beams[0][2] == 0, f"a lamp with a cone is a spotlight: {worst:.4f} off {beams[0][::8]} {beams[1][::8]}")

# --- A lamp behind cloth is of use where the shader asks for light from there, and of none where it does not.
CLOTH = """Projection "orthographic"
WorldBegin
LightSource "distantlight" 1 "from" [0 0 1] "to" [0 0 0]
Surface "%s"
Polygon "P" [-1 -1 5  -1 1 5  1 1 5  1 -1 5]
WorldEnd
"""
for name, asked, useless in (("through", "P", False), ("backlit", "P, -N, PI / 2", False), ("front", "P, N, PI / 2", True)):
    t.write(name + ".sl", f"surface {name}() {{ Oi = 1; Ci = 0; illuminance({asked}) Ci += Cl; }}\n")
    t.write(name + ".rib", CLOTH % name)
    result = t.expect_run(f"a lamp behind the surface {name}", [name + ".rib", "-o", name + ".exr", "--format", "16x16"], 0)
    t.expect(("[light-useless]" in result.stderr) == useless, f"a lamp behind the surface {name} is called useless: {useless} ({result.stderr[:300]})")
t.finish()
