#!/usr/bin/env python3
"""Writes teapots.rib: twelve teapots on three steps. Each is painted by a different pattern from shaders/include.

    make_teapots.py > teapots.rib

The unit is the one of Geometry "teapot", which is 3.15 high. x points to the right, y up and z away from the eye.
"""
import pathlib
import sys

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1]))
from parts import head

ACROSS, RISE, TREAD = 6.8, 3.1, 5.2  # These are the distance between pots, and the height and depth of a step.
STEPS = (("marble", "harlequin", "crackle", "terrazzo"), ("copper", "breton", "walnut", "bricks"), ("gingham", "malachite", "stoneware", "dots"))
WIDE = 60


def box(y0, y1, z0, z1):
    """Returns the riser and the tread of one step, with a rounded edge between them."""
    edge = 0.12
    rows = [(y0, z0), (y1 - edge, z0), (y1 - 0.3 * edge, z0 + 0.3 * edge), (y1, z0 + edge), (y1, z1)]
    points = " ".join(f"{x:g} {y:g} {z:g}" for y, z in rows for x in (-WIDE, WIDE))
    return f'PatchMesh "bilinear" 2 "nonperiodic" {len(rows)} "nonperiodic" "P" [{points}]'


head("teapots", "Twelve teapots in soft light", 18.5, "DepthOfField 16 2 46", "Clipping 1 500", "Rotate -13.7 1 0 0", "Translate 0 -16 44")
print('''WorldBegin
  Attribute "light" "string shadows" ["on"]
  LightSource "occlusionlight" "room" "float samples" [128] "float maxdist" [18] "float maxvariation" [0.02] "lightcolor" [0.24 0.245 0.265]
  AttributeBegin
    AreaLightSource "arealight" "softbox" "float intensity" [7] "lightcolor" [1.0 0.93 0.84] "float samples" [48]
    Polygon "P" [-34 12 -26  -34 40 -26  -26 40 2  -26 12 2]
  AttributeEnd
  AttributeBegin
    AreaLightSource "arealight" "rim" "float intensity" [2.4] "lightcolor" [0.72 0.84 1.0] "float samples" [24]
    Polygon "P" [36 8 -16  36 8 6  36 30 6  36 30 -16]
  AttributeEnd
  Illuminate "softbox" 1
  Illuminate "rim" 1
  AttributeBegin
    Attribute "identifier" "string name" ["steps"]
    Surface "plaster"''')
for k in range(len(STEPS)):
    print("    " + box((k - 1) * RISE if k else -12, k * RISE, k * TREAD - 2.7, (k + 1) * TREAD - 2.7 if k < 2 else 20))
print('''  AttributeEnd
  AttributeBegin
    Attribute "identifier" "string name" ["wall"]
    Surface "plaster" "color pale" [0.30 0.335 0.34]
    Polygon "P" [-90 -20 20  -90 90 20  90 90 20  90 -20 20]
  AttributeEnd''')
for k, step in enumerate(STEPS):
    for n, shader in enumerate(step):
        x = (n - 1.5) * ACROSS + (0.8 if k == 1 else 0)
        print(f'  AttributeBegin\n    Attribute "identifier" "string name" ["{shader}"]\n    Surface "{shader}"')
        if shader == "copper":
            print('    Attribute "displacementbound" "float sphere" [0.08]\n    Displacement "dimples"')
        print(f'    Translate {x:g} {k * RISE:g} {k * TREAD:g}\n    Rotate {(-24, -36, -18, -30)[(n + k) % 4]} 0 1 0\n    Rotate -90 1 0 0\n    Geometry "teapot"\n  AttributeEnd')
print("WorldEnd")
