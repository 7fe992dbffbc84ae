"""Tests shaders in the RenderMan Shading Language as a user meets them: they are found by name and compiled, their errors are
reported, and commands try them."""
import json
import os
import pathlib
import re
import signal
import subprocess
import sys
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "image"))
from pictures import pixels  # noqa: E402
from program import Suite  # noqa: E402

t = Suite()
GREEN, BLUE, RED, MAGENTA, BLACK = (0, 1, 0), (0, 0, 1), (1, 0, 0), (1, 0, 1), (0, 0, 0)
SCENE = """Display "%s.exr" "openexr" "rgba"
Format 32 32 1
PixelFilter "box" 1 1
%s
Projection "perspective" "fov" [90]
WorldBegin
%s
Patch "bilinear" "P" [-2 2 1  2 2 1  -2 -2 1  2 -2 1] %s
WorldEnd
"""


def scene(name, requests, options="", variables=""):
    return t.write(name + ".rib", SCENE % (name, options, requests, variables))


def plain(name, value, kind="surface"):
    return f"{kind} {name}() {{ Oi = 1; Ci = {value}; }}\n"


def folder(name):
    (t.folder / name).mkdir(exist_ok=True)
    return name


def picture(name):
    return {at: tuple(round(v, 3) for v in p[:3]) for at, p in pixels(t.folder / (name + ".exr")).items()}


def expect_all(name, color, what):
    seen = set(picture(name).values())
    t.expect(seen == {color}, f"{what} ({sorted(seen)[:3]})")


def expect_checker(name, what):
    """Expects two colours, both of them magenta."""
    colors = set(picture(name).values())
    t.expect(len(colors) > 1 and all(c[0] == c[2] > 2 * c[1] for c in colors), f"{what} ({sorted(colors)[:3]})")


def render(what, name, code=0, *says):
    result = t.expect_run(what, [name + ".rib"], code, *says)
    if code == 0 and not says:
        t.expect(not result.stdout + result.stderr, "and says nothing")
    return result


# Shaders are found by name.
t.write("green.sl", plain("green", "color(0, 1, 0)"))
scene("beside", 'Surface "green"')
render("a .sl beside the scene", "beside")
expect_all("beside", GREEN, "is its surface")
elsewhere = subprocess.run([t.program, t.folder / "beside.rib", "-o", t.folder / "elsewhere.exr"], cwd="/", capture_output=True, text=True)
t.expect(elsewhere.returncode == 0 and not elsewhere.stderr, f"beside the scene is not the working folder ({elsewhere.stderr[:200]})")
expect_all("elsewhere", GREEN, "and the surface is found from there")
for name, value, x in (("left", "color(0, 1, 0)", -1), ("right", "color(0, 0, 1)", 1)):
    t.write(f"{folder(name)}/own.sl", plain("own", value))
    t.write(f"{name}/half.rib", f'Surface "own"\nPatch "bilinear" "P" [{x - 1} 2 0.9  {x + 1} 2 0.9  {x - 1} -2 0.9  {x + 1} -2 0.9]\n')
scene("halves", 'ReadArchive "left/half.rib"\nReadArchive "right/half.rib"\nSurface "constant"')
render("equal shader calls in archives of two folders", "halves")
t.expect(picture("halves")[4, 16] == GREEN and picture("halves")[28, 16] == BLUE, "name the shader beside each archive")
folder("library")
t.write("library/green.sl", plain("green", "color(1, 0, 0)"))
os.environ["TOMALES_SHADERS"] = "library"
t.expect_run("a .sl of that name in a folder of the user", ["beside.rib"], 0)
expect_all("beside", GREEN, "comes after the one beside the scene")
del os.environ["TOMALES_SHADERS"]
t.expect_run("in a folder of --shaders", ["beside.rib", "--shaders", "library"], 0)
expect_all("beside", RED, "it comes before that")
(t.folder / "library/green.sl").unlink()
t.write("library/collection.sl", plain("ruby", "color(1, 0, 0)") + plain("sapphire", "color(0, 0, 1)"))
scene("collected", 'Surface "sapphire"', 'Option "searchpath" "string shader" ["library"]')
render("a shader in a file of another name, on the scene's path", "collected")
expect_all("collected", BLUE, "is found by its own name")
t.write("other.sl", plain("renamed", "color(0, 0, 1)"))
scene("single", 'Surface "other"')
render("a file with one shader of another name", "single")
expect_all("single", BLUE, "is that shader")
(t.folder / "swapped").mkdir()
t.write("swapped/near.sl", plain("away", "color(1, 0, 0)"))
t.write("swapped/away.sl", plain("near", "color(0, 1, 0)"))
scene("swapped", 'Surface "near"', 'Option "searchpath" "shader" ["swapped"]')
render("a shader in a file of another name, beside a file of its own name", "swapped")
expect_all("swapped", GREEN, "is found by its own name")
for compiled in ("green.slo", "green.sdr", "green.slx", "green.sl", "/home/somebody/shaders/green.slo"):
    scene("compiled", f'Surface "{compiled}"')
    render(f'"{compiled}" stands for green.sl', "compiled", 0, *(["shader-elsewhere"] if "/" in compiled else []))
    expect_all("compiled", GREEN, "which is rendered")
t.write("lone.slo", b"\x00\x01")
scene("lone", 'Surface "lone.slo"')
render("a compiled shader without its text", "lone", 3, "lone.slo", "compiled for another renderer")
expect_checker("lone", "is a checker")
t.write("matte.sl", plain("matte", "color(1, 0, 0)"))
t.write("disney.sl", plain("disney", "color(1, 0, 0)"))
scene("fixed", 'LightSource "ambientlight" 1 Surface "matte"')
render("a .sl called as a shader of the specification", "fixed", 0, "matte.sl: note:", "--standard-shaders files")
expect_all("fixed", (1, 1, 1), "does not come before it")
(t.folder / "matte.sl").unlink()
scene("replaced", 'Surface "disney"')
render("a .sl called as another built-in shader", "replaced")
expect_all("replaced", RED, "comes before it")
t.write("light.sl", plain("light", "color(0, 1, 0)"))
scene("kind", 'LightSource "green" 1 Surface "constant"')
render("a surface that is named as a light", "kind", 3, "green.sl", 'has no light "green", but surface "green"')

# Numbers given for other types, and defaults that the shader computes.
t.write("ofmatrix.sl", "surface ofmatrix(matrix k = 1) { Oi = 1; Ci = determinant(k) / 32; }\n")
scene("ofmatrix", 'Surface "ofmatrix" "k" [2]')
render("a number for a matrix", "ofmatrix", 0)
expect_all("ofmatrix", (.5, .5, .5), "is that multiple of the identity")
t.write("part.sl", "surface part(float n = 2; float k[3] = {n, n, n}) { Oi = 1; Ci = color(k[0], k[1], k[2]) / 4; }\n")
scene("part", 'Surface "part" "k" [1]')
render("the first element of an array alone", "part", 0, "takes 3 numbers and was given 1")
expect_all("part", (.25, .5, .5), "leaves the others their computed default")
t.write("derived.sl", 'light derived(float n = 0; float __nondiffuse = time * n, __samples = 2 * n; string __category = "a") { solar(vector "shader" (0, 0, 1), 0) Cl = 1 + __nondiffuse * 0; }\n')
scene("derived", 'LightSource "derived" 1 Surface "matte" "Ka" 0')
render("a parameter for the renderer whose default the shader computes", "derived", 0, "light-value", '"__nondiffuse"')
t.expect(all(c[0] > .9 for c in picture("derived").values()), "leaves the renderer its own default")

# Errors of a shader are reported, and the frame is rendered.
t.write("broken.sl", "surface broken(float Kd = 1) {\n  Oi = Os;\n  Ci = Kd * diffuse(N;\n}\n")
scene("broken", 'Surface "broken"')
said = render("a syntax error", "broken", 3, "broken.sl:3:22: error: expected ')' before ';'", "  Ci = Kd * diffuse(N;\n", "broken.rib:7").stderr
t.expect(re.search(r"N;\n {21}\^\n", said), "a caret points at it")
expect_checker("broken", "the surface is a checker")
t.write("wrong.sl", "surface wrong() {\n  float a = colour;\n  Ci = b + a;\n  Oi = Oss;\n}\n")
t.expect_run("several errors in one run", ["compile", "wrong.sl"], 2, "wrong.sl:2:13: error", "wrong.sl:3:8: error", 'did you mean "Os"?', "wrong.sl: 3 errors")
t.write("lacking.sl", "surface lacking() { Ci = company_noise(P); Oi = 1; }\n")
scene("lacking", 'Surface "lacking"')
render("a function that nobody has", "lacking", 3, "company_noise")
expect_all("lacking", MAGENTA, "gives magenta")
t.write("includes.sl", '#include "nosuch.h"\n' + plain("includes", "1"))
scene("includes", 'Surface "includes"')
render("a header that is not there", "includes", 3, "includes.sl:1:", "nosuch.h")
folder("headers")
t.write("headers/deep.h", "#include \"deeper.h\"\n")
t.write("headers/deeper.h", "#define SHADE Ci = nowhere\n")
t.write("nested.sl", '#include "deep.h"\nsurface nested() { SHADE; Oi = 1; }\n')
t.expect_run("an error in a macro of a header of a header", ["compile", "nested.sl", "-I", "headers"], 2, "headers/deeper.h:1:", "in expansion of macro 'SHADE'",
             "nested.sl:2:20")
t.write("headers/worse.h", "float half(float x) { return x / tow; }\n")
t.write("headers/deep.h", "#include \"worse.h\"\n#define SHADE Ci = half(1)\n")
t.expect_run("an error in a header of a header", ["compile", "nested.sl", "-I", "headers"], 2, "headers/worse.h:1:34: error", "included from headers/deep.h:1", "included from nested.sl:1")
t.write("coshader.sl", "class coshader(float Kd = 1) { public float weight() { return Kd; } }\n")
t.expect_run("a class that others call", ["compile", "coshader.sl"], 2, "RSL 2", "coshader.sl:1:1")
t.write("alone.sl", """class alone(float grey = 0; float height = 0) {
  float seen = 0;
  public void begin() { seen = shade(grey); }
  public void displacement(output point P; output normal N) { P += height * normalize(N); }
  public void surface(output color Ci, Oi) { Oi = 1; Ci = color(0, seen, 0); }
  float shade(float x) { return x; }
}
class bulb(float power = 0) { public void light(output vector L; output color Cl) { solar(vector(0, 0, 1), 0) { Cl = power; } } }
""")
result = t.expect_run("a class that stands alone", ["compile", "alone.sl"], 0)
t.expect(not re.search("warning", result.stderr), "is right")
scene("alone", 'Surface "alone" "grey" [1]')
render("a class as a surface", "alone")
expect_all("alone", GREEN, "shades by its methods")
scene("away", 'Surface "constant" Color [0 0 1] Attribute "displacementbound" "float sphere" [9] Displacement "alone" "height" [-9]')
render("a class as a displacement", "away")
t.expect({BLUE, BLACK} <= set(picture("away").values()), "moves the surface away")
scene("lit", 'LightSource "bulb" 1 "power" [1] Color [0 0 1] Surface "matte"')
render("a class as a light", "lit")
expect_all("lit", BLUE, "shines")

# These commands take shaders: compile, info, shadetest.
t.write("suspicious.sl", "surface suspicious(float unread = 1) { float forgotten; Oi = 1; Ci = forgotten; }\n")
t.expect(not t.expect_run("compile of a good shader", ["compile", "green.sl"], 0).stderr, "says nothing")
result = t.expect_run("compile of a suspicious one", ["compile", "suspicious.sl"], 0, 'warning: the parameter "unread" is never read', '"forgotten"')
t.expect(not result.stdout and result.stderr, "speaks on standard error")
t.expect(not t.expect_run("without warnings", ["compile", "-q", "suspicious.sl"], 0).stderr, "is quiet")
EDGES = {"1, 0, s": True, "HALF, -(HALF), s": True, "1 - 0.5, 1 / 4, s": True, "0, 1, s": False, "1, 1, s": False, "1, s, t": False, "s, 0, t": False}
for edges, warns in EDGES.items():
    t.write("edges.sl", f"#define HALF 0.5\nsurface edges() {{ Oi = 1; Ci = smoothstep({edges}); }}\n")
    said = t.expect_run(f"compile of smoothstep({edges})", ["compile", "edges.sl"], 0).stderr
    t.expect(("edges.sl:2:32: warning: smoothstep() whose first edge" in said) == warns, f"{'warns' if warns else 'does not warn'} of a hard step")
LIGHT = "light many(float k = 0) {{ {} }}"
SHINE = "illuminate(point \"shader\" (0, 0, 0)) Cl = 1; "
for body, warns in ((SHINE, False), (2 * SHINE, True), (f"if (k > 0) {SHINE} else {SHINE}", False), (f"float i; for (i = 0; i < 3; i += 1) {SHINE}", True),
                    (f"if (k > 0) {{ {SHINE} }} solar(vector \"shader\" (0, 0, 1), 0) Cl = 1;", True)):
    t.write("many.sl", LIGHT.format(body))
    said = t.expect_run("compile of a light", ["compile", "many.sl"], 0).stderr
    t.expect(("the last gives the direction" in said) == warns, f"that {'may shine from several places' if warns else 'shines from one place'}: {body}")
t.expect_run("compile of a shader that lacks a function", ["compile", "lacking.sl"], 3, "lacking.sl:1:26: warning", "company_noise")
t.expect_run("compile of a file that is not there", ["compile", "nosuch.sl"], 2, "nosuch.sl")
t.expect_run("compile of nothing", ["compile"], 1)
t.expect_run("of good and bad files all are looked at", ["compile", "green.sl", "broken.sl", "wrong.sl"], 2, "broken.sl:3", "wrong.sl:2")
t.write("defined.sl", "#ifdef BLUE\n#define C color(0, 0, BLUE)\n#endif\nsurface defined() { Ci = C; Oi = 1; }\n")
t.expect_run("compile without its definition", ["compile", "defined.sl"], 2, '"C"')
t.expect_run("and with it", ["compile", "defined.sl", "-D", "BLUE=0.5"], 0)
t.write("twice.sl", '#include "deeper.h"\n#include "own.h"\nsurface twice() { Ci = color(RED, GREEN, OWN); Oi = 1; }\n')
t.write(folder("own") + "/own.h", "#define OWN 1\n")
t.expect_run("-D and -I as often as they are given", ["compile", "-I", "headers", "-D", "RED=1", "-I", "own", "-D", "GREEN=0", "twice.sl"], 0)
t.write("dumped.sl", "float twice(float x) { return 2 * x; }\nsurface dumped(float Kd = .5) { Oi = Os; Ci = Os * Cs * twice(Kd) * diffuse(normalize(N)); }\n")
for stage, says in (("tokens", ["dumped.sl:1:1", "twice"]), ("tree", ["function float twice", "surface dumped", "call diffuse"]), ("types", ["call diffuse : color", "name Kd : float"]),
                    ("lowered", ["surface dumped", "parameter float Kd", "Diffuse"]), ("code", ["surface dumped", "Mul 2 uf0.Kd", "Diffuse"])):
    result = t.expect_run(f"--dump {stage}", ["compile", "dumped.sl", "--dump", stage], 0, *says)
    t.expect(("twice" in result.stdout) == (stage not in ("lowered", "code")), "functions are inlined by the lowering")
t.expect_run("--dump of a stage that there is not", ["compile", "dumped.sl", "--dump", "assembly"], 1, "assembly")
t.write("params.sl", """/* A shader with parameters of many kinds. The rest is not for the list. */
surface params(uniform float Kd = .5; varying color tint = color(1, .5, 0); float width = 2 * Kd; string map = "a.tif";
               float weights[3] = {1, 2, 3}; point where = point "shader" (1, 2, 3); output varying color mask = 0;) {
  mask = tint * where * weights[2];
  Oi = match("tif", map);
  Ci = Kd * width;
}
volume params2() { Ci *= .5; Oi = Oi; }
""")
about = json.loads(t.expect_run("info", ["info", "--json", "params.sl"], 0).stdout)
t.expect(about["kind"] == "shaders" and [(s["name"], s["kind"]) for s in about["shaders"]] == [("params", "surface"), ("params2", "volume")], "lists the shaders of a file")
t.expect(about["shaders"][0]["doc"] == "A shader with parameters of many kinds.", "with the first sentence of their comment")
listed = {p["name"]: p for p in about["shaders"][0]["parameters"]}
t.expect({n: p["type"] for n, p in listed.items()} == {"Kd": "float", "tint": "color", "width": "float", "map": "string", "weights": "float", "where": "point",
                                                       "mask": "output color"}, "with types")
t.expect([listed[n]["default"] for n in ("Kd", "tint", "map", "weights", "where", "width")] == [[0.5], [1, 0.5, 0], ["a.tif"], [1, 2, 3], [1, 2, 3], "computed"],
         f"and defaults ({[listed[n].get('default') for n in listed]})")
t.expect([listed[n].get("detail") for n in ("Kd", "tint", "width", "mask")] == ["uniform", "varying", None, "varying"], "and details, where the file says them")
t.expect_run("info as text", ["info", "params.sl"], 0, "name: params", "detail: uniform")
t.expect_run("info of a broken shader", ["info", "broken.sl"], 2, "broken.sl:3:22")


def mean(*arguments, code=0):
    result = t.run("shadetest", *arguments, "--grid", "8x8")
    found = re.search(r"^Ci mean: (.*)$", result.stdout, re.M)
    t.expect(result.returncode == code and found is not None, f"shadetest {' '.join(arguments)} ({result.stderr[:200]})")
    return tuple(float(x) for x in found[1].split()) if found else None


t.write("simple.sl", 'surface simple(float Kd = .5; color tint = 1; string mode = "on"; float w[2] = {1, 1}) { Oi = 1; Ci = mode == "on" ? Kd * tint * w[1] : color 0; }\n')
t.expect(mean("simple.sl") == (0.5, 0.5, 0.5), "has its defaults")
t.expect(mean("simple.sl", "Kd=.25") == (0.25, 0.25, 0.25), "has the value of the command line")
t.expect(mean("simple.sl", "Kd=1", "tint=1,0.5,0") == (1, 0.5, 0), "and a colour")
t.expect(mean("simple.sl", "mode=off") == (0, 0, 0), "and a string")
t.expect(mean("simple.sl", "w=0,2", "Kd=1") == (2, 2, 2), "and an array")
t.expect(mean("simple.sl", "kd=1", code=3) == (0.5, 0.5, 0.5), "a parameter that there is not is told")
t.expect_run("shadetest of a broken shader", ["shadetest", "broken.sl"], 2, "broken.sl:3:22")
t.expect_run("shadetest --check", ["shadetest", "green.sl", "--check"], 0, "faults: 0")


def watch(what, change):
    """Returns the lines of --watch after a change. A signal ends it."""
    process = subprocess.Popen([t.program, "shadetest", "watched.sl", "--watch", "--grid", "4x4"], cwd=t.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)

    def next_mean():
        for line in process.stdout:
            if line.startswith("Ci mean"):
                return line.split(":")[1].split()[0]

    before = next_mean()
    time.sleep(0.05)
    change()
    after = next_mean()
    process.send_signal(signal.SIGTERM)
    process.communicate(timeout=20)
    t.expect((before, after) == ("0.25", "0.75"), f"shadetest --watch: {what} ({before}, {after})")
    t.expect(process.returncode in (0, 143), f"and ends by a signal ({process.returncode})")


t.write("watched.sl", plain("watched", "0.25"))
watch("the shader changes", lambda: t.write("watched.sl", plain("watched", "0.75")))
t.write("level.h", "#define LEVEL 0.25\n")
t.write("watched.sl", '#include "level.h"\n' + plain("watched", "LEVEL"))
watch("what it includes changes", lambda: t.write("level.h", "#define LEVEL 0.75\n"))

# Parameters come from the scene and from primitive variables, and some are outputs.
t.write("tinted.sl", "surface tinted(color tint = color(1, 0, 0)) { Oi = 1; Ci = tint; }\n")
scene("given", 'Surface "tinted" "color tint" [0 0 1]')
render("a parameter of the scene", "given")
expect_all("given", BLUE, "has its value")
scene("varying", 'Surface "tinted" "color tint" [0 0 1]', variables='"varying color tint" [0 0 0  1 0 0  0 1 0  1 1 0]')
render("a primitive variable of a parameter's name", "varying")
seen = picture("varying")
t.expect(all(abs(c[0] - ((x + 0.5) / 64 + 0.25)) < 0.02 and abs(c[1] - ((y + 0.5) / 64 + 0.25)) < 0.02 and c[2] == 0 for (x, y), c in seen.items()), f"takes its place, point by point ({seen[0, 0]}, {seen[31, 31]})")
t.write("measured.sl", "surface measured(output varying color mask = 0; output float plain = 0) { mask = color(s, t, 1); plain = 2; Oi = 1; Ci = color(0, 1, 0); }\n")
scene("outputs", 'Surface "measured"', 'DisplayChannel "varying color mask" DisplayChannel "varying float plain" Display "+mask.exr" "openexr" "mask" Display "+plain.exr" "openexr" "plain"')
render("outputs of a shader in further Displays", "outputs")
expect_all("outputs", GREEN, "leave Ci alone")
mask = picture("mask")
t.expect(all(abs(c[0] - ((x + 0.5) / 64 + 0.25)) < 0.02 and abs(c[1] - ((y + 0.5) / 64 + 0.25)) < 0.02 and c[2] == 1 for (x, y), c in mask.items()), f"show s and t ({mask[0, 0]}, {mask[31, 31]})")
t.expect({p[0] for p in pixels(t.folder / "plain.exr").values()} == {2}, "and numbers")
t.write("keyed.sl", "surface keyed(output varying color paint = 0; output float amount = 0) { Oi = 1; Ci = paint * amount; amount = 3; }\n")
scene("keyed", 'Surface "keyed" "color paint" [0 0 1] "float amount" [1]')
render("outputs of which the scene gives the first values", "keyed")
expect_all("keyed", BLUE, "have them")
scene("keyed2", 'Surface "keyed" "float amount" [1]', variables='"constant color paint" [1 0 0]')
render("or a primitive variable", "keyed2")
expect_all("keyed2", RED, "have those")
t.write("dull.sl", "light dull(output float __nonspecular = 0, __nondiffuse = 0) { illuminate (point \"camera\" (0, 0, 0)) { Cl = 1; } }\n"
        "light changing(output float __nondiffuse = 1) { illuminate (point \"camera\" (0, 0, 0)) { Cl = 1; __nondiffuse = 0; } }\n")
t.write("parts.sl", "surface parts() { Oi = 1; normal n = faceforward(normalize(N), I); color d = diffuse(n), r = specular(n, -normalize(I), 100);"
        " Ci = color(comp(d, 0) > .1, comp(r, 0) > .1, 0); }\n")
for name, given, color in (("both", "", (1, 1, 0)), ("dull", '"float __nonspecular" [1]', RED), ("shiny", '"float __nondiffuse" [1]', GREEN)):
    scene(name, f'LightSource "dull" 1 {given} Surface "parts"')
    render(f"a light whose outputs are for the renderer: {name}", name)
    expect_all(name, color, "is seen by those that it says")
scene("changing", 'LightSource "changing" 1 Surface "parts"')
render("a light that changes such an output", "changing")
expect_all("changing", (1, 1, 0), "has the last word, point by point")

# The other kinds of shaders work.
t.write("kinds.sl", """light lamp(color shade = 1) { Cl = shade; }
displacement lifted() { P += .25 * normalize(N); }
volume halved() { Ci *= .5; }
imager swapped() { Ci = color(Ci[2], Ci[0], Ci[1]); }
light beam(point from = (0, 0, 0); point to = (0, 0, 1)) { illuminate (from, to - from, .3) { Cl = 4 / (L . L); } }
""".replace("Ci[2], Ci[0], Ci[1]", "comp(Ci, 2), comp(Ci, 0), comp(Ci, 1)"))
scene("kinds", 'LightSource "lamp" 1 "color shade" [0 1 0] Atmosphere "halved" Surface "matte"', 'Imager "swapped"')
render("a light, a volume and an imager of one file", "kinds")
expect_all("kinds", (0, 0, 0.5), "do what they say")
# A file whose shader's name comes from a macro or from another file is found by the file's name.
for name, text in (("named", "#define NAME named\n" + plain("NAME", "color(0, 1, 0)")), ("whole", '#include "whole.h"\n')):
    t.write(f"swapped/{name}.sl", text)
    t.write(f"swapped/{name}_old.sl", plain(name, "color(1, 0, 0)"))
    t.write("swapped/whole.h", plain("whole", "color(0, 1, 0)"))
    scene(name, f'Surface "{name}"', 'Option "searchpath" "shader" ["swapped"]')
    render(f"the shader \"{name}\" beside an old copy", name)
    expect_all(name, GREEN, "is that of the file")
t.write("swapped/woods.sl", "#define oakgrain 2\n" + plain("oak", "color(0, oakgrain / 2, 0)"))
scene("oak", 'Surface "oak"', 'Option "searchpath" "shader" ["swapped"]')
render("a shader in a file with a macro whose name begins alike", "oak")
expect_all("oak", GREEN, "is found")
# Primitive variables have derivatives, also where nothing else asks for any. Over the square, u goes from 0 to 1.
t.write("slopes.sl", "surface slopes(varying float w = 0; varying point q = 0;) { Oi = 1; Ci = color(Du(w), -Dv(w), length(Du(q))); }\n"
        "volume haze(varying float w = 0; varying point q = 0;) { Oi = 1; Ci = color(Du(w), -Dv(w), length(Du(q))); }\n")
for kind, shaders in (("surface", 'Surface "slopes"'), ("volume", 'Surface "constant" Atmosphere "haze"')):
    scene("slopes", shaders, "", '"varying float w" [.25 .5 0 .25] "varying point q" [0 0 0  .5 0 0  0 0 0  .5 0 0]')
    render(f"derivatives in a {kind} of primitive variables alone", "slopes")
    expect_all("slopes", (0.25, 0.25, 0.5), "are theirs")
scene("beam", 'LightSource "beam" 1 Surface "matte"')
render("a spotlight", "beam")
lit = picture("beam")
t.expect(lit[16, 16][0] > 0.9 and lit[2, 16] == BLACK, f"lights its cone alone ({lit[16, 16]}, {lit[2, 16]})")
scene("lifted", 'Attribute "displacementbound" "sphere" [0.3] Surface "constant" Displacement "lifted" Scale 0.4 0.4 1')
render("a displacement", "lifted")
far = sum(c != BLACK for c in picture("lifted").values())
scene("flat", 'Surface "constant" Scale 0.4 0.4 1')
render("and the same without it", "flat")
t.expect(far != sum(c != BLACK for c in picture("flat").values()), "moves the surface")

t.write("raised.sl", """surface raised() { vector V = -normalize(I);
  color seen = ambient() + diffuse(N) + specular(N, V, .1) + phong(N, V, 9) + trace(P, N) + occlusion(P, N, 4);
  P += (.25 + 1e-9 * comp(seen, 0)) * normalize(N); Ci = 1; Oi = 1; }
""")
scene("raised", 'LightSource "lamp" 1 Attribute "displacementbound" "sphere" [0.3] Surface "raised" Scale 0.4 0.4 1')
render("a surface that looks for light before it displaces", "raised")
t.expect(sum(c != BLACK for c in picture("raised").values()) == far, "moves the surface as a displacement does")

# Bases of splines have two names, and unknown names are reported.
for basis, code in (("bspline", None), ("catrom", None), ("solvecatrom", None), ("bogus", 'basis "bogus"')):
    t.write("curve.sl", f'surface curve() {{ Oi = 1; Ci = spline("{basis}", s, 0, 0, 1, 1); }}\n')
    scene("curve", 'Surface "curve"')
    render(f"a spline of basis {basis}", "curve", 0, *([code] if code else []))

# A stranger's shader cannot do harm.
t.write("endless.sl", "surface endless() { float i = 0; while (i < 1) { i = i * .5; } Ci = i; Oi = 1; }\n")
scene("endless", 'Surface "endless"')
began = time.time()
render("an endless loop ends by its limit", "endless", 3, "endless", "iterations")
t.expect(time.time() - began < 50, f"in time ({time.time() - began:.1f} s)")
process = subprocess.Popen([t.program, "endless.rib", "-o", "stopped.exr", "--format", "900x900"], cwd=t.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
time.sleep(0.5)
began = time.time()
process.send_signal(signal.SIGTERM)
process.communicate(timeout=30)
t.expect(process.returncode == 143 and time.time() - began < 5, f"or by a signal ({process.returncode}, {time.time() - began:.1f} s)")
for path in ("../../../../../../../../etc/passwd", "/etc/passwd", "headers/../../../../../../../etc/passwd"):
    t.write("spy.sl", f'#include "{path}"\n' + plain("spy", "1"))
    result = t.expect_run(f"#include of {path}", ["compile", "spy.sl"], 2, "spy.sl:1:", "outside of the folders")
    t.expect("root:" not in result.stdout + result.stderr, "shows nothing of it")
os.symlink("/etc/passwd", t.folder / "link.h")
t.write("spy.sl", '#include "link.h"\n' + plain("spy", "1"))
t.expect("root:" not in t.expect_run("#include of a link out of the folder", ["compile", "spy.sl"], 2, "outside of the folders").stderr, "shows nothing of it")
t.write("bounds.sl", "surface bounds() { float a[4] = {1, 2, 3, 4}; float k = 1e9 * s; a[k] = 7; Oi = 1; Ci = a[-k] + a[3]; }\n")
scene("bounds", 'Surface "bounds"')
t.expect(t.run("bounds.rib").returncode in (0, 3), "indices beyond an array do no harm")
t.write("deep.sl", "surface deep() { Oi = 1; Ci = " + "(" * 5000 + "1" + ")" * 5000 + "; }\n")
t.expect_run("5000 brackets", ["compile", "deep.sl"], 2, "nested more than")
t.write("bomb.sl", "#define A0 1\n" + "".join(f"#define A{k + 1} A{k} + A{k} + A{k} + A{k}\n" for k in range(20)) + plain("bomb", "A20"))
t.expect_run("macros that explode", ["compile", "bomb.sl"], 2, "bomb.sl:")
t.write("self.sl", '#include "self.sl"\n' + plain("self", "1"))
t.expect_run("a file that includes itself", ["compile", "self.sl"], 2, "self.sl:1:")

# The shaders of a scene are compiled side by side, and their messages keep the order of the scene.
requests = ""
for k in range(24):
    broken = k % 7 == 3
    t.write(f"many{k}.sl", f"surface many{k}() {{ Oi = 1; Ci = {'nowhere' if broken else k / 24}; }}\n")
    requests += f'AttributeBegin Surface "many{k}" Translate {k / 4} 0 0 Sphere 0.1 -0.1 0.1 360 AttributeEnd\n'
scene("many", requests)
told = [t.run("many.rib", "-t", threads) for threads in ("1", "4", "4")]
t.expect(all(r.returncode == 3 for r in told), "24 shaders, of which three do not compile: exit code 3")
t.expect([line.split(":")[0].split("/")[-1] for line in told[0].stderr.splitlines() if "does not compile" in line] == ["many3.sl", "many10.sl", "many17.sl"], f"each is named, in the order of the scene ({told[0].stderr[:400]})")
t.expect(told[0].stderr.count("[shader-text]") == 3, "as texts, not as plugins")
t.expect(all(r.stderr == told[0].stderr for r in told), "with any number of threads alike")

# A shader changes between two frames of one process. The process waits for the second frame in a pipe when the first is done.
t.write("edited.sl", plain("edited", "color(0, 1, 0)"))
os.mkfifo(t.folder / "second.rib")
scene("first", 'Surface "edited"')
process = subprocess.Popen([t.program, "first.rib", "second.rib"], cwd=t.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
end = time.time() + 30
while not (t.folder / "first.exr").exists() and time.time() < end:
    time.sleep(0.02)
t.write("edited.sl", plain("edited", "color(0, 0, 1)") + "/* longer */\n")
with open(t.folder / "second.rib", "w") as pipe:
    pipe.write(SCENE % ("second", "", 'Surface "edited"', ""))
errors = process.communicate(timeout=60)[1]
t.expect(process.returncode == 0 and not errors, f"two frames of one process ({errors[:200]})")
expect_all("first", GREEN, "the first has the shader as it was")
expect_all("second", BLUE, "the second has it as it has become")

# Messages name places in the user's files alone.
t.write("wrong_fresnel.sl", "surface wrong_fresnel() { color a, b; fresnel(I, N, 1.5, a, b); Ci = a; }")
said = t.run("compile", "wrong_fresnel.sl").stderr
t.expect("\nnote: there is void fresnel(vector, vector, float, output float, output float)" in said, f"what a built-in function takes has no place in the file ({said})")
t.write("twice.sl", "surface twice() { Ci = color(0, 1, 0); }\nsurface twice() { Ci = color(1, 0, 0); }\ndisplacement twice() { P += 0; }\n")
said = t.expect_run("a second shader of one name and kind gets a warning", ["compile", "twice.sl"], 0, 'twice.sl:2:9: warning: surface "twice" is defined again; the first one counts', "twice.sl:1:9: note").stderr
t.expect(said.count("defined again") == 1, "and one of another kind gets none")
scene("twice", 'Surface "twice"')
t.run("twice.rib")
expect_all("twice", GREEN, "the first of two shaders counts")
t.finish()
