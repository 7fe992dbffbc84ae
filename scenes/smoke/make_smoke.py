"""Writes smoke.vdb, a puff of smoke that noise shapes. The file smoke.rib beside this one renders it.

    make_smoke.py [POINTS [FILE]]

POINTS is the number of points of the lattice along each axis; the default is 64. FILE is the file to write instead of smoke.vdb.
"""
import math
import pathlib
import random
import sys

FOLDER = pathlib.Path(__file__).resolve().parent
sys.path.append(str(FOLDER.parent))
import vdb  # noqa: E402

SIDE = int(sys.argv[1]) if len(sys.argv) > 1 else 64
chance = random.Random(3)
table = [chance.random() for _ in range(4096)]


def smooth(t):
    return t * t * (3 - 2 * t)


def noise(x, y, z):
    """Returns smooth noise between 0 and 1, which interpolates random numbers at whole coordinates."""
    i, j, k = math.floor(x), math.floor(y), math.floor(z)
    u, v, w = smooth(x - i), smooth(y - j), smooth(z - k)
    total = 0
    for a in (0, 1):
        for b in (0, 1):
            for c in (0, 1):
                share = (u if a else 1 - u) * (v if b else 1 - v) * (w if c else 1 - w)
                total += share * table[((i + a) * 73856093 ^ (j + b) * 19349663 ^ (k + c) * 83492791) & 4095]
    return total


def clouds(x, y, z):
    return sum(noise(2 ** k * x, 2 ** k * y, 2 ** k * z) / 2 ** (k + 1) for k in range(4))


def density(i, j, k):
    """Returns the density at a point of the lattice. The smoke is a ball with a ragged surface and a stalk below it."""
    x, y, z = (2 * c / (SIDE - 1) - 1 for c in (i, j, k))
    ball = 0.62 - math.hypot(x, y - 0.25, z)
    stalk = 0.16 + 0.1 * y - math.hypot(x + 0.1 * math.sin(5 * y), z) if y < 0.1 else -1
    edge = max(ball, stalk) + 1.3 * (clouds(2.2 * x + 9, 2.2 * y + 9, 2.2 * z + 9) - 0.5)
    # The density falls to 0 towards the faces of the box, so that no edge shows.
    inside = smooth(min(1.0, 3.5 * (1 - max(abs(x), abs(y), abs(z)))))
    return max(0.0, min(1.0, 5 * (edge + inside - 1)))


vdb.write(sys.argv[2] if len(sys.argv) > 2 else FOLDER / "smoke.vdb", "density", SIDE, density, 2 / (SIDE - 1), (-1, -1, -1))
