"""A scene may come from a stranger: native code that it names is not run unless the user trusts the scene or the folder."""
import os
import pathlib
import subprocess

from program import Suite

t = Suite()
source = pathlib.Path(__file__).resolve().parent.parent.parent
PLUGIN = """#include <reyes/shader.h>
#include <cstdio>
namespace {
struct Loaded { Loaded() { if (FILE* f = std::fopen("ran", "w")) std::fclose(f); } } loaded;
void shade(const TmGrid* g) {
  for (int i : rsl::Batch(g)) rsl::Batch(g).output(i, rsl::Color{0.5f, 1, 1}, {1, 1, 1});
}
const rsl::Shader shader(TM_SURFACE, "evil", "", 0, shade, {});
const rsl::Shader light(TM_LIGHT, "evil", "", 0, shade, {});
}
TM_SHADER_LIBRARY(shader, light)
"""
SCENE = """%s
Display "o.exr" "file" "rgba"
Format 16 16 1
Projection "perspective" "fov" [40]
Translate 0 0 4
WorldBegin
LightSource "distantlight" 1
%s
Sphere 1 -1 1 360
WorldEnd
"""


def scene(name, path, request):
    return t.write(name, SCENE % (f'Option "searchpath" "string shader" ["{path}"]' if path else "", request))


def runs(what, arguments, code, *says):
    """Was the plugin's code run? In this process or in that which tries plugins."""
    (t.folder / "ran").unlink(missing_ok=True)
    t.expect_run(what, arguments, code, *says)
    return (t.folder / "ran").exists()


t.write("evil.cpp", PLUGIN)
(t.folder / "brought").mkdir()
(t.folder / "mine/below").mkdir(parents=True)
subprocess.run([os.environ["CXX"], "-std=c++17", "-shared", "-fPIC", "-I", source, t.folder / "evil.cpp", "-o", t.folder / "brought/evil.so"], check=True)
code = (t.folder / "brought/evil.so").read_bytes()
(t.folder / "evil.so").write_bytes(code)
(t.folder / "mine/below/evil.so").write_bytes(code)

REFUSED = "is not loaded; --shaders"
scene("working.rib", None, 'Surface "evil"')
scene("path.rib", "brought", 'Surface "evil"')
scene("upwards.rib", "mine", 'Surface "../brought/evil"')
scene("absolute.rib", "mine", f'Surface "{t.folder}/brought/evil"')
scene("light.rib", "brought", 'LightSource "evil" 2')
for name in ("working", "path", "upwards", "absolute", "light"):
    file = name + ".rib"
    t.expect(not runs(f"{name}: render refuses it", [file], 3, REFUSED), f"{name}: render does not run it")
    t.expect(runs(f"{name}: --allow-system", [file, "--allow-system"], 3 if name in ("upwards", "absolute") else 0), f"{name}: --allow-system runs it")
    t.expect(not runs(f"{name}: hide", ["hide", file, "-o", "o.dfb"], 3, REFUSED), f"{name}: hide does not run it")
    t.expect(not runs(f"{name}: shade", ["shade", "o.dfb"], 3, REFUSED), f"{name}: shade does not run it")
    t.expect(not runs(f"{name}: photons", ["photons", file, "-o", "maps", "--photons", "100"], 3, REFUSED), f"{name}: photons do not run it")
for name in ("upwards", "absolute"):
    t.expect(not runs(f"{name}: --shaders", [name + ".rib", "--shaders", "mine"], 3, REFUSED), f"a trusted folder is not left: {name}")

t.expect(runs("a trusted folder", ["path.rib", "--shaders", "/nowhere:mine/below"], 0), "a plugin of a trusted folder is loaded")
t.expect(runs("a name below it", [scene("below.rib", None, 'Surface "below/evil"'), "--shaders", "mine"], 3, "has no surface"), "so is one of a folder below it")
os.environ["TOMALES_SHADERS"] = "mine/below"
t.expect(runs("$TOMALES_SHADERS", ["path.rib"], 0), "the environment names trusted folders")
t.finish()
