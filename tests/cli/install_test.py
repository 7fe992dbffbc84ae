"""Does literally what docs/shader_writing.md says, in an empty folder. The renderer is installed into an empty prefix and runs from there. A plugin
of every kind is built with nothing but the installed headers, and a picture shows it."""
import os
import pathlib
import re
import subprocess

from program import Suite

t = Suite()
t.trust_shaders("plugins:.")
build = t.program.parent
docs = pathlib.Path(__file__).resolve().parent.parent.parent / "docs"
prefix = t.folder / "prefix"
SCENE = """Option "searchpath" "string shader" ["plugins:."]
Display "%s.exr" "file" "rgba"
Format 32 32 1
Projection "perspective" "fov" [40]
Translate 0 0 4
%sWorldBegin
LightSource "distantlight" 1
%sSphere 1 -1 1 360
WorldEnd
"""
KINDS = {  # These requests stand before WorldBegin and before the sphere.
    "plain": ("", 'Surface "plastic"\n'),
    "dots": ("", 'Surface "dots" "float Kd" [0.9] "color dotcolor" [0 0 1]\n'),
    "ripple": ("", 'Attribute "displacementbound" "float sphere" [0.1]\nDisplacement "ripple" "float waves" [6]\nSurface "plastic"\n'),
    "flame": ("", 'LightSource "flame" 2 "point from" [1 1 -3] "float intensity" [5]\nSurface "plastic"\n'),
    "panel": ("", 'AttributeBegin\nTranslate 0 2 -2\nRotate -90 1 0 0\nAreaLightSource "panel" 2 "float radiance" [5]\nPolygon "P" [-1 -1 0 -1 1 0 1 1 0 1 -1 0]\nAttributeEnd\nIlluminate 2 1\nSurface "plastic"\n'),
    "murk": ("", 'Atmosphere "murk"\nSurface "plastic"\n'),
    "scanlines": ('Imager "scanlines"\n', 'Surface "plastic"\n'),
    "toon": ("", 'Surface "toon"\n'),
}


def do(what, command, **more):
    result = subprocess.run(command, cwd=t.folder, capture_output=True, text=True, timeout=300, env={**os.environ, "CPLUS_INCLUDE_PATH": ""}, **more)
    t.expect(result.returncode == 0, what)
    if result.returncode:
        print(result.stdout[-2000:], result.stderr[-2000:])
    return result


do("cmake --install into an empty prefix", ["cmake", "--install", build, "--prefix", prefix])
headers = sorted(p.name for p in (prefix / "include").rglob("*") if p.is_file())
t.expect("shader.h" in headers and "sl.h" in headers and len(headers) > 10, "the headers of plugins are there")

module = next((prefix / "lib").rglob("tomales/ri.py")).parent.parent
said = do("the module of Python finds the program", ["env", "-u", "TOMALES", f"PYTHONPATH={module}", "python3", "-c", "import prman, tomales; print(tomales.program.find())"])
t.expect(said.stdout.strip() == str(prefix / "bin/tomales"), "that was installed with it: " + said.stdout)

page = (docs / "shader_writing.md").read_text()
first = re.search(r"```cpp\n(// dots.cpp\n#include.*?)```", page, re.DOTALL)[1]
t.write("dots.cpp", first)
(t.folder / "plugins").mkdir()
line = re.search(r"^(g\+\+ .* -o plugins/dots\.so dots\.cpp)$", page, re.MULTILINE)[1].replace("PREFIX", str(prefix))
do("the first shader of the page compiles by the line below it", line.split())
example = t.folder / "example"
do("and by CMake", ["cmake", "-S", docs / "example_plugin", "-B", example, f"-DCMAKE_PREFIX_PATH={prefix}", "-DCMAKE_BUILD_TYPE=Release"])
do("which builds", ["cmake", "--build", example])
for source, names in ((docs / "example_plugin/kinds.cpp", ("ripple", "flame", "panel", "murk", "scanlines")), (docs / "rsl_plugins/toon.cpp", ("toon",))):
    library = t.folder / (source.stem + ".so")
    do(f"{source.name} compiles", ["g++", "-O1", "-std=c++17", "-shared", "-fPIC", "-I", prefix / "include/tomales", "-o", library, source])
    for name in names:
        (t.folder / "plugins" / (name + ".so")).write_bytes(library.read_bytes())

t.program = prefix / "bin/tomales"
for name, (options, attributes) in KINDS.items():
    t.write(name + ".rib", SCENE % (name, options, attributes))
    said = t.expect_run(f"{name} renders with the installed program", [name + ".rib"], 0).stderr
    t.expect(not said, f"{name}: without a word")
pictures = {name: (t.folder / (name + ".exr")).read_bytes() for name in KINDS}
t.expect(len(set(pictures.values())) == len(KINDS), "each shader shows")
t.expect_run("the installed program tries one shader alone", ["shadetest", t.folder / "plugins/dots.so", "--grid", "64x64", "-o", "ci.png"], 0, "nanoseconds a point")
# The licences of libraries without a package of their own ask for their notices beside the program.
notices = (docs.parent / "cmake/copyright").read_text()
known = t.run("--version").stdout
for library in ("GLM", "CLI11", "JSON for Modern C++", "Chart.js"):
    t.expect(f"  {library} " in known and f"({library})" in notices, f"the notice of {library}, whose code is compiled in, comes with the package")
t.finish()
