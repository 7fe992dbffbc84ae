"""Tests scenes that come from a stranger: each risk that docs/security.md names is tried, with permission and without."""
import os
import pathlib
import shutil
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
    """Returns whether the plugin's code was run, in this process or in the one that tries plugins."""
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

REFUSED = "is not loaded; --plugin-path"
scene("working.rib", None, 'Surface "evil"')
scene("path.rib", "brought", 'Surface "evil"')
scene("upwards.rib", "mine", 'Surface "../brought/evil"')
scene("absolute.rib", "mine", f'Surface "{t.folder}/brought/evil"')
scene("light.rib", "brought", 'LightSource "evil" 2')
for name in ("working", "path", "upwards", "absolute", "light"):
    file = name + ".rib"
    t.expect(not runs(f"{name}: render refuses it", [file], 3, REFUSED), f"{name}: render does not run it")
    for leave in ("--allow-plugins", "--allow-system"):
        t.expect(runs(f"{name}: {leave}", [file, leave], 3 if name in ("upwards", "absolute") else 0), f"{name}: {leave} runs it")
    t.expect(not runs(f"{name}: hide", ["hide", file, "-o", "o.dfb"], 3, REFUSED), f"{name}: hide does not run it")
    t.expect(not runs(f"{name}: shade", ["shade", "o.dfb"], 3, REFUSED), f"{name}: shade does not run it")
    t.expect(not runs(f"{name}: photons", ["photons", file, "-o", "maps", "--photons", "100"], 3, REFUSED), f"{name}: photons do not run it")
    t.expect(not runs(f"{name}: an edit", ["shade", "o.dfb", "--edit", t.write("edit.rib", f'Option "searchpath" "shader" "brought" Surface "evil"')],
                      3), f"{name}: an edit does not run it")
for name in ("upwards", "absolute"):
    for option in ("--shaders", "--plugin-path"):
        t.expect(not runs(f"{name}: {option}", [name + ".rib", option, "mine"], 3, REFUSED), f"a trusted folder is not left: {name}")

t.expect(runs("a trusted folder", ["path.rib", "--shaders", "/nowhere:mine/below"], 0), "a plugin of a trusted folder is loaded")
t.expect(runs("a name below it", [scene("below.rib", None, 'Surface "below/evil"'), "--shaders", "mine"], 3, "has no surface"), "so is one of a folder below it")


def with_environment(name, value, what, arguments, code=0):
    os.environ[name] = str(value)
    t.expect(runs(f"${name}", arguments, code), what)
    del os.environ[name]


with_environment("TOMALES_SHADERS", "mine/below", "TOMALES_SHADERS names trusted folders", ["path.rib"])
with_environment("TOMALES_PLUGIN_PATH", "/nowhere:mine/below", "so does TOMALES_PLUGIN_PATH", ["path.rib"])
with_environment("TOMALES_PLUGIN_PATH", "mine/below", "also beside --plugin-path", ["path.rib", "--plugin-path", "mine"])
t.expect(runs("--plugin-path", ["path.rib", "--plugin-path", "/nowhere:mine/below"], 0), "so does --plugin-path")


def put(folder):
    (t.folder / folder).mkdir(parents=True)
    (t.folder / folder / "evil.so").write_bytes(code)
    return t.folder / folder


put("home/.config/tomales/plugins"), put("config2/tomales/plugins")
with_environment("XDG_CONFIG_HOME", t.folder / "config2", "the user's configuration holds trusted plugins", ["path.rib"])
os.environ["XDG_CONFIG_HOME"] = ""
with_environment("HOME", t.folder / "home", "by default below the home folder", ["path.rib"])
del os.environ["XDG_CONFIG_HOME"]
os.environ["XDG_CONFIG_HOME"] = "config2"
t.expect(not runs("a relative XDG_CONFIG_HOME", ["path.rib"], 3, REFUSED), "a relative folder of configuration is ignored, as XDG asks")
del os.environ["XDG_CONFIG_HOME"]
(t.folder / "prefix/bin").mkdir(parents=True)
put("prefix/lib/tomales/plugins")
shutil.copy(t.program, t.folder / "prefix/bin/tomales")
built, t.program = t.program, t.folder / "prefix/bin/tomales"
t.expect(runs("an installation", ["path.rib"], 0), "so does the installation")
t.program = built

# Procedurals name a plugin of "DynamicLoad".
t.write("procedural.cpp", """#include <reyes/ri.h>
#include <cstdio>
extern "C" RtPointer ConvertParameters(char*) { if (FILE* f = std::fopen("ran", "w")) std::fclose(f); return nullptr; }
extern "C" void Subdivide(RtPointer, RtFloat) { RiSphere(1, -1, 1, 360, RI_NULL); }
extern "C" void Free(RtPointer) {}
""")
build = [os.environ["CXX"], "-std=c++17", "-shared", "-fPIC", "-I", source, t.folder / "procedural.cpp", "-o"]
for folder in (".", "brought", "mine/below"):
    subprocess.run([*build, t.folder / folder / "worse.so"], check=True)
CALL = 'Procedural "DynamicLoad" ["%s" ""] [-1 1 -1 1 -1 1]'
scene("p_working.rib", None, CALL % "worse")
t.write("p_path.rib", 'Option "searchpath" "procedural" "brought"\n' + SCENE % ("", CALL % "worse.so"))
scene("p_upwards.rib", None, CALL % "brought/../brought/worse.so")
scene("p_absolute.rib", None, CALL % f"{t.folder}/brought/worse.so")
t.write("p_archive.rib", CALL % "worse")
scene("p_nested.rib", None, 'Procedural "DelayedReadArchive" ["p_archive.rib"] [-1 1 -1 1 -1 1]')
scene("p_second.rib", None, 'Procedural2 "DynamicLoad2" "SimpleBound" "string dsoname" "worse" "float[6] bound" [-1 1 -1 1 -1 1]')
for name in ("working", "path", "upwards", "absolute", "nested", "second"):
    file = f"p_{name}.rib"
    t.expect(not runs(f"{file}: render refuses it", [file], 3, REFUSED), f"{file}: it does not run")
    t.expect(not runs(f"{file}: --shaders", [file, "--shaders", "mine/below"], 3, REFUSED), f"{file}: --shaders is for shaders alone")
    t.expect(runs(f"{file}: --allow-plugins", [file, "--allow-plugins"], 0), f"{file}: --allow-plugins runs it")
for name in ("working", "path", "nested", "second"):
    t.expect(runs(f"{name}: --plugin-path", [f"p_{name}.rib", "--plugin-path", "mine/below"], 0), f"p_{name}.rib: a trusted folder runs it")

# Scenes name programs.
scene("system.rib", None, 'System "touch ran"')
scene("program.rib", None, 'Procedural "RunProgram" ["touch ran; echo Sphere 1 -1 1 360; printf \\377; cat" ""] [-1 1 -1 1 -1 1]')
for name in ("system", "program"):
    t.expect(not runs(f"{name} is refused", [name + ".rib", "--allow-plugins", "--plugin-path", "."], 3, "--allow-system allows them"), f"{name}: plugins are no programs")
    t.expect(runs(f"{name} is allowed", [name + ".rib", "--allow-system"], 0), f"{name}: --allow-system runs it")

# The folder of a scene holds files with the names of libraries of the program.
for line in subprocess.run(["ldd", t.program], capture_output=True, text=True, check=True).stdout.splitlines():
    if line.strip().startswith("lib"):
        t.write(line.split()[0], "no library")
t.expect_run("libraries are not looked for in the working folder", ["--version"], 0)
t.finish()
