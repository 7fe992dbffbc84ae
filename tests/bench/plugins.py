#!/usr/bin/env python3
"""Measures what many shader plugins cost: plugins.py build/release/tomales [--count 300]. It renders the same small squares in
turn with a plugin each, with a built-in shader, and with a built-in shader while the plugins lie unused on the search path. It
prints the least seconds of some runs."""
import argparse
import pathlib
import subprocess
import tempfile
import time

SOURCE = pathlib.Path(__file__).resolve().parent.parent.parent
PLUGIN = """#include <reyes/shader.h>
namespace {
rsl::FloatParam Kd("Kd", 1, "weight");
void shade(const TmGrid* g) {
  const rsl::Batch b(g);
  for (int i : b) b.output(i, Kd(g, i) * b.Cs(i), b.Os(i));
}
const rsl::Shader shader(TM_SURFACE, "%s", "", TM_KEEPS_OPACITY, shade, {&Kd});
}  // namespace
TM_SHADER_LIBRARY(shader)
"""


def build(folder, count):
    """Compiles one plugin. The others are copies under other names."""
    (folder / "plugins").mkdir()
    (folder / "p.cpp").write_text(PLUGIN % "p-000")
    subprocess.run(["g++", "-O1", "-std=c++17", "-fPIC", "-shared", "-I", str(SOURCE), str(folder / "p.cpp"), "-o", str(folder / "p.so")], check=True)
    code = (folder / "p.so").read_bytes()
    for k in range(count):
        (folder / "plugins" / f"p-{k:03}.so").write_bytes(code.replace(b"p-000", b"p-%03d" % k))


def scene(folder, name, shaders, path):
    text = f'Option "searchpath" "string shader" ["{path}"]\nDisplay "{folder}/{name}.exr" "file" "rgba"\nFormat 64 64 1\nWorldBegin\n'
    for k, shader in enumerate(shaders):
        text += f'AttributeBegin\nSurface "{shader}"\nTranslate {k * 0.001} 0 1\nPolygon "P" [0 0 0 0.1 0 0 0.1 0.1 0 0 0.1 0]\nAttributeEnd\n'
    (folder / f"{name}.rib").write_text(text + "WorldEnd\n")
    return str(folder / f"{name}.rib")


def main():
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("tomales")
    arguments.add_argument("--count", type=int, default=300)
    arguments.add_argument("--runs", type=int, default=7)
    a = arguments.parse_args()
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        build(folder, a.count)
        plugins, none = folder / "plugins", folder / "none"
        none.mkdir()
        scenes = {"plugins": scene(folder, "plugins", [f"p-{k:03}" for k in range(a.count)], plugins),
                  "unused": scene(folder, "unused", ["constant"] * a.count, plugins),
                  "none": scene(folder, "none", ["constant"] * a.count, none)}
        least = {}
        for _ in range(a.runs):
            for what, file in scenes.items():
                start = time.perf_counter()
                subprocess.run([a.tomales, file, "-t", "1"], check=True)
                least[what] = min(least.get(what, 1e9), time.perf_counter() - start)
    for what, seconds in least.items():
        print(f"{what:8} {seconds:.3f} s  ({seconds - least['none']:+.3f})")


main()
