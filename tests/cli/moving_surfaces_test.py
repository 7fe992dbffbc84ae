"""Tests that surface shaders that assign P displace, as they do in renderers that shade before they hide."""
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "image"))
from pictures import pixels  # noqa: E402
from program import Suite  # noqa: E402

t = Suite()
BUMP = "float d = height * sin(20 * s) * sin(20 * t); P += d * normalize(N);"
LOOK = "Oi = Os; Ci = Os * Cs * diffuse(faceforward(normalize(N), I));"
t.write("bumpy.sl", "surface bumpy(float height = .1; output varying float d = 0) "
        "{ d = height * sin(20 * s) * sin(20 * t); P += d * normalize(N); N = calculatenormal(P);" + LOOK + "}")
t.write("bumps.sl", f"displacement bumps(float height = .1) {{ {BUMP} N = calculatenormal(P); }}")
t.write("even.sl", f"surface even() {{ {LOOK} }}")
t.write("turned.sl", f"surface turned() {{ N = calculatenormal(P); {LOOK} }}")
t.write("speaking.sl", f'surface speaking(float height = .1) {{ printf("once\\n"); {BUMP} Ci = Cs; Oi = Os; }}')
t.write("local.sl", f"surface local() {{ point Q = P + N; N = calculatenormal(Q); {LOOK} }}")


def scene(shaders, body="Sphere 1 -1 1 360", options=""):
    return f"""Format 96 96 1
Projection "perspective" "fov" [40]
Translate 0 0 4
{options}WorldBegin
LightSource "distantlight" 1 "from" [1 1 -1]
Attribute "displacementbound" "sphere" [.1]
{shaders}
{body}
WorldEnd
"""


def render(name, text, code=0, *arguments):
    t.write(name + ".rib", text)
    result = t.expect_run(name, [name + ".rib", "-o", name + ".exr", *arguments], code)
    return pixels(t.folder / (name + ".exr")), result.stdout + result.stderr


def farthest(a, b):
    return max(abs(x - y) for key in a for x, y in zip(a[key], b[key]))


moved, said = render("moved", scene('Surface "bumpy" "height" [.07]'))
t.expect(not said, f"without a message ({said[:200]})")
twice, _ = render("twice", scene('Displacement "bumps" "height" [.07] Surface "turned"'))
t.expect(farthest(moved, twice) < 1e-5, f"as by a displacement and a surface ({farthest(moved, twice):.2g})")
flat, _ = render("flat", scene('Surface "even"'))
t.expect(sum(flat[p][3] > 0.5 and moved[p][3] < 0.5 or flat[p][3] < 0.5 and moved[p][3] > 0.5 for p in flat) > 20,
         "and the outline has moved")
t.write("inside.rib", "Sphere 1 -1 1 360\n")
inside, _ = render("inside_procedural", scene('Surface "bumpy" "height" [.07]', 'Procedural "DelayedReadArchive" ["inside.rib"] [-1.2 1.2 -1.2 1.2 -1.2 1.2]'))
t.expect(farthest(moved, inside) < 1e-5, f"in an archive that is read late ({farthest(moved, inside):.2g})")
own, said = render("own", scene('Displacement "bumps" "height" [.07] Surface "bumpy" "height" [.07]'))
t.expect("surface-moves" in said and '"bumps"' in said, f"a displacement of the object's own is told of ({said[:200]})")
t.expect(farthest(twice, own) < 1e-5, "and is the one that moves it")
_, said = render("once", scene('Surface "speaking"', "Polygon \"P\" [0 0 0 .3 0 0 0 .3 0]"), 0)
t.expect(0 < said.count("once"), "what the shader prints is printed")
printed = said.count("once")
t.write("speaking.sl", 'surface speaking(float height = .1) { printf("once\\n"); Ci = Cs; Oi = Os; }')
_, said = render("plain", scene('Surface "speaking"', "Polygon \"P\" [0 0 0 .3 0 0 0 .3 0]"), 0)
t.expect(said.count("once") == printed, f"and not for the displacement again ({said.count('once')}, {printed})")
local, said = render("local", scene('Surface "local"'))
t.expect(all((flat[p][3] > 0) == (local[p][3] > 0) for p in flat), "a shader that moves a copy moves nothing")
draft, _ = render("draft", scene('Surface "bumpy" "height" [.07]'), 0, "--draft")
even, _ = render("even", scene('Surface "even"'), 0, "--draft")
t.expect(all((even[p][3] > 0) == (draft[p][3] > 0) for p in even), "drafts displace nothing")
t.run("render", "moved.rib", "-o", "threads.exr", "-t", "1", "--bucket-size", "8")
t.expect(farthest(moved, pixels(t.folder / "threads.exr")) == 0, "the same bits for other buckets on one thread")
t.expect_run("the frame in steps", ["hide", "moved.rib", "-o", "moved.dfb"], 0)
result = t.expect_run("shaded", ["shade", "moved.dfb", "-o", "steps.exr"], 0)
t.expect(not result.stderr, f"without a message ({result.stderr[:200]})")
t.expect(farthest(moved, pixels(t.folder / "steps.exr")) == 0, "is the same")
t.write("edit.rib", 'Surface "bumpy" "height" [.02]')
result = t.expect_run("another surface", ["shade", "moved.dfb", "--edit", "edit.rib", "-o", "edited.exr"], 0)
t.expect(not result.stderr, f"is edited without a message ({result.stderr[:200]})")
t.write("named.rib", scene('Displacement "surface:bumpy" "height" [.07] Surface "turned"'))
t.expect_run("a displacement that is named after a surface", ["named.rib", "-o", "named.exr"], 0)
t.expect(farthest(twice, pixels(t.folder / "named.exr")) < 1e-5, "moves what the surface would")

# A surface may ask its displacement for values that it has computed at each point.
t.write("carved.sl", "displacement carved(output varying float depth = 0; output varying color tint = 0) "
        "{ depth = .05 * sin(20 * s); P -= depth * normalize(N); N = calculatenormal(P); tint = color(s, t, .5); }")
t.write("asking.sl", 'surface asking() { float depth = 7; color tint = 7; float told = displacement("depth", depth) + displacement("tint", tint);'
        "Oi = 1; Ci = color(20 * depth - sin(20 * s), comp(tint, 0) - s, told); }")
t.write("telling.sl", 'surface telling(output varying float told = 0) { told = 5; Oi = 1; Ci = 0; illuminance(P, N, PI) Ci += Cl; }')
t.write("hearing.sl", 'light hearing() { float told = 7; float known = surface("told", told); solar(vector "shader" (0, 0, 1), 0) Cl = color(known, told, 0); }')
CARVED = 'Displacement "carved" Surface "asking"'


def told(picture):
    return [p[:3] for (x, y), p in picture.items() if (x - 47.5) ** 2 + (y - 47.5) ** 2 < 20**2]


carved, said = render("carved", scene(CARVED))
t.expect(not said, f"without a message ({said[:200]})")
t.expect(all(max(abs(a), abs(b), abs(c - 2)) < 0.02 for a, b, c in told(carved)), f"tells each point of its depth and colour ({told(carved)[:2]})")
late, _ = render("carved_late", scene(CARVED, 'Procedural "DelayedReadArchive" ["inside.rib"] [-1.2 1.2 -1.2 1.2 -1.2 1.2]'))
t.expect(farthest(carved, late) < 1e-5, "in an archive that is read late too")
t.run("hide", "carved.rib", "-o", "carved.dfb")
t.run("shade", "carved.dfb", "-o", "carved_later.exr")
t.expect(farthest(carved, pixels(t.folder / "carved_later.exr")) == 0, "and in steps")
silent, _ = render("silent", scene('Surface "asking"'))
t.expect(all(abs(a - 140) < 2 and c == 0 for a, b, c in told(silent)), f"nothing is told where nothing is displaced ({told(silent)[:2]})")
heard, _ = render("heard", scene('LightSource "hearing" 9 Illuminate 1 0 Surface "telling"'), 0)
t.expect(all(a == 0 and abs(b - 7) < 1e-4 and c == 0 for a, b, c in told(heard)), f"lights do not hear what a surface computes, and are told so ({told(heard)[:2]})")
# Arrays, matrices and strings are not kept. The first value of such an output is not returned, unless the shader never
# assigns it.
t.write("listing.sl", 'displacement listing(output varying float w[2] = {1, 2}; output varying matrix m = 3; output string g = "first";'
        'output varying float still[2] = {4, 5}) { w[0] = s; m = 7; g = "last"; N = calculatenormal(P); }')
t.write("reading.sl", 'surface reading() { float w[2] = {9, 9}, still[2] = {9, 9}; matrix m = 9; string g = "own";'
        'float known = displacement("w", w) + displacement("m", m) + displacement("g", g); Oi = 1;'
        'Ci = color(known + w[0] + comp(m, 1, 1), match("own", g), 10 * displacement("still", still) + still[1]); }')
read, _ = render("reading", scene('Displacement "listing" Surface "reading"'))
t.expect(all(abs(a - 18) + abs(b - 1) + abs(c - 15) < 1e-3 for a, b, c in told(read)), f"arrays, matrices and texts keep what the surface gave them ({told(read)[:2]})")
t.finish()
