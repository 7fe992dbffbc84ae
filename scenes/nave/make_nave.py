#!/usr/bin/env python3
"""Writes nave.rib: a vaulted hall, where the sun comes through windows into dusty air.

    make_nave.py > nave.rib

Units are metres. x points to the right, y up from the floor and z into the hall.
"""
import math
import pathlib
import sys

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1]))
from parts import head, numbers

BAYS, BAY = 7, 5.0
HALF, SPRING, RISE = 4.0, 7.0, 4.0     # These are half the width of the nave, the height at which its vaults begin, and their rise.
WALL, AISLE = 0.7, 7.6                 # These are the thickness of the walls and the x of the outer walls.
ARCADE, COLUMN = 4.2, 0.42             # These are the height at which the arches between columns begin, and the radius of the columns.
STEPS = 48                             # This is the number of straight pieces of an arch.


def begin(name, *requests):
    print(f'  AttributeBegin\n    Attribute "identifier" "string name" ["{name}"]')
    for request in requests:
        print("    " + request)


def arch(centre, half, spring, low):
    """Returns the outline of an opening with a round head: points (z, y) from the far foot over the head to the near foot."""
    head = [(centre + half * math.cos(math.pi * k / STEPS), spring + half * math.sin(math.pi * k / STEPS)) for k in range(STEPS + 1)]
    return [(centre + half, low), *head, (centre - half, low)] if low < spring else head


def strip(outline, x0, x1):
    """Prints the sides of an opening, which run through the thickness of the wall."""
    points = [c for x in (x0, x1) for z, y in outline for c in (x, y, z)]
    print(f'    PatchMesh "bilinear" {len(outline)} "nonperiodic" 2 "nonperiodic" "P" [{numbers(points)}]')


def wall(outer, hole, x0, x1):
    """Prints both faces of a wall and the sides of its opening."""
    for x in (x0, x1):
        points = [c for z, y in outer + hole for c in (x, y, z)]
        loops = [len(outer), len(hole)] if hole else [len(outer)]
        indices = range(len(outer) + len(hole))
        print(f'    PointsGeneralPolygons [{len(loops)}] [{numbers(loops)}] [{numbers(indices)}] "P" [{numbers(points)}]')
    if hole:
        strip(hole + hole[:1], x0, x1)


def vault(middle):
    """Prints the four fields of a groined vault. It is where two barrel vaults of the same height cross."""
    for turned in (False, True):
        for side in (-1, 1):
            points, normals = [], []
            for row in range(33):
                b = math.sin(math.pi * (row / 32 - 0.5))
                for column in range(5):
                    a = side * (abs(b) + column / 4 * (1 - abs(b)))
                    across, along = (b, a) if turned else (a, b)
                    points += [HALF * across, SPRING + RISE * math.sqrt(max(0, 1 - b * b)), middle + BAY / 2 * along]
                    up = math.sqrt(max(0, 1 - b * b)) / RISE
                    normals += [-b / HALF if turned else 0, -up, 0 if turned else -b / (BAY / 2)]
            print(f'    PatchMesh "bilinear" 5 "nonperiodic" 33 "nonperiodic" "P" [{numbers(points)}] "vertex normal N" [{numbers(normals)}]')


def rib(x, z, degrees, width, thick):
    """Prints a rib, which is half a hoop from one springing of a vault to the other."""
    print(f'    TransformBegin Translate {x:g} {SPRING} {z:g} Rotate {degrees:g} 0 1 0 Scale {width / RISE:g} 1 1 Torus {RISE} {thick} 0 360 180 TransformEnd')


head("nave", "A vaulted hall with shafts of light", 50, "Clipping 0.1 200", "Rotate 7 1 0 0", "Rotate 9 0 1 0", "Translate 1.6 -1.7 -0.6", 'ShadingInterpolation "smooth"', size=(1200, 1600))
print('''WorldBegin
  CoordinateSystem "hall"
  Attribute "light" "string shadows" ["on"]
  LightSource "distantlight" "sun" "from" [0.72 0.56 0.34] "to" [0 0 0] "intensity" [13] "lightcolor" [1 0.80 0.55] "string __category" ["sun"]
  LightSource "occlusionlight" "room" "float samples" [128] "float maxdist" [7] "float maxvariation" [0.02] "lightcolor" [0.21 0.215 0.24]
  Atmosphere "dust"
  # Stones touch each other, and shading at their corners sends rays from there. These rays start at a small distance.
  Attribute "trace" "float offset" [0.02]''')

begin("vaults", 'Surface "stone" "color pale" [0.56 0.52 0.45]')
for bay in range(BAYS):
    vault((bay + 0.5) * BAY)
print(f'    Polygon "P" [-9 11.6 -6  4.8 11.6 -6  4.8 11.6 {BAYS * BAY + 3}  -9 11.6 {BAYS * BAY + 3}]')
print("  AttributeEnd")

begin("ribs", 'Surface "stone" "color pale" [0.50 0.45 0.37] "float courses" [0]')
for bay in range(BAYS + 1):
    rib(0, bay * BAY, 0, HALF, 0.2)
for bay in range(BAYS):
    diagonal = math.degrees(math.atan2(BAY / 2, HALF))
    for turn in (-diagonal, diagonal):
        rib(0, (bay + 0.5) * BAY, turn, math.hypot(HALF, BAY / 2), 0.1)
print("  AttributeEnd")

begin("walls", 'Surface "stone" "color pale" [0.54 0.48 0.40]')
for side in (-1, 1):
    for bay in range(BAYS):
        z0, z1, middle = bay * BAY, (bay + 1) * BAY, (bay + 0.5) * BAY
        opening = arch(middle, BAY / 2 - 0.38, ARCADE, ARCADE)
        wall([(z0, ARCADE), (z0, 11.6), (z1, 11.6), (z1, ARCADE)] + opening, arch(middle, 0.75, 9.0, 7.7), side * HALF, side * (HALF + WALL))
        strip(opening, side * HALF, side * (HALF + WALL))
        wall([(z0, 0), (z0, 11.6 if side < 0 else 6.9), (z1, 11.6 if side < 0 else 6.9), (z1, 0)], arch(middle, 0.7, 4.4, 1.7), side * AISLE, side * (AISLE + WALL))
    print(f'    Polygon "P" [{side * HALF} 6.9 -6  {side * 9} 6.9 -6  {side * 9} 6.9 {BAYS * BAY}  {side * HALF} 6.9 {BAYS * BAY}]')
    print(f'    Polygon "P" [{side * HALF} 0 -6  {side * HALF} 11.6 -6  {side * HALF} 11.6 0  {side * HALF} 0 0]')
end = BAYS * BAY
wall_points = [(-9, 0), (-9, 11.6), (9, 11.6), (9, 0)]
window = arch(0, 1.25, 7.2, 3.2)
for z in (end, end + 0.6):
    points = [c for x, y in wall_points + window for c in (x, y, z)]
    print(f'    PointsGeneralPolygons [2] [4 {len(window)}] [{numbers(range(4 + len(window)))}] "P" [{numbers(points)}]')
print('    Polygon "P" [-9 0 -6  -9 11.6 -6  9 11.6 -6  9 0 -6]')
print("  AttributeEnd")

begin("panes", 'Attribute "visibility" "int transmission" [0] "int diffuse" [0]', 'Surface "pane"')
print(f'    Polygon "P" [-1.5 3 {end + 0.3}  -1.5 9 {end + 0.3}  1.5 9 {end + 0.3}  1.5 3 {end + 0.3}]')
for side in (-1, 1):
    for x, low, high in ((HALF + 0.5 * WALL, 7.6, 10), (AISLE + 0.5 * WALL, 1.6, 5.2)):
        print(f'    Polygon "P" [{side * x:g} {low} 0  {side * x:g} {high} 0  {side * x:g} {high} {end}  {side * x:g} {low} {end}]')
print("  AttributeEnd")

begin("columns", 'Surface "stone" "color pale" [0.50 0.46 0.40] "float courses" [0]')
print('''    ObjectBegin "column"
      TransformBegin Rotate -90 1 0 0
        Hyperboloid 0.42 0 0.55 0.38 0 3.45 360
        TransformBegin Translate 0 0 0.5 Torus 0.44 0.09 0 360 360 TransformEnd
        TransformBegin Translate 0 0 0.3 Torus 0.50 0.13 0 360 360 TransformEnd
        TransformBegin Translate 0 0 3.45 Torus 0.38 0.06 0 360 360 TransformEnd
        Hyperboloid 0.38 0 3.45 0.6 0 3.95 360
      TransformEnd
      PointsPolygons [4 4 4 4 4] [0 1 5 4  1 2 6 5  2 3 7 6  3 0 4 7  0 3 2 1] "P" [-0.66 3.95 -0.66  0.66 3.95 -0.66  0.66 3.95 0.66  -0.66 3.95 0.66  -0.66 4.22 -0.66  0.66 4.22 -0.66  0.66 4.22 0.66  -0.66 4.22 0.66]
      PointsPolygons [4 4 4 4 4] [0 1 5 4  1 2 6 5  2 3 7 6  3 0 4 7  4 5 6 7] "P" [-0.7 0 -0.7  0.7 0 -0.7  0.7 0 0.7  -0.7 0 0.7  -0.66 0.2 -0.66  0.66 0.2 -0.66  0.66 0.2 0.66  -0.66 0.2 0.66]
    ObjectEnd
    ObjectBegin "shaft"
      TransformBegin Rotate -90 1 0 0
        Cylinder 0.16 4.2 6.75 360
        Hyperboloid 0.16 0 6.75 0.3 0 7.05 360
        TransformBegin Translate 0 0 6.75 Torus 0.17 0.04 0 360 360 TransformEnd
      TransformEnd
    ObjectEnd''')
for side in (-1, 1):
    for k in range(BAYS + 1):
        print(f'    TransformBegin Translate {side * (HALF + WALL / 2):g} 0 {k * BAY:g} ObjectInstance "column" TransformEnd')
        print(f'    TransformBegin Translate {side * HALF:g} 0 {k * BAY:g} ObjectInstance "shaft" TransformEnd')
print("  AttributeEnd")

begin("floor", 'Surface "tiles"')
print(f'    Polygon "P" [-9 0 -6  9 0 -6  9 0 {end + 1}  -9 0 {end + 1}]')
print("  AttributeEnd\nWorldEnd")
