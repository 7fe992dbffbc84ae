"""Tests shader plugins that are broken in every way that can be detected: errors have a place, and the frame goes on with a
conspicuous substitute."""
import os
import pathlib
import signal
import subprocess
import time

from program import Suite

t = Suite()
t.trust_shaders(".")
source = pathlib.Path(__file__).resolve().parent.parent.parent
SCENE = """Display "o.exr" "file" "rgba"
Format 16 16 1
Projection "perspective" "fov" [40]
Translate 0 0 4
WorldBegin
LightSource "distantlight" 1
Attribute "identifier" "name" ["ball"]
Surface "%s"
Sphere 1 -1 1 360
WorldEnd
"""
SHADER = """#include <reyes/shader.h>
namespace {
void shade(const TmGrid* g) {
  for (int i : rsl::Batch(g)) rsl::Batch(g).output(i, rsl::Color{%s, 1, 1}, {1, 1, 1});
}
const rsl::Shader shader(TM_SURFACE, "%s", "", 0, shade, {});
%s
}
TM_SHADER_LIBRARY(shader)
"""


def build(name, code):
    t.write(name + ".cpp", code)
    subprocess.run([os.environ["CXX"], "-std=c++17", "-shared", "-fPIC", "-I", source, t.folder / (name + ".cpp"), "-o", t.folder / (name + ".so")],
                   check=True)


def render(name, code, *says):
    t.write("scene.rib", SCENE % name)
    result = t.expect_run(name, ["scene.rib"], code, *says)
    t.expect((t.folder / "o.exr").exists(), f"{name}: there is a picture")
    (t.folder / "o.exr").unlink(missing_ok=True)
    return result


build("good", SHADER % ("0.5f", "good", ""))
t.expect(not render("good", 0).stderr, "a good plugin renders without a word")
build("crashing", SHADER % ("0.5f", "crashing", "struct Crash { Crash() { *(volatile int*)8 = 1; } } crash;"))
render("crashing", 3, "crashing.so", "crashes while it is loaded", "scene.rib:8", "\"ball\"", "magenta")
build("leaving", "#include <cstdlib>\n" + SHADER % ("0.5f", "leaving", "struct Leave { Leave() { std::_Exit(7); } } leave;"))
render("leaving", 3, "leaving.so", "ends the program while it is loaded", "scene.rib:8")
build("misnamed", SHADER % ("0.5f", "other", ""))
render("misnamed", 3, "misnamed.so", 'has no surface "misnamed", but surface "other"', "magenta")
build("lamp", SHADER.replace("TM_SURFACE", "TM_LIGHT") % ("0.5f", "lamp", ""))
render("lamp", 3, "lamp.so", 'has no surface "lamp", but light "lamp"', "magenta")
build("quitting", "#include <cstdlib>\n" + SHADER % ("0.5f", "quitting", "struct Quit { Quit() { std::_Exit(0); } } quit;"))
render("quitting", 3, "quitting.so", "ends the program while it is loaded", "scene.rib:8")
t.write("several.rib", (SCENE % "crashing").replace("WorldEnd", 'Surface "good"\nSphere 1 -1 1 360\nSurface "leaving"\nSphere 1 -1 1 360\nSurface "crashing"\nSphere 1 -1 1 360\nWorldEnd'))
said = t.expect_run("plugins are tried after others have crashed", ["several.rib"], 3, "crashing.so", "leaving.so").stderr
t.expect("good.so" not in said and said.count("crashes while it is loaded") == 1, "each for itself, and once")
# Procedurals meet these plugins while other threads shade. Each broken plugin is reported, and everything sound is in the picture.
for k in range(6):
    (t.folder / f"crashing{k}.so").write_bytes((t.folder / "crashing.so").read_bytes())
    t.write(f"later{k}.rib", f'Surface "crashing{k}"\nTranslate {k - 3} 0 0\nSphere 0.3 -0.3 0.3 360\n')
later = "".join(f'Procedural "DelayedReadArchive" ["later{k}.rib"] [-4 4 -0.3 0.3 -0.3 0.3]\n' for k in range(6))
t.write("later.rib", (SCENE % "good").replace("Format 16 16", "Format 64 64").replace("WorldEnd", later + "WorldEnd"))
said = t.expect_run("plugins are tried while other threads run", ["later.rib", "--bucket-size", "8", "-t", "4"], 3, *(f"crashing{k}.so" for k in range(6))).stderr
t.expect(said.count("crashes while it is loaded") == 6 and "good.so" not in said, "each is told once, and nothing else is lost")

build("old", (SHADER % ("0.5f", "old", "")).replace("#include", "#include <reyes/shader_api.h>\n#undef TM_SHADER_ABI\n#define TM_SHADER_ABI 0u\n#include"))
render("old", 3, "old.so", "is built for shader ABI 0, 32 bytes; this renderer has ABI 1, 32 bytes: compile it against the headers", "scene.rib:8")
build("empty", "extern \"C\" int unrelated() { return 1; }")
render("empty", 3, "empty.so", "does not export tomales_shaders")
build("nameless", (SHADER % ("0.5f", "", "")))
render("nameless", 3, "nameless.so", "lacks a name")
t.write("text.so", "no library")
render("text", 3, "text.so", "cannot be loaded")

build("dividing", SHADER % ("0.0f / 0.0f", "dividing", ""))
said = render("dividing", 0, "\"ball\"", "\"dividing\"", "NaN").stderr
t.expect(said.count("dividing\"") == 1, "NaN is told once")
build("throwing", "#include <stdexcept>\n" + (SHADER % ("0.5f", "throwing", "")).replace("void shade(const TmGrid* g) {", "void shade(const TmGrid* g) {\n  if (g) throw std::runtime_error(\"no bananas\");"))
said = render("throwing", 3, "\"ball\"", "no bananas", "scene.rib:8").stderr
t.expect(said.count("no bananas") == 1, "an exception is told once")

# Parameters that are listed wrongly are found when the plugin is loaded. Each plugin counts its own.
build("unlisted", (SHADER % ("Ks(g, i)", "unlisted", "")).replace("void shade", 'rsl::FloatParam Ks("Ks", 0.5f, "");\nvoid shade'))
render("unlisted", 3, "unlisted.so", 'no shader lists the parameter "Ks"', "magenta")
build("placed", (SHADER % ("b(g, i)", "placed", 'const rsl::Shader second(TM_SURFACE, "second", "", 0, shade, {&b});'))
      .replace("void shade", 'rsl::FloatParam a("a", 0, ""), b("b", 1, "");\nvoid shade').replace("shade, {});", "shade, {&a, &b});", 1).replace("(shader)", "(shader, second)"))
render("placed", 3, "placed.so", 'shader "second" lists the parameter "b" at place 1, and shader "placed" lists it at place 2')
t.write("both.rib", (SCENE % "unlisted").replace("WorldEnd", 'Surface "good"\nSphere 1 -1 1 360\nWorldEnd'))
said = t.expect_run("a sound plugin beside one with an unlisted parameter", ["both.rib"], 3, "unlisted.so").stderr
t.expect("good.so" not in said, "is not blamed for it")

# A crash inside a shader ends the program as before, but says where it was.
CRASHES = {
    "segv": ("*(volatile int*)8 = 1;", -signal.SIGSEGV, "SIGSEGV"),
    "deep": ("volatile char a[4096]; a[0] = 1; if (g) { void shade(const TmGrid*); shade(g); } a[1] = a[0];", -signal.SIGSEGV, "SIGSEGV"),
    "zero": ("raise(SIGFPE);", -signal.SIGFPE, "SIGFPE"),
    "stop": ("abort();", -signal.SIGABRT, "SIGABRT"),
}
for name, (code, status, says) in CRASHES.items():
    build(name, "#include <csignal>\n#include <cstdlib>\n" + (SHADER % ("0.5f", name, "")).replace("void shade(const TmGrid* g) {", "void shade(const TmGrid* g) {\n  " + code))
    for threads in ("1", "4"):
        t.write("scene.rib", SCENE % name)
        t.expect_run(f"a shader that ends by {says}: {name}, {threads} threads", ["scene.rib", "-t", threads], status,
                     f'scene.rib:8: "ball", in the bucket of the pixels -1,-1 to 16,16: surface shader "{name}" crashes ({says}')
t.write("scene.rib", (SCENE % "good").replace('LightSource "distantlight" 1', 'LightSource "segv" "lamp"'))
build("segv", "#include <csignal>\n" + (SHADER % ("0.5f", "segv", "")).replace("TM_SURFACE", "TM_LIGHT").replace("void shade(const TmGrid* g) {", "void shade(const TmGrid* g) {\n  *(volatile int*)8 = 1;"))
build("lit", (SHADER % ("0.5f", "lit", "")).replace("void shade(const TmGrid* g) {", "void shade(const TmGrid* g) {\n  rsl::Batch(g).diffuse(g->Ng);"))
t.write("scene.rib", (SCENE % "lit").replace('LightSource "distantlight" 1', 'LightSource "segv" "lamp"'))
t.expect_run("a light that crashes", ["scene.rib"], -signal.SIGSEGV, 'scene.rib:6: light "lamp", on "ball", in the bucket of the pixels -1,-1 to 16,16: light shader "segv" crashes')

# An endless shader is reported too, 10 s after the first signal.
build("endless", (SHADER % ("0.5f", "endless", "")).replace("void shade(const TmGrid* g) {", "void shade(const TmGrid* g) {\n  for (volatile int k = 0;; k = 1 - k) {}"))
t.write("scene.rib", SCENE % "endless")
process = subprocess.Popen([t.program, "scene.rib", "-t", "2"], cwd=t.folder, stderr=subprocess.PIPE, text=True)
time.sleep(1)
process.send_signal(signal.SIGTERM)
said = process.communicate(timeout=60)[1]
t.expect(process.returncode == 143 and 'scene.rib:8: "ball", in the bucket of the pixels -1,-1 to 16,16: surface shader "endless" does not return' in said, f"an endless shader is named after one signal ({process.returncode}, {said[:300]})")
t.finish()
