"""Tests the sources of shader parameters besides the request: primitive variables of every class and type, and defaults in named spaces."""
import itertools
import math
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "image"))
from pictures import pixels  # noqa: E402
from program import Suite  # noqa: E402

t = Suite()
SIZE = 16
SCENE = """Format 16 16 1
PixelFilter "box" 1 1
PixelSamples 1 1
ShadingRate 0.01
Hider "hidden" "int jitter" [0]
Translate 0 0 3
WorldBegin
%s
WorldEnd
"""
SQUARE = '"P" [-1 1 0  1 1 0  -1 -1 0  1 -1 0]'
PATCH = f'Patch "bilinear" {SQUARE}'
NET = " ".join(f"{x} {y} 0" for y in (1, 1 / 3, -1 / 3, -1) for x in (-1, -1 / 3, 1 / 3, 1))
WEIGHED = " ".join(f"{x} {y} 0 1" for y in (1, -1) for x in (-1, 1))
# Squares fill the picture. Where they have u and v, these run from left to right and from top to bottom.
PRIMITIVES = {"bilinear": PATCH,
              "bicubic": f'Basis "bezier" 3 "bezier" 3 Patch "bicubic" "P" [{NET}]',
              "mesh": f'PatchMesh "bilinear" 2 "nonperiodic" 2 "nonperiodic" {SQUARE}',
              "nurbs": f'NuPatch 2 2 [0 0 1 1] 0 1 2 2 [0 0 1 1] 0 1 "Pw" [{WEIGHED}]',
              "polygon": 'Polygon "P" [-1 1 0  1 1 0  1 -1 0  -1 -1 0]',
              "polygons": 'PointsPolygons [4] [0 1 3 2] ' + SQUARE,
              "subdivision": 'SubdivisionMesh "catmull-clark" [4] [0 1 3 2] ["interpolateboundary" "corner"] [0 0 4 1] [0 1 2 3] [10] ' + SQUARE}


def shown(name, requests, code=0):
    t.write(name + ".rib", SCENE % requests)
    result = t.expect_run(f"{name}", [name + ".rib", "-o", name + ".exr"], code)
    t.expect(code != 0 or not result.stderr, f"  without a message ({result.stderr[:300]})")
    return pixels(t.folder / (name + ".exr"))


def differs(picture, wanted):
    """Returns the largest difference of a picture from wanted(x, y) in the square from -1 to 1."""
    at = [(2 * (k + 0.5) / SIZE - 1) for k in range(SIZE)]
    return max(abs(a - b) for x, y in itertools.product(range(SIZE), repeat=2)
               for a, b in zip(picture[x, y], wanted(at[x], -at[y])))


def expect(name, requests, wanted, what, tolerance=0.02):  # A micropolygon is an eighth of a pixel wide.
    far = differs(shown(name, requests), wanted)
    t.expect(far <= tolerance, f"  {what} (off by {far:.2g})")


t.write("reference.sl", "surface reference(varying point __Pref = 1000) { Oi = 1; Ci = color(xcomp(__Pref), ycomp(__Pref), zcomp(__Pref)); }\n")
t.write("told.sl", "surface told(uniform color tint = 1) { Oi = 1; Ci = tint; }\n")
t.write("weighed.sl", "surface weighed(float weights[3] = {9, 9, 9}; uniform color tints[2] = {9, 9}) { Oi = 1;"
        " Ci = color(weights[0], weights[1], weights[2]) + 0 * tints[0]; }\n")
t.write("tinted.sl", "surface tinted(color tints[2] = {9, 9}) { uniform float k; Oi = 1; Ci = 0; for (k = 0; k < 2; k += 1) Ci += tints[k]; }\n")

# Points come as hpoint and as point, at control points and at corners. They are in the object's space, and the camera is 3 away, so the shader has 3
# + x, 3 + y, 3.
CORNERS = ((2, 4), (4, 4), (2, 2), (4, 2))
for name, primitive in PRIMITIVES.items():
    corners = [CORNERS[k] for k in ((0, 1, 3, 2) if name == "polygon" else (0, 1, 2, 3))]
    plain = " ".join(f"{x} {y} 0" for x, y in corners)
    classes = {"vertex point": plain, "varying point": plain, "vertex hpoint": " ".join(f"{2 * x} {2 * y} 0 2" for x, y in corners)}
    if name == "bicubic":
        net = list(zip(*[iter(map(float, NET.split()))] * 3))
        classes["vertex point"] = " ".join(f"{3 + x} {3 + y} 0" for x, y, _ in net)
        classes["vertex hpoint"] = " ".join(f"{6 + 2 * x} {6 + 2 * y} 0 2" for x, y, _ in net)
    for kind, values in classes.items():
        expect("reference", f'Surface "reference" {primitive} "{kind} __Pref" [{values}]', lambda x, y: (3 + x, 3 + y, 3),
               f"{kind} on {name} is taken for a parameter of type point")

# RISpec 3.2, section 11: a value of a primitive overrides the value of the request, whatever detail the shader declares.
for kind, values in (("constant", "1 0 0"), ("uniform", "1 0 0"), ("varying", "1 0 0 " * 4), ("vertex", "1 0 0 " * 4)):
    expect("told", f'Surface "told" {PATCH} "{kind} color tint" [{values}]', lambda x, y: (1, 0, 0), f"{kind} color for a uniform parameter")
expect("told", f'Surface "told" {PATCH} "varying color tint" [0 0 0  1 0 0  0 1 0  1 1 0]', lambda x, y: ((1 + x) / 2, (1 - y) / 2, 0),
       "is taken point by point where it varies")
faces = 'PointsPolygons [4 4] [0 1 4 3 1 2 5 4] "P" [-1 1 0  0 1 0  1 1 0  -1 -1 0  0 -1 0  1 -1 0]'
expect("told", f'Surface "told" {faces} "uniform color tint" [1 0 0  0 0 1]', lambda x, y: (1, 0, 0) if x < 0 else (0, 0, 1), "uniform color of each face")

# Arrays work.
expect("weighed", f'Surface "weighed" {PATCH} "constant float[3] weights" [1 2 3]', lambda x, y: (1, 2, 3), "constant float[3]")
expect("weighed", f'Surface "weighed" {PATCH} "varying float[3] weights" [0 0 7  1 0 7  0 1 7  1 1 7]', lambda x, y: ((1 + x) / 2, (1 - y) / 2, 7),
       "varying float[3], each element point by point")
expect("tinted", f'Surface "tinted" {PATCH} "varying color[2] tints" [0 0 7 1 1 1  1 0 7 1 1 1  0 1 7 1 1 1  1 1 7 1 1 1]',
       lambda x, y: ((1 + x) / 2 + 1, (1 - y) / 2 + 1, 8), "varying color[2], in a loop")
expect("tinted", f'Surface "tinted" {faces} "uniform color[2] tints" [1 0 0 1 0 0  0 0 1 0 0 1]', lambda x, y: (2, 0, 0) if x < 0 else (0, 0, 2),
       "uniform color[2] of each face")
expect("tinted", f'Surface "tinted" "color tints[2]" [1 1 1 1 1 1] {PATCH} "varying color[2] tints" [{"0 0 1 1 0 0 " * 4}]', lambda x, y: (1, 0, 1),
       "before that of the request")
points = " ".join(f"{2 + x} {3 - y} 0  0 0 0" for y in (0, 1) for x in (0, 1))
t.write("placed.sl", "surface placed(point places[2] = {9, 9}) { Oi = 1; Ci = color(xcomp(places[0]), ycomp(places[0]), zcomp(places[1])); }\n")
expect("placed", f'Surface "placed" {PATCH} "varying point[2] places" [{points}]', lambda x, y: (2 + (1 + x) / 2, 3 - (1 - y) / 2, 3),
       "varying point[2] is brought to current space")
t.write("rough.sl", "displacement rough(float heights[2] = {9, 9}) { P += (heights[0] + heights[1]) * vector(0, 0, 1); }\n"
        "surface rough2() { Oi = 1; Ci = zcomp(P); }\n")
expect("rough", f'Attribute "displacementbound" "sphere" [2] Displacement "rough" Surface "rough2" {PATCH} "varying float[2] heights" [0 1 .5 1 0 1 .5 1]',
       lambda x, y: (4 + (1 + x) / 4,) * 3, "varying float[2] of a displacement")

# A matrix of a primitive leads from the object's space, whose origin is 3 in front of the camera. A matrix of the
# request leads from the shader's space.
t.write("led.sl", "surface led(matrix mm = 0) { Oi = 1; Ci = color(comp(mm, 3, 0), comp(mm, 3, 1), comp(mm, 3, 2)); }\n")
MOVED = "[1 0 0 0 0 1 0 0 0 0 1 0 %s 2 3 1]"
expect("led", f'Surface "led" "matrix mm" {MOVED % 1} {PATCH}', lambda x, y: (1, 2, 6), "a matrix of the request")
for kind in ("constant", "uniform"):
    expect("led", f'Surface "led" {PATCH} "{kind} matrix mm" {MOVED % 1}', lambda x, y: (1, 2, 6), f"{kind} matrix")
expect("led", f'Surface "led" {faces} "uniform matrix mm" [{(MOVED % 1).strip("[]")} {(MOVED % 5).strip("[]")}]', lambda x, y: (1 if x < 0 else 5, 2, 6),
       "uniform matrix of each face")

# Defaults are in named spaces. The shader's own space is turned by 90 degrees about z and at 5 0 0 of the world, whose origin is 3 before the camera.
t.write("spaces.sl", """surface spaces(uniform point p = point SPACE (1, 2, 3); vector d = vector SPACE (1, 2, 3); normal n = normal SPACE (1, 2, 3);
  matrix m = matrix SPACE 1; float which = 0) {
  Oi = 1;
  vector v = vector p;
  if (which == 1) v = d;
  if (which == 2) v = vector n;
  if (which == 3) v = vector transform(m, point (1, 2, 3));
  Ci = color(xcomp(v), ycomp(v), zcomp(v));
}
""")
source = (t.folder / "spaces.sl").read_text()
for space, point, vector in (('"current"', (1, 2, 3), (1, 2, 3)), ('"world"', (1, 2, 6), (1, 2, 3)), ('"shader"', (3, 1, 6), (-2, 1, 3)), ("", (3, 1, 6), (-2, 1, 3)),
                             ('"camera"', (1, 2, 3), (1, 2, 3))):
    name = "in_" + (space.strip('"') or "none")
    t.write(name + ".sl", source.replace("SPACE", space).replace("surface spaces", "surface " + name))
    for which, wanted in enumerate((point, vector, vector)):
        expect(name, f'Translate 5 0 0 Rotate 90 0 0 1 Surface "{name}" "float which" [{which}] Rotate -90 0 0 1 Translate -5 0 0 {PATCH}',
               lambda x, y: wanted, f'a default {("point", "vector", "normal")[which]} {space} (1, 2, 3)')
# A matrix holds the space: transform() by the matrix of "current" changes nothing.
expect("in_current", f'Translate 5 0 0 Rotate 90 0 0 1 Surface "in_current" "float which" [3] Rotate -90 0 0 1 Translate -5 0 0 {PATCH}', lambda x, y: (1, 2, 3),
       'a default matrix "current" 1')
# A normal is the same whether a request or a primitive brings it. Neither the surface's orientation nor a scale's size takes part.
t.write("brought.sl", "surface brought(varying normal n = 0) { Oi = 1; Ci = color (comp(n, 0), comp(n, 1), comp(n, 2)); }\n")
for turned in ("", "ReverseOrientation", 'Orientation "inside"'):
    for kind, wanted in (("Scale 2 1 1", (.5, 2, 3)), ("Scale -1 1 1", (-1, 2, 3)), ("Rotate 90 0 0 1", (-2, 1, 3)), ("Scale 2 2 2", (.5, 1, 1.5))):
        back = {"Scale 2 1 1": "Scale .5 1 1", "Scale -1 1 1": "Scale -1 1 1", "Rotate 90 0 0 1": "Rotate -90 0 0 1", "Scale 2 2 2": "Scale .5 .5 .5"}[kind]
        expect("brought", f'{kind} {turned} Surface "brought" "normal n" [1 2 3] {back} {PATCH}', lambda x, y: wanted, f"a normal of a shader after {kind} {turned}")
        expect("brought", f'{kind} {turned} Surface "brought" {PATCH} "constant normal n" [1 2 3]', lambda x, y: wanted, f"a normal of a primitive after {kind} {turned}")
t.write("moons.sl", "surface moons(uniform point shade = point \"current\" (.6, .5, 0)) { float d = distance(shade, (s, t, 0)); Oi = 1; Ci = d; }\n")
expect("moons", f'Surface "moons" {PATCH}', lambda x, y: (math.hypot((1 + x) / 2 - .6, (1 - y) / 2 - .5),) * 3, "a point of texture space, as patterns have it")

# The u and v of a polygon are its x and y. Its micropolygons have other edges, so that du or dv is a rounding error.
t.write("sides.sl", "surface sides() { Oi = 1; Ci = 0.5 + 0.5 * normalize(calculatenormal(P)) . normalize(N); }\n")
t.write("wall.rib", """Format 160 100 1 Projection "perspective" "fov" [24] PixelSamples 2 2
Rotate -7.5 1 0 0 Translate 0 -3.75 15.2 WorldBegin Surface "sides" Polygon "P" [-14 -8 9 -14 16 9 14 16 9 14 -8 9] WorldEnd
""")
t.expect_run("a wall", ["wall.rib", "-o", "wall.exr"], 0)
wall = pixels(t.folder / "wall.exr")
t.expect(min(p[0] for p in wall.values()) > 0.999, f"calculatenormal() of a polygon is its normal ({min(p[0] for p in wall.values()):.3f})")

t.write("other.rib", f'Format 8 8 1 WorldBegin Translate 0 0 1 Surface "told" {PATCH} "constant float tint" [0.5] WorldEnd')
t.expect_run("a primitive variable of another type", ["other.rib", "-o", "other.exr"], 0, "shader-parameter-type", 'parameter "tint"')
t.finish()
