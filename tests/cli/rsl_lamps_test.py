"""Tests light shaders in RSL with an extent: over the geometry of AreaLightSource (RISpec 3.2, sections 4.6 and 12.2), and by solar() over the whole
sky. Last, it tests indirectdiffuse() beside the light that --gi adds."""
import math
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "image"))
from pictures import pixels  # noqa: E402
from program import Suite  # noqa: E402

t = Suite()
SIZE = 8
# The camera sees a floor from -1 to 1 from above, with x to the right and y up.
SCENE = """Format 8 8 1
PixelFilter "box" 1 1
PixelSamples 4 4
Translate 0 0 10
WorldBegin
%s
Surface "matte" "Kd" [1] "Ka" [0]
Patch "bilinear" "P" [-1 1 0  1 1 0  -1 -1 0  1 -1 0]
WorldEnd
"""
# The lamp is a square of side 2, 1.5 before the floor, and looks at it. The camera looks through it.
LAMP = """AttributeBegin
Attribute "visibility" "int camera" [0]
%sAreaLightSource "%s" 1 %s
Patch "bilinear" "P" [%s]
AttributeEnd
Illuminate 1 1"""
DOWN = "-1 -1 -1.5  1 -1 -1.5  -1 1 -1.5  1 1 -1.5"
UP = "-1 -1 -1.5  -1 1 -1.5  1 -1 -1.5  1 1 -1.5"


def lamp(shader, given='"float __samples" [64]', before="", points=DOWN):
    return LAMP % (before, shader, given, points)


def render(name, requests, code=0, *says):
    t.write(name + ".rib", SCENE % requests)
    result = t.expect_run(name, [name + ".rib", "-o", name + ".exr"], code, *says)
    t.expect(code != 0 or says or not result.stderr, f"  without a message ({result.stderr[:300]})")
    return pixels(t.folder / (name + ".exr"))


def mean_over_lamp(x, y, light):
    """Returns the mean over the lamp of `light` at its points, times the cosine at the floor."""
    steps, total = 40, 0
    for i in range(steps):
        for j in range(steps):
            px, py = 2 * (i + 0.5) / steps - 1, 2 * (j + 0.5) / steps - 1
            square = (px - x) ** 2 + (py - y) ** 2 + 1.5 ** 2
            total += light(px, py, square) * 1.5 / square ** 0.5
    return total / steps ** 2


def expect(name, picture, light, what, tolerance=0.04):
    """Compares a picture with an integral, in the mean and at each pixel as far as samples are noisy."""
    at = [2 * (k + 0.5) / SIZE - 1 for k in range(SIZE)]
    wanted = {(x, y): mean_over_lamp(at[x], -at[y], light) for x in range(SIZE) for y in range(SIZE)}
    whole = sum(p[0] for p in picture.values()) / sum(wanted.values())
    off = max(abs(picture[k][0] - wanted[k]) for k in wanted) / max(wanted.values())
    t.expect(abs(whole - 1) < 0.01 and off < tolerance, f"  {what} (mean {whole:.4f} of it, off by {off:.3f})")


t.write("even.sl", "light even(float intensity = 2) { illuminate(P) { Cl = intensity / (L . L); } }\n")
t.write("downward.sl", "light downward() { illuminate(P, N, PI / 2) { Cl = (L . N) / length(L) / (L . L); } }\n")
t.write("half.sl", 'light half() { point Q = transform("world", P); illuminate(P) { Cl = step(0, xcomp(Q)); } }\n')
t.write("written.sl", "light written(float __samples = 4) { illuminate(P) { Cl = 1; } }\n")
t.write("still.sl", 'light still() { illuminate(point "world" (0, 0, -1.5)) { Cl = 1; } }\n')
t.write("normals.sl", 'light normals() { normal n = ntransform("world", normalize(N)), g = ntransform("world", normalize(Ng));'
        " illuminate(P) { Cl = color(zcomp(n), zcomp(g), length(N)); } }\n")

even = render("even", lamp("even"))
expect("even", even, lambda px, py, square: 2 / square, "is the mean of lights all over the lamp")
expect("even_back", render("even_back", lamp("even", points=UP)), lambda px, py, square: 2 / square, "from both sides, as illuminate() names no cone")
# The mean of cosine / distance^2 over a sphere equals the value at its centre (Newton's shell theorem), whichever half
# of it is seen.
ball_lamp = '''AttributeBegin Attribute "visibility" "int camera" [0] AreaLightSource "even" 1 "float __samples" [256]
Translate 0 0 -1.5 %sSphere .5 -.5 .5 360 AttributeEnd Illuminate 1 1 ShadingRate .02'''
at = [2 * (k + 0.5) / SIZE - 1 for k in range(SIZE)]
for name, turn in (("ball", ""), ("ball_inside_out", "ReverseOrientation ")):
    ball = render(name, ball_lamp % turn)
    shares = [ball[x, y][0] / (2 * 1.5 / (at[x] ** 2 + at[y] ** 2 + 1.5 ** 2) ** 1.5) for x in range(SIZE) for y in range(SIZE)]
    mean, off = sum(shares) / len(shares), max(abs(share - 1) for share in shares)
    t.expect(abs(mean - 1) < 0.005 and off < 0.02, f"  {name}: all of a sphere shines, and hides none of it ({mean:.4f} of it, off by {off:.3f})")
# A cone of more than a right angle reaches behind the lamp, whether the shader or the scene says so; and so does one
# that does not stand on the lamp.
t.write("whole.sl", "light whole() { illuminate(P, N, PI) { Cl = 2 / (L . L); } }\n")
t.write("wide.sl", "light wide(float angle = PI / 2) { illuminate(P, normalize(N), angle) { Cl = 2 / (L . L); } }\n")
t.write("turned.sl", "light turned() { illuminate(P, -N, PI / 2) { Cl = 2 / (L . L); } }\n")
expect("whole", render("whole", lamp("whole", points=UP)), lambda px, py, square: 2 / square, "a cone of PI is everything")
expect("wide", render("wide", lamp("wide", '"angle" [3.2] "float __samples" [64]', points=UP)), lambda px, py, square: 2 / square, "also from the scene")
expect("narrow", render("narrow", lamp("wide")), lambda px, py, square: 2 / square, "less shines from the front")
t.write("quarter.sl", "light quarter() { illuminate(P, N, PI / 2) { Cl = 2 / (L . L); } }\n")
t.write("named.sl", "light named() { normal n = normalize(N); illuminate(P, n, radians(90)) { Cl = 2 / (L . L); } }\n")
for name in ("quarter", "named"):
    behind = render(name, lamp(name, points=UP), 0, "light-useless")
    t.expect(all(p[0] == 0 for p in behind.values()), f"  {name}: a cone of a right angle does not shine behind the lamp")
expect("turned", render("turned", lamp("turned", points=UP)), lambda px, py, square: 2 / square, "another axis counts")
# A cone counts as it is when the shader has computed it.
t.write("degrees.sl", "light degrees(float angle = 90) { float wide = radians(angle); illuminate(P, N, wide) { Cl = 2 / (L . L); } }\n")
t.write("assigned.sl", "light assigned(float angle = 90) { if (angle > 0) angle = radians(angle); illuminate(P, N, angle) { Cl = 2 / (L . L); } }\n")
t.write("chosen.sl", "light chosen(float angle = 90, half = angle / 2) { if (angle > 90) { illuminate(P, N, radians(2 * half)) { Cl = 2 / (L . L); } }"
        " else illuminate(P, N, PI / 2) { Cl = 2 / (L . L); } }\n")
for name in ("degrees", "assigned", "chosen"):
    all_round = render(name, lamp(name, '"angle" [180] "float __samples" [64]', points=UP))
    expect(name, all_round, lambda px, py, square: 2 / square, "a cone that is computed reaches behind the lamp")
    behind = render(name, lamp(name, points=UP), 0, "light-useless")
    t.expect(all(p[0] == 0 for p in behind.values()), f"  {name}: and does not if it is a right angle")
# The eye sees a lamp on the side to which it shines: pi Cl d^2 / (A cosine).
for name, points, radiance in (("turned", DOWN, math.pi / 2), ("turned", UP, 0), ("even", UP, math.pi / 2), ("even", DOWN, math.pi / 2)):
    seen = render("seen", lamp(name, '"float __visible" [1]', points=points).replace('Attribute "visibility" "int camera" [0]', 'Surface "constant" Color [0 0 0]'))
    t.expect(abs(seen[4, 4][0] - radiance) < 0.05, f"  the eye sees {name} with {radiance:.2f} ({seen[4, 4][0]:.3f})")
# What a light says of its sample is that of the point on the lamp.
# A condition that depends on the lit point decides where the lamp shines, and not how wide its cone is.
t.write("near.sl", "light near(float reach = 100, angle = PI) { if (distance(Ps, P) < reach) illuminate(P, N, angle) { Cl = 2 / (L . L); } }\n")
expect("near", render("near", lamp("near", points=UP)), lambda px, py, square: 2 / square, "a cone under a condition reaches behind the lamp")
t.write("placed.sl", 'light placed(float across = xcomp(transform("world", P))) { illuminate(P) { Cl = 1; } }\n')
t.write("hears.sl", 'surface hears() { illuminance(P, N, PI / 2) { float x = 7; lightsource("across", x); Ci += x * x * Cl; } Oi = 1; }\n')
SCENE, matte = SCENE.replace('"matte" "Kd" [1] "Ka" [0]', '"hears"'), SCENE
heard = render("hears", lamp("placed", '"float __samples" [256]'))
t.expect(all(abs(p[0] - 1 / 3) < 0.02 for p in heard.values()), f"  defaults of a lamp are those of its points: the mean of x^2 from -1 to 1 ({heard[4, 4][0]:.4f})")
# A narrow highlight, and a mirror, see both halves of a ball whose light goes all round: the mean of what arrives.
SCENE = matte.replace('"matte" "Kd" [1] "Ka" [0]', '"glossy"')
t.write("glossy.sl", "surface glossy() { Ci = specular(normalize(N), -normalize(I), .02); Oi = 1; }\n")
t.write("each.sl", "surface each() { normal n = normalize(N); vector V = -normalize(I); illuminance(P, n, PI / 2) Ci += Cl * specularbrdf(normalize(L), n, V, .02); Oi = 1; }\n")
shiny = render("glossy", ball_lamp % "")
SCENE = matte.replace('"matte" "Kd" [1] "Ka" [0]', '"each"')
plain = render("each", (ball_lamp % "").replace("[256]", "[4096]"))
centre = [(x, y) for x in range(2, 6) for y in range(2, 6)]
sums = [sum(p[k][0] for k in centre) for p in (shiny, plain)]
t.expect(sums[1] > 0 and abs(sums[0] / sums[1] - 1) < 0.03, f"  specular() finds all of the lamp's light ({sums})")
SCENE = matte.replace('"matte" "Kd" [1] "Ka" [0]', '"glossy"')
few = render("few", (ball_lamp % "").replace("[256]", "[4]"))
off = (sum((few[k][0] - plain[k][0]) ** 2 for k in centre) / len(centre)) ** 0.5 / (sums[1] / len(centre))
t.expect(off < 0.15, f"  without noise, also with few samples (off by {off:.3f})")
SCENE = matte
two = render("two", (ball_lamp % "") + ''' AttributeBegin Surface "constant" Attribute "visibility" "int camera" [0]
 Patch "bilinear" "P" [-9 9 -1.5 9 9 -1.5 -9 -9 -1.5 9 -9 -1.5] AttributeEnd''')
ways = [(2 * math.pi * (j + .5) / 64, (i + .5) / 64) for i in range(64) for j in range(64)]
near = [(.5 * math.sqrt(1 - z * z) * math.cos(a), .5 * math.sqrt(1 - z * z) * math.sin(a), 1.5 - .5 * z) for a, z in ways]
half = sum(z / ((x - at[4]) ** 2 + (y - at[4]) ** 2 + z * z) ** 1.5 for x, y, z in near) / len(near)
t.expect(abs(two[4, 4][0] / half - 1) < 0.05, f"  what stands in it hides the far half ({two[4, 4][0]:.3f} of {half:.3f})")
expect("downward", render("downward", lamp("downward")), lambda px, py, square: 1.5 / square ** 1.5, "with the cosine at the lamp, by N")
t.expect(max(p[0] for p in render("upward", lamp("downward", points=UP), 0, "reaches nothing").values()) == 0, "  whose other side looks away")
expect("half", render("half", lamp("half", '"float __samples" [256]')), lambda px, py, square: float(px > 0), "P tells where on the lamp, in any space", 0.08)
seen = render("normals", lamp("normals"))[4, 4]
t.expect(seen[0] == seen[1] > 0.5 and abs(seen[0] - seen[2]) < 1e-4, f"  N and Ng are those of the lamp: towards the floor ({seen[:3]})")
moved = render("moved", "Translate 0 0 -1.5\n" + lamp("even", points="-1 -1 0  1 -1 0  -1 1 0  1 1 0") + "\nTranslate 0 0 1.5")
t.expect(all(abs(moved[k][0] - even[k][0]) < 1e-4 for k in even), "  wherever the shader's own space is")
less = render("written", lamp("written", ""))
t.expect(max(p[0] for p in less.values()) > 0, '  "__samples" may be a parameter of the shader')
hidden = render("hidden", lamp("even") + '\nAttributeBegin Surface "constant" Opacity [1 1 1] Attribute "visibility" "int camera" [0]'
                ' Patch "bilinear" "P" [-9 9 -1  9 9 -1  -9 -9 -1  9 -9 -1] AttributeEnd', 0, "lies in its shadow")
t.expect(max(p[0] for p in hidden.values()) == 0, "  what is between throws a shadow")
t.expect_run("a light that stands elsewhere", [t.write("still.rib", SCENE % lamp("still", "")), "-o", "still.exr"], 0, "not an area light; it shines without its geometry")

# Photons pass through the lamp that they leave, like shadow rays. Half of the photons of a ball that shines in all
# directions begin inwards.
walls = ('AttributeBegin Attribute "visibility" "int camera" [0] Patch "bilinear" "P" [1 1 0  1 -1 0  1 1 -3  1 -1 -3]'
         ' Patch "bilinear" "P" [-1 1 0  -1 -1 0  -1 1 -3  -1 -1 -3] AttributeEnd')
round_lamp = SCENE % (LAMP % ("Translate 0 0 -1.5 ", "even", "", "") + "\n" + walls)
ball_of_light = round_lamp.replace('Patch "bilinear" "P" []', "Sphere .5 -.5 .5 360")
for what, scene in (("lamp", ball_of_light), ("lamp that shines behind it", SCENE % (lamp("turned", points=UP) + "\n" + walls))):
    t.write("photons.rib", scene)
    counted = []
    for method in (["progressive", "--photons", "200000"], ["reference", "--samples", "200"]):
        t.expect_run(method[0], ["photons.rib", "-o", "photons.exr", "--gi", *method, "--bounces", "1", "--indirect-only"], 0)
        counted.append(sum(p[0] for p in pixels(t.folder / "photons.exr").values()))
    t.expect(counted[1] > 1 and abs(counted[0] / counted[1] - 1) < 0.04, f"  all photons of a {what} leave it ({counted})")

# solar() without a direction takes light from everywhere above. E/pi of a sky that is 1 is 1 (RISpec 3.2, section 13.4).
t.write("sky.sl", "light sky(color shade = 1) { solar() { Cl = shade; } }\n")
t.write("dome.sl", 'light dome() { solar() { vector way = vtransform("world", -normalize(L)); Cl = -zcomp(way); } }\n')
samples = '"float __samples" [64]'
seen = render("sky", f'LightSource "sky" 1 "color shade" [.5 1 2] {samples}')
mean = [sum(p[c] for p in seen.values()) / len(seen) for c in range(3)]
t.expect(all(abs(m - w) < 0.01 * w for m, w in zip(mean, (0.5, 1, 2))), f"  an even sky brings its radiance ({mean})")
seen = render("dome", f'LightSource "dome" 1 {samples}')
mean = sum(p[0] for p in seen.values()) / len(seen)
t.expect(abs(mean - 2 / 3) < 0.01, f"  a sky as bright as it is high: 2/3, the mean cosine by cosine ({mean:.4f})")
ball = 'Translate 0 0 -.5 Surface "constant" Sphere .4 -.4 .4 360 Translate 0 0 .5'
shade = render("shaded", f'LightSource "sky" 1 {samples} AttributeBegin Attribute "visibility" "int camera" [0] {ball} AttributeEnd')
t.expect(shade[3, 3][0] < 0.6 < 0.9 < shade[0, 0][0], f"  what stands before the sky throws a shadow ({shade[3, 3][0]:.2f} below, {shade[0, 0][0]:.2f} aside)")

# A shader asks for bounced light itself, beside the indirect light that --gi adds.
t.write("asks.sl", "surface asks() { normal n = normalize(N); Ci = diffuse(n) + indirectdiffuse(P, n, 4); Oi = 1; }\n")
asks = SCENE.replace('"matte" "Kd" [1] "Ka" [0]', '"asks"') % 'LightSource "distantlight" 1 "intensity" [1]'
t.write("asks.rib", asks)
t.expect_run("indirectdiffuse() and --gi", ["asks.rib", "-o", "asks.exr", "--gi", "gather"], 0, "light-twice", '"asks"')
t.expect("light-twice" not in t.expect_run("indirectdiffuse() alone", ["asks.rib", "-o", "asks.exr"], 0).stderr, "  counts once")
t.write("asks.rib", asks.replace('LightSource', 'LightSource "indirectlight" 2 LightSource'))
t.expect("light-twice" not in t.expect_run("an indirect light of the scene", ["asks.rib", "-o", "asks.exr"], 0).stderr, "  is the scene's choice")
t.finish()
