"""Writes film.rib: a frame in the resolution of a film.

A creature like a toad sits on a floor under a sky. Its body is one Catmull-Clark mesh with vertex colours and displaced warts. Nothing is
random, so the file is the same every time."""
import math
import sys

COLUMNS, ROWS = 64, 40


def bump(x, y, cx, cy, width):
    """Returns a bump that is 1 at (cx, cy) and falls smoothly to 0 at the distance `width`. x wraps around at 1."""
    dx = (x - cx + 0.5) % 1 - 0.5
    d = math.hypot(dx, (y - cy) * 0.5) / width
    return (1 - d * d) ** 2 if d < 1 else 0.0


def body(i, j):
    """Returns position and colour of a vertex. Columns i run around the body from the nose, and rows j run from bottom to top."""
    x, y = i / COLUMNS, (j + 0.5) / ROWS
    phi, theta = 2 * math.pi * x, math.pi * (y - 0.5)
    radius = 1.0
    radius += 0.28 * bump(x, y, 0.0, 0.55, 0.20)                                  # snout
    radius += sum(0.42 * bump(x, y, c, 0.78, 0.075) for c in (0.11, 0.89))        # eye sockets
    radius += sum(0.65 * bump(x, y, c, 0.22, 0.085) for c in (0.12, 0.88))        # front legs
    radius += sum(0.95 * bump(x, y, c, 0.24, 0.12) for c in (0.36, 0.64))         # haunches
    radius -= sum(0.10 * bump(x, y, c, 0.47, 0.05) for c in (0.05, 0.95, 0.0))    # mouth
    radius += 0.10 * bump(x, y, 0.5, 0.85, 0.25)                                  # hump
    p = (radius * math.cos(theta) * math.sin(phi), 0.8 * radius * math.sin(theta), -1.15 * radius * math.cos(theta) * math.cos(phi))
    belly = max(0.0, min(1.0, (0.42 - y) * 6 + 0.6 * bump(x, y, 0.0, 0.3, 0.3)))
    spots = max(0.0, math.sin(23 * x * math.pi * 2 / 4 + 3 * math.sin(9 * y)) * math.sin(31 * y + 2 * math.cos(14 * math.pi * x))) ** 2
    green, pale, brown = (0.22, 0.34, 0.10), (0.72, 0.66, 0.44), (0.20, 0.12, 0.05)
    skin = [g * (1 - spots) + b * spots for g, b in zip(green, brown)]
    return p, [s * (1 - belly) + w * belly for s, w in zip(skin, pale)]


def mesh():
    points, colors = [], []
    for j in range(ROWS):
        for i in range(COLUMNS):
            p, c = body(i, j)
            points.append(p), colors.append(c)
    faces = [[j * COLUMNS + i, j * COLUMNS + (i + 1) % COLUMNS, (j + 1) * COLUMNS + (i + 1) % COLUMNS, (j + 1) * COLUMNS + i]
             for j in range(ROWS - 1) for i in range(COLUMNS)]
    for row, order in ((0, -1), (ROWS - 1, 1)):  # A fan of triangles closes each pole.
        ring = [row * COLUMNS + i for i in range(COLUMNS)]
        centre = [sum(points[v][k] for v in ring) / COLUMNS for k in range(3)]
        points.append(tuple(centre)), colors.append(colors[ring[0]])
        for i in range(COLUMNS):
            faces.append([ring[i], ring[(i + 1) % COLUMNS], len(points) - 1][::order])
    return points, colors, faces


def numbers(values):
    return " ".join(f"{v:.5g}" for v in values)


# Gather rays that miss everything else meet this environment. Its light counts as indirect light, so direct light needs
# no rays for it.
SKY = """AttributeBegin
Attribute "identifier" "name" ["sky"]
Attribute "visibility" "int camera" [0] "int diffuse" [1] "int specular" [0] "int transmission" [0]
Attribute "radiosity" "float screentexels" [64]
Surface "constant"
Color [0.22 0.27 0.36]
Sphere 60 -60 60 360
AttributeEnd"""


def rib():
    points, colors, faces = mesh()
    flat = lambda rows: [v for row in rows for v in row]
    eyes = "".join(f"""AttributeBegin
Attribute "identifier" "name" ["eyes"]
Surface "plastic" "Ks" [0.9] "roughness" [0.03]
Color [{c}]
Translate {s * x} {y} {z}
Sphere {r} -{r} {r} 360
AttributeEnd
""" for s in (-1, 1) for c, x, y, z, r in (("0.55 0.35 0.04", 0.46, 0.86, -0.62, 0.19), ("0.01 0.01 0.01", 0.50, 0.88, -0.72, 0.115)))
    return f"""##RenderMan RIB
# Written by make_film.py. README.md says what to look at.
Display "film.exr" "openexr" "rgba" "string exrpixeltype" ["half"]
Display "film.png" "png" "rgb" "string transfer" ["sRGB"]
Format 1828 1102 1
PixelSamples 4 4
PixelFilter "gaussian" 2 2
ShadingRate 0.152
Projection "perspective" "fov" [32]
Translate 0 -0.05 5.2
Rotate -14 1 0 0
Rotate 24 0 1 0
WorldBegin
LightSource "spotlight" "key" "from" [-4 5 -5] "to" [0 0 0] "intensity" [55] "coneangle" [0.7] "string shadowname" ["raytrace"] "lightcolor" [1 0.93 0.8]
LightSource "distantlight" "rim" "from" [3 2.5 4] "to" [0 0 0] "intensity" [0.5] "lightcolor" [0.6 0.75 1]
LightSource "indirectlight" "gi" "float samples" [600]
Illuminate "gi" 0
LightSource "filterlight" "art" "string source" ["gi"]
{SKY}
AttributeBegin
Attribute "identifier" "name" ["floor"]
Surface "matte"
Color [0.42 0.36 0.30]
Displacement "noisybump" "float Km" [0.04] "float frequency" [2.5] "float octaves" [5]
Attribute "displacementbound" "sphere" [0.05]
Attribute "trace" "int displacements" [0]
Patch "bilinear" "P" [-9 -0.92 -5  9 -0.92 -5  -9 -0.92 14  9 -0.92 14]
AttributeEnd
{eyes}AttributeBegin
Attribute "identifier" "name" ["toad"]
Attribute "trace" "int displacements" [1] "float tessellation" [0.25]
Attribute "irradiance" "float maxerror" [1.3]
Surface "plastic" "Kd" [0.8] "Ks" [0.25] "roughness" [0.12]
Displacement "noisybump" "float Km" [0.075] "float frequency" [5] "float octaves" [6]
Attribute "displacementbound" "sphere" [0.08]
SubdivisionMesh "catmull-clark" [{numbers(len(f) for f in faces)}] [{numbers(flat(faces))}] ["interpolateboundary"] [0 0] [] []
  "P" [{numbers(flat(points))}] "vertex color Cs" [{numbers(flat(colors))}]
AttributeEnd
WorldEnd
"""


sys.stdout.write(rib())
