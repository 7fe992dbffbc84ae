"""Two rooms that every renderer can render, as data. They are in RIB's camera space: x right, y up, z away, and the eye at the origin.

A room is quadrilaterals and spheres of one diffuse colour each, and one rectangular lamp that shines downwards (radiance in W/m2/sr).
"""
import dataclasses
import math

import numpy

WHITE, RED, GREEN = (0.73, 0.73, 0.71), (0.63, 0.065, 0.05), (0.14, 0.45, 0.091)


@dataclasses.dataclass
class Quad:
    corners: list  # The 4 points are in turn.
    color: tuple


@dataclasses.dataclass
class Ball:
    centre: tuple
    radius: float
    color: tuple


@dataclasses.dataclass
class Lamp:
    centre: tuple
    width: float   # The width is along x.
    depth: float   # The depth is along z.
    radiance: float


@dataclasses.dataclass
class Room:
    name: str
    fov_deg: float
    lamp: Lamp
    quads: list
    balls: list

    def first_seen(self, x, y):
        """Returns the index of the shape that rays through (x, y) of the plane z = 1 meet first: -1 for none, -2 for the lamp."""
        d = numpy.stack([x, y, numpy.ones_like(x)], -1)
        nearest, which = numpy.full(x.shape, numpy.inf), numpy.full(x.shape, -1)

        def meet(t, hit, index):
            closer = hit & (t > 1e-6) & (t < nearest)
            nearest[closer], which[closer] = t[closer], index

        lamp = self.lamp
        cx, cy, cz = lamp.centre
        quads = [q.corners for q in self.quads] + [[(cx + sx * lamp.width / 2, cy, cz + sz * lamp.depth / 2)
                                                    for sx, sz in ((-1, -1), (1, -1), (1, 1), (-1, 1))]]
        for i, corners in enumerate(quads):
            p, a, b = (numpy.array(corners[k], float) for k in (0, 1, 3))
            u, v = a - p, b - p
            n = numpy.cross(u, v)
            facing = d @ n
            t = n @ p / numpy.where(facing == 0, 1e-30, facing)
            q = d * t[..., None] - p
            s, r = numpy.cross(q, v) @ n / (n @ n), numpy.cross(u, q) @ n / (n @ n)
            meet(t, (s >= 0) & (s <= 1) & (r >= 0) & (r <= 1), i if i < len(self.quads) else -2)
        for i, ball in enumerate(self.balls):
            c = numpy.array(ball.centre)
            along, square = d @ c, (d * d).sum(-1)
            inside = along**2 - square * (c @ c - ball.radius**2)
            meet((along - numpy.sqrt(numpy.maximum(inside, 0))) / square, inside > 0, len(self.quads) + i)
        return which

    def over_lamp(self, x, y):
        """Returns whether rays through (x, y) of the plane z = 1 meet the ceiling over the lamp, or less than 5 cm beside it."""
        top = max(corner[1] for q in self.quads for corner in q.corners)
        t = top / numpy.where(y > 0, y, 1e-30)
        cx, _, cz = self.lamp.centre
        return (y > 0) & (abs(t * x - cx) < self.lamp.width / 2 + 0.05) & (abs(t - cz) < self.lamp.depth / 2 + 0.05)

    def mask(self, size):
        """Returns the pixels whose points all see one shape that is no lamp, because one ray per pixel and box filters agree
        there. The slot over the lamp is left out: Cycles' lamps are no obstacles, and POV-Ray's cache carries light into it
        (twice the mean light too bright)."""
        edge = math.tan(math.radians(self.fov_deg) / 2)
        parts = []
        for dx in (0.0, 0.5, 1.0):
            for dy in (0.0, 0.5, 1.0):
                x, y = numpy.meshgrid((numpy.arange(size) + dx) / size, (numpy.arange(size) + dy) / size)
                parts.append(numpy.where(self.over_lamp(edge * (2 * x - 1), edge * (1 - 2 * y)), -2, self.first_seen(edge * (2 * x - 1), edge * (1 - 2 * y))))
        return (parts[0] >= 0) & numpy.all([p == parts[0] for p in parts[1:]], 0)


def box(lo, hi, color, turn_deg=0.0):
    """Returns six sides, turned about the vertical axis through the middle."""
    middle = [(a + b) / 2 for a, b in zip(lo, hi)]
    s, c = math.sin(math.radians(turn_deg)), math.cos(math.radians(turn_deg))

    def corner(i, j, k):
        x, y, z = (hi if i else lo)[0] - middle[0], (hi if j else lo)[1], (hi if k else lo)[2] - middle[2]
        return (middle[0] + c * x + s * z, y, middle[2] - s * x + c * z)

    sides = [[(0, 0, 0), (0, 1, 0), (1, 1, 0), (1, 0, 0)], [(0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)], [(0, 0, 0), (0, 0, 1), (0, 1, 1), (0, 1, 0)],
             [(1, 0, 0), (1, 1, 0), (1, 1, 1), (1, 0, 1)], [(0, 0, 0), (1, 0, 0), (1, 0, 1), (0, 0, 1)], [(0, 1, 0), (0, 1, 1), (1, 1, 1), (1, 1, 0)]]
    return [Quad([corner(*v) for v in side], color) for side in sides]


def walls(lo, hi, colors):
    """Returns a box without its front. The colours are those of left, right, floor, ceiling and back."""
    left, right, floor, ceiling, back = colors
    sides = box(lo, hi, WHITE)
    for side, color in zip(sides[1:], (back, left, right, floor, ceiling)):
        side.color = color
    return sides[1:]


def moved(shapes, dz):
    for s in shapes:
        if isinstance(s, Quad):
            s.corners = [(x, y, z + dz) for x, y, z in s.corners]
        else:
            s.centre = (s.centre[0], s.centre[1], s.centre[2] + dz)
    return shapes


def cornell():
    quads = walls((-1, -1, -1), (1, 1, 1), (RED, GREEN, WHITE, WHITE, WHITE)) + box((-0.7, -1, -0.1), (-0.15, 0.2, 0.45), WHITE, 18)
    return Room("cornell", 38, Lamp((0, 0.98, 3.95), 0.5, 0.5, 12), moved(quads, 3.95), moved([Ball((0.4, -0.65, -0.3), 0.35, WHITE)], 3.95))


def interior():
    """Returns a room with a table and shelves. The lamp stands behind a screen, so most of the visible surfaces are lit indirectly."""
    wood, cloth = (0.45, 0.28, 0.15), (0.2, 0.3, 0.5)
    quads = walls((-2, -1.2, 1), (2, 1.3, 6), (WHITE, cloth, wood, WHITE, WHITE))
    quads += box((0.1, -1.2, 3.4), (0.2, 0.75, 6), WHITE)                                         # This is the screen.
    quads += box((-1.5, -0.55, 2.8), (-0.3, -0.48, 3.8), wood, 12)                                # These are the table and its legs.
    for x, z in ((-1.4, 2.95), (-0.45, 2.95), (-1.4, 3.65), (-0.45, 3.65)):
        quads += box((x, -1.2, z), (x + 0.08, -0.55, z + 0.08), wood)
    for y in (-0.5, 0.1, 0.7):
        quads += box((-2, y, 4.6), (-1.6, y + 0.05, 6), WHITE)                                    # These are shelves.
    balls = [Ball((-0.9, -0.3, 3.3), 0.18, RED), Ball((-0.3, -0.95, 4.6), 0.25, GREEN)]
    return Room("interior", 60, Lamp((1.1, 1.2, 4.7), 0.6, 0.6, 25), quads, balls)
