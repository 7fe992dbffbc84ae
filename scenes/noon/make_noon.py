#!/usr/bin/env python3
"""Writes noon.rib: a street of an old city at noon, with its houses, plane trees and cars, and a dome in the haze at its end.

    make_noon.py > noon.rib

Units are metres. x points to the right, y up and z away from the eye.
"""
import math
import pathlib
import random
import sys

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1]))
from cars import car
from houses import WALL, House, colour
from parts import box, flat, head, lathe, numbers, part, soft

random.seed(12)
SUN = (-0.44, 0.82, -0.36)             # This direction to the sun stands in noon.h too.
LEAVES = 64                            # This is the number of leaves at the end of a twig.
KERB, FAR = 7.0, 250.0                 # These are the x of the kerbs and the z at which the street ends.


def street():
    for side in (-1, 1):
        z, index = -9.0 - 3 * side, 0
        rng = random.Random(40 + side)
        while z < FAR:
            wide = rng.choice((9.5, 11, 12.5, 14, 16.5))
            House(index + (0 if side < 0 else 50), wide, z < 75).write(f"house {'left' if side < 0 else 'right'} {index}", side, z)
            z, index = z + wide, index + 1
    part("street", 'Surface "street"', *(f'Patch "bilinear" "P" [{numbers((-KERB, 0, a, KERB, 0, a, -KERB, 0, b, KERB, 0, b))}]' for a, b in ((-12, 20), (20, 60), (60, 140), (140, 330))))
    for side in (-1, 1):
        x0, x1 = sorted((side * (KERB + 0.28), side * (WALL + 0.6)))
        part("pavement", 'Surface "street" "float flags" [1]', *(f'Patch "bilinear" "P" [{numbers((x0, 0.15, a, x1, 0.15, a, x0, 0.15, b, x1, 0.15, b))}]' for a, b in ((-12, 20), (20, 60), (60, 140), (140, 330))))
        a, b = sorted((side * KERB, side * (KERB + 0.28)))
        part("kerb", 'Surface "masonry" "float bond" [3]', "Color 0.42 0.41 0.39", *(soft(a, b, -0.2, 0.152, z + 0.006, z + 0.994, hard=3.5) for z in range(-8, 60)), box(a, b, -0.2, 0.15, 60, 330))


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def unit(a):
    return tuple(c / math.hypot(*a) for c in a)


def tree(name, seed, tall):
    """Prints a plane tree. Its trunk forks into boughs, and leaves surround the ends of its twigs. A leaf is a bent rhombus."""
    rng = random.Random(seed)
    boughs, ends = [], []
    def grow(at, d, length, radius, depth):
        points = [at]
        for k in range(3):
            d = unit([c + rng.uniform(-0.16, 0.16) + (0.05 if n == 1 else 0) for n, c in enumerate(d)])
            points.append(tuple(p + length / 3 * c for p, c in zip(points[-1], d)))
        boughs.append((points, radius, 0.6 * radius))
        if depth >= 2:
            ends.extend(points[1:] if depth >= 3 else points[2:])
        if depth < 4:
            turn = rng.uniform(0, 6.28)
            for k in range(3 if depth < 3 else 2):
                side = unit(cross(d, (math.cos(turn + 2.1 * k), 0.3, math.sin(turn + 2.1 * k))))
                lean = rng.uniform(0.55, 0.95)
                grow(points[-1 if k else -2], unit([c + lean * s for c, s in zip(d, side)]), length * rng.uniform(0.62, 0.82), 0.58 * radius, depth + 1)
    grow((0, 0, 0), (0, 1, 0), 0.46 * tall, 0.19, 0)
    points = [p for path, _, _ in boughs for p in path]
    widths = [w for path, a, b in boughs for w in numbers_between(2 * a, 2 * b, len(path))]
    leaves, open_, which = [], [], []
    middle = tuple(sum(e[k] for e in ends) / len(ends) for k in range(3))
    reach = max(math.dist(e, middle) for e in ends)
    for end in ends:
        for _ in range(LEAVES):
            base = tuple(c + rng.gauss(0, 0.26) for c in end)
            outward = unit([b - m + 0.001 for b, m in zip(base, middle)])
            along = unit([o * 0.7 + rng.uniform(-1, 1) for o in outward])
            up = unit([rng.uniform(-0.6, 0.6) + 0.35 * o for o in outward[:1]] + [1] + [rng.uniform(-0.6, 0.6)])
            across, size = unit(cross(up, along)), rng.uniform(0.09, 0.16)
            tip = tuple(b + size * a for b, a in zip(base, along))
            sides = [tuple(b + 0.5 * size * a + s * 0.45 * size * c + 0.12 * size * u for b, a, c, u in zip(base, along, across, up)) for s in (-1, 1)]
            leaves += [base, sides[0], tip, sides[1]]
            open_.append(min(1, max(0, math.dist(base, middle) / reach)) ** 1.5)
            which.append(rng.random())
    count = len(which)
    faces = " ".join(f"{4 * k} {4 * k + 1} {4 * k + 2} {4 * k} {4 * k + 2} {4 * k + 3}" for k in range(count))
    twice = lambda values: numbers((v for v in values for _ in (0, 1)), ".2f")
    print(f'ObjectBegin "{name}"\n  Surface "plain" "float uneven" [0.6] "float formula" [1]\n  Color 0.33 0.30 0.24\n  Attribute "dice" "int roundcurve" [1]')
    print(f'  Curves "linear" [{numbers(len(p) for p, _, _ in boughs)}] "nonperiodic" "P" [{numbers(flat(points), ".3f")}] "varying float width" [{numbers(widths, ".3f")}]')
    print(f'  Surface "leaf"\n  PointsPolygons [{"3 3 " * count}] [{faces}] "P" [{numbers(flat(leaves), ".3f")}] "uniform float open" [{twice(open_)}] "uniform float which" [{twice(which)}]\nObjectEnd')


def numbers_between(a, b, count):
    return [a + (b - a) * k / (count - 1) for k in range(count)]


PAINTS = [(0.50, 0.020, 0.016), (0.70, 0.70, 0.68), (0.035, 0.075, 0.18), (0.025, 0.026, 0.028), (0.30, 0.32, 0.33), (0.09, 0.16, 0.12), (0.62, 0.55, 0.42), (0.16, 0.28, 0.36), (0.72, 0.71, 0.66), (0.36, 0.06, 0.05)]


def cars():
    rng = random.Random(12)
    # These cars drive. Those on the left come towards the eye, and those on the right go away from it.
    moving = [("hatch", (0.56, 0.022, 0.016), -2.25, 15.2, 180), ("sedan", (0.66, 0.42, 0.03), 2.2, 10.8 + 7, 0), ("van", (0.72, 0.72, 0.70), -2.2, 27, 180), ("sedan", (0.04, 0.10, 0.22), 2.35, 31, 0),
              ("sedan", PAINTS[4], -2.3, 43, 180), ("hatch", PAINTS[8], 2.2, 46, 0), ("van", (0.10, 0.20, 0.16), 2.2, 68, 0), ("sedan", PAINTS[1], -2.2, 63, 180), ("hatch", PAINTS[0], -2.2, 84, 180), ("sedan", PAINTS[3], 2.2, 90, 0), ("sedan", PAINTS[6], -2.2, 118, 180), ("van", PAINTS[1], 2.2, 124, 0), ("hatch", PAINTS[4], -2.2, 150, 180)]
    for k, (kind, paint, x, z, heading) in enumerate(moving):
        car(f"car {k}", kind, paint, x, z, heading, taxi=k == 1)
    for side in (-1, 1):
        z, k = 16.5 + (1.5 if side > 0 else 0), 0
        while z < 170:
            kind = rng.choice(("sedan", "hatch", "hatch", "sedan", "van"))
            car(f"parked {side} {k}", kind, rng.choice(PAINTS), side * rng.uniform(5.72, 5.86), z, (180 if side < 0 else 0) + rng.uniform(-1.2, 1.2), flake=rng.choice((0, 0.6, 1)))
            z, k = z + rng.choice((5.2, 5.5, 6.0, 11)), k + 1


def lamp(name):
    """Prints a street lamp of cast iron."""
    print(f'ObjectBegin "{name}"\n  Surface "plain" "float gloss" [0.4] "float formula" [1]\n  Color 0.03 0.045 0.04')
    print("  " + lathe([(0.2, 0), (0.2, 0.1), (0.2, 0.1), (0.15, 0.2), (0.12, 0.7), (0.15, 0.8), (0.075, 0.95), (0.06, 2.2), (0.085, 2.3), (0.055, 2.4), (0.045, 4.3), (0.08, 4.4), (0.05, 4.5), (0.13, 4.62), (0.13, 4.66), (0.02, 4.66)]))
    print("  " + lathe([(0.24, 5.2), (0.24, 5.24), (0.12, 5.36), (0.05, 5.42), (0.05, 5.5), (0.0, 5.56)]))
    print('  Surface "chrome" "float glass" [1]\n  Color 0.85 0.85 0.8\n  ' + lathe([(0.12, 4.66), (0.17, 4.9), (0.21, 5.2)]) + "\nObjectEnd")


def walker(name, seed):
    """Prints a person who walks, with legs, a coat or a shirt, arms, shoes, hands and a head."""
    rng = random.Random(seed)
    cloth, legs = rng.choice([(0.55, 0.12, 0.10), (0.12, 0.18, 0.30), (0.62, 0.58, 0.50), (0.10, 0.10, 0.11), (0.45, 0.42, 0.12), (0.20, 0.32, 0.26)]), rng.choice([(0.06, 0.07, 0.12), (0.05, 0.05, 0.05), (0.30, 0.26, 0.20)])
    def limb(points, radii):
        rings = [[(x + a * math.cos(t), y, z + b * math.sin(t)) for t in (2 * math.pi * n / 8 for n in range(8))] for (x, y, z), (a, b) in zip(points, radii)]
        first, last = ([tuple(c + 0.02 * (d - c) for c, d in zip(at, p)) for p in ring] for at, ring in ((points[0], rings[0]), (points[-1], rings[-1])))  # Both ends are closed.
        rings = [first] * 3 + rings + [last] * 3
        return f'Basis "b-spline" 1 "b-spline" 1 PatchMesh "bicubic" 8 "periodic" {len(rings)} "nonperiodic" "P" [{numbers(flat(flat(rings)))}]'
    stride = rng.uniform(0.16, 0.3)
    skin = "Color 0.50 0.33 0.24 "
    rows = [f'Surface "plain" "float uneven" [0.25]\n  {colour(legs)}']
    for s in (-1, 1):
        rows.append(limb([(0.05 * s, 0.95, 0), (0.085 * s, 0.84, 0), (0.10 * s, 0.5, 0.5 * stride * s + 0.03), (0.10 * s, 0.28, 0.8 * stride * s), (0.10 * s, 0.09, stride * s - 0.01)], [(0.07, 0.09), (0.09, 0.11), (0.07, 0.075), (0.06, 0.07), (0.06, 0.075)]))
    rows.append(colour(cloth))
    rows.append(limb([(0, 0.80, 0), (0, 0.92, 0), (0, 1.12, 0), (0, 1.33, 0), (0, 1.43, 0), (0, 1.49, 0), (0, 1.53, 0)], [(0.185, 0.14), (0.18, 0.135), (0.17, 0.12), (0.215, 0.13), (0.21, 0.11), (0.11, 0.08), (0.06, 0.06)]))
    for s in (-1, 1):
        rows.append(limb([(0.14 * s, 1.46, 0), (0.20 * s, 1.38, 0), (0.235 * s, 1.15, -0.10 * s), (0.245 * s, 0.92, -0.2 * s + 0.05)], [(0.07, 0.07), (0.065, 0.07), (0.052, 0.057), (0.042, 0.045)]))
    rows.append("Color 0.035 0.028 0.022")
    for s in (-1, 1):
        rows.append(limb([(0.10 * s, 0.11, stride * s), (0.10 * s, 0.06, stride * s + 0.03), (0.10 * s, 0.0, stride * s + 0.05)], [(0.05, 0.06), (0.055, 0.12), (0.055, 0.13)]))
    rows.append(skin + limb([(0, 1.48, 0.0), (0, 1.55, 0.01), (0, 1.61, 0.02), (0, 1.71, 0.02), (0, 1.79, 0.01), (0, 1.81, 0.0)], [(0.055, 0.055), (0.052, 0.056), (0.072, 0.09), (0.078, 0.096), (0.06, 0.08), (0.01, 0.01)]))
    for s in (-1, 1):
        rows.append(limb([(0.25 * s, 0.93, -0.2 * s + 0.05), (0.25 * s, 0.86, -0.2 * s + 0.07), (0.25 * s, 0.79, -0.2 * s + 0.08)], [(0.035, 0.035), (0.03, 0.048), (0.02, 0.03)]))
    rows.append("Color 0.09 0.06 0.04 " + limb([(0, 1.66, -0.035), (0, 1.75, -0.025), (0, 1.81, -0.01), (0, 1.835, 0)], [(0.08, 0.075), (0.085, 0.10), (0.06, 0.075), (0.01, 0.01)]))
    print(f'ObjectBegin "{name}"\n  ' + "\n  ".join(rows) + "\nObjectEnd")


def dome():
    """Prints the church to which the street leads. It has a portico, a drum and a dome."""
    rows = ['Surface "masonry" "float bond" [3]', "Color 0.70 0.66 0.58", box(-19, 19, 0, 24, 285, 330), box(-20, 20, 24, 25.4, 284, 331), box(-13, 13, 18, 20, 276, 286), box(-13, 13, 0, 1.2, 275, 286),
            'PointsPolygons [3 4 4] [0 1 2 0 2 3 4 1 5 3 2] "P" [-13.6 20 275.6 13.6 20 275.6 0 25.5 275.6 0 25.5 286 -13.6 20 286 13.6 20 286]']
    for k in range(8):
        rows.append(f"TransformBegin Translate {-11.2 + 3.2 * k} 1.2 277.5 Rotate -90 1 0 0 Cylinder 0.85 0 17 360 TransformEnd")
    rows += ["TransformBegin Translate 0 0 306", lathe([(13, 25), (13, 28), (13, 28), (11.4, 28), (11.4, 28), (11.4, 38), (11.4, 38), (12.6, 38.4), (12.6, 39.4), (12.6, 39.4), (11.3, 39.6), (11.3, 41.5)], around=24)]
    for k in range(20):
        a = 2 * math.pi * k / 20
        rows.append(f"TransformBegin Translate {12 * math.cos(a):.3f} 28 {12 * math.sin(a):.3f} Rotate -90 1 0 0 Cylinder 0.5 0 10.2 360 TransformEnd")
    rows += ['Color 0.30 0.40 0.38 Surface "plain"', lathe([(11.2, 41.3), (11.0, 44), (9.6, 48), (6.9, 51.4), (3.4, 53.4), (2.3, 53.6)], around=24), 'Color 0.70 0.66 0.58', lathe([(2.2, 53), (2.2, 57), (2.2, 57), (2.7, 57.2), (2.7, 57.6), (1.6, 58), (0.7, 59.5), (0.2, 61), (0.1, 64)]), "TransformEnd"]
    part("church", "Sides 2", *rows)
    part("square", 'Surface "street" "float flags" [1]', f'Patch "bilinear" "P" [-400 -0.02 250 400 -0.02 250 -400 -0.02 700 400 -0.02 700]')


def furniture():
    rng = random.Random(77)
    rows = []
    for side in (-1, 1):
        z, k = 14.0 + 2 * (side > 0), 0
        while z < 240:
            turn, scale = rng.uniform(0, 360), rng.uniform(0.86, 1.12)
            rows.append(f'TransformBegin Translate {side * 8.35} 0.12 {z:.1f} Rotate {turn:.0f} 0 1 0 Scale {scale:.2f} {scale:.2f} {scale:.2f} ObjectInstance "tree{k % 3}" TransformEnd')
            if k % 2 == 0:
                rows.append(f'TransformBegin Translate {side * 7.75} 0.15 {z + 5.5:.1f} ObjectInstance "lamp" TransformEnd')
            z, k = z + 11, k + 1
    part("trees and lamps", 'Illuminate "bounce" 0', "Sides 2", *rows)
    people = []
    for k in range(34):
        side = rng.choice((-1, 1))
        z = 19 + 90 * rng.random() ** 1.2
        people.append(f'TransformBegin Translate {side * rng.uniform(9.0, 10.6):.2f} 0.15 {z:.2f} Rotate {rng.choice((0, 180)) + rng.uniform(-15, 15):.0f} 0 1 0 Scale 1 {rng.uniform(0.92, 1.05):.2f} 1 ObjectInstance "walker{k % 6}" TransformEnd')
    part("people", "Sides 2", *people)


head("noon", "A street at noon", 44, "ScreenWindow -1.7778 1.7778 -0.80 1.20", "Clipping 0.3 3000", "Translate -0.35 -3.1 2.0")
for k in range(3):
    tree(f"tree{k}", 31 + k, (8.6, 9.4, 7.9)[k])
lamp("lamp")
for k in range(6):
    walker(f"walker{k}", 60 + k)
print(f'''WorldBegin
CoordinateSystem "city"
Attribute "light" "string shadows" ["on"]
LightSource "sunlight" "sun" "vector sundirection" [{numbers(SUN)}] "intensity" [1.9] "samples" [16] "string __category" ["sun"]
LightSource "indirectlight" "bounce" "samples" [160]
Atmosphere "noonhaze"
AttributeBegin
  Attribute "identifier" "string name" ["sky"]
  Attribute "visibility" "int transmission" [0]
  Surface "noonsky"
  Atmosphere "null"
  Rotate -90 1 0 0
  Sphere 2000 -200 2000 360
AttributeEnd''')
street()
dome()
furniture()
cars()
print("WorldEnd")
