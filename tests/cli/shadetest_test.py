"""Tests `tomales shadetest`, which runs one shader over a grid: known values, and shaders that do not exist."""
import os
import pathlib
import re
import subprocess

from program import GOOD, Suite

t = Suite()


def figure(result, name):
    return [float(x) for x in re.search(f"^{name}: (.*)$", result.stdout, re.MULTILINE)[1].split()]


constant = t.expect_run("constant", ["shadetest", "constant", "--grid", "8x4", "-o", "c.exr"], 0, "points: 8 x 4")
t.expect(figure(constant, "Ci mean") == [1, 1, 1], "is white")
t.expect((t.folder / "c.exr").exists(), "the picture is written")
t.expect(figure(constant, "nanoseconds a point")[0] > 0, "takes time")
light = t.expect_run("a light is tried on matte", ["shadetest", "ambientlight"], 0)
t.expect(figure(light, "Ci greatest") == [1, 1, 1], "and lights it")
bump = t.expect_run("a displacement", ["shadetest", "noisybump"], 0)
t.expect(0 < figure(bump, "longest displacement")[0] <= 0.1, "stays within its Km")
t.expect("displacement-bound" not in bump.stderr, "needs no bound of a scene that the user has not written")
for wrong in ("Km=abc", "Km=1,2", "Km=", "Km=1x"):
    t.expect_run(f"a value that does not suit, {wrong},", ["shadetest", "noisybump", wrong], 3, '"Km" takes 1 number, and not', "shadetest-parameter")
for kind, body in (("surface", ""), ("volume", ""), ("displacement", ""), ("light", "solar(vector(0, 0, 1), 0) Cl = 1;")):
    t.write("says.sl", f'{kind} says() {{ printf("here\\n"); {body} }}\n')
    lines = t.expect_run(f"a {kind} that prints", ["shadetest", "says.sl", "--grid", "3x3"], 0).stderr.count("here")
    t.expect(lines == 9, f"does so once a point, however often it is timed ({lines} lines)")
fog = t.expect_run("a volume lies before a lit square", ["shadetest", "fog", "--grid", "3x3"], 0)
plain = t.expect_run("which is as bright as", ["shadetest", "matte", "--grid", "3x3"], 0)
t.expect(abs(figure(fog, "Ci greatest")[0] / figure(plain, "Ci greatest")[0] - 2.718281828 ** -5) < 1e-4, "without five units of fog")
imager = t.expect_run("an imager", ["shadetest", "background", "--grid", "5x2", "-o", "i.exr"], 0)
t.expect(figure(imager, "Ci least") == [0.5] * 3 and figure(imager, "Ci greatest") == [1] * 3, "fills what alpha leaves of its wedge")
t.expect_run("an unknown name", ["shadetest", "nosuch"], 2, "nosuch")
t.expect_run("a file that is no plugin", ["shadetest", t.write("no.so", "text")], 3, "no.so")
t.expect_run("a grid of one point", ["shadetest", "matte", "--grid", "1x1"], 1)
profile = t.expect_run("--profile-shaders", [t.write("good.rib", GOOD), "--profile-shaders"], 0, "matte", "ns a point")
t.expect(int(re.search(r"^matte +(\d+) ", profile.stdout, re.MULTILINE)[1]) > 0, "counts the points of matte")
for shader in ("glass", "mirror", "occlusionlight", "arealight"):
    t.expect(not t.expect_run(f"{shader} asks for rays", ["shadetest", shader, "--grid", "4x4"], 0).stderr, "and there are some")
arealight = t.run("shadetest", "arealight", "--grid", "4x4")
t.expect(figure(arealight, "Ci greatest")[0] > 0.01, "an area light has a lamp to shine from")

# --check compares what a shader declares with what it does.
source = pathlib.Path(__file__).resolve().parent.parent.parent
PLUGIN = """#include <reyes/shader.h>
namespace {
%s
void shade(const TmGrid* g) {
  const rsl::Batch b(g);
  %s
}
const rsl::Shader shader(%s, "tried", "", %s, shade, {%s});
%s
}
TM_SHADER_LIBRARY(shader%s)
"""


def check(what, body, faults, kind="TM_SURFACE", capabilities="0", before="", params="", after="", also=""):
    t.write("tried.cpp", PLUGIN % (before, body, kind, capabilities, params, after, also))
    subprocess.run([os.environ["CXX"], "-std=c++17", "-shared", "-fPIC", "-I", source, t.folder / "tried.cpp", "-o", t.folder / "tried.so"], check=True)
    return t.expect_run("check: " + what, ["shadetest", "./tried.so", "--check"], 3 if faults else 0, f"faults: {len(faults)}", *faults)


MATTE = "const auto light = b.diffuse(b.facingNormals()); for (int i : b) b.output(i, b.Cs(i) * light[i], %s);"
check("a sound shader", MATTE % "b.Os(i)", [], capabilities="TM_KEEPS_OPACITY | TM_EVEN")
check("another opacity", MATTE % "0.5f * b.Os(i)", ['shader "tried" writes another Oi than Os, but has declared TM_KEEPS_OPACITY'], capabilities="TM_KEEPS_OPACITY")
check("which it may have", MATTE % "0.5f * b.Os(i)", [])
check("a glow", "for (int i : b) b.output(i, {1, 1, 1}, b.Os(i));", ["adds light where there is none, but has not declared TM_EMITS"])
check("that is declared", "for (int i : b) b.output(i, {1, 1, 1}, b.Os(i));", [], capabilities="TM_EMITS")
check("dots on an even surface", "const auto light = b.diffuse(b.facingNormals()); for (int i : b) b.output(i, g->s[i] * light[i], b.Os(i));",
      ["does not look the same everywhere"], capabilities="TM_EVEN")
check("points that are not active", "for (int i = 0; i < g->count; ++i) b.output(i, {0, 0, 0}, b.Os(i));", ["writes Oi of points that are not active"])
check("the tail", "for (int i = g->count; i < g->padded; ++i) g->Ci.y[i] = 1;", ["writes Ci of points that are not active"])
check("beyond the tail", "g->Oi.y[g->padded] = 1;", ["writes outside of its arrays, beside Oi"])
check("NaN", "for (int i : b) b.output(i, b.Cs(i) * std::sqrt(-1 - g->s[i]) * b.diffuse(b.facingNormals())[i].x, b.Os(i));", ["leaves NaN or infinity in Ci"] * 1 + ["NaN or infinity; such points are black"])
check("an output", "if (out.wanted(g)) for (int i = 0; i < g->count; ++i) out.set(g, i, 1);", ['writes output "out" of points that are not active'],
      before='rsl::FloatOutput out("out", "");', params="&out")
check("rays that are not declared", "b.trace(b.facingNormals());", ["has not declared TM_TRACES"])
check("a displacement", "rsl::Array far(g); for (int i = 0; i < g->count; ++i) g->P.x[i] += 1;", ["writes P of points that are not active"], kind="TM_DISPLACEMENT")
check("a light", "for (int i : b) b.illuminate(i, {0, 0, -1 / g->s[0] * 0}, {1, 1, 1}); for (int i = 0; i < g->count; ++i) g->Cl.x[i] = 1;", ["writes Cl of points that are not active"],
      kind="TM_LIGHT", capabilities="TM_LIGHT_SOLAR")
check("a shader that ends the program", "std::exit(0);", ['shader "tried" ends the program'])
check("a crash", "*(volatile int*)8 = 1;", ['shader "tried" crashes (Segmentation fault)'])
second = {"before": 'rsl::FloatParam mine("mine", 1, ""), its("its", 1, "");\nvoid other(const TmGrid* g) { for (int i : rsl::Batch(g)) rsl::Batch(g).output(i, {0, 0, 0}, {its(g, i), 1, 1}); }',
          "params": "&mine", "after": 'const rsl::Shader second(TM_SURFACE, "second", "", 0, other, {&its});', "also": ", second"}
check("its own parameter", "for (int i : b) b.output(i, {0, 0, 0}, {mine(g, i), 1, 1});", [], **second)
check("another shader's parameter", "for (int i : b) b.output(i, {0, 0, 0}, {its(g, i), 1, 1});", ['shader "tried" reads the parameter "its", which it does not list'][:1], **second)
for shader in ("matte", "plastic", "disney", "glass", "constant", "noisybump", "fog", "background", "distantlight", "arealight", "environmentlight", "sunlight"):
    t.expect_run(f"check: {shader} is what it says", ["shadetest", shader, "--check"], 0, "faults: 0")
t.finish()
