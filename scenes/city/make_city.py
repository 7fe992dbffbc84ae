"""Writes city.rib and the files that it reads: a street whose only light is the sun.

Its houses, cars and trees are NURBS and subdivision surfaces with displacement and textures. Every house, car and tree has a photon map
of its own, and so have the ground and the pavements, as in "An Irradiance Atlas for Global Illumination in Complex Production Scenes"
(2004), section 5. Every run writes the same files.
"""
import argparse
import math
import pathlib
import random
import struct
import zlib

HOUSES, CARS, TREES = 20, 12, 12
TEXTURE_SIZE = 64
# At this shading rate, all primitives dice to 212 million triangles. Rays meet as many polygons as at rate 1 and half the tessellation.
SHADING_RATE = 0.04
# These are the width of the street, the width of each pavement, and the length of both, in metres.
STREET, PAVEMENT, LENGTH = 10.0, 3.0, 90.0

PANEL_KNOTS = "[0 0 0 0 1 1 1 1]"
SHEET_FACES = "[4 4 4 4] [0 1 4 3  1 2 5 4  3 4 7 6  4 5 8 7]"
BOX = ("[4 4 4 4 4 4] [0 1 3 2  4 6 7 5  0 4 5 1  2 3 7 6  0 2 6 4  1 5 7 3] "
       '["crease" "crease" "crease" "crease" "crease" "crease"] [5 1 5 1 2 1 2 1 2 1 2 1] '
       "[0 1 3 2 0 4 5 7 6 4 0 4 1 5 2 6 3 7] [2 2 2 2 2 2]")


def numbers(values):
    return " ".join(f"{v:.4g}" for v in values)


def panel(corner, u, v, bulge):
    """Returns a bicubic patch over a parallelogram. Its middle stands out along u x v."""
    n = (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])
    length = math.sqrt(sum(c * c for c in n)) or 1
    points = []
    for j in range(4):
        for i in range(4):
            out = bulge / length if 0 < i < 3 and 0 < j < 3 else 0
            points += [corner[k] + u[k] * i / 3 + v[k] * j / 3 + n[k] * out for k in range(3)]
    return f'NuPatch 4 4 {PANEL_KNOTS} 0 1 4 4 {PANEL_KNOTS} 0 1 "P" [{numbers(points)}]\n'


def tube(base, top, wide, narrow, bend=0.0):
    """Returns a closed cubic NURBS tube around a line, for a branch or a post."""
    axis = [t - b for t, b in zip(top, base)]
    side = (1, 0, 0) if abs(axis[0]) < 0.6 * math.hypot(*axis) else (0, 0, 1)
    p = (axis[1] * side[2] - axis[2] * side[1], axis[2] * side[0] - axis[0] * side[2], axis[0] * side[1] - axis[1] * side[0])
    p = [c / math.hypot(*p) for c in p]
    q = (axis[1] * p[2] - axis[2] * p[1], axis[2] * p[0] - axis[0] * p[2], axis[0] * p[1] - axis[1] * p[0])
    q = [c / math.hypot(*q) for c in q]
    points = []
    for j in range(4):
        r, off = (wide * (3 - j) + narrow * j) / 3 * 1.4, bend * math.sin(math.pi * j / 3)
        for i in range(7):
            a = 2 * math.pi * i / 4
            points += [base[k] + axis[k] * j / 3 + r * (math.cos(a) * p[k] + math.sin(a) * q[k]) + off * p[k] for k in range(3)]
    return f'NuPatch 7 4 [0 1 2 3 4 5 6 7 8 9 10] 3 7 4 4 {PANEL_KNOTS} 0 1 "P" [{numbers(points)}]\n'


def box(lo, hi):
    points = [c for k in range(8) for c in ((hi if k & 1 else lo)[0], (hi if k & 2 else lo)[1], (hi if k & 4 else lo)[2])]
    return f'SubdivisionMesh "catmull-clark" {BOX} "P" [{numbers(points)}]\n'


def leaves(rng, centre, size):
    """Returns a bent sheet of four faces, which stands for leaves."""
    a, b = rng.uniform(0, 2 * math.pi), rng.uniform(-0.6, 0.6)
    u = (size * math.cos(a), size * b, size * math.sin(a))
    v = (-size * math.sin(a) * 0.7, size * rng.uniform(-0.3, 0.5), size * math.cos(a) * 0.7)
    points = []
    for j in (-1, 0, 1):
        for i in (-1, 0, 1):
            sag = -0.3 * size * (i * i + j * j)
            points += [centre[k] + i * u[k] + j * v[k] + (sag if k == 1 else 0) for k in range(3)]
    return f'SubdivisionMesh "catmull-clark" {SHEET_FACES} ["interpolateboundary"] [0 0] [] [] "P" [{numbers(points)}]\n'


class City:
    def __init__(self, folder, scale, view=None):
        self.folder, self.scale, self.view = folder, scale, view
        self.rng = random.Random(2004)
        self.textures = self.count(300, least=8)
        self.primitives = self.groups = 0
        self.rib = []

    def count(self, whole, least=1):
        return max(least, round(whole * self.scale))

    def paint(self, color, texture, bump, frequency=3.0):
        name = f"textures/wall{texture % self.textures:03}.png"
        surface = f'"paintedplastic" "Ka" 0 "Kd" 0.9 "Ks" 0 "texturename" ["{name}"]'
        if self.view:
            surface = '"atlasview" "string map" ["maps/GROUP.bkm"]' + (f' "texturename" ["{name}"]' if self.view == "reflected" else "")
        return (f'Color [{numbers(color)}]\nSurface {surface}\n'
                f'Attribute "displacementbound" "sphere" [{1.7 * bump:.4g}] "coordinatesystem" ["shader"]\n'
                f'Displacement "noisybump" "float Km" {bump} "float frequency" {frequency} "float octaves" 3\n')

    def group(self, name, parts):
        """Writes an archive with `parts`, which are attributes and geometry. Each archive has one photon map."""
        self.groups += 1
        self.primitives += sum(p.startswith(("NuPatch", "Subdivision")) for p in parts)
        (self.folder / f"{name}.rib").write_text("".join(parts).replace("GROUP", name))
        self.rib.append(f'AttributeBegin\nAttribute "identifier" "name" ["{name}"]\nAttribute "photon" "globalmap" ["{name}"]\n'
                        f'ReadArchive "{name}.rib"\nAttributeEnd\n')

    def bay(self, at, right, width, height, texture, color):
        """Returns one window with the wall around it: twelve primitives. `right` runs along the wall, whose outside is up x right."""
        out = (-right[2], 0.0, right[0])  # This is right x up. The next line turns it out of the wall.
        out = (-out[0], 0.0, -out[2])

        def p(x, y, z=0.0):
            return [at[k] + right[k] * x * width + (y * height if k == 1 else 0) + out[k] * z for k in range(3)]

        def across(x0, y0, x1, y1, z, bulge):
            """Returns a panel that bulges out of the wall. Its u x v points into the house, so it gets the bulge with a minus."""
            a = p(x0, y0, z)
            return panel(a, [c - d for c, d in zip(p(x1, y0, z), a)], [c - d for c, d in zip(p(x0, y1, z), a)], -bulge)

        def block(x0, y0, x1, y1, deep):
            a, b = p(x0, y0, -0.05), p(x1, y1, deep)
            return box([min(s, t) for s, t in zip(a, b)], [max(s, t) for s, t in zip(a, b)])

        wall = [self.paint(color, texture, 0.03, 4.0), across(0, 0, 1, 0.28, 0, 0.02), across(0, 0.82, 1, 1, 0, 0.02),
                across(0, 0.28, 0.25, 0.82, 0, 0.02), across(0.75, 0.28, 1, 0.82, 0, 0.02)]
        pane = [self.paint((0.25, 0.3, 0.38), texture + 1, 0.004, 1.0), across(0.25, 0.28, 0.75, 0.82, -0.12, 0.03)]
        frame = [self.paint((0.75, 0.72, 0.66), texture + 2, 0.008, 8.0), block(0.22, 0.25, 0.78, 0.30, 0.16), block(0.22, 0.80, 0.78, 0.86, 0.10),
                 block(0.22, 0.28, 0.27, 0.82, 0.06), block(0.73, 0.28, 0.78, 0.82, 0.06), block(0.49, 0.30, 0.51, 0.80, -0.02),
                 block(0.0, 0.96, 1.0, 1.02, 0.12), block(0.27, 0.55, 0.73, 0.57, -0.02)]
        return wall + pane + frame

    def house(self, index):
        rng = random.Random(index)
        side, row = index % 2, index // 2
        depth, length = rng.uniform(8, 11), LENGTH / (HOUSES / 2)
        x0 = (STREET / 2 + PAVEMENT) * (1 if side else -1)
        z0, tall = row * length, rng.uniform(11, 19)
        color = [rng.uniform(0.45, 0.85) * c for c in rng.choice([(1, 0.8, 0.6), (0.95, 0.9, 0.8), (0.9, 0.55, 0.45), (0.7, 0.8, 0.9), (0.85, 0.85, 0.6)])]
        bays = self.count(130)
        columns = max(1, round(math.sqrt(bays * length / tall)))
        floors = max(1, round(bays / columns))
        parts = []
        right = (0, 0, -1.0) if side else (0, 0, 1.0)
        for j in range(floors):
            for i in range(columns):
                w, h = length / columns, tall / floors
                start = (x0, j * h, z0 + (length - i * w if side else i * w))
                parts += self.bay(start, right, w, h, 10 * index + j % 7, color)
        parts.append(self.paint(color, 10 * index + 3, 0.05, 2.0))
        far = x0 + depth * (1 if side else -1)
        lo, hi = min(x0, far), max(x0, far)
        parts += [panel((lo, 0, z0), (hi - lo, 0, 0), (0, tall, 0), 0.0), panel((hi, 0, z0 + length), (lo - hi, 0, 0), (0, tall, 0), 0.0),
                  panel((lo, tall, z0), (hi - lo, 0, 0), (0, 0, length), -0.3), panel((far, 0, z0), (0, 0, length), (0, tall, 0), 0.0)]
        self.group(f"house{index:02}", parts)

    def car(self, index):
        rng = random.Random(100 + index)
        side = index % 2
        x, z = (3.6 if side else -3.6) + rng.uniform(-0.2, 0.2), 4 + index * (LENGTH - 16) / CARS + rng.uniform(-1, 1)
        color = [(0.75, 0.05, 0.04), (0.1, 0.2, 0.55), (0.8, 0.75, 0.2), (0.15, 0.45, 0.2), (0.75, 0.75, 0.75), (0.1, 0.1, 0.12)][index % 6]
        profile = [(-2.0, 0.35), (-2.05, 0.75), (-1.2, 0.9), (-0.7, 1.4), (0.7, 1.42), (1.3, 0.95), (2.0, 0.85), (2.05, 0.35)]
        slices = self.count(8)
        parts = [self.paint(color, 200 + index, 0.004, 2.0)]
        for (za, ya), (zb, yb) in zip(profile, profile[1:]):
            for s in range(slices):
                a, w = -0.85 + 1.7 * s / slices, 1.7 / slices
                parts.append(panel((x + a, ya, z + za), (0, yb - ya, zb - za), (w, 0, 0), 0.02))
        for edge in (-0.85, 0.85):
            for (za, ya), (zb, yb) in zip(profile, profile[1:]):
                u, v = (0, ya - 0.35, 0), (0, 0.5 * (yb - ya), zb - za)
                parts.append(panel((x + edge, 0.35, z + za), *((v, u) if edge < 0 else (u, v)), 0.02))
        parts.append(self.paint((0.05, 0.05, 0.05), 220, 0.006, 9.0))
        for dx in (-0.8, 0.8):
            for dz in (-1.3, 1.3):
                parts.append(tube((x + dx - 0.1, 0.33, z + dz), (x + dx + 0.1, 0.33, z + dz), 0.24, 0.24))
        self.group(f"car{index:02}", parts)

    def tree(self, index):
        rng = random.Random(200 + index)
        x, z = (STREET / 2 + 1.2) * (1 if index % 2 else -1), 6 + index * (LENGTH - 12) / TREES
        tall = rng.uniform(4.5, 6.5)
        crown = (x, tall, z)
        parts = [self.paint((0.30, 0.22, 0.15), 230 + index, 0.03, 6.0), tube((x, 0, z), (x + 0.1, tall * 0.8, z), 0.16, 0.08, 0.1)]
        for _ in range(self.count(40)):
            a, e = rng.uniform(0, 2 * math.pi), rng.uniform(0.1, 1.2)
            end = (x + 1.6 * math.cos(a) * math.cos(e), tall * 0.75 + 1.8 * math.sin(e), z + 1.6 * math.sin(a) * math.cos(e))
            parts.append(tube((x + 0.05, tall * rng.uniform(0.5, 0.78), z), end, 0.05, 0.015, rng.uniform(-0.1, 0.1)))
        # If there are fewer leaves, each is larger, so that the density of the crown stays the same.
        leaf = self.count(420)
        size = 0.16 * math.sqrt(420 / leaf)
        for shade in range(3):
            parts.append(self.paint((0.16 + 0.05 * shade, 0.42 + 0.08 * shade, 0.08), 242 + shade, 0.01, 5.0))
            for _ in range(max(1, leaf // 3)):
                a, e, r = rng.uniform(0, 2 * math.pi), math.asin(rng.uniform(-0.8, 1)), 1.9 * rng.uniform(0.4, 1) ** 0.5
                parts.append(leaves(rng, (crown[0] + r * math.cos(a) * math.cos(e), crown[1] + 0.8 * r * math.sin(e), crown[2] + r * math.sin(a) * math.cos(e)), size))
        self.group(f"tree{index:02}", parts)

    def ground(self):
        slabs = self.count(900)
        columns = max(1, round(math.sqrt(slabs * STREET / LENGTH)))
        rows = max(1, round(slabs / columns))
        parts = [self.paint((0.35, 0.34, 0.33), 250, 0.02, 5.0)]
        for j in range(rows):
            for i in range(columns):
                parts.append(panel((-STREET / 2 + STREET * i / columns, 0, LENGTH * (j + 1) / rows), (STREET / columns, 0, 0), (0, 0, -LENGTH / rows), 0.0))
        self.group("street", parts)
        for side in (-1, 1):
            parts = [self.paint((0.55, 0.53, 0.5), 251 + side, 0.012, 6.0)]
            tiles = self.count(600)
            across = max(1, round(math.sqrt(tiles * PAVEMENT / LENGTH)))
            along = max(1, round(tiles / across))
            for j in range(along):
                for i in range(across):
                    a = side * (STREET / 2 + PAVEMENT * i / across)
                    b = side * (STREET / 2 + PAVEMENT * (i + 1) / across)
                    parts.append(box((min(a, b), -0.1, LENGTH * j / along), (max(a, b), 0.15, LENGTH * (j + 1) / along)))
            self.group(f"pavement{(side + 1) // 2}", parts)

    def write_textures(self):
        (self.folder / "textures").mkdir(exist_ok=True)
        n = TEXTURE_SIZE
        for t in range(self.textures):
            rng = random.Random(1000 + t)
            kind, rows = t % 3, rng.choice((8, 16))
            tone = [rng.uniform(0.75, 1) for _ in range(256)]
            pixels = bytearray()
            for y in range(n):
                pixels.append(0)  # This row of the PNG has no filter.
                row = y * rows // n
                for x in range(n):
                    column = (x + (row % 2) * n // rows) * rows // (2 * n) if kind == 0 else x * rows // n
                    joint = kind < 2 and (y * rows % n < rows or (x + (row % 2 if kind == 0 else 0) * n // rows) * rows // (2 if kind == 0 else 1) % n < rows)
                    v = 0.6 if joint else tone[(row * 31 + column * 7) % 256] if kind < 2 else tone[(x * 13 + y * 57) % 256]
                    v *= 0.94 + 0.06 * tone[(x * 7 + y * 131) % 256]
                    pixels += bytes((int(255 * v), int(250 * v), int(242 * v)))
            def chunk(name, data):
                return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))
            (self.folder / "textures" / f"wall{t:03}.png").write_bytes(
                b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", n, n, 8, 2, 0, 0, 0)) + chunk(b"IDAT", zlib.compress(bytes(pixels))) + chunk(b"IEND", b""))

    def write(self):
        self.folder.mkdir(parents=True, exist_ok=True)
        self.write_textures()
        for i in range(HOUSES):
            self.house(i)
        for i in range(CARS):
            self.car(i)
        for i in range(TREES):
            self.tree(i)
        self.ground()
        (self.folder / "city.rib").write_text(f"""##RenderMan RIB-Structure 1.1
# Written by scenes/city/make_city.py: {self.primitives} primitives in {self.groups} photon maps, {self.textures} textures.
version 3.03
Option "limits" "bucketsize" [16 16] "gridsize" [1024]
Option "bucket" "order" ["vertical"]
Option "searchpath" "shader" [".:@"]
Display "city.exr" "openexr" "rgb"
Format 1024 553 1
PixelSamples 3 3
PixelFilter "gaussian" 2 2
Projection "perspective" "fov" [48]
Clipping 0.2 500
Rotate -4 1 0 0
Translate 0.8 -2.6 -1.5
WorldBegin
LightSource "distantlight" "sun" "intensity" [2.6] "color lightcolor" [1 0.95 0.85] "from" [-6 13 -2] "to" [0 0 0] "shadowname" ["raytrace"]
LightSource "indirectlight" "bounce" "samples" [256]
Sides 2
ShadingRate {SHADING_RATE}
Attribute "dice" "rasterorient" [0]
Attribute "trace" "tessellation" [{0.5 * math.sqrt(SHADING_RATE):.3g}]
{"".join(self.rib)}WorldEnd
""")
        return f"{self.primitives} primitives, {self.groups} photon maps, {self.textures} textures"


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("scale", type=float, nargs="?", default=1.0,
                        help="1 (default) is 36,000 primitives and 300 textures; 0.01 the same street of fewer, larger parts")
    parser.add_argument("view", nargs="?", choices=["irradiance", "reflected"],
                        help="show the brick maps in FOLDER/maps (atlasview.cpp), or their irradiance times the colours")
    args = parser.parse_args()
    print(City(args.folder, args.scale, args.view).write())


if __name__ == "__main__":
    main()
