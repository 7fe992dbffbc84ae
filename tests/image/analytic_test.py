"""Compares pictures with closed forms: the white furnace, and a rectangular light over a floor."""
import math
import pathlib
import subprocess
import sys
import tempfile

from pictures import pixels

tomales, root = sys.argv[1], pathlib.Path(sys.argv[2])
failures = []


def expect(condition, message):
    print(("ok      " if condition else "FAILED  ") + message)
    if not condition:
        failures.append(message)


def render(scene, *options):
    with tempfile.TemporaryDirectory() as folder:
        out = pathlib.Path(folder) / "out.exr"
        subprocess.run([tomales, "render", str(root / "scenes" / scene), "-o", str(out), "-q", *options], check=True)
        return pixels(out)


def rectangle_irradiance(point, normal, corners):
    """Returns irradiance / (pi * radiance) of a polygon by contour integration (Lambert). The corners are in the order in which
    the point sees them."""
    directions = []
    for c in corners:
        d = [a - b for a, b in zip(c, point)]
        length = math.sqrt(sum(x * x for x in d))
        directions.append([x / length for x in d])
    total = 0.0
    for a, b in zip(directions, directions[1:] + directions[:1]):
        cross = [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
        length = math.sqrt(sum(x * x for x in cross))
        angle = math.acos(max(-1.0, min(1.0, sum(x * y for x, y in zip(a, b)))))
        total += angle * sum(x * n for x, n in zip(cross, normal)) / length
    return abs(total) / (2 * math.pi)


# The white furnace has albedo 0.5 inside radiance 1.
for mode in ("gather", "reference"):
    picture = render("furnace/furnace.rib", "--gi", mode, "--samples", "64")
    inside = [p for (x, y), p in picture.items() if (x - 63.5) ** 2 + (y - 63.5) ** 2 < 36**2]
    mean = sum(p[0] for p in inside) / len(inside)
    worst = max(abs(p[0] - 0.5) for p in inside)
    expect(abs(mean / 0.5 - 1) < 0.005, f"furnace --gi {mode}: mean {mean:.5f} of 0.5 (within 0.5 %)")
    expect(worst < 0.025, f"furnace --gi {mode}: no pixel of the sphere is off by more than 5 % (worst {worst / 0.5:.2%})")

# The rectangle of 2 x 1 and radiance 3 is 1.5 above the floor. The camera looks down -y; raster x is +x, and raster y (down) is -z.
picture = render("rectlight/rectlight.rib")
corners = [(-1, 1.5, -0.5), (1, 1.5, -0.5), (1, 1.5, 0.5), (-1, 1.5, 0.5)]
for px in (24, 96, 168):
    for py in (24, 96, 168):
        truth = measured = 0.0
        for x in range(px - 3, px + 4):
            for y in range(py - 3, py + 4):
                world = ((x + 0.5) / 48 - 2, 0.0, 2 - (y + 0.5) / 48)
                truth += 3 * rectangle_irradiance(world, (0, 1, 0), corners)
                measured += picture[x, y][0]
        expect(abs(measured / truth - 1) < 0.01,
               f"rectangle light at pixel {px},{py}: {measured / 49:.5f}, closed form {truth / 49:.5f} ({measured / truth - 1:+.3%})")

sys.exit(bool(failures))
