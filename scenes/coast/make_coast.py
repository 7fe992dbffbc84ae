#!/usr/bin/env python3
"""Writes coast.rib: a headland at evening. All land is a flat sheet that shaders raise, and the grass is curves.

    make_coast.py > coast.rib
"""
import math
import pathlib
import random
import sys

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1]))
from parts import head, numbers

random.seed(37)
TUFTS, BLADES, PLACES = 6, 46, 2300


def knoll(x, z):
    """Returns the height in metres of the ground in front of the eye. The grass stands on it."""
    return 42.0 + 0.13 * x - 0.0032 * z * z + 0.10 * math.sin(0.9 * x + 0.5) * math.sin(0.7 * z) - 0.002 * x * x


def tuft(name):
    """Prints blades that start close together, lean outwards, and bend with the wind from the sea."""
    points, widths = [], []
    for _ in range(BLADES):
        angle, away = random.uniform(0, 2 * math.pi), 0.16 * math.sqrt(random.random())
        height, lean = random.uniform(0.28, 0.75), random.uniform(0.05, 0.35)
        x, z = away * math.cos(angle), away * math.sin(angle)
        dx, dz = lean * math.cos(angle) * 0.7 + 0.22, lean * math.sin(angle) * 0.7 - 0.05
        for k in range(4):
            s = k / 3
            points += [x + height * dx * s ** 2 * 1.3, height * (s - 0.18 * s ** 3), z + height * dz * s ** 2 * 1.3]
        widths += [0.008, 0.002]
    print(f'ObjectBegin "{name}"')
    print(f'  Curves "cubic" [{numbers([4] * BLADES, ".3g")}] "nonperiodic" "P" [{numbers(points, ".3g")}] "varying float width" [{numbers(widths, ".3g")}]')
    print("ObjectEnd")


def sheet(near, far, columns):
    """Prints a flat sheet that widens away from the eye. The shader "headland" raises it."""
    angles = [math.radians(-31 + 62 * k / columns) for k in range(columns + 1)]
    points = [c for r in (near, far) for a in angles for c in (r * math.tan(a), 0, r)]
    print(f'    PatchMesh "bilinear" {columns + 1} "nonperiodic" 2 "nonperiodic" "P" [{numbers(points, ".3g")}]')


head("coast", "A headland by the sea in the evening", 31, "Clipping 0.3 40000", "Rotate 2.4 1 0 0", "Translate 0 -44 0", 'ShadingInterpolation "smooth"', imager="grade")
print('''WorldBegin
  CoordinateSystem "coast"
  AttributeBegin
    Attribute "identifier" "string name" ["sky"]
    Attribute "visibility" "int diffuse" [0] "int specular" [0] "int transmission" [0]
    Surface "eveningsky"
    Translate 0 44 0
    Rotate -90 1 0 0
    Sphere 30000 -3000 30000 360
  AttributeEnd
  Attribute "light" "string shadows" ["on"]
  LightSource "distantlight" "sun" "from" [-0.9 0.25 -0.12] "to" [0 0 0] "intensity" [2.6] "lightcolor" [1 0.66 0.36]
  Atmosphere "seahaze"

  AttributeBegin
    Attribute "identifier" "string name" ["sea"]
    Attribute "visibility" "int transmission" [0]
    Surface "sea"
    Patch "bilinear" "P" [-60 0 60  60 0 60  -16000 0 24000  16000 0 24000]
  AttributeEnd

  AttributeBegin
    Attribute "identifier" "string name" ["land"]
    Attribute "dice" "int rasterorient" [0]
    Attribute "trace" "int displacements" [1]
    Attribute "displacementbound" "float sphere" [170] "string coordinatesystem" ["coast"]
    Displacement "headland"
    Surface "land"
    ShadingRate 1''')
sheet(90, 180, 8)
print("    ShadingRate 0.35")  # Cliffs stretch the sheet to several times its size, so that it needs smaller pieces there.
for near, far in ((180, 300), (300, 450), (450, 600), (600, 900)):
    sheet(near, far, 8)
print("    ShadingRate 1")
for near, far in ((900, 1500), (1500, 2600), (2600, 4500), (4500, 9000)):
    sheet(near, far, 8)
print('''  AttributeEnd

  # Grass stands in front of the eye. Its tufts are instances, and there is ground between them.''')
for k in range(TUFTS):
    tuft(f"tuft{k}")
print('''  AttributeBegin
    Attribute "identifier" "string name" ["knoll"]
    Surface "grass" "color root" [0.30 0.21 0.08] "color tip" [0.30 0.21 0.08]''')
cells = [(-14 + k * 1.0, 0.5 + n * 1.0) for n in range(34) for k in range(33)]
points = [c for x, z in cells for c in (x, knoll(x, z), z)]
print(f'    PatchMesh "bilinear" 33 "nonperiodic" 34 "nonperiodic" "P" [{" ".join(f"{c:.5g}" for c in points)}]')
print('''  AttributeEnd
  AttributeBegin
    Attribute "identifier" "string name" ["grass"]
    Surface "grass"''')
places = []
for _ in range(PLACES):
    z = 2.2 + 30 * random.random() ** 1.6
    places.append((z * random.uniform(-0.62, 0.62), z))
for x, z in sorted(places, key=lambda place: -place[1]):
    size = random.uniform(0.6, 1.25) * (0.8 + 0.35 * math.sin(0.8 * x + 2) * math.cos(0.5 * z))
    print(f'    TransformBegin Translate {x:.2f} {knoll(x, z) - 0.02:.3f} {z:.2f} Rotate {random.uniform(-35, 35):.0f} 0 1 0 '
          f'Scale {size:.2f} {size * random.uniform(0.8, 1.2):.2f} {size:.2f} ObjectInstance "tuft{random.randrange(TUFTS)}" TransformEnd')
print('''  AttributeEnd

  # Poppies grow among the grass.
  ObjectBegin "poppy"
    TransformBegin Rotate -90 1 0 0 Paraboloid 0.045 0 0.06 360 TransformEnd
  ObjectEnd
  AttributeBegin
    Attribute "identifier" "string name" ["poppies"]
    Surface "poppy"''')
for _ in range(70):
    z = 3.5 + 9 * random.random()
    x = z * random.uniform(-0.1, 0.55) * (0.75 + 0.25 * math.sin(1.7 * z))
    print(f'    TransformBegin Translate {x:.2f} {knoll(x, z) + random.uniform(0.30, 0.48):.3f} {z:.2f} Rotate {random.uniform(-30, 30):.0f} 1 0 1 '
          f'ObjectInstance "poppy" TransformEnd')
print('''  AttributeEnd

  # A fence leads to the sea, and gulls fly over the bay.
  AttributeBegin
    Attribute "identifier" "string name" ["fence"]
    Surface "weathered"''')
posts = [(9.5 - 1.9 * k + 0.05 * k * k, 13.5 + 1.5 * k) for k in range(7)]
tops = []
for x, z in posts:
    tall, lean = random.uniform(1.15, 1.3), random.uniform(-5, 5)
    tops.append((x - tall * math.sin(math.radians(lean)), knoll(x, z) + tall, z))
    print(f'    TransformBegin Translate {x:.2f} {knoll(x, z) - 0.2:.3f} {z:.2f} Rotate {lean:.1f} 0 0 1 Rotate -90 1 0 0 '
          f'Cylinder 0.055 0 {tall + 0.2:.2f} 360 Disk {tall + 0.2:.2f} 0.055 360 TransformEnd')
for low in (0.12, 0.5, 0.85):
    wire = []
    for (x0, y0, z0), (x1, y1, z1) in zip(tops, tops[1:]):
        for k in range(6):
            s = k / 6
            wire += [x0 + s * (x1 - x0), y0 + s * (y1 - y0) - low - 0.16 * s * (1 - s), z0 + s * (z1 - z0)]
    print(f'    Curves "linear" [{len(wire) // 3}] "nonperiodic" "P" [{" ".join(f"{c:.4g}" for c in wire)}] "constantwidth" [0.012]')
print('''  AttributeEnd
  AttributeBegin
    Attribute "identifier" "string name" ["gulls"]
    Surface "matte"
    Color 1.6 1.6 1.6''')
for x, y, z, wing, bank in ((-62, 50, 230, 0.75, 12), (-55, 53, 240, 0.7, -8), (-49, 51.5, 250, 0.75, 20), (-70, 56, 262, 0.7, 5), (-30, 47, 205, 0.75, -15)):
    print(f'    TransformBegin Translate {x} {y} {z} Rotate {bank} 0 0 1 Curves "cubic" [7] "nonperiodic" "P" '
          f'[{-wing} 0.08 0  {-0.7 * wing:.3g} 0.28 0  {-0.3 * wing:.3g} 0.3 0  0 0 0  {0.3 * wing:.3g} 0.3 0  {0.7 * wing:.3g} 0.28 0  {wing} 0.08 0] '
          f'"varying float width" [0.05 0.24 0.05] TransformEnd')
print('''  AttributeEnd
WorldEnd''')
