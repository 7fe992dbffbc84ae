#!/usr/bin/env python3
"""Writes watch.rib: the movement of a watch. The camera is so close that little of the movement is in focus.

    make_watch.py > watch.rib

Units are millimetres. x points to the right, y up from the main plate and z away from the eye.
"""
import math
import pathlib
import random
import sys

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1]))
from parts import head, numbers, part

random.seed(12)


# An outline is a closed list of (x, z). It runs counterclockwise as seen from above with z up the page.
def circle(radius, count=96, x=0.0, z=0.0):
    return [(x + radius * math.cos(2 * math.pi * k / count), z + radius * math.sin(2 * math.pi * k / count)) for k in range(count)]


def arc(radius, a0, a1, count=20):
    return [(radius * math.cos(a0 + (a1 - a0) * k / count), radius * math.sin(a0 + (a1 - a0) * k / count)) for k in range(count + 1)]


def curve(points, steps=14):
    """Returns a closed Catmull-Rom curve through points."""
    out = []
    for k in range(len(points)):
        p, q, r, s = (points[(k + n) % len(points)] for n in (-1, 0, 1, 2))
        for i in range(steps):
            t = i / steps
            out.append(tuple(0.5 * (2 * b + (c - a) * t + (2 * a - 5 * b + 4 * c - d) * t * t + (3 * b - a - 3 * c + d) * t ** 3) for a, b, c, d in zip(p, q, r, s)))
    return out


def outwards(outline):
    """Returns the unit normals of an outline on its right-hand side."""
    normals = []
    for k in range(len(outline)):
        (ax, az), (bx, bz) = outline[k - 1], outline[(k + 1) % len(outline)]
        length = math.hypot(bx - ax, bz - az) or 1
        normals.append(((bz - az) / length, (ax - bx) / length))
    return normals


def inset(outline, by):
    return [(x - by * nx, z - by * nz) for (x, z), (nx, nz) in zip(outline, outwards(outline))]


def band(below, above, y0, y1, lean):
    """Returns a strip between two outlines. Its normals lean upwards: their y is `lean`."""
    count, normals = len(below), outwards(below)
    faces = " ".join(f"{k} {(k + 1) % count} {count + (k + 1) % count} {count + k}" for k in range(count))
    points = [c for outline, y in ((below, y0), (above, y1)) for x, z in outline for c in (x, y, z)]
    flat = math.sqrt(1 - lean * lean)
    tilted = [c for nx, nz in normals for c in (flat * nx, lean, flat * nz)]
    return f'PointsPolygons [{" ".join(["4"] * count)}] [{faces}] "P" [{numbers(points)}] "varying normal N" [{numbers(tilted + tilted)}]'


def plate(outline, holes, y0, y1, chamfer):
    """Returns the top, the chamfers and the sides of a part that is cut out of sheet metal. Holes run clockwise."""
    loops = [outline, *holes]
    tops = [inset(loop, chamfer) for loop in loops]
    points = [c for loop in tops for x, z in loop for c in (x, y1, z)]
    count = sum(map(len, loops))
    top = f'PointsGeneralPolygons [{len(loops)}] [{" ".join(str(len(loop)) for loop in loops)}] [{" ".join(map(str, range(count)))}] "P" [{numbers(points)}]'
    bevels = [band(loop, over, y1 - chamfer, y1, 0.7071) for loop, over in zip(loops, tops)]
    sides = [band(loop, loop, y0, y1 - chamfer, 0) for loop in loops]
    return [top], bevels, sides


def cut(name, outline, holes, y0, y1, chamfer, top, edge, *place):
    tops, bevels, sides = plate(outline, holes, y0, y1, chamfer)
    part(name, *place, f"Surface {top}", *tops, f"Surface {edge}", *bevels, *sides)


def backwards(outline):
    return outline[::-1]


def teeth(count, root, tip):
    """Returns the outline of a wheel, whose teeth are rounded towards their tips."""
    out, step = [], 2 * math.pi / count
    for k in range(count):
        for share, radius in ((-0.5, root), (-0.36, root), (-0.24, root + 0.35 * (tip - root)), (-0.17, root + 0.75 * (tip - root)), (-0.07, tip),
                              (0.07, tip), (0.17, root + 0.75 * (tip - root)), (0.24, root + 0.35 * (tip - root)), (0.36, root)):
            a = step * (k + share)
            out.append((radius * math.cos(a), radius * math.sin(a)))
    return out


def spaces(count, inner, outer, spoke, turn=0.0):
    """Returns the outlines of the openings between spokes. They run clockwise."""
    out = []
    for k in range(count):
        a0, a1 = 2 * math.pi * k / count + turn, 2 * math.pi * (k + 1) / count + turn
        outside = arc(outer, a0 + 0.5 * spoke / outer, a1 - 0.5 * spoke / outer)
        inside = arc(inner, a1 - 0.5 * spoke / inner, a0 + 0.5 * spoke / inner, 10)
        out.append(backwards(outside + inside))
    return out


def turned(profile):
    """Returns quadrics around the vertical axis. The profile is a list of (radius, height) from the bottom to the top."""
    return "TransformBegin Rotate -90 1 0 0 " + " ".join(
        f"Disk {y0:.4g} {max(r0, r1):.4g} 360" if abs(y0 - y1) < 1e-6 and min(r0, r1) < 1e-6 else f"Hyperboloid {r0:.4g} 0 {y0:.4g}  {r1:.4g} 0 {y1:.4g} 360"
        for (r0, y0), (r1, y1) in zip(profile, profile[1:])) + " TransformEnd"


GILT, STEEL, BLUE = '"gilt"', '"steel"', '"blued"'
POLISHED = '"bevel"'


def wheel(name, x, z, y, count, tip, spokes, pinion=0.55, turn=0.0):
    """Prints a wheel of brass on an arbor of steel, with a pinion below it."""
    root = tip - 2.0 * tip / count * 1.15
    place = f"Translate {x} 0 {z} Rotate {turn} 0 1 0"
    cut(name, teeth(count, root, tip), spaces(spokes, 0.26 * tip, root - 0.14 * tip, 0.11 * tip), y, y + 0.34, 0.05, GILT, POLISHED, place)
    part(f"arbor of the {name}", f"Surface {STEEL}", place, turned([(0.22, -0.3), (0.22, y - 0.9), (0.22, y + 0.9), (0.12, y + 1.0), (0.12, y + 1.5), (0, y + 1.5)]))
    part(f"boss of the {name}", f"Surface {GILT}", place, turned([(0.2 * tip, y + 0.34), (0.2 * tip, y + 0.44), (0.17 * tip, y + 0.48), (0, y + 0.48)]))
    cut(f"pinion of the {name}", teeth(10, 0.7 * pinion, pinion), [], y - 1.2, y - 0.1, 0.04, STEEL, STEEL, place)


def screw(name, x, z, y, radius, turn):
    """Prints a blued screw. Its head is two halves with a slot between them."""
    gap = math.asin(0.16)
    half = arc(radius, gap, math.pi - gap, 30)
    place = f"Translate {x} {y} {z} Rotate {turn} 0 1 0"
    for k, outline in enumerate((half, [(-px, -pz) for px, pz in half])):
        cut(f"{name}, half {k + 1}", outline, [], 0, 0.34 * radius + 0.12, 0.10 * radius, BLUE, BLUE, place)
    part(f"slot of the {name}", 'Surface "steel"', place, turned([(0.98 * radius, 0.02), (0, 0.02)]))


def jewel(name, x, z, y, radius):
    """Prints a pierced ruby in a ring of gold."""
    place = f"Translate {x} {y} {z}"
    part(f"setting of the {name}", 'Surface "gilt" "float shine" [1]', place, turned([(1.62 * radius, -0.2), (1.62 * radius, 0.06), (1.55 * radius, 0.12), (1.2 * radius, 0.12), (1.02 * radius, 0.0), (1.0 * radius, -0.12)]),
         turned([(1.02 * radius, -0.42), (0, -0.42)]))
    profile = [(0.98, -0.30), (1.0, -0.2), (1.0, 0.0), (0.93, 0.07), (0.80, 0.10), (0.62, 0.09), (0.42, 0.03), (0.26, -0.07), (0.17, -0.16), (0.15, -0.24)]
    part(name, 'Surface "ruby"', 'Attribute "trace" "int maxspeculardepth" [6]', place, turned([(r * radius, h * radius) for r, h in profile]))
    part(f"pivot in the {name}", f"Surface {STEEL}", place, turned([(0.12 * radius, -0.4), (0.12 * radius, 0.0), (0.07 * radius, 0.06 * radius), (0, 0.07 * radius)]))


head("watch", "The movement of a watch, seen through a lens that is wide open", 22.5, 'Hider "hidden" "float[4] aperture" [7 12 0.35 0]', "DepthOfField 1 1.7 34.5", "Clipping 1 400", "Rotate -32 1 0 0", "Rotate 3 0 1 0", "Translate -0.4 -22.0 37.4", 'ShadingInterpolation "smooth"', samples=12, rate=1.6)
print('''WorldBegin
  CoordinateSystem "movement"
  Attribute "trace" "int maxspeculardepth" [3]
''')
part("studio", 'Attribute "visibility" "int camera" [0]', 'Surface "studio"', "Rotate -90 1 0 0", "Sphere 150 -150 150 360")

# The main plate has a ring around it.
part("main plate", 'Surface "perlage"', turned([(20.4, -0.4), (0, -0.4)]))
part("case", 'Surface "steel"', turned([(20.4, -0.4), (20.4, 2.6), (20.9, 3.1), (22.0, 3.1), (22.6, 2.5), (22.6, -4)]))

# The train is the row of meshing wheels from the barrel to the escape wheel.
wheel("centre wheel", -2.3, 1.6, 1.5, 80, 6.2, 5, 0.9, 7)
wheel("third wheel", 5.6, -0.4, 0.75, 72, 4.5, 5, 0.7, 20)
wheel("fourth wheel", 3.4, -6.6, 1.75, 64, 3.9, 4, 0.6, 31)
cut("barrel", teeth(96, 7.0, 7.35), [], 0.2, 1.25, 0.06, '"sunray"', POLISHED, "Translate -10.6 0 7.2")
escape = [(r * math.cos(a), r * math.sin(a)) for k in range(15) for r, a in ((1.55, 0.4189 * k - 0.14), (1.62, 0.4189 * k - 0.03), (2.22, 0.4189 * k + 0.10), (2.32, 0.4189 * k + 0.11), (2.32, 0.4189 * k + 0.155), (1.8, 0.4189 * k + 0.13), (1.55, 0.4189 * k + 0.19))]
cut("escape wheel", escape, spaces(4, 0.5, 1.3, 0.26), 0.9, 1.12, 0.035, STEEL, POLISHED, "Translate 9.4 0 -5.2 Rotate 13 0 1 0")
part("arbor of the escape wheel", f"Surface {STEEL}", "Translate 9.4 0 -5.2", turned([(0.2, -0.3), (0.2, 1.8), (0.1, 1.9), (0.1, 2.2), (0, 2.2)]))

# Each bridge has stripes, polished bevels, jewels and screws.
BRIDGES = {"barrel bridge": ([(-19.2, 2.6), (-13.8, -0.2), (-8.2, 2.3), (-4.9, 6.4), (-1.8, 9.4), (-0.9, 14.0), (-3.6, 18.6), (-10.5, 16.8), (-16.2, 11.2)], 2.9),
           "train bridge": ([(0.4, 17.6), (0.6, 11.2), (-0.9, 6.0), (-4.2, 3.4), (-4.5, 1.2), (-3.6, -0.4), (-1.6, -0.7), (0.4, 0.6), (2.0, 2.0), (3.3, 1.3), (3.8, -0.6), (5.4, -1.7), (7.2, -1.3), (8.6, 1.0), (12.6, 2.6), (18.2, 1.6), (18.6, 6.4), (14.2, 13.0), (7.4, 17.8)], 3.0),
           "escape bridge": ([(7.5, -5.7), (9.3, -7.6), (11.2, -7.0), (13.0, -8.6), (15.2, -10.4), (17.4, -9.6), (19.2, -5.2), (18.4, -3.2), (13.8, -3.9), (11.0, -4.2), (9.3, -3.8)], 2.3)}
HOLES = {"barrel bridge": [(-10.6, 7.2, 1.5)], "train bridge": [(-2.3, 1.6, 0.85), (5.6, 0.5, 0.8)], "escape bridge": [(9.4, -5.7, 0.62)]}
for name, (points, top) in BRIDGES.items():
    holes = [backwards(circle(1.66 * r if name != "barrel bridge" else r, 64, x, z)) for x, z, r in HOLES[name]]
    cut(name, curve(points), holes, 1.9 if name != "escape bridge" else 1.5, top, 0.22, '"stripes"', POLISHED)
for name, x, z, y, r in (("jewel of the centre wheel", -2.3, 1.6, 2.98, 0.85), ("jewel of the third wheel", 5.6, 0.5, 2.98, 0.8), ("jewel of the escape wheel", 9.4, -5.7, 2.28, 0.62)):
    jewel(name, x, z, y, r)
cut("ratchet wheel", teeth(48, 4.0, 4.35), [backwards(circle(0.7, 48))], 2.95, 3.45, 0.09, '"sunray"', POLISHED, "Translate -10.6 0 7.2")
screw("screw of the ratchet wheel", -10.6, 7.2, 3.42, 1.25, 24)
for k, (x, z, y, r) in enumerate(((-16.4, 3.6, 2.88, 1.05), (-4.6, 15.6, 2.88, 1.05), (-5.4, 9.2, 2.88, 0.75), (3.0, 14.6, 2.98, 1.05), (15.9, 4.0, 2.98, 1.05), (2.0, 5.6, 2.98, 0.75), (16.6, -6.2, 2.28, 1.0), (9.4, 10.2, 2.98, 0.75))):
    screw(f"screw {k + 1}", x, z, y, r, random.uniform(0, 180))

# These parts stand on the main plate, nearer to the eye.
for name, x, z, r in (("jewel of the fourth wheel", 1.3, -11.9, 0.75), ("jewel of the lever", 6.6, -10.6, 0.62)):
    jewel(name, x, z, -0.38, r)
cut("lever", curve([(4.6, -10.0), (6.2, -11.4), (7.2, -11.2), (9.6, -9.0), (10.4, -8.2), (9.9, -7.6), (8.6, -8.6), (7.0, -9.8), (6.0, -9.6), (5.0, -9.2)]), [], 0.5, 0.85, 0.08, STEEL, POLISHED)

# The balance has a spring, and a cock holds it.
BX, BZ, BY = -5.0, -7.6, 2.5
place = f"Translate {BX} 0 {BZ}"
cut("balance", circle(5.4, 160), spaces(3, 0.75, 4.75, 0.6, 0.5), BY, BY + 0.62, 0.08, '"gilt" "float shine" [1]', POLISHED, place)
part("screws of the balance", 'Surface "gilt" "float shine" [1]', place,
     *(f"TransformBegin Translate 0 {BY + 0.31} 0 Rotate {360 * (k + 0.25) / 18:.4g} 0 1 0 Rotate 90 0 1 0 Cylinder 0.2 5.35 5.75 360 Cylinder 0.3 5.75 6.15 360 Disk 6.15 0.3 360 Disk 5.75 0.3 360 TransformEnd" for k in range(18)))
spiral = [c for k in range(421) for a, r in [(2 * math.pi * (k - 6) / 36, 0.75 + 2.55 * k / 420)] for c in (r * math.cos(a), BY + 1.05, r * math.sin(a))]
part("hairspring", 'Surface "blued" "float bright" [1.3]', place, 'Attribute "dice" "int roundcurve" [1] Basis "catmull-rom" 1 "catmull-rom" 1', f'Curves "cubic" [421] "nonperiodic" "P" [{numbers(spiral)}] "constant float constantwidth" [0.085]')
part("stud of the hairspring", f"Surface {STEEL}", f"Translate {BX - 3.3} 0 {BZ}", turned([(0, BY + 0.75), (0.22, BY + 0.75), (0.22, BY + 1.9)]))
part("staff", f"Surface {STEEL}", place, turned([(0.3, -0.3), (0.3, BY + 0.9), (0.7, BY + 0.9), (0.7, BY + 1.3), (0.25, BY + 1.35), (0.25, BY + 2.0)]))
COCK = curve([(-18.6, -6.0), (-16.6, -4.0), (-13.4, -4.8), (-10.4, -5.7), (-7.4, -5.4), (-5.2, -5.2), (-3.1, -6.0), (-2.6, -7.8), (-3.4, -9.5), (-5.2, -10.1), (-7.0, -9.7), (-8.8, -9.0), (-11.4, -9.3), (-14.2, -11.4), (-16.4, -10.8)][::-1])
cut("balance cock", COCK, [backwards(circle(1.62, 64, BX, BZ))], BY + 1.75, BY + 2.55, 0.22, '"grained"', POLISHED)
jewel("jewel of the balance", BX, BZ, BY + 2.55, 0.95)
screw("screw of the cock", -15.4, -7.6, BY + 2.5, 1.25, 62)
part("pillar of the cock", f"Surface {STEEL}", "Translate -15.4 0 -7.6", turned([(1.9, -0.4), (1.9, BY + 1.8)]))
print("WorldEnd")
