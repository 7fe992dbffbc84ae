#!/usr/bin/env python3
"""Writes still_life.rib: a jug, a bowl of lemons, a bottle, a glass and a candle on an oak table beside a window.

    make_still_life.py > still_life.rib

Units are decimetres. x points to the right, y up from the table and z away from the eye.
"""
import math
import pathlib
import sys

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1]))
from parts import head, lathe, numbers

# These are the x and z of the things on the table.
STANDS = {"jug": (-2.2, 1.5), "bowl": (0.35, 0.4), "glass": (2.55, -0.6), "bottle": (1.75, 2.4), "candle": (4.05, 1.5)}


def place(name, x, z, *requests, y=0.0):
    """Prints an object with a name on the table. The requests are its shaders and geometry."""
    print(f'  AttributeBegin\n    Attribute "identifier" "string name" ["{name}"]\n    Translate {x} {y} {z}')
    for request in requests:
        print("    " + request)
    print("  AttributeEnd")


def smooth(low, high, x):
    s = min(1, max(0, (x - low) / (high - low)))
    return s * s * (3 - 2 * s)


def wave(x):
    """Returns the phase of the folds of the cloth. It is not linear, so the folds differ in width."""
    return 6.0 * x + 0.7 * math.sin(2.3 * x)


def ridge(distance, width):
    return math.exp(-(distance / width) ** 2)


def cloth(left, right, back, edge, drop):
    """Linen that lies on the table from z = back to its edge, and hangs down in folds from there."""
    columns, lying, hanging = 90, 44, 34
    points = []
    for row in range(lying + hanging + 1):
        for column in range(columns + 1):
            s = column / columns
            x = left + s * (right - left) + 0.25 * math.sin(0.06 * row + 1) * (1 - s)
            if row <= lying:
                r = row / lying
                z = back + 0.22 * math.sin(5 * s + 1) * (1 - r) + r * (edge + 0.04 - back)
                near = smooth(0.55, 1.0, r)
                creases = (ridge(x - 0.55 * (z - edge) - 1.15, 0.2) * smooth(0.15, 0.6, r) +
                           0.7 * ridge(x + 0.4 * (z - edge) - 2.2, 0.24) * smooth(0.4, 0.8, r))
                hem = ridge(r - 0.01, 0.02)
                flat = min(smooth(0.85, 1.3, math.dist((x, z), STANDS[name])) for name in ("glass", "bowl"))
                y = 0.035 + 0.13 * flat * creases + near * 0.025 * (1 + math.sin(wave(x))) + 0.02 * hem
                points += [x, y, z]
            else:
                h = (row - lying) / hanging
                fold = math.sin(wave(x) + 0.5 * h) + 0.35 * math.sin(11 * x + 2 + h)
                y = 0.035 - drop * h * (1 + 0.05 * math.sin(4.1 * s + 0.6)) + 0.05 * (1 - h) ** 6 * (1 + fold)
                z = edge - 0.05 - 0.20 * smooth(0, 0.5, h) - (0.09 + 0.13 * h) * smooth(0, 0.2, h) * (1 + fold)
                points += [x + 0.10 * h * math.cos(wave(x)), y, z]
    return (f'Basis "b-spline" 1 "b-spline" 1 PatchMesh "bicubic" {columns + 1} "nonperiodic" {lying + hanging + 1} "nonperiodic" '
            f'"P" [{numbers(points)}]')


JUG = [(0, 0), (0.75, 0), (0.80, 0), (0.82, 0.08), (0.95, 0.35), (1.45, 1.0), (1.62, 1.7), (1.45, 2.4), (0.95, 2.95), (0.62, 3.4), (0.55, 3.8),
       (0.62, 4.2), (0.80, 4.45), (0.80, 4.5), (0.74, 4.5), (0.56, 4.2), (0.48, 3.8), (0.55, 3.4), (0.6, 3.0), (0, 2.9)]
BOWL = [(0, 0), (0.55, 0), (0.6, 0), (0.6, 0.12), (0.55, 0.2), (0.9, 0.28), (1.5, 0.6), (1.85, 1.1), (1.92, 1.24), (1.88, 1.27), (1.78, 1.1), (1.42, 0.66),
        (0.85, 0.36), (0, 0.32)]
# The inner side of the glass ends where the wine begins. The side of the wine lies between wine and glass, its top between wine and air.
GLASS = [(0, 0.02), (0.6, 0.02), (0.78, 0.0), (0.80, 0.03), (0.6, 0.07), (0.16, 0.16), (0.085, 0.35), (0.075, 0.8), (0.1, 1.15), (0.45, 1.38), (0.74, 1.85),
         (0.76, 2.4), (0.66, 2.95), (0.655, 2.99), (0.642, 2.98), (0.712, 2.6), (0.733, 2.35), (0.735, 2.2)]
WINE_SIDE = [(0, 1.43), (0.2, 1.45), (0.46, 1.53), (0.70, 1.87), (0.73, 2.05), (0.735, 2.2)]
WINE_TOP = [(0.735, 2.2), (0.4, 2.2), (0, 2.2)]
STICK = [(0, 0), (1.0, 0), (1.05, 0), (1.05, 0.06), (0.9, 0.12), (0.35, 0.2), (0.2, 0.3), (0.2, 0.45), (0.32, 0.55), (0.32, 0.62), (0.18, 0.75), (0.16, 1.1),
         (0.28, 1.3), (0.42, 1.4), (0.44, 1.45), (0.36, 1.5), (0, 1.5)]
CANDLE = [(0, 1.45), (0.24, 1.45), (0.25, 1.45), (0.235, 2.2), (0.23, 3.1), (0.235, 3.2), (0.21, 3.25), (0.15, 3.2), (0, 3.17)]
BOTTLE = [(0, 0.12), (0.45, 0.1), (0.72, 0), (0.80, 0.03), (0.83, 0.15), (0.83, 1.0), (0.83, 2.0), (0.82, 2.5), (0.66, 2.95), (0.36, 3.35), (0.29, 3.7), (0.27, 4.3),
          (0.27, 4.55), (0.33, 4.58), (0.33, 4.75), (0.27, 4.8), (0.21, 4.78), (0.20, 4.5), (0, 4.48)]
FLAME = [(0, 0), (0.05, 0.02), (0.075, 0.14), (0.06, 0.28), (0.025, 0.44), (0, 0.56)]
HALF = [(0, -0.64), (0.06, -0.62), (0.11, -0.54), (0.26, -0.44), (0.42, -0.22), (0.448, -0.02), (0.448, 0)]
LEMON = [(0, -0.64), (0.06, -0.62), (0.11, -0.54), (0.26, -0.44), (0.42, -0.22), (0.45, 0.0), (0.42, 0.22), (0.26, 0.46), (0.12, 0.56), (0.10, 0.66), (0.05, 0.71), (0, 0.72)]

head("still_life", "A still life beside a window, with a candle", 26.5, "DepthOfField 7 1.0 14.6", "Clipping 1 100", "Rotate -9 1 0 0", "Translate 0 -3.75 15.2", size=(1620, 1080))
print('''WorldBegin
  CoordinateSystem "room"
  Attribute "irradiance" "float maxerror" [1]  # the shaders' occlusion() is interpolated between records
  Attribute "light" "string shadows" ["on"]
  AttributeBegin
    AreaLightSource "arealight" "window" "float intensity" [11] "lightcolor" [0.80 0.90 1.0] "float samples" [32]
    Polygon "P" [-11 1 -9.5  -11 9 -9.5  -11 9 2  -11 1 2]
  AttributeEnd
  AttributeBegin
    Attribute "visibility" "int camera" [0] "int diffuse" [0] "int specular" [0] "int transmission" [0]
    AreaLightSource "arealight" "flame" "float intensity" [1300] "lightcolor" [1.0 0.56 0.22] "float samples" [32] "float visible" [0]
    Translate 4.05 3.55 1.5
    Sphere 0.12 -0.12 0.12 360
  AttributeEnd

  Illuminate "window" 1
  Illuminate "flame" 1

  # The room has a plastered wall behind the table, and dark walls that are not visible.
  AttributeBegin
    Attribute "identifier" "string name" ["wall"]
    Surface "plaster"
    Polygon "P" [-14 -8 6.5  -14 16 6.5  14 16 6.5  14 -8 6.5]
  AttributeEnd
  AttributeBegin
    Attribute "identifier" "string name" ["room"]
    Surface "matte"
    Color 0.24 0.20 0.16
    Polygon "P" [13 -8 -16  13 -8 9  13 16 9  13 16 -16]
    Polygon "P" [-14 -8 -16  -14 -8 9  13 -8 9  13 -8 -16]
    Polygon "P" [-14 16 -16  13 16 -16  13 16 9  -14 16 9]
  AttributeEnd
  AttributeBegin
    Attribute "identifier" "string name" ["table"]
    Surface "oak"
    PointsPolygons [4 4 4] [0 1 2 3  4 5 1 0  3 2 6 7] "P" [-9 0 -3.2  9 0 -3.2  9 0 4.6  -9 0 4.6   -9 -0.45 -3.2  9 -0.45 -3.2   9 -0.45 4.6  -9 -0.45 4.6]
  AttributeEnd''')

print("""  AttributeBegin
    Attribute "identifier" "string name" ["window frame"]
    Surface "matte"
    Color 0.05 0.045 0.04""")
for y0, y1, z0, z1 in ((4.8, 5.2, -10, 2.5), (0.5, 9.5, -6.0, -5.6), (0.5, 9.5, -2.1, -1.7)):
    print(f"    Polygon \"P\" [-10.8 {y0} {z0}  -10.8 {y1} {z0}  -10.8 {y1} {z1}  -10.8 {y0} {z1}]")
print("  AttributeEnd")
place("jug", *STANDS["jug"], 'Color 0.10 0.30 0.34', 'Surface "glaze" "float top" [4.5]', lathe(JUG),
      'Rotate -35 0 1 0', 'Attribute "dice" "int roundcurve" [1] Basis "bezier" 3 "bezier" 3',
      'Curves "cubic" [7] "nonperiodic" "P" [0.52 4.05 0  1.3 4.5 0  2.0 4.0 0  1.9 3.2 0  1.85 2.7 0  1.6 2.4 0  1.3 2.4 0] "varying float width" [0.26 0.3 0.3]')
place("bowl", *STANDS["bowl"], 'Color 0.62 0.50 0.36', 'Surface "glaze" "float top" [1.27] "color drip" [0.75 0.70 0.60] "float dripheight" [0.55]', lathe(BOWL))
print('  ObjectBegin "lemon"\n    ' + lathe(LEMON) + "\n  ObjectEnd")
for k, (x, y, z, turns) in enumerate(((-0.25, 0.93, 0.35, "Rotate 78 0.2 0 1"), (0.85, 0.93, 0.15, "Rotate -62 0.5 0 1 "), (0.45, 0.98, 1.05, "Rotate 80 1 0 0.3"),
                                      (0.3, 1.5, 0.5, "Rotate 70 -0.4 0 1"), (-1.15, 0.44, -1.5, "Rotate 40 0 1 0 Rotate 86 0 0 1"))):
    place(f"lemon {k + 1}", x, z, turns, 'Attribute "displacementbound" "float sphere" [0.02]', 'Displacement "peel"', 'Surface "lemon"', 'ObjectInstance "lemon"', y=y)
place("cloth", 0, 0, 'Sides 2 Surface "linen"', cloth(0.35, 3.9, 0.7, -3.2, 2.0))
# Half a lemon lies on the cloth. Its cut side faces the eye and the window.
place("half lemon", 1.25, -1.75, 'Rotate 24 0 1 0 Rotate -62 1 0 0', 'Surface "lemon"', lathe(HALF), 'Rotate -90 1 0 0 Surface "pulp"', 'Disk 0.001 0.447 360', y=0.42)
CLEAR = 'Attribute "trace" "int maxspeculardepth" [8] ShadingRate 0.5 ShadingInterpolation "smooth" Attribute "visibility" "int diffuse" [0]'
RED = '"color tint" [0.42 0.03 0.035]'
place("glass", *STANDS["glass"], CLEAR, 'Surface "crystal"', lathe(GLASS))
place("wine in glass", *STANDS["glass"], CLEAR, f'Surface "crystal" "float eta" [0.875] {RED}', lathe(WINE_SIDE))
place("wine", *STANDS["glass"], CLEAR, f'Surface "crystal" "float eta" [1.33] {RED}', lathe(WINE_TOP))
place("bottle", *STANDS["bottle"], CLEAR, 'Surface "crystal" "color tint" [0.30 0.42 0.16]', lathe(BOTTLE))
place("candlestick", *STANDS["candle"], 'Color 0.83 0.60 0.28', 'Surface "brass"', lathe(STICK))
place("candle", *STANDS["candle"], 'Illuminate "flame" 0 Surface "wax"', lathe(CANDLE))
place("glow", *STANDS["candle"], 'Attribute "visibility" "int diffuse" [0] "int specular" [0] "int transmission" [0]', 'Surface "glow"', 'Rotate 180 0 1 0 Disk 0.3 2.2 360', y=3.5)
place("flame", *STANDS["candle"], 'Attribute "visibility" "int diffuse" [0] "int transmission" [0]', 'Surface "flame"', lathe(FLAME), y=3.27)
print("WorldEnd")
