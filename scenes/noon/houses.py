"""Makes the houses of noon.rib. A house is one mesh for each material. Points are in metres along the wall, up, and out of it."""
import random

from parts import flat, numbers, part

WALL = 11.6                            # The houses on both sides stand at this distance from the middle of the street.
BOX = ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3))
WALLS = [((0.74, 0.66, 0.52), 2), ((0.66, 0.60, 0.51), 2), ((0.52, 0.26, 0.19), 1), ((0.78, 0.60, 0.42), 0), ((0.80, 0.74, 0.62), 0), ((0.60, 0.37, 0.27), 1),
         ((0.70, 0.46, 0.34), 0), ((0.62, 0.66, 0.62), 0), ((0.78, 0.70, 0.44), 0), ((0.68, 0.62, 0.56), 2)]
SHUTTERS = [(0.16, 0.24, 0.20), (0.20, 0.27, 0.34), (0.36, 0.36, 0.33), (0.10, 0.19, 0.13)]
AWNINGS = [(0.55, 0.09, 0.07), (0.10, 0.26, 0.16), (0.12, 0.20, 0.38), (0.62, 0.36, 0.08)]


class Mesh:
    """Collects polygons of one material. Points are (along the wall, height, out of the wall)."""

    def __init__(self, surface, *requests):
        self.surface, self.requests, self.points, self.sizes, self.vertices, self.st, self.which = surface, requests, [], [], [], [], []

    def face(self, points, st=None):
        self.vertices += range(len(self.points), len(self.points) + len(points))
        self.points += points
        self.sizes.append(len(points))
        self.st += st or [(0, 0)] * len(points)
        self.which.append(random.random())

    def rectangle(self, x0, x1, y0, y1, z):
        self.face([(x0, y0, z), (x1, y0, z), (x1, y1, z), (x0, y1, z)], [(0, 0), (1, 0), (1, 1), (0, 1)])

    def block(self, x0, x1, y0, y1, z0, z1):
        points = [(x, y, z) for x in (x0, x1) for y in (y0, y1) for z in (z0, z1)]
        for face in BOX:
            self.face([points[k] for k in face])

    def write(self):
        if not self.points:
            return []
        st = f' "facevarying float[2] st" [{numbers(flat(self.st), ".3g")}] "uniform float which" [{numbers(self.which, ".3f")}]' if "pane" in self.surface else ""
        return ["AttributeBegin", self.surface, *self.requests,
                f'PointsPolygons [{" ".join(map(str, self.sizes))}] [{" ".join(map(str, self.vertices))}] "P" [{numbers(flat(self.points), ".6g")}]{st}', "AttributeEnd"]


def colour(c, shade=1.0):
    return f"Color [{numbers((x * shade for x in c), '.3f')}]"


class House:
    """Builds a house as meshes by material. Only the side towards the street is visible."""

    def __init__(self, index, wide, near):
        rng = random.Random(500 + index)
        self.rng, self.wide, self.near = rng, wide, near
        wall, bond = WALLS[(index * 7 + index // 9) % len(WALLS)]
        stone = (0.72, 0.67, 0.58) if bond != 0 else tuple(min(0.82, c * 1.12 + 0.05) for c in wall)
        self.wall = Mesh(f'Surface "masonry" "float bond" [{bond}]', colour(wall))
        self.stone = Mesh('Surface "masonry" "float bond" [3]', colour(stone))
        self.frame = Mesh('Surface "plain"', colour(rng.choice([(0.74, 0.72, 0.68), (0.30, 0.22, 0.16), (0.70, 0.69, 0.66)])))
        self.pane = Mesh('Surface "pane"')
        self.shop = Mesh('Surface "pane" "float shop" [1]')
        self.shutter = Mesh('Surface "plain"', colour(rng.choice(SHUTTERS)))
        self.iron = Mesh('Surface "plain"', colour((0.035, 0.037, 0.04)))
        self.sign = Mesh('Surface "plain" "float gloss" [0.3]', colour(rng.choice([(0.05, 0.12, 0.09), (0.30, 0.05, 0.05), (0.05, 0.07, 0.14), (0.06, 0.055, 0.05), (0.33, 0.24, 0.09)])))
        self.awning = Mesh(f'Surface "plain" "float stripes" [{rng.choice([0, 0.5, 0.36])}] "float uneven" [0.06]', colour(rng.choice(AWNINGS)))
        self.slate = Mesh('Surface "plain"', colour((0.17, 0.18, 0.20)))
        self.bars = []
        self.shuttered, self.balconies, self.arched = rng.random() < 0.4, rng.random() < 0.65, rng.random() < 0.5
        self.build()

    def opening(self, x0, x1, y0, y1, a, b, c, d, deep):
        """Adds the wall between x0..x1, y0..y1 around a hole a..b, c..d, and the sides of the hole."""
        xs, ys = (x0, a, b, x1), (y0, c, d, y1)
        for i in range(3):
            for j in range(3):
                if (i, j) != (1, 1) and xs[i + 1] - xs[i] > 1e-6 and ys[j + 1] - ys[j] > 1e-6:
                    self.wall.rectangle(xs[i], xs[i + 1], ys[j], ys[j + 1], 0)
        for (p, q), (r, s) in (((a, c), (a, d)), ((b, d), (b, c)), ((a, d), (b, d)), ((b, c), (a, c))):
            self.wall.face([(p, q, 0), (r, s, 0), (r, s, -deep), (p, q, -deep)])

    def window(self, x0, x1, y0, y1, french, floor):
        wide, deep = min(1.25, 0.52 * (x1 - x0), 0.5 * (x1 - x0) - 0.21 if self.shuttered else 9), 0.30
        a, b = 0.5 * (x0 + x1 - wide), 0.5 * (x0 + x1 + wide)
        c, d = y0 + (0.12 if french else 0.85), y1 - 0.48
        self.opening(x0, x1, y0, y1, a, b, c, d, deep)
        rail = c + (0.70 if french else 0.62) * (d - c)
        for left, right in ((a + 0.06, 0.5 * (a + b) - 0.03), (0.5 * (a + b) + 0.03, b - 0.06)):
            self.pane.rectangle(left, right, c + 0.06, rail - 0.025, -deep + 0.03)
            self.pane.rectangle(left, right, rail + 0.025, d - 0.06, -deep + 0.03)
        for sides in ((a, a + 0.06, c, d), (b - 0.06, b, c, d), (a + 0.06, b - 0.06, c, c + 0.06), (a + 0.06, b - 0.06, d - 0.06, d),
                      (0.5 * (a + b) - 0.03, 0.5 * (a + b) + 0.03, c + 0.06, d - 0.06), (a + 0.06, b - 0.06, rail - 0.025, rail + 0.025)):
            self.frame.block(*sides, -deep - 0.01, -deep + 0.08)
        for p, q in ((a - 0.17, a + 0.01), (b - 0.01, b + 0.17)):
            self.stone.block(p, q, c - 0.02, d + 0.02, -0.05, 0.05)
        self.stone.block(a - 0.22, b + 0.22, d - 0.012, d + 0.22, -0.05, 0.08)
        if floor < 3:
            self.stone.block(a - 0.28, b + 0.28, d + 0.20, d + 0.30, -0.04, 0.20)
        self.stone.block(a - 0.22, b + 0.22, c - 0.11, c + 0.012, -deep, 0.14)
        if self.shuttered and not french:
            for p in (a - 0.18 - 0.5 * wide, b + 0.18):
                self.shutter.block(p, p + 0.5 * wide, c, d, 0.02, 0.055)
                for k in range(int((d - c) / 0.09)) if self.near else ():
                    y = c + 0.05 + 0.09 * k
                    self.shutter.face([(p + 0.05, y, 0.085), (p + 0.5 * wide - 0.05, y, 0.085), (p + 0.5 * wide - 0.05, y + 0.07, 0.057), (p + 0.05, y + 0.07, 0.057)])
        if french:
            self.balcony(a - 0.35, b + 0.35, c - 0.1, 0.42)

    def balcony(self, x0, x1, y, out):
        self.stone.block(x0, x1, y - 0.14, y, -0.02, out)
        for p in (x0 + 0.12, x1 - 0.26):
            self.stone.block(p, p + 0.14, y - 0.42, y - 0.12, -0.02, 0.7 * out)
        out -= 0.05
        for top in (0.10, 0.95):
            self.iron.block(x0 + 0.03, x1 - 0.03, y + top, y + top + 0.04, out - 0.04, out)
            for p in (x0 + 0.03, x1 - 0.07):
                self.iron.block(p, p + 0.04, y + top, y + top + 0.04, 0, out)
        steps = int((x1 - x0) / 0.12)
        self.bars += [[(x0 + 0.05 + (x1 - x0 - 0.1) * k / steps, y + h, out - 0.02) for h in (0.1, 0.97)] for k in range(steps + 1)]

    def shopfront(self, x0, x1, tall):
        rng, pier, deep = self.rng, 0.32, 0.45
        a, b, c, d = x0 + pier, x1 - pier, 0.45, tall - 0.95
        self.opening(x0, x1, 0.0, tall, a, b, c, d, deep)
        parts = max(2, round((b - a) / 1.3))
        door = rng.randrange(parts)
        for k in range(parts):
            p, q = a + (b - a) * k / parts, a + (b - a) * (k + 1) / parts
            low = c + 0.04
            self.shop.rectangle(p + 0.04, q - 0.04, low, d - 0.62, -deep + 0.05)
            self.shop.rectangle(p + 0.04, q - 0.04, d - 0.56, d - 0.05, -deep + 0.05)
            self.sign.block(p - 0.04, p + 0.04, c, d, -deep, -deep + 0.12)
            if k == door:
                self.sign.block(p + 0.1, q - 0.1, 0.02, 0.62, -deep + 0.02, -deep + 0.1)
        self.sign.block(b - 0.04, b + 0.04, c, d, -deep, -deep + 0.12)
        self.sign.block(a, b, d - 0.62, d - 0.56, -deep, -deep + 0.1)
        self.sign.block(a - 0.1, b + 0.1, d + 0.03, d + 0.60, -0.02, 0.10)
        self.stone.block(x0 + 0.002, x0 + 0.30, 0, 0.7, -0.03, 0.05)
        if rng.random() < 0.62:
            out, low, high = rng.uniform(1.2, 1.7), 2.55, d + 0.02
            top, rim = [(a, high, 0.06), (b, high, 0.06)], [(b, low, out), (a, low, out)]
            self.awning.face(top + rim)
            self.awning.face([(a, low, out), (b, low, out), (b, low - 0.22, out), (a, low - 0.22, out)])
            for x in (a, b):
                self.awning.face([(x, high, 0.06), (x, low, out), (x, low - 0.22, out), (x, low - 0.22, 0.06)][:3])

    def ledge(self, y, tall, out):
        self.stone.block(-0.1 * out, self.wide - 0.15 * out, y, y + tall, -0.05, out)

    def build(self):
        rng = self.rng
        ground, storey, floors = rng.uniform(4.1, 4.6), rng.uniform(3.25, 3.65), rng.choice((3, 4, 4, 5))
        bays = max(2, round(self.wide / rng.uniform(2.5, 3.0)))
        step = self.wide / bays
        shops = max(1, round(self.wide / 5.2))
        for k in range(shops):
            self.shopfront(self.wide * k / shops, self.wide * (k + 1) / shops, ground)
        self.ledge(ground - 0.06, 0.22, 0.16)
        y = ground
        for floor in range(floors):
            french = self.balconies and floor in (0, 2) or (self.balconies and floor == 1 and self.arched)
            for k in range(bays):
                self.window(k * step, (k + 1) * step, y, y + storey, french, floor)
            y += storey
            if floor < floors - 1:
                self.ledge(y - 0.08, 0.14, 0.07)
        # The main cornice rests on consoles. The roof rises behind it.
        self.ledge(y, 0.32, 0.12), self.ledge(y + 0.30, 0.18, 0.46), self.ledge(y + 0.46, 0.14, 0.62)
        for k in range(int(self.wide / 0.55)) if self.near else ():
            self.stone.block(0.2 + 0.55 * k, 0.42 + 0.55 * k, y + 0.04, y + 0.32, 0.05, 0.42)
        y += 0.60
        rise = rng.uniform(2.4, 3.1)
        self.slate.face([(0, y, 0.05), (self.wide, y, 0.05), (self.wide, y + rise, -1.1), (0, y + rise, -1.1)])
        self.slate.face([(0, y + rise, -1.1), (self.wide, y + rise, -1.1), (self.wide, y + rise + 0.9, -6), (0, y + rise + 0.9, -6)])
        for k in range(bays):
            middle = (k + 0.5) * step
            self.stone.block(middle - 0.72, middle - 0.55, y - 0.02, y + 1.92, -0.9, 0.02), self.stone.block(middle + 0.55, middle + 0.72, y - 0.02, y + 1.92, -0.9, 0.02)
            self.stone.block(middle - 0.80, middle + 0.80, y + 1.9, y + 2.08, -0.9, 0.14)
            self.pane.rectangle(middle - 0.5, middle + 0.5, y + 0.45, y + 1.85, -0.14)
            self.frame.block(middle - 0.03, middle + 0.03, y + 0.4, y + 1.9, -0.14, -0.08), self.frame.block(middle - 0.55, middle + 0.55, y + 0.2, y + 0.45, -0.2, 0.0)
        # A wall with chimneys separates this house from the one before it.
        self.wall.block(-0.22, 0.22, 0, y + rise + 0.6, -8, -0.05)
        self.stone.block(-0.28, 0.28, y + rise + 0.58, y + rise + 0.8, -3.2, -1.0)
        for k in range(4):
            self.slate.block(-0.16, 0.16, y + rise + 0.8, y + rise + 1.25, -3.0 + 0.5 * k, -2.7 + 0.5 * k)

    def write(self, name, side, start):
        """Prints the house. `side` is -1 on the left and 1 on the right. The first coordinate runs away from the eye on the left and towards it
        on the right, so that the third one always points to the street."""
        place = f"ConcatTransform [{numbers((0, 0, 1, 0, 0, 1, 0, 0, -side, 0, 0, 0, side * WALL, 0, start, 1))}]"
        rows = [r for mesh in (self.wall, self.stone, self.frame, self.pane, self.shop, self.shutter, self.iron, self.sign, self.awning, self.slate) for r in mesh.write()]
        if self.bars:
            rows += ['Surface "plain"', "Color 0.035 0.037 0.04", f'Curves "linear" [{numbers(map(len, self.bars))}] "nonperiodic" "P" [{numbers(flat(flat(self.bars)), ".5g")}] "constantwidth" [0.022]']
        part(name, place, "Sides 2", 'Attribute "trace" "float offset" [0.004]', *rows)
