"""Tests Procedural "DynamicLoad": the example plugin is built out of the tree as its page says, and other plugins are broken."""
import os
import pathlib
import subprocess

from program import Suite

t = Suite()
source = pathlib.Path(__file__).resolve().parent.parent.parent
example = source / "docs/example_procedural"


def build(name, file, compiler="CC"):
    subprocess.run([os.environ[compiler], "-shared", "-fPIC", "-I", source, file, "-o", t.folder / name], check=True)


def pixels(name):
    return (t.folder / name).read_bytes()


build("tree.so", example / "tree.c")
tree = (example / "tree.rib").read_text()
t.write("tree.rib", tree)
small = ["--format", "96x96", "--pixel-samples", "2x2", "--plugin-path", "."]
result = t.expect_run("the example plugin", ["tree.rib", "-o", "one.exr", "-t", "1", *small], 0)
t.expect(not result.stderr, "draws without a word")
t.expect_run("with four threads", ["tree.rib", "-o", "four.exr", "-t", "4", *small], 0)
t.expect(pixels("one.exr") == pixels("four.exr"), "the tree is the same, whoever opens its twigs")
t.write("bare.rib", "\n".join(line for line in tree.splitlines() if "DynamicLoad" not in line))
t.run("bare.rib", "-o", "bare.exr", *small)
t.expect(pixels("bare.exr") != pixels("one.exr"), "and there is a tree")
line = 1 + tree[: tree.index("Procedural \"Dyn")].count("\n")
t.expect_run("without leave", ["tree.rib", "-o", "no.tif", "--format", "8x8"], 3, f"tree.rib:{line}", "--allow-plugins")

scene = 'Display "o.exr" "file" "rgba" Format 8 8 1 Translate 0 0 5 WorldBegin\nProcedural "DynamicLoad" ["%s" "x"] [-1 1 -1 1 -1 1]\nWorldEnd\n'
t.write("plugin.cpp", """#include <reyes/ri.h>
#include <stdexcept>
extern "C" RtPointer ConvertParameters(char* text) { return text; }
extern "C" void Subdivide(RtPointer, RtFloat) {
  RiSphere(1, -1, 1, 360, RI_NULL);
  throw std::runtime_error("out of twigs");
}
extern "C" void Free(RtPointer) {}
""")
build("throws.so", t.folder / "plugin.cpp", "CXX")
t.write("half.cpp", 'extern "C" void* ConvertParameters(char*) { return 0; }')
build("half.so", t.folder / "half.cpp", "CXX")
t.write("fake.so", "no library")
for name, says in (("throws", "out of twigs"), ("half", "has no function Subdivide, Free"), ("fake.so", "cannot be loaded"),
                   ("nowhere", "is not found"), ("", "names no plugin")):
    t.write("bad.rib", scene % name)
    t.expect_run(f"plugin \"{name}\"", ["bad.rib", "--allow-plugins"], 3, "bad.rib:2", says)
t.finish()
