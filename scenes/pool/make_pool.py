#!/usr/bin/env python3
"""Writes pool.rib: a courtyard pool in the afternoon. Its waves throw caustics onto its floor and, faintly, onto the loggia.

    make_pool.py > pool.rib

Units are metres. x points to the right, y up from the still water and z away from the eye.
"""
import math
import pathlib
import random
import sys

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1]))
from parts import box, head, lathe as spun, numbers, part, rounded, soft

random.seed(21)
DECK, FLOOR = 0.16, -1.35              # These are the heights of the stone around the water and of the mosaic below it.
LEFT, RIGHT, NEAR, FAR = -3.3, 3.5, 0, 6.2  # These are the sides of the basin. A white wall stands on its right side.
WALL = 8.7                             # The rear wall stands at this z.


def lathe(profile):
    """Returns a surface of revolution made of quadric bands. The profile is a list of (radius, height) from the bottom to the top."""
    bands = [f"Hyperboloid {r0:.4g} 0 {y0:.4g}  {r1:.4g} 0 {y1:.4g} 360" for (r0, y0), (r1, y1) in zip(profile, profile[1:])]
    return "TransformBegin Rotate -90 1 0 0 " + " ".join(bands) + " TransformEnd"


def agave(leaves, size):
    """Returns stiff leaves in a rosette. Each is a bicubic patch that is broadest below its middle, hollow on its upper side, and pointed."""
    out = []
    for k in range(leaves):
        angle, rise = 2.39996 * k, math.radians(18 + 62 * (k / leaves) ** 0.8 + random.uniform(-6, 6))
        length = size * random.uniform(0.85, 1.1) * (1 - 0.35 * k / leaves)
        points = []
        for along, width, sag in ((0, 0.075, 0), (0.35, 0.16, 0.02), (0.7, 0.13, 0.0), (1, 0.004, -0.10 * (1 - rise))):
            away, up = length * along * math.cos(rise), length * (along * math.sin(rise) + sag)
            for across in (-1, -0.4, 0.4, 1):
                side, fold = across * width * length, 0.35 * width * length * (abs(across) - 0.4)
                points += [away * math.cos(angle) - side * math.sin(angle), up + fold, away * math.sin(angle) + side * math.cos(angle)]
        out.append(f'Patch "bicubic" "P" [{numbers(points)}]')
    return ['Basis "bezier" 3 "bezier" 3'] + out


def sprig(name, count, size):
    """Prints an object of leaves, which are small quadrilaterals at random angles within a ball of about 30 cm."""
    points = []
    for _ in range(count):
        at = [random.gauss(0, 0.13) for _ in range(3)]
        a, b = ([random.gauss(0, size) for _ in range(3)] for _ in range(2))
        points += [c + s * p + 0.6 * t * q for s, t in ((-1, 0), (0, -1), (1, 0), (0, 1)) for c, p, q in zip(at, a, b)]
    print(f'  ObjectBegin "{name}"\n    PointsPolygons [{" ".join(["4"] * count)}] [{" ".join(str(k) for k in range(4 * count))}] "P" [{" ".join(f"{c:.3f}" for c in points)}]\n  ObjectEnd')


def sprigs(name, places):
    return [f"TransformBegin Translate {x:.2f} {y:.2f} {z:.2f} Rotate {random.uniform(0, 360):.0f} {random.uniform(-1, 1):.1f} 1 {random.uniform(-1, 1):.1f} Scale {w:.2f} {h:.2f} {w:.2f} "
            f'ObjectInstance "{name}" TransformEnd' for x, y, z, w, h in places]


def bougainvillea(count, flowers):
    """Yields places of sprigs that hang over the rear wall on the left. Sprigs with flowers hang further out than sprigs with leaves."""
    for _ in range(count):
        x = random.triangular(-9.0, -4.5, -7.6)
        bough, hang = 0.5 + 0.5 * math.sin(2.1 * x + 1) * math.sin(3.7 * x), random.random() ** 1.4
        out = 0.5 * math.sin(math.pi * min(1, hang + 0.25))
        yield x, 3.35 + 0.3 * random.random() - hang * (0.5 + 1.6 * bough), WALL - 0.1 - out * (1.1 if flowers else 0.7), random.uniform(0.7, 1.2), random.uniform(0.7, 1.1)


def cypress(x, z, tall, wide):
    for k in range(130):
        up = (k + random.random()) / 130
        away, angle = wide * (1 - up) ** 0.75 * min(1, 0.5 + 3 * up) * random.uniform(0.5, 1), random.uniform(0, 2 * math.pi)
        yield x + away * math.cos(angle), 0.3 + tall * up, z + away * math.sin(angle), 0.75 - 0.35 * up, 1.5


head("pool", "A courtyard pool in the afternoon", 38, "Clipping 0.2 500", "Rotate -10 1 0 0", "Rotate -6 0 1 0", "Translate 0.75 -1.9 3.9")
print(f'''WorldBegin
  CoordinateSystem "court"
  Attribute "irradiance" "float maxerror" [1]  # the shaders' occlusion() is interpolated between records
  Attribute "light" "string shadows" ["on"]
  Attribute "photon" "string globalmap" ["rest"] "string causticmap" ["caustics"]
  LightSource "sunlight" "sun" "vector sundirection" [-0.62 0.66 -0.50] "float turbidity" [3] "float samples" [6]
''')

part("sky", 'Attribute "visibility" "int diffuse" [0] "int transmission" [0] "int photon" [0]', 'Surface "summersky"',
     "Rotate -90 1 0 0", "Sphere 200 -200 200 360")

# The water is a flat sheet. The shader "waves" raises it, for rays and photons too.
part("water", 'Attribute "photon" "string globalmap" ["rest"]', 'Attribute "photon" "string shadingmodel" ["water"]', 'Attribute "displacementbound" "float sphere" [0.06]',
     'Attribute "trace" "int displacements" [1] "int maxspeculardepth" [4] "float tessellation" [2]', 'Displacement "waves"', 'Surface "water"', 'Interior "depths"',
     f'PatchMesh "bilinear" 15 "nonperiodic" 14 "nonperiodic" "P" [{numbers(c for j in range(14) for i in range(14, -1, -1) for c in (LEFT - 0.05 + i * (RIGHT - LEFT + 0.1) / 14, 0, NEAR - 0.05 + j * (FAR - NEAR + 0.1) / 13))}]')

WET = 'Interior "depths" Exterior "depths"'
PHOTONS = ' "string photons" ["photons/caustics.caustic.ptc"]'
MOSAIC = 'Surface "mosaic"' + PHOTONS
part("basin", WET, MOSAIC,
     f'PointsPolygons [4 4 4 4 4] [0 1 2 3  0 4 5 1  1 5 6 2  2 6 7 3  3 7 4 0] "P" [{numbers(c for y in (FLOOR, 0.1) for x, z in ((LEFT, NEAR), (LEFT, FAR), (RIGHT, FAR), (RIGHT, NEAR)) for c in (x, y, z))}]')
for k in range(3):
    top = -0.28 - 0.32 * k
    part(f"step {k + 1}", WET, MOSAIC + ' "color deep" [0.42 0.66 0.64] "color pale" [0.62 0.78 0.74]', box(LEFT, -1.75, FLOOR, top, FAR - 0.42 * (k + 1), FAR - 0.42 * k))

# The stone around the water has a rounded edge.
UNLIT = 'Attribute "visibility" "int photon" [0]'  # Photons need not reach these objects.
STONE = 'Surface "travertine"'
print("  ShadingRate 0.25")  # The shadows of the sun are sharp on dry surfaces, so steps between micropolygons would show.
part("near deck", UNLIT, STONE, box(-9, RIGHT, -0.3, DECK, -4.5, NEAR - 0.04))
part("left deck", UNLIT, STONE, box(-9, LEFT - 0.04, -0.3, DECK, NEAR - 0.04, WALL))
part("far deck", UNLIT, STONE, box(LEFT - 0.04, RIGHT, -0.3, DECK, FAR + 0.04, WALL + 0.3))
for name, (x0, x1, z0, z1) in {"near edge": (LEFT - 0.3, RIGHT, NEAR - 0.3, NEAR + 0.03), "far edge": (LEFT - 0.3, RIGHT, FAR - 0.03, FAR + 0.3),
                               "left edge": (LEFT - 0.3, LEFT + 0.03, NEAR - 0.1, FAR + 0.1)}.items():
    part(name, 'Surface "travertine" "float slab" [0.45]', soft(x0, x1, DECK - 0.07, DECK + 0.025, z0, z1))

# Walls surround the court, and a loggia stands at its rear.
WHITE = 'Surface "stucco" "color paint" [0.80 0.77 0.71]'
part("right wall", UNLIT, WHITE, box(RIGHT, RIGHT + 0.35, 0.1, 3.05, -1.2, 9.1))
part("rear wall", 'Surface "stucco" "color paint" [0.66 0.27 0.17]' + PHOTONS, box(-9, 1.0, 0, 3.3, WALL, WALL + 0.3), box(2.1, RIGHT, 0, 3.3, WALL, WALL + 0.3),
     box(1.0, 2.1, 2.32, 3.3, WALL, WALL + 0.3))
part("roof", WHITE + PHOTONS, box(-4.3, RIGHT, 2.62, 2.84, 6.55, WALL + 0.1))
for k, x in enumerate((-4.0, -1.45, 1.1)):
    part(f"pillar {k + 1}", WHITE + PHOTONS, box(x - 0.13, x + 0.13, DECK, 2.62, 6.75, 7.01))
part("door", UNLIT, 'Surface "shutter" "color paint" [0.035 0.075 0.24]', box(1.0, 2.1, DECK, 2.32, WALL + 0.12, WALL + 0.17))
part("bench", 'Surface "shutter" "color paint" [0.30 0.17 0.085] "float slat" [0.11]', box(-3.4, -1.0, 0.50, 0.56, 7.75, 8.5), box(-3.3, -3.2, DECK, 0.5, 7.8, 8.45), box(-1.2, -1.1, DECK, 0.5, 7.8, 8.45))
part("cushions", UNLIT, 'Surface "stucco" "color paint" [0.82 0.78 0.68]', soft(-3.38, -2.22, 0.56, 0.74, 7.78, 8.48), soft(-2.2, -1.02, 0.56, 0.74, 7.78, 8.48))
part("pillow", 'Surface "stucco" "color paint" [0.80 0.47 0.10]', "Translate -2.95 0.93 8.42 Rotate -14 1 0 0 Rotate 9 0 0 1", soft(-0.27, 0.27, -0.24, 0.24, -0.09, 0.09))

# Plants stand in pots and hang over the wall.
POT = 'Surface "stucco" "color paint" [0.50 0.22 0.12]'
for name, x, z, size, leaves in (("agave by the loggia", 2.75, 7.3, 0.72, 30), ("agave on the left", -4.2, 4.5, 0.95, 34)):
    part(f"pot of the {name}", UNLIT, POT, f"Translate {x} {DECK} {z}", lathe(rounded([(0.001, 0), (0.2, 0), (0.27, 0.2), (0.31, 0.42), (0.36, 0.44), (0.36, 0.52), (0.31, 0.53), (0.29, 0.46), (0.001, 0.46)])))
    part(name, UNLIT, 'Surface "leaf" "color green" [0.14 0.24 0.15]', f"Translate {x} {DECK + 0.42} {z}", *agave(leaves, size))
sprig("bracts", 80, 0.042)
sprig("leaves", 80, 0.045)
part("bougainvillea, bracts", UNLIT, 'Surface "leaf" "color green" [0.66 0.05 0.27]', *sprigs("bracts", bougainvillea(60, True)))
part("bougainvillea, leaves", UNLIT, 'Surface "leaf" "color green" [0.10 0.19 0.045]', *sprigs("leaves", bougainvillea(75, False)))
part("cypresses", UNLIT, 'Surface "leaf" "color green" [0.045 0.085 0.04]', *(p for tree in ((-2.6, 15.5, 4.6, 0.55), (-1.0, 17, 5.4, 0.6), (0.4, 15.2, 4.2, 0.5)) for p in sprigs("leaves", cypress(*tree))))

# People have left a few objects behind.
part("swim ring", 'Surface "vinyl"', "Translate 1.55 0.045 2.35 Rotate 3 0 0 1 Rotate 20 0 1 0 Rotate -88 1 0 0", "Torus 0.40 0.135 0 360 360")
part("handrail", 'Surface "steel"', 'Attribute "photon" "string shadingmodel" ["chrome"]', 'Color 0.75 0.76 0.78', 'Attribute "dice" "int roundcurve" [1] Basis "bezier" 3 "bezier" 3',
     *(f'Curves "cubic" [10] "nonperiodic" "P" [{numbers(c for y, z in ((-0.6, 5.05), (-0.1, 5.05), (0.2, 5.05), (0.75, 5.15), (1.05, 5.25), (1.05, 5.7), (1.05, 6.2), (1.05, 6.5), (0.8, 6.6), (0.15, 6.6)) for c in (x, y, z))}] "constant float constantwidth" [0.042]' for x in (-1.72, -2.35)))
part("hat", UNLIT, 'Attribute "trace" "float tessellation" [6]', 'Surface "straw"', f"Translate -1.93 {DECK + 0.055} -0.42 Rotate 5 0 0 1", spun([(0.262, 0.036), (0.235, 0.012), (0.17, 0.0), (0.112, 0.008), (0.108, 0.03), (0.104, 0.09), (0.09, 0.125), (0.055, 0.132), (0, 0.12)], 16))
part("ribbon", UNLIT, 'Surface "stucco" "color paint" [0.05 0.06 0.10]', f"Translate -1.93 {DECK + 0.055} -0.42 Rotate 5 0 0 1", "Rotate -90 1 0 0", "Hyperboloid 0.1105 0 0.014  0.1085 0 0.05 360")
part("towels", UNLIT, 'Surface "towel"', f"Translate -1.18 {DECK + 0.03} -0.50", *(
    f"TransformBegin Translate {random.uniform(-0.012, 0.012):.3f} {0.021 * k:.3f} {random.uniform(-0.012, 0.012):.3f} Rotate {10 + random.uniform(-2.5, 2.5):.1f} 0 1 0 "
    + soft(-0.3, 0.3, 0, 0.024, -0.2, 0.2, hard=4) + " TransformEnd" for k in range(6)))
print("WorldEnd")
