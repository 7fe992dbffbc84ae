"""Tests functions of plugins that shaders in RSL call (DSO shadeops): docs/example_plugin/functions.c, and broken ones."""
import math
import os
import pathlib
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "image"))
from pictures import pixels  # noqa: E402
from program import Suite  # noqa: E402

t = Suite()
source = pathlib.Path(__file__).resolve().parent.parent.parent
SCENE = """Format 16 16 1
PixelFilter "box" 1 1
PixelSamples 1 1
Hider "hidden" "int jitter" [0]
ShadingRate .01
Translate 0 0 3
WorldBegin
Surface "%s"
Patch "bilinear" "P" [-1 1 0  1 1 0  -1 -1 0  1 -1 0]
WorldEnd
"""


def build(name, code, folder="."):
    (t.folder / folder).mkdir(exist_ok=True)
    t.write(name + ".c", code)
    subprocess.run([os.environ["CC"], "-O2", "-shared", "-fPIC", "-I", source, t.folder / (name + ".c"), "-o", t.folder / folder / (name + ".so"), "-lm"], check=True)


def render(name, code=0, *says, options=()):
    result = t.expect_run(name, [t.write(name + ".rib", SCENE % name), "-o", name + ".exr", *options], code, *says)
    t.expect(code != 0 or not result.stderr, f"  without a message ({result.stderr[:300]})")
    return pixels(t.folder / (name + ".exr"))


def expect(name, wanted, what, tolerance=1e-3, **more):
    seen = render(name, **more)
    off = max(abs(a - b) for (x, y), p in seen.items() for a, b in zip(p, wanted((x + 0.5) / 16, (y + 0.5) / 16)))
    t.expect(off < tolerance, f"  {what} (off by {off:.2g})")


FUNCTIONS = (source / "docs/example_plugin/functions.c").read_text()
build("functions", FUNCTIONS, "plugins")
t.trust_shaders("plugins")
t.write("woven.sl", "surface woven() { Oi = 1; Ci = weave(4 * s, 4 * t); }\n")
expect("woven", lambda s, t: ((math.floor(4 * s) + math.floor(4 * t)) % 2,) * 3, "a number of numbers")
t.write("turned.sl", "surface turned() { float r = 7, a = 7; if (s > .5) polar(s - .5, t - .5, r, a); Oi = 1; Ci = color(r, a, 0); }\n")
expect("turned", lambda s, t: (math.hypot(s - .5, t - .5), math.atan2(t - .5, s - .5), 0) if s > .5 else (7, 7, 0),
       "outputs, where a condition holds", 0.1)  # The angle turns quickly near the middle.
t.write("faded.sl", "surface faded(uniform float density = 2) { Oi = 1; Ci = fade(color(1, s, 0), density); Ci += 0 * fade(1, t); }\n")
expect("faded", lambda s, t: (math.exp(-2), s * math.exp(-2), 0), "colours, numbers for them, and what is uniform")
t.expect_run("compile knows them", ["compile", "woven.sl"], 0)
t.expect_run("and what they take", ["compile", t.write("misused.sl", "surface misused() { Ci = weave(P); }\n")], 2, "there is no weave(point)", "there is float weave(float, float)")
t.expect_run("and --dump shows them", ["compile", "woven.sl", "--dump", "code"], 0, "Plugin")
t.expect_run("shadetest knows them", ["shadetest", "woven.sl", "--grid", "8x8"], 0)
t.write("own.sl", "float weave(float a, b) { return 0; }\nsurface own() { Oi = 1; Ci = weave(s, t); }\n")
expect("own", lambda s, t: (0, 0, 0), "a function of the file comes first")

# The plugin counts for --skip-finished.
line = ["woven.rib", "-o", "woven.exr", "--skip-finished"]
t.expect_run("a frame whose plugin is the same", line, 0, "frame-skipped")
build("functions", FUNCTIONS.replace("fmodf(fabsf(x + y), 2)", "1 - fmodf(fabsf(x + y), 2)"), "plugins")
t.expect("frame-skipped" not in t.expect_run("one whose plugin has changed", line, 0).stderr, "is rendered again")
build("functions", FUNCTIONS, "plugins")

# The function does not exist.
t.write("lacking.sl", "surface lacking() { Oi = 1; Ci = crochet(s, t); }\n")
t.expect({p[:3] for p in render("lacking", 3, "crochet").values()} == {(1, 0, 1)}, "  is named, and gives a loud colour")

# Plugins of folders that are not trusted are not loaded (docs/security.md).
t.trust_shaders("")
os.rename(t.folder / "plugins/functions.so", t.folder / "functions.so")
render("woven", 3, "weave")
expect("woven", lambda s, t: ((math.floor(4 * s) + math.floor(4 * t)) % 2,) * 3, "with --allow-plugins those beside the scene are", options=["--allow-plugins"])

# Errors of a plugin are reported.
t.trust_shaders("broken")
HEAD = "#include <reyes/shader/functions.h>\nstatic void call(const TmFunctionCall* c) { (void)c; }\n"
LIBRARY = "static const TmFunctionLibrary library = {%s, sizeof library, f, sizeof f / sizeof *f, sizeof *f};\nconst TmFunctionLibrary* tomales_functions(void) { return &library; }\n"
for k, (prototype, what) in enumerate((("float knit(quaternion)", "of a type that there is not"), ("matrix knit(float)", "whose result is a matrix"),
                                       ("float knit(output string)", "with an output text"), ("float knit(float", "that is cut off"), ("", "of no prototype"))):
    build(f"bad{k}", HEAD + f'static const TmFunction f[] = {{{{"{prototype}", "", call}}}};\n' + LIBRARY % "TM_SHADER_ABI", "broken")
    render("lacking", 3, f"bad{k}.so", "crochet")
    os.remove(t.folder / f"broken/bad{k}.so")
    print(f"        a function {what}")
build("other", HEAD + 'static const TmFunction f[] = {{"float knit(float)", "", call}};\n' + LIBRARY % "TM_SHADER_ABI + 1", "broken")
render("lacking", 3, "other.so", "another version")
os.remove(t.folder / "broken/other.so")
build("crashing", "__attribute__((constructor)) static void crash(void) { *(volatile int*)8 = 1; }\n", "broken")
render("lacking", 3, "crashing.so", "crashes while it is loaded")
t.finish()
