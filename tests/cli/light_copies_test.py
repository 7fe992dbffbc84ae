"""Tests that the renderer knows a light by what its shader declares, never by names. A plugin copy of every built-in light has another name and other
names of its parameters. It must give the same bits with every method for indirect light and through every command."""
import json
import os
import pathlib
import re
import subprocess
import sys

from program import Suite

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "image"))
from pictures import pixels  # noqa: E402

t = Suite()
t.trust_shaders(".")
source = pathlib.Path(__file__).resolve().parent.parent.parent

# --- The copies are one plugin of all files that hold lights, each in a namespace of its own.
PARAMETER = re.compile(r'(\b\w+[({]\s*)"(\w+)"(?=,\s)')
LIGHT = re.compile(r'\bTM_LIGHT,\s*"(\w+)"')
declared = {}  # These are the names of the parameters of each light.


def copied(path):
    text = path.read_text()
    text = re.sub(r'#include "(shaders/\w+\.h)"', r'#include "copied_\1"', text)
    text = LIGHT.sub(r'TM_LIGHT, "copy_\1"', text)
    return PARAMETER.sub(r'\1"z\2"', text)


def build_copies():
    (t.folder / "copied_shaders").mkdir()
    headers = sorted(p.name for p in (source / "shaders").glob("*.h"))
    for name in headers:
        t.write("copied_shaders/" + name, copied(source / "shaders" / name))
    parts, shaders = ["#include <cstring>\n#include \"reyes/shader.h\"\n"], []
    parts += [f'#include "copied_shaders/{name}"\n' for name in headers]
    for path in sorted((source / "shaders").glob("*.cpp")):
        names = LIGHT.findall(path.read_text())
        if not names:
            continue
        t.write("copied_" + path.name, copied(path))
        parts.append(f'namespace {path.stem}_copy {{\n#include "copied_{path.name}"\n}}\n')
        shaders += [f"{path.stem}_copy::{name}Shader" for name in names]
    parts.append(f"TM_SHADER_LIBRARY({', '.join(shaders)})\n")
    t.write("copies.cpp", "".join(parts))
    # Arithmetic depends on these options of the build.
    subprocess.run([os.environ["CXX"], "-O1", "-ffp-contract=off", "-fno-math-errno", "-fno-trapping-math", "-std=c++20", "-shared", "-fPIC", "-I", t.folder,
                    "-I", source, t.folder / "copies.cpp", "-o", t.folder / "copies.so"], check=True)
    for shader in json.loads(t.run("info", "--json", "copies.so").stdout)["shaders"]:
        os.link(t.folder / "copies.so", t.folder / (shader["name"] + ".so"))
        declared[shader["name"].removeprefix("copy_")] = {p["name"].removeprefix("z") for p in shader["parameters"]}


build_copies()

# --- The scenes have built-in lights ("built") or copies ("copy").
SCENE = """Format 20 20 1
PixelSamples 2 2
ShadingRate 4
Projection "perspective" "fov" [50]
Clipping 0.1 100
Translate 0 0 4
WorldBegin
TransformBegin Translate 0 1.9 0 Rotate 90 1 0 0 Scale 2 2 1 CoordinateSystem "window" TransformEnd
{lights}
Surface "matte"
Color [0.7 0.6 0.5]
Polygon "P" [-2 -1 -2 -2 -1 2 2 -1 2 2 -1 -2]
Polygon "P" [-2 -1 2 -2 2 2 2 2 2 2 -1 2]
AttributeBegin
Attribute "identifier" "name" ["ball"]
Color [0.8 0.2 0.2]
Translate -0.6 -0.5 0
Surface "plastic"
Sphere 0.5 -0.5 0.5 360
AttributeEnd
AttributeBegin
Attribute "photon" "shadingmodel" ["chrome"]
Translate 0.6 -0.5 0
Surface "mirror"
Sphere 0.5 -0.5 0.5 360
AttributeEnd
WorldEnd
"""
LAMP = """AttributeBegin
Translate 0 1.2 0.5
Rotate -90 1 0 0
{light}
Scale 0.6 0.6 1
Polygon "P" [-1 -1 0 -1 1 0 1 1 0 1 -1 0]
AttributeEnd
Illuminate "lamp" 1
"""


def light(variant, shader, handle, **params):
    """Returns a LightSource. The names of parameters are Python's, and their values are RIB. An arealight is a rectangle under the ceiling."""
    types = {"from_": "point from", "to": "point to", "lightcolor": "color lightcolor", "sundirection": "vector sundirection"}
    strings = ("map", "mapspace", "portals", "source", "shadowname", "radiance", "atlas", "errorfunction", "lighting", "__group", "sfpx", "sfnz")
    text = ""
    for name, value in params.items():
        kind, name = types.get(name, ("string " if name in strings else "float ") + name).split()
        z = "z" if variant == "copy" and name in declared[shader] else ""
        text += f' "{kind} {z}{name}" [{str(value).replace("{v}", variant)}]'
    request = f'"{"copy_" if variant == "copy" else ""}{shader}" "{handle}"{text}\n'
    return LAMP.format(light="AreaLightSource " + request) if shader == "arealight" else "LightSource " + request


def said(text):
    """Returns messages with the names of the built-in lights and without those of temporary folders."""
    return sorted(set(re.sub(r"/tmp/tomales_\w+", "", text.replace("copy", "built").replace("built_", "")).splitlines()))


def alike(what, lights, *commands):
    """Runs the commands, in which {v} is the variant, for both scenes. Compares their messages and the picture of the last command."""
    results = {}
    for variant in ("built", "copy"):
        t.write(variant + ".rib", SCENE.format(lights="".join(light(variant, *request, **params) for *request, params in lights)))
        runs = [t.run(*(a.replace("{v}", variant) for a in command)) for command in commands]
        results[variant] = [r.returncode for r in runs], said("".join(r.stderr for r in runs)), pixels(str(t.folder / (variant + ".exr")))
        (t.folder / (variant + ".exr")).unlink()
    built, copy = results["built"], results["copy"]
    t.expect(built[2] == copy[2], f"{what}: the same bits")
    t.expect(set(built[0]) == {0} and built[:2] == copy[:2], f"{what}: exits and messages")
    if built[:2] != copy[:2] or set(built[0]) != {0}:
        print("        ", built[:2], "\n        ", copy[:2])
    return built[2]


RENDER = ["{v}.rib", "-o", "{v}.exr"]
t.write("sky.rib", 'Format 32 16 1\nDisplay "sky.exr" "file" "rgb"\nWorldBegin\nSurface "constant"\nColor [1 0.5 0.2]\nDisk 0.5 0.6 360\nWorldEnd\n')
t.expect_run("a sky", ["sky.rib"], 0)
t.write("map.rib", 'Format 32 32 1\nDisplay "map.shd" "shadow" "z"\nRotate -90 1 0 0\nTranslate 0 -3 0\nWorldBegin\nSphere 0.5 -0.5 0.5 360\nWorldEnd\n')
t.expect_run("a shadow map", ["map.rib"], 0)

# --- Each light works by itself.
AREA = ("arealight", "lamp", {"intensity": 3, "lightcolor": "1 0.3 0.2", "samples": 4})
KEY = ("pointlight", "key", {"from_": "1 1.5 -1", "intensity": 2})
DOWN = {"from_": "0 3 0", "to": "0 0 0", "intensity": 3}
alone = [
    ("ambientlight", {"intensity": 0.5, "lightcolor": "1 0.5 0.2"}),
    ("distantlight", {"from_": "1 2 -1", "to": "0 0 0", "lighting": '"direct"'}),
    ("pointlight", {"from_": "1 1.5 -1", "intensity": 3, "shadowname": '"raytrace"'}),
    ("spotlight", {"coneangle": 0.6, "__group": '"key"', **DOWN}),
    ("environmentlight", {"map": '"sky.exr"', "mapspace": '"shader"', "samples": 5, "portals": '"window"'}),
    ("environmentlight", {"samples": 5, "visible": 0}),
    ("daylight", {"sundirection": "0.5 1 -0.5", "samples": 6, "portals": '"window"'}),
    ("sunlight", {"sundirection": "0.5 1 -0.5", "samples": 3, "sunsize": 20}),
    ("occlusionlight", {"samples": 16, "maxvariation": 0.2}),
    ("occlusionlight", {"samples": 16, "maxvariation": 0, "maxdist": 2}),
    ("shadowdistant", {"shadowname": '"map.shd"', **DOWN}),
    ("shadowdistant", {"shadowname": '"raytrace"', **DOWN}),
    ("shadowspot", {"shadowname": '"map.shd"', "blur": 0.05, **DOWN}),
    ("shadowpoint", {"sfpx": '"map.shd"', "sfnz": '"raytrace"', "from_": "1 1.5 -1", "intensity": 3}),
]
for name, params in alone:
    alike(name, [(name, "it", params)], RENDER)
radiance = alike("arealight", [AREA], RENDER)[10, 17][0]
t.expect(radiance > 0, "it lights the floor")
ofBmrt = alike("arealight as BMRT has it", [AREA], [*RENDER, "--arealight", "bmrt"])[10, 17][0]
t.expect(abs(ofBmrt / radiance - 3.14159265 / 1.44) < 0.01, f"by pi / area more ({ofBmrt / radiance:.4f})")
alike("arealight, invisible", [("arealight", "lamp", {"samples": 4, "visible": 0})], RENDER)
tested = {name for name, _ in alone} | {"arealight", "indirectlight", "filterlight"}
t.expect(tested == set(declared), f"every built-in light is here: {tested ^ set(declared)}")

# --- Indirect light follows the command line and the light's own parameters.
GI = ("indirectlight", "gi", {"samples": 16, "maxerror": 0.7, "errorfunction": '"ward"', "maxdist": 20, "intensity": 1.5, "lightcolor": "1 1 0.5"})
FILTER = ("filterlight", "more", {"source": '"gi"', "brightness": 0.5, "from_": "0 2 0", "to": "0 0 0", "coneangle": 1})


def asking(**params):
    return [KEY, AREA, (*GI[:2], {**GI[2], **params}), FILTER]


direct = alike("direct light", asking(), [*RENDER, "--gi", "none"])
gathered = alike("as the scene asks", asking(), RENDER)
t.expect(gathered != direct, "there is indirect light")
t.expect(alike("gather", asking(), [*RENDER, "--gi", "gather"]) == gathered, "--gi gather adds no second indirect light")
alike("bounces of the light", asking(bounces=3), RENDER)
alike("reference", asking(bounces=2), [*RENDER, "--gi", "reference"])
alike("radiosity", asking(), [*RENDER, "--gi", "radiosity"])
alike("radiosity of the light", asking(radiance='"radiosity"'), RENDER)
PHOTONS = ["--photons", "3000"]
by_option = alike("atlas", asking(bounces=3), [*RENDER, "--gi", "atlas", *PHOTONS])
by_light = alike("atlas of the light", asking(bounces=3, radiance='"atlas"', atlas='"{v}_maps"'), [*RENDER, *PHOTONS])
t.expect(by_option == by_light != gathered, "the light asks for it as the option does")
t.expect((t.folder / "copy_maps").is_dir(), "and for the folder")
CLOUDS = [["photons", "{v}.rib", "-o", "{v}_photons", *PHOTONS], ["irradiance", "{v}_photons", "-o", "{v}_clouds"]]
by_option = alike("points", asking(bounces=3), *CLOUDS, [*RENDER, "--gi", "points", "--atlas", "{v}_clouds"])
by_light = alike("points of the light", asking(bounces=3, radiance='"points"', atlas='"{v}_clouds"'), *CLOUDS, RENDER)
t.expect(by_option == by_light != gathered, "the light asks for it as the option does")
KEEP = [*RENDER, "--baked", "{v}_baked"]
alike("baked", asking(), KEEP, [*RENDER, "--gi", "baked", "--baked", "{v}_baked"])
for name, params in alone:
    if not name.startswith("shadow"):
        alike(f"photons of {name}", [(name, "it", params), (*GI[:2], {"samples": 16})], [*RENDER, "--gi", "atlas", *PHOTONS])
alike("a draft", asking(), [*RENDER, "--draft"])
alike("no indirect light of the scene's own", [KEY], [*RENDER, "--gi", "gather", "--samples", "16"])

# --- The lights are written to files and read back.
HIDE = ["hide", "{v}.rib", "-o", "{v}.dfb"]
GATHER = ["gather", "{v}.dfb", "-o", "{v}.icf"]
SHADE = ["shade", "{v}.dfb", "--irradiance", "{v}.icf", "-o", "{v}.exr"]
t.expect(alike("hide, gather, shade", asking(), HIDE, GATHER, SHADE) == gathered, "as in one process")
for variant in ("built", "copy"):
    t.write(variant + "_edit.rib", light(variant, "pointlight", "key", intensity=5) + light(variant, "indirectlight", "gi", lightcolor="0 1 0"))
EDIT = [*SHADE, "--edit", "{v}_edit.rib"]
stale = alike("edits", asking(), HIDE, GATHER, EDIT)
t.expect(alike("edits of light that is kept by lamps", asking(), HIDE, [*GATHER, "--by-light"], EDIT) != stale, "what bounces follows")
t.finish()
