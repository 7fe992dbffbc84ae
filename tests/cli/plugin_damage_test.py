"""Tests plugins with flipped bytes: `info` must always end with an exit code. A render must do so too, or name the plugin in its
last message."""
import os
import pathlib
import random
import re
import subprocess

from program import Suite

t = Suite()
source = pathlib.Path(__file__).resolve().parent.parent.parent
COUNT = int(os.environ.get("TOMALES_FLIPS", "60"))
t.write("dots.cpp", (source / "docs/example_plugin/dots.cpp").read_text())
subprocess.run([os.environ["CXX"], "-std=c++17", "-O2", "-shared", "-fPIC", "-s", "-I", source, t.folder / "dots.cpp", "-o", t.folder / "whole.so"], check=True)
whole = (t.folder / "whole.so").read_bytes()
(t.folder / "plugins").mkdir()
t.write("scene.rib", """Display "o.exr" "file" "rgba"
Format 8 8 1
PixelSamples 1 1
Projection "perspective" "fov" [40]
Translate 0 0 4
WorldBegin
LightSource "distantlight" 1
Attribute "identifier" "name" "ball"
Surface "dots"
Sphere 1 -1 1 360
WorldEnd
""")
t.expect_run("the whole plugin", ["info", "whole.so"], 0, "dots")
chance = random.Random(1)
crashes = 0
for _ in range(COUNT):
    data = bytearray(whole)
    places = [chance.randrange(len(data)) for _ in range(chance.choice([1, 1, 4]))]
    for place in places:
        data[place] ^= 1 << chance.randrange(8)
    t.write("plugins/dots.so", bytes(data))
    info = t.run("info", "plugins/dots.so")
    if info.returncode not in (0, 2, 3):
        t.expect(False, f"bytes {places}: info ends with {info.returncode}: {info.stderr[-300:]}")
    render = t.run("scene.rib", "--plugin-path", "plugins", "-t", "1")
    if render.returncode in (0, 2, 3):
        continue
    crashes += 1
    named = "dots" in render.stderr.splitlines()[-1] if render.stderr else False
    t.expect(named, f"bytes {places}: a render that ends with {render.returncode} says whose code it was: {render.stderr[-300:]}")
print(f"{crashes} of {COUNT} renders were ended by the plugin's code")

# This plugin survives its trial and crashes when the renderer describes or runs it.
t.write("late.cpp", """#include <reyes/shader.h>
namespace { void shade(const TmGrid*) { *static_cast<volatile int*>(nullptr) = 1; } const rsl::Shader shader(TM_SURFACE, "dots", "", 0, shade, {}); }
TM_SHADER_LIBRARY(shader)
""")
subprocess.run([os.environ["CXX"], "-std=c++17", "-shared", "-fPIC", "-I", source, t.folder / "late.cpp", "-o", t.folder / "plugins/dots.so"], check=True)
result = t.run("scene.rib", "--plugin-path", "plugins", "-t", "1", "--log", "farm.log")
t.expect(result.returncode == -11 and re.search(r'scene.rib:9: "ball", in the bucket of the pixels -?\d+,-?\d+ to \d+,\d+: surface shader "dots" crashes', result.stderr), f"a crash while it shades names shader, object, line and bucket: {result.stderr[-300:]}")
last = (t.folder / "farm.log").read_text().splitlines()[-1]
t.expect(re.fullmatch(r"\d{4}-\d\d-\d\dT\d\d:\d\d:\d\dZ " + re.escape(result.stderr.splitlines()[-1]), last), f"in the log, too, with the time: {last}")
full = ["sh", "-c", '"$@" 2>/dev/full', "sh", t.program, "scene.rib", "--plugin-path", "plugins", "-t", "1", "--log", "full.log"]
subprocess.run(full, cwd=t.folder, timeout=60)
t.expect('"dots" crashes' in (t.folder / "full.log").read_text(), "also where standard error takes nothing")
t.write("wild.cpp", """#include <reyes/shader_api.h>
static const TmParamDecl params[] = {{(const char*)8, TM_FLOAT, 1, 0, 0, 0, 0}};
static const TmShader shader = {TM_SHADER_ABI, sizeof(TmShader), TM_SURFACE, 0, 1, sizeof(TmParamDecl), params, [](const TmGrid*) {}, "dots", 0, 0, 0};
static const TmShader* const shaders[] = {&shader};
static const TmShaderLibrary library = {TM_SHADER_ABI, sizeof(TmShaderLibrary), shaders, 0, 1};
extern "C" const TmShaderLibrary* tomales_shaders() { return &library; }
""")
subprocess.run([os.environ["CXX"], "-std=c++17", "-shared", "-fPIC", "-I", source, t.folder / "wild.cpp", "-o", t.folder / "plugins/dots.so"], check=True)
t.expect_run("a name that leads nowhere is found on trial", ["scene.rib", "--plugin-path", "plugins"], 3, "crashes while it is loaded")
t.expect_run("and in info", ["info", "plugins/dots.so"], 2, "crashes")

# A procedural's constructor that crashes ends the trial of the plugin, but not the frame.
t.write("tree.cpp", """#include <reyes/ri.h>
struct Bad { Bad() { __builtin_trap(); } } bad;
extern "C" RtPointer ConvertParameters(char*) { return nullptr; }
extern "C" void Subdivide(RtPointer, RtFloat) { RiSphere(1, -1, 1, 360, RI_NULL); }
extern "C" void Free(RtPointer) {}
""")
subprocess.run([os.environ["CXX"], "-std=c++17", "-shared", "-fPIC", "-I", source, t.folder / "tree.cpp", "-o", t.folder / "plugins/tree.so"], check=True)
t.write("tree.rib", 'Display "o.exr" "file" "rgba" Format 8 8 1 Translate 0 0 5 WorldBegin\nProcedural "DynamicLoad" ["tree" ""] [-1 1 -1 1 -1 1]\nWorldEnd\n')
t.expect_run("a procedural that crashes in a constructor", ["tree.rib", "--plugin-path", "plugins"], 3, "tree.rib:2", "crashes while it is loaded")
t.write("tree.cpp", (t.folder / "tree.cpp").read_text().replace("struct Bad { Bad() { __builtin_trap(); } } bad;", "").replace("{ RiSphere(1, -1, 1, 360, RI_NULL); }", "{ __builtin_trap(); }"))
subprocess.run([os.environ["CXX"], "-std=c++17", "-shared", "-fPIC", "-I", source, t.folder / "tree.cpp", "-o", t.folder / "plugins/tree.so"], check=True)
result = t.run("tree.rib", "--plugin-path", "plugins")
t.expect(result.returncode == -4 and re.search(r'tree.rib:2: Procedural, in the bucket of .*: plugin "tree" crashes', result.stderr), f"one that crashes in Subdivide is named: {result.stderr[-300:]}")
t.finish()
