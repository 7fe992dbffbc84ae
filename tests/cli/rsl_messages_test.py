"""Tests what shaders can read of each other (RISpec 3.2, section 15.8) and of options, and primitive variables in volume shaders."""
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "image"))
from pictures import pixels  # noqa: E402
from program import Suite  # noqa: E402

t = Suite()
# One square fills the picture. s runs from left to right; the world lies 2 before the camera and is not turned.
SCENE = """Format 4 4 1 Projection "orthographic" PixelFilter "box" 1 1 PixelSamples 1 1 ShadingRate 0.01 Hider "hidden" "int jitter" [0]
%s
WorldBegin
%s
Translate 0 0 2 Patch "bilinear" "P" [-1 1 0 1 1 0 -1 -1 0 1 -1 0] %s
WorldEnd
"""


def shown(name, world, more="", before="", says=()):
    """Returns the picture, row by row."""
    t.write(name + ".rib", SCENE % (before, world, more))
    result = t.expect_run(name, [name + ".rib", "-o", name + ".exr"], 0, *says)
    t.expect(says or not result.stderr, f"  without a message ({result.stderr[:300]})")
    seen = pixels(t.folder / (name + ".exr"))
    return [[seen[x, y][:3] for x in range(4)] for y in range(4)]


def expect(name, picture, wanted, what, tolerance=0.02):
    """Compares each pixel with wanted(s) in the middle of the pixel. A micropolygon is a tenth of a pixel wide."""
    off = max(abs(a - b) for row in picture for x, p in enumerate(row) for a, b in zip(p, wanted((x + 0.5) / 4)))
    t.expect(off < tolerance, f"  {what} (off by {off:.3f})")


# A default may ask another shader for one that it computes in turn.
t.write("asked.sl", "displacement asked(float a = 2; float b = 3 * a;) { N = N; }\n")
t.write("chain.sl", 'float b() { float x = -3; displacement("b", x); return x; }\nsurface chain(float c = b();) { Ci = c / 8; Oi = 1; }\n')
t.write("last.sl", 'volume last() { float x = -1; float r = surface("c", x); Ci = color(comp(Ci, 0), x / 8, r); Oi = 1; }\n')
expect("chain", shown("chain", 'Displacement "asked" Surface "chain" Atmosphere "last"'), lambda s: (0.75, 0.75, 1), "a chain of defaults")

# Arrays and matrices that vary are told point by point.
t.write("rows.sl", """surface rows(float l[2] = {0, 0}; float q[2] = {2, 3 * s}; matrix m = translate(1, vector(s, 0, 0)); color k[2] = {0, color(s, 1, t)};) { Ci = l[0] + q[0] + comp(m, 0, 0) + k[0]; Oi = 1; }
volume hears(float which = 0;) { float l[2] = -1, q[2] = -1; matrix m = 0; color k[2] = -1;
  float r = surface("l", l) + surface("q", q) + surface("m", m) + surface("k", k);
  Ci = color(which == 0 ? l[0] : which == 1 ? q[1] / 3 : which == 2 ? comp(m, 3, 0) : comp(k[1], 0), l[1] / 4, r / 4); Oi = 1; }
""")
for which in range(4):
    rows = shown(f"rows{which}", f'Surface "rows" Atmosphere "hears" "which" [{which}]', '"varying float[2] l" [0 4 1 4 0 4 1 4]')
    expect(f"rows{which}", rows, lambda s: (s, 1, 1), "what differs from point to point does so for others")

# The parameters of the surface have defaults of every kind that it computes when it runs.
t.write("told.sl", """surface told(float a = 2; float b = 3 * a; vector w = vector "world" (1, 0, 0); color c = color(s, a, 0); string n = concat("x", "y");
    float l[2] = {a, 2 * a}; matrix m = translate(1, vector(a, 0, 0)); output float o = .5; output varying color p = 1; output float kept = 4 * a;) {
  o = .75; p = color(s, 0, 1); Ci = 1; Oi = 1; }
""")
ASKS = """%s asks(float which = 0;) {
  float x = -1, r; vector v = -1; color k = -1; string n = ""; float l[2] = {-1, -1}; matrix m = 0;
  color told = -1;
  if (which == 0) { r = surface("b", x); told = color(r, x, 0); }
  if (which == 1) { r = surface("w", v); told = color(xcomp(v), ycomp(v), zcomp(v)) * r; }
  if (which == 2) { r = surface("c", k); told = k * r; }
  if (which == 3) { r = surface("n", n); told = color(r, n == "xy" ? 1 : 0, 0); }
  if (which == 4) { r = surface("l", l); told = color(r, l[0], l[1]); }
  if (which == 5) { r = surface("m", m); told = color(r, comp(m, 3, 0), comp(m, 0, 0)); }
  if (which == 6) { r = surface("o", x); told = color(r, abs(x), 0); }
  if (which == 7) { r = surface("p", k); told = k * r; }
  if (which == 8) { r = surface("kept", x); told = color(r, x, 0); }
  %s
}
"""
t.write("air.sl", ASKS.replace("asks", "air") % ("volume", "Ci = told; Oi = 1;"))
t.write("lamp.sl", ASKS.replace("asks", "lamp") % ("light", "solar(vector \"camera\" (0, 0, 1), 0) { Cl = told; }"))
t.write("lit.sl", (t.folder / "told.sl").read_text().replace("told(", "lit(").replace("Ci = 1", "illuminance(P) { Ci = Cl; }"))
COMPUTED = [(0, lambda s: (1, 6, 0), "a number"), (1, lambda s: (1, 0, 0), "a vector of a space"), (2, lambda s: (s, 2, 0), "a colour that varies"),
            (3, lambda s: (1, 1, 0), "a text"), (4, lambda s: (1, 2, 4), "an array"), (5, lambda s: (1, 2, 1), "a matrix"),
            (8, lambda s: (1, 8, 0), "an output that is never assigned")]
for which, wanted, what in COMPUTED:
    expect("air", shown("air", f'Surface "told" Atmosphere "air" "which" [{which}]'), wanted, f"the atmosphere is told a default that is computed: {what}")
    expect("lamp", shown("lamp", f'LightSource "lamp" 1 "which" [{which}] Surface "lit"'), wanted, f"so is a light: {what}")
expect("given", shown("given", 'Surface "told" "float a" [5] "float b" [7] Atmosphere "air"'), lambda s: (1, 7, 0), "a value that is given counts")
expect("variable", shown("variable", 'Surface "told" Atmosphere "air"', '"varying float a" [0 1 0 1]'), lambda s: (1, 3 * s, 0), "a default follows a primitive variable", 0.06)
t.write("mover.sl", "displacement mover(float a = 2; float b = 3 * a) { N = N; }\n")
t.write("looks.sl", 'surface looks() { float x = -1, y = -1, r = displacement("b", x), q = 0; illuminance(P) { q = lightsource("twice", y); } Ci = color(r * x, q, y); Oi = 1; }\n')
t.write("sun.sl", 'light sun(float k = 2; float twice = 2 * k) { solar(vector "camera" (0, 0, 1), 0) { Cl = 1; } }\n')
expect("looks", shown("looks", 'LightSource "sun" 1 Displacement "mover" Surface "looks"'), lambda s: (6, 1, 4), "displacement() and lightsource() tell computed defaults")

# The atmosphere runs after the surface, and lights before it ends.
expect("after", shown("after", 'Surface "told" Atmosphere "air" "which" [6]'), lambda s: (1, .75, 0), "the atmosphere is told what the surface has put out")
expect("after2", shown("after2", 'Surface "told" Atmosphere "air" "which" [7]'), lambda s: (s, 0, 1), "point by point")
both = shown("both", 'Surface "told" Atmosphere "air" "which" [7]', before='DisplayChannel "varying color p" Display "both.exr" "openexr" "rgba" Display "+p.exr" "openexr" "p"')
expect("both", both, lambda s: (s, 0, 1), "also where a Display shows it")
shade = pixels(t.folder / "both_p.exr")
t.expect(max(abs(shade[x, 0][0] - (x + .5) / 4) for x in range(4)) < 0.02, "  which it still does")
expect("before", shown("before", 'LightSource "lamp" 1 "which" [6] Surface "lit"'), lambda s: (0, 1, 0), "a light is not told what the surface assigns later")

# A primitive variable replaces a parameter of a volume shader.
t.write("vp.sl", "volume vp(varying float q = .125; float twice = 2 * q) { Ci = color(q, twice, 0); Oi = 1; }\n")
for kind, values, wanted in (("constant", ".5", lambda s: (.5, 1, 0)), ("varying", "0 1 0 1", lambda s: (s, 2 * s, 0))):
    expect("vp", shown("vp", 'Surface "constant" Atmosphere "vp"', f'"{kind} float q" [{values}]'), wanted, f"{kind} float for a parameter of the atmosphere", 0.04)

# Options (RISpec 3.2, table 15.5). FrameAspectRatio 2 leaves the upper half of the format.
t.write("opts.sl", """surface opts() {
  float f[3] = {0, 0, 0}, d[3] = {0, 0, 0}, l[3] = {0, 0, 0}, c[4] = {0, 0, 0, 0}, s2[2] = {0, 0}, n[2] = {0, 0}, a = 0;
  float r = option("Format", f) + option("DeviceResolution", d) + option("DepthOfField", l) + option("CropWindow", c) + option("Shutter", s2)
    + option("Clipping", n) + option("FrameAspectRatio", a);
  if (u < .3 && v < .3) printf("%f: %f %f %f, %f %f %f, %f %f %f, %f %f %f %f, %f %f, %f %f, %f\\n", r, f[0], f[1], f[2], d[0], d[1], d[2], l[0], l[1], l[2],
    c[0], c[1], c[2], c[3], s2[0], s2[1], n[0], n[1], a);
  Ci = 1; Oi = 1; }
""")
WHOLE = "7.000000: 4.000000 4.000000 1.000000, 4.000000 {rows}.000000 1.000000, 2.800000 .500000 3.000000, 0.000000 1.000000 0.000000 1.000000, 0.000000 1.000000, .500000 100.000000, {aspect}.000000"
LENS = "DepthOfField 2.8 .5 3 Shutter 0 1 Clipping .5 100"
for before, rows, aspect in (("", 4, 1), ("FrameAspectRatio 2", 2, 2)):
    shown("opts", 'Surface "opts"', before=f"{before} {LENS}", says=(WHOLE.format(rows=rows, aspect=aspect).replace(" .", " 0."),))

# A value that a light computes for the renderer is known if it is the same everywhere, or an output.
t.write("roles.sl", 'light roles(float nd = 0; string first = "a"; uniform float __nondiffuse = nd; string __category = concat(first, ",b"))'
        ' { solar(vector "camera" (0, 0, 1), 0) { Cl = 1; } }\n'
        'light puts(float nd = 0; output float __nondiffuse = nd) { solar(vector "camera" (0, 0, 1), 0) { Cl = 1; } }\n'
        'light unknown(uniform float __nondiffuse = step(2, time)) { solar(vector "camera" (0, 0, 1), 0) { Cl = 1; } }\n')
t.write("by.sl", 'surface by() { Ci = color(comp(diffuse(N), 0), 0, 0); illuminance("b", P) { Ci += color(0, 1, 0); } Oi = 1; }\n')
for light, says, wanted in (('"roles" 1', (), (1, 1, 0)), ('"roles" 1 "nd" [1]', (), (0, 1, 0)), ('"roles" 1 "first" ["c"]', (), (1, 1, 0)), ('"puts" 1 "nd" [1]', (), (0, 0, 0)),
                            ('"puts" 1', (), (1, 0, 0)), ('"unknown" 1', ("light-value", '"__nondiffuse"'), (1, 0, 0))):
    expect("roles", shown("roles", f'LightSource {light} Surface "by"', says=says), lambda s: wanted, f"LightSource {light}")
t.finish()
