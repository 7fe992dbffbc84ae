#!/usr/bin/env python3
"""Writes evening.rib: a reading corner at dusk, which two lamps light.

    make_evening.py > evening.rib

Units are metres. x points to the right, y up from the floor and z away from the eye.
"""
import math
import pathlib
import random
import sys

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1]))
from parts import box, head, lathe, numbers, part, rounded, soft

random.seed(4)
BACK, LEFT, RIGHT, TOP = 2.5, -2.9, 3.0, 2.75  # These are the rear wall, the side walls and the ceiling.


def curtain(x0, x1, z, folds, top, bottom):
    """Returns cloth that hangs in folds. The folds are shallower at the top."""
    columns, rows, points = 14 * folds, 9, []
    for row in range(-1, rows + 2):  # A B-spline surface ends one row within its control points.
        h = row / rows
        for column in range(-1, columns + 2):
            s = column / columns
            phase = 2 * math.pi * folds * s + 0.5 * math.sin(5 * s + 2 * h)
            deep = (0.028 + 0.022 * h) * (1 + 0.35 * math.sin(9.1 * s + 1))
            points += [x0 + s * (x1 - x0) + 0.012 * h * math.sin(2 * phase), top + h * (bottom - top), z + deep * math.sin(phase)]
    return f'Basis "b-spline" 1 "b-spline" 1 PatchMesh "bicubic" {columns + 3} "nonperiodic" {rows + 3} "nonperiodic" "P" [{numbers(points)}]'


COVERS = [(0.30, 0.05, 0.035), (0.05, 0.10, 0.16), (0.06, 0.12, 0.07), (0.40, 0.30, 0.16), (0.17, 0.08, 0.04), (0.48, 0.40, 0.28), (0.10, 0.045, 0.08),
          (0.36, 0.16, 0.05), (0.035, 0.04, 0.05), (0.22, 0.22, 0.20), (0.45, 0.20, 0.12), (0.14, 0.17, 0.20)]


def books(x0, x1, y, back, space):
    """Returns a row of books between x0 and x1 on a board. Their spines face the eye and are bowed a little. The variable "up" runs from
    0 at the foot of a book to 1 at its head."""
    counts, faces, points, ups, colors = [], [], [], [], []
    x, cover = x0, random.choice(COVERS)
    while x < x1 - 0.06:
        if random.random() < 0.75:
            cover = random.choice(COVERS)
        thick, tall, deep = random.uniform(0.016, 0.05), random.uniform(0.62, 0.93) * space, random.uniform(0.15, 0.2)
        if random.random() < 0.05:
            x += random.uniform(0.05, 0.2)
            continue
        lean = 0 if random.random() < 0.9 else random.uniform(0.02, 0.05)
        first, front = len(points) // 3, back - deep
        profile = [(x, back), (x, front), (x + 0.2 * thick, front - 0.004), (x + 0.8 * thick, front - 0.004), (x + thick, front), (x + thick, back)]
        for high in (0, 1):
            for px, pz in profile:
                points += [px + lean * high, y + high * tall, pz]
                ups.append(high)
        for k in range(5):
            counts.append(4)
            faces += [first + k, first + k + 1, first + k + 7, first + k + 6]
            colors += cover
        counts.append(6)
        faces += [first + 6 + k for k in range(6)]
        colors += [0.62, 0.54, 0.40]
        x += thick + lean + random.uniform(0.0005, 0.003)
    return (f'PointsPolygons [{" ".join(map(str, counts))}] [{" ".join(map(str, faces))}] "P" [{numbers(points)}] '
            f'"varying float up" [{" ".join(map(str, ups))}] "uniform color Cs" [{numbers(colors)}]')


UNSEEN = 'Attribute "visibility" "int camera" [0] "int diffuse" [0] "int specular" [0] "int transmission" [0]'


def lamp(name, x, z, foot, shade, height, bulb, cloth):
    """Prints a lamp with a foot of brass. Its bulb shines up and down, and the cloth of its shade shines outwards."""
    below, above, tall = shade
    place = f"Translate {x} {height} {z} Rotate -90 1 0 0"
    part(f"foot of the {name}", 'Surface "brass"', f"Translate {x} {foot[0]} {z}", lathe(foot[1]))
    part(f"bulb of the {name}", UNSEEN, f'AreaLightSource "arealight" "{name} bulb" "float intensity" [{bulb}] "lightcolor" [1.0 0.60 0.28] "float samples" [12] "float visible" [0]',
         f"Translate {x} {height + 0.45 * tall} {z}", "Sphere 0.03 -0.03 0.03 360")
    part(f"light of the shade of the {name}", UNSEEN, f'AreaLightSource "arealight" "{name} shade" "float intensity" [{cloth}] "lightcolor" [1.0 0.58 0.25] "float samples" [12] "float visible" [0]',
         place, f"Hyperboloid {below + 0.004} 0 0  {above + 0.004} 0 {tall} 360")
    part(f"shade of the {name}", 'Attribute "visibility" "int diffuse" [0]', place, f'Surface "lampshade" "float height" [{tall}]', f"Hyperboloid {below} 0 0  {above} 0 {tall} 360")
    part(f"rims of the {name}", 'Surface "brass"', place, f"Torus {below} 0.004 0 360 360", f"Translate 0 0 {tall}", f"Torus {above} 0.004 0 360 360")
    print(f'  Illuminate "{name} bulb" 1\n  Illuminate "{name} shade" 1')


head("evening", "A reading corner at dusk", 35, "Clipping 0.2 200", "Rotate -5 1 0 0", "Rotate 2.5 0 1 0", "Translate -0.05 -1.28 3.3")
print('''WorldBegin
  CoordinateSystem "room"
  Attribute "light" "string shadows" ["on"]
  # What is left of the day comes by the window.
  AttributeBegin
    Attribute "visibility" "int camera" [0] "int specular" [0] "int transmission" [0]
    AreaLightSource "arealight" "dusk" "float intensity" [0.9] "lightcolor" [0.16 0.30 0.62] "float samples" [16] "float visible" [0]
    Polygon "P" [-2.5 2.6 2.9  -0.35 2.6 2.9  -0.35 0.35 2.9  -2.5 0.35 2.9]
  AttributeEnd
  Illuminate "dusk" 1
''')
# These area lights stand for the light that the ceiling and the wall behind the eye send back. Gathering it would take many rays.
for name, power, points in (("ceiling above the floor lamp", 0.85, [(2.7, 2.74, 0.4), (2.7, 2.74, 2.45), (0.5, 2.74, 2.45), (0.5, 2.74, 0.4)]),
                            ("ceiling above the table lamp", 0.35, [(-1.2, 2.74, 0.6), (-1.2, 2.74, 2.45), (-2.88, 2.74, 2.45), (-2.88, 2.74, 0.6)]),
                            ("wall behind the eye", 0.075, [(2.9, 0.1, -3.9), (2.9, 2.7, -3.9), (-2.8, 2.7, -3.9), (-2.8, 0.1, -3.9)])):
    part(name, UNSEEN, f'AreaLightSource "arealight" "{name}" "float intensity" [{power}] "lightcolor" [1.0 0.66 0.38] "float samples" [12] "float visible" [0]',
         f'Polygon "P" [{numbers(c for point in points for c in point)}]')
    print(f'  Illuminate "{name}" 1')
lamp("floor lamp", 1.62, 1.62, (0, rounded([(0.0, 0.0), (0.15, 0.0), (0.16, 0.012), (0.06, 0.03), (0.014, 0.06), (0.011, 0.3), (0.011, 1.0), (0.011, 1.45), (0.011, 1.6), (0, 1.62)], 3)),
     (0.24, 0.17, 0.27), 1.42, 1900, 6.0)
lamp("table lamp", -2.5, 1.72, (0.78, rounded([(0, 0), (0.08, 0), (0.085, 0.015), (0.05, 0.04), (0.075, 0.1), (0.095, 0.17), (0.06, 0.25), (0.018, 0.29), (0.012, 0.33), (0.012, 0.45), (0, 0.46)], 3)),
     (0.17, 0.12, 0.2), 1.16, 800, 6.0)

# The room has a wooden floor, plaster above a panelled dado, and a window with twelve panes.
part("floor", 'Surface "parquet"', f'Polygon "P" [{LEFT} 0 -4  {LEFT} 0 {BACK}  {RIGHT} 0 {BACK}  {RIGHT} 0 -4]')
part("ceiling", 'Surface "wall" "color paint" [0.74 0.71 0.65]', f'Polygon "P" [{LEFT} {TOP} -4  {RIGHT} {TOP} -4  {RIGHT} {TOP} {BACK}  {LEFT} {TOP} {BACK}]')
PAINT = 'Surface "wall" "color paint" [0.135 0.20 0.185]'
part("side walls", PAINT, f'Polygon "P" [{LEFT} 0 -4  {LEFT} {TOP} -4  {LEFT} {TOP} {BACK}  {LEFT} 0 {BACK}]', f'Polygon "P" [{RIGHT} 0 -4  {RIGHT} 0 {BACK}  {RIGHT} {TOP} {BACK}  {RIGHT} {TOP} -4]')
part("wall behind the eye", 'Surface "matte" Color 0.25 0.24 0.2', f'Polygon "P" [{LEFT} 0 -4  {RIGHT} 0 -4  {RIGHT} {TOP} -4  {LEFT} {TOP} -4]')
WINDOW = (-2.2, -0.6, 0.55, 2.35)
x0, x1, y0, y1 = WINDOW
part("back wall", PAINT, box(LEFT, x0, 0, TOP, BACK, BACK + 0.25), box(x1, RIGHT, 0, TOP, BACK, BACK + 0.25), box(x0, x1, 0, y0, BACK, BACK + 0.25), box(x0, x1, y1, TOP, BACK, BACK + 0.25))
PAINTED = 'Surface "joinery" "color paint" [0.50 0.48 0.43]'
part("window frame", PAINTED, *(box(x - 0.022, x + 0.022, y0, y1, BACK + 0.1, BACK + 0.15) for x in (x0 + 0.022, x0 + (x1 - x0) / 3, x0 + 2 * (x1 - x0) / 3, x1 - 0.022)),
     *(box(x0, x1, y - 0.02, y + 0.02, BACK + 0.105, BACK + 0.145) for y in (y0 + 0.02, y0 + 0.45, y0 + 0.9, y0 + 1.35, y1 - 0.02)),
     box(x0 - 0.09, x0, y0 - 0.05, y1, BACK - 0.03, BACK), box(x1, x1 + 0.09, y0 - 0.05, y1, BACK - 0.03, BACK), box(x0 - 0.1, x1 + 0.1, y1, y1 + 0.1, BACK - 0.035, BACK))
part("sill", PAINTED, soft(x0 - 0.12, x1 + 0.12, y0 - 0.04, y0 + 0.012, BACK - 0.14, BACK + 0.1, hard=3))
part("skirting and rail", 'Surface "joinery" "color paint" [0.12 0.175 0.16]', soft(LEFT, RIGHT, 0, 0.14, BACK - 0.025, BACK + 0.02, hard=3), soft(LEFT, LEFT + 0.025, 0, 0.14, -4, BACK, hard=3))
part("panes", 'Attribute "visibility" "int diffuse" [0] "int transmission" [0] "int specular" [0]', 'Surface "pane"', f'Polygon "P" [{x0} {y0} {BACK + 0.125}  {x0} {y1} {BACK + 0.125}  {x1} {y1} {BACK + 0.125}  {x1} {y0} {BACK + 0.125}]')
part("outside", 'Attribute "visibility" "int diffuse" [0] "int transmission" [0]', 'Surface "dusk"', 'Polygon "P" [-16 -6 22  -16 14 22  12 14 22  12 -6 22]')
part("curtains", 'Sides 2 Surface "linen"', curtain(-2.62, -2.08, BACK - 0.16, 5, 2.58, 0.04), curtain(-0.72, -0.2, BACK - 0.16, 5, 2.58, 0.04))
part("rod", 'Surface "brass"', "TransformBegin Translate -2.75 2.6 2.34 Rotate 90 0 1 0 Cylinder 0.014 0 2.68 360 TransformEnd", "TransformBegin Translate -0.07 2.6 2.34 Sphere 0.03 -0.03 0.03 360 TransformEnd")

# A bookcase stands in the corner behind the chair.
SHELVES = [0.09, 0.50, 0.88, 1.23, 1.56, 1.88, 2.2]
OAK = 'Surface "oak" "color pale" [0.26 0.145 0.07] "color dark" [0.10 0.046 0.02]'
part("bookcase", OAK, *(box(x - 0.017, x + 0.017, 0, 2.235, BACK - 0.28, BACK) for x in (0.02, 0.86, 1.70, 2.54)), box(0, 2.56, 2.22, 2.26, BACK - 0.3, BACK), box(0, 2.56, 0, 0.07, BACK - 0.26, BACK))
part("shelves", OAK, *(box(0.0, 2.55, y - 0.022, y, BACK - 0.27, BACK) for y in SHELVES[:-1]))
for row, (y, above) in enumerate(zip(SHELVES, SHELVES[1:])):
    for column, x in enumerate((0.042, 0.882, 1.722)):
        end = x + 0.8
        if (row, column) in ((3, 1), (4, 0), (5, 2)):  # Other things stand in these places.
            end -= 0.34
        part(f"books {row} {column}", 'Surface "cloth_bound"', books(x, end, y, BACK - 0.03, above - y - 0.03))
FINE = 'Attribute "trace" "float tessellation" [4]'  # Thin objects need more polygons for rays.
part("vase on a shelf", 'Surface "glaze" Color 0.50 0.42 0.30', f"Translate 1.47 {SHELVES[3]} {BACK - 0.14}", lathe(rounded([(0, 0), (0.04, 0), (0.045, 0.01), (0.08, 0.08), (0.07, 0.15), (0.03, 0.19), (0.04, 0.22), (0.035, 0.222), (0, 0.2)], 3)))
part("bowl on a shelf", FINE, 'Surface "glaze" Color 0.09 0.22 0.24', f"Translate 0.64 {SHELVES[4]} {BACK - 0.14}", lathe(rounded([(0, 0), (0.04, 0), (0.045, 0.015), (0.09, 0.06), (0.115, 0.11), (0.11, 0.112), (0.08, 0.06), (0, 0.03)], 3)))
part("globe on a shelf", 'Surface "globe"', f"Translate 2.36 {SHELVES[5] + 0.155} {BACK - 0.15} Rotate 23 0 0 1", "Rotate -90 1 0 0", "Sphere 0.105 -0.105 0.105 360")
part("foot of the globe", 'Surface "brass"', f"Translate 2.36 {SHELVES[5]} {BACK - 0.15}", lathe(rounded([(0, 0), (0.06, 0), (0.06, 0.012), (0.012, 0.025), (0.01, 0.05), (0, 0.055)], 3)))

# An armchair of leather stands on a rug. It has a cushion.
CHAIR = "Translate 0.78 0 1.02 Rotate 28 0 1 0"
part("armchair", 'Surface "leather"', CHAIR, soft(-0.33, 0.33, 0.13, 0.36, -0.36, 0.34, hard=2.5), soft(-0.325, 0.325, 0.30, 0.50, -0.42, 0.26, hard=1.4),
     soft(-0.49, -0.30, 0.12, 0.63, -0.42, 0.40, hard=1.6), soft(0.30, 0.49, 0.12, 0.63, -0.42, 0.40, hard=1.6),
     "TransformBegin Translate 0 0.30 0.27 Rotate 13 1 0 0", soft(-0.42, 0.42, -0.1, 0.68, -0.05, 0.17, hard=1.5), soft(-0.31, 0.31, 0.14, 0.66, -0.16, 0.02, hard=0.8), "TransformEnd")
part("feet of the armchair", OAK, CHAIR, *(f"TransformBegin Translate {x} 0 {z} Rotate -90 1 0 0 Hyperboloid 0.016 0 0  0.024 0 0.14 360 TransformEnd" for x in (-0.38, 0.38) for z in (-0.34, 0.32)))
part("cushion", 'Surface "weave" "color ground" [0.40 0.17 0.055] "color stripe" [0.58 0.48 0.32]', CHAIR, "Translate 0.05 0.69 0.13 Rotate -7 0 0 1 Rotate 18 1 0 0", soft(-0.21, 0.21, -0.2, 0.2, -0.085, 0.085, hard=0.9))
part("rug", 'Surface "rug"', box(-1.7, 1.9, 0.002, 0.014, -1.5, 1.55))

# A table stands in front of the chair, with a tray, a decanter of whisky, a tumbler and a book on it.
TABLE = (-0.62, 0.02)
part("table", OAK, f"Translate {TABLE[0]} 0 {TABLE[1]}", lathe([(0, 0.40), (0.44, 0.40), (0.45, 0.40), (0.465, 0.415), (0.46, 0.43), (0.44, 0.432), (0, 0.432)], 16),
     *(f"TransformBegin Rotate {a} 0 1 0 Translate 0.33 0 0 Rotate 8 0 0 1 Rotate -90 1 0 0 Hyperboloid 0.013 0 -0.01  0.022 0 0.405 360 TransformEnd" for a in (35, 155, 275)))
part("tray", FINE, 'Surface "brass"', f"Translate {TABLE[0] - 0.14} 0.433 {TABLE[1] + 0.1}", lathe([(0, 0.004), (0.17, 0.004), (0.175, 0.004), (0.19, 0.022), (0.195, 0.022), (0.19, 0.018), (0.178, 0), (0, 0)], 16))
GLASS = 'Surface "crystal" Attribute "trace" "int maxspeculardepth" [9] Attribute "visibility" "int diffuse" [0]'
AMBER = '"color tint" [0.88 0.46 0.10]'
AT = f"Translate {TABLE[0] - 0.17} 0.438 {TABLE[1] + 0.15}"
part("decanter", GLASS, AT, lathe(rounded([(0, 0.002), (0.06, 0.0), (0.066, 0.01), (0.07, 0.06), (0.066, 0.11), (0.035, 0.15), (0.02, 0.175), (0.019, 0.215), (0.026, 0.235)], 3) + rounded([(0.023, 0.237), (0.015, 0.215), (0.016, 0.175), (0.03, 0.148), (0.06, 0.108)], 3)))
part("whisky in the decanter", GLASS, f'Surface "crystal" "float eta" [0.9] {AMBER}', AT, lathe(rounded([(0, 0.01), (0.05, 0.01), (0.06, 0.014), (0.064, 0.06), (0.0599, 0.1079)], 3)))
part("top of the whisky", GLASS, f'Surface "crystal" "float eta" [1.36] {AMBER}', AT, "Rotate -90 1 0 0", "Disk 0.1078 0.0602 360")
part("stopper", GLASS, AT, "Translate 0 0.268 0", "Sphere 0.033 -0.033 0.033 360")
AT = f"Translate {TABLE[0]} 0.438 {TABLE[1]}"
part("tumbler", GLASS, AT, lathe(rounded([(0, 0), (0.03, 0), (0.034, 0.004), (0.038, 0.045), (0.041, 0.088)], 3) + rounded([(0.0385, 0.088), (0.0365, 0.06), (0.0355, 0.04)], 3)))
part("whisky in the tumbler", GLASS, f'Surface "crystal" "float eta" [0.9] {AMBER}', AT, lathe(rounded([(0, 0.014), (0.03, 0.014), (0.033, 0.02), (0.0355, 0.04)], 3)))
part("top of the whisky in the tumbler", GLASS, f'Surface "crystal" "float eta" [1.36] {AMBER}', AT, "Rotate -90 1 0 0", "Disk 0.04 0.0355 360")
part("closed book", 'Surface "cloth_bound"', f"Translate {TABLE[0] + 0.22} 0.433 {TABLE[1] - 0.12} Rotate 24 0 1 0", 'Color 0.30 0.05 0.035', box(-0.08, 0.08, 0, 0.004, -0.11, 0.11), box(-0.08, 0.08, 0.03, 0.034, -0.11, 0.11), box(-0.084, -0.078, 0, 0.034, -0.11, 0.11),
     'Surface "pages"', box(-0.078, 0.075, 0.004, 0.03, -0.105, 0.105))

# A chest stands along the left wall, below a picture.
part("chest", OAK, soft(LEFT + 0.01, LEFT + 0.5, 0.74, 0.78, 0.5, 2.0, hard=4), box(LEFT + 0.02, LEFT + 0.47, 0.12, 0.74, 0.54, 1.96), *(box(x, x + 0.04, 0, 0.12, z, z + 0.04) for x in (LEFT + 0.05, LEFT + 0.4) for z in (0.58, 1.88)))
part("drawers", OAK, *(soft(LEFT + 0.46, LEFT + 0.485, y, y + 0.27, z, z + 0.67, hard=4) for y in (0.15, 0.45) for z in (0.57, 1.26)))
part("knobs", 'Surface "brass"', *(f"TransformBegin Translate {LEFT + 0.5} {y} {z} Sphere 0.016 -0.016 0.016 360 TransformEnd" for y in (0.285, 0.585) for z in (0.75, 1.06, 1.44, 1.75)))
part("picture", 'Surface "painting"', f'Polygon "P" [{LEFT + 0.02} 1.35 1.85  {LEFT + 0.02} 2.05 1.85  {LEFT + 0.02} 2.05 0.75  {LEFT + 0.02} 1.35 0.75] "st" [0 1  0 0  1 0  1 1]')
part("frame", 'Surface "brass"', *(soft(LEFT + 0.0, LEFT + 0.045, *sides, hard=3) for sides in ((1.31, 1.36, 0.71, 1.89), (2.04, 2.09, 0.71, 1.89), (1.31, 2.09, 0.71, 0.76), (1.31, 2.09, 1.84, 1.89))))
print("WorldEnd")
