"""Times whole renders of generated scenes on one thread, and prints JSON. The scenes are everyday work for a Reyes renderer, and
the two cases in which classic ones are slowest (deep transparency; motion with defocus).

    tests/bench/reyes_set.py build/release/tomales [--runs 3] [--only NAME ...] [--keep FOLDER]

`classic_s` has the user seconds of the two open Reyes renderers on a machine of this kind, the better first, for scenes of the
same description (not the same files). null means that it was stopped after 120 s. `faster` is the time of the better one divided
by ours.
"""
import argparse
import json
import math
import os
import pathlib
import random
import resource
import statistics
import subprocess
import sys
import tempfile

HEADER = """Display "x.exr" "openexr" "rgba"
Format {width} {height} 1
Projection "perspective" "float fov" [40]
PixelSamples {samples} {samples}
PixelFilter "gaussian" 2 2
ShadingRate {rate}
{options}
WorldBegin
LightSource "distantlight" 1 "point from" [-1 2 -2] "point to" [0 0 0]
LightSource "ambientlight" 2 "float intensity" [0.1]
"""


def frame(body, samples, rate=1, options="", width=640, height=480):
    return HEADER.format(width=width, height=height, samples=samples, rate=rate, options=options) + body + "WorldEnd\n"


def numbers(values):
    return "[" + " ".join(f"{v:.5g}" for v in values) + "]"


FLOOR = 'Surface "matte"\nPolygon "P" [-20 -1.5 0  20 -1.5 0  20 -1.5 40  -20 -1.5 40]\n'
BUMPY = ('Attribute "displacementbound" "float sphere" [{bound}]\n'
         'Displacement "noisybump" "float Km" [{height}] "float frequency" [{frequency}] "float octaves" [8]\n')


def fractal_sphere():
    body = FLOOR + BUMPY.format(bound=0.35, height=0.3, frequency=2)
    return frame(body + 'Surface "plastic"\nTranslate 0 0 5\nSphere 1.4 -1.4 1.4 360\n', samples=3, rate=0.5)


def scattered(rng, count, radius, body):
    out = []
    for _ in range(count):
        z = rng.uniform(5, 14)
        x, y = rng.uniform(-0.42, 0.42) * z, rng.uniform(-0.32, 0.32) * z
        color = numbers(rng.uniform(0.2, 1) for _ in range(3))
        r = rng.uniform(*radius)
        out.append(f"AttributeBegin\nColor {color}\n" + body(rng, x, y, z, r) + "AttributeEnd\n")
    return "".join(out)


def displaced_spheres():
    rng = random.Random(1)
    bumpy = BUMPY.format(bound=0.12, height=0.1, frequency=4)

    def body(rng, x, y, z, r):
        return f'Surface "plastic"\nTranslate {x:.4f} {y:.4f} {z:.4f}\nSphere {r:.4f} {-r:.4f} {r:.4f} 360\n'

    return frame(bumpy + scattered(rng, 120, (0.3, 0.7), body), samples=4)


def curves():
    rng = random.Random(2)
    points, counts = [], 40_000
    for _ in range(counts):
        x, z = rng.uniform(-4, 4), rng.uniform(5, 12)
        lean = [rng.uniform(-0.4, 0.4) for _ in range(4)]
        for k in range(4):
            points += [x + lean[0] * k * k / 9 + lean[2] * k / 6, -1.5 + 0.35 * k, z + lean[1] * k * k / 9 + lean[3] * k / 6]
    curve = f'Basis "bezier" 3 "bezier" 3\nCurves "cubic" [{"4 " * counts}] "nonperiodic" "P" {numbers(points)}'
    return frame('Surface "plastic"\n' + curve + ' "constantwidth" [0.015]\n', samples=4)


def lattice(rows, columns, height):
    """Returns a hilly plane of rows x columns quadrilaterals."""
    points = []
    for j in range(rows + 1):
        for i in range(columns + 1):
            u, v = i / columns, j / rows
            points += [8 * u - 4, -1.6 + height * math.sin(17 * u) * math.cos(13 * v) + 0.5 * math.sin(9 * v), 4 + 9 * v]
    return points


def triangles():
    n = 316
    faces = []
    for j in range(n):
        for i in range(n):
            a = j * (n + 1) + i
            faces += [a, a + 1, a + n + 2, a, a + n + 2, a + n + 1]
    body = f'PointsPolygons [{"3 " * (2 * n * n)}] [{" ".join(map(str, faces))}] "P" {numbers(lattice(n, n, 0.3))}\n'
    return frame('Surface "plastic"\n' + body, samples=4)


def subdivision():
    n = 100
    faces = []
    for j in range(n):
        for i in range(n):
            a = j * (n + 1) + i
            faces += [a, a + 1, a + n + 2, a + n + 1]
    body = (f'SubdivisionMesh "catmull-clark" [{"4 " * (n * n)}] [{" ".join(map(str, faces))}] '
            f'["interpolateboundary"] [0 0] [] [] "P" {numbers(lattice(n, n, 0.3))}\n')
    return frame('Surface "plastic"\n' + body, samples=4)


def points():
    rng = random.Random(3)
    P = []
    for _ in range(200_000):
        z = rng.uniform(5, 12)
        P += [rng.uniform(-0.45, 0.45) * z, rng.uniform(-0.35, 0.35) * z, z]
    return frame(f'Surface "matte"\nPoints "P" {numbers(P)} "constantwidth" [0.02]\n', samples=3)


def transparent_spheres():
    rng = random.Random(4)

    def body(rng, x, y, z, r):
        return (f'Opacity [0.15 0.15 0.15]\nSurface "plastic"\nTranslate {x:.4f} {y:.4f} {z:.4f}\n'
                f"Sphere {r:.4f} {-r:.4f} {r:.4f} 360\n")

    return frame(scattered(rng, 300, (0.3, 0.7), body), samples=4)


def moving_spheres(samples, width, height):
    rng = random.Random(5)

    def body(rng, x, y, z, r):
        dx, dy, dz = (rng.uniform(-0.4, 0.4) for _ in range(3))
        return ('Surface "plastic"\nMotionBegin [0 1]\n'
                f"Translate {x:.4f} {y:.4f} {z:.4f}\nTranslate {x + dx:.4f} {y + dy:.4f} {z + dz:.4f}\nMotionEnd\n"
                f"Sphere {r:.4f} {-r:.4f} {r:.4f} 360\n")

    options = "Shutter 0 1\nDepthOfField 4 0.5 9"
    return frame(scattered(rng, 150, (0.2, 0.6), body), samples=samples, options=options, width=width, height=height)


# Each name has a scene and the seconds of the classic renderers.
SCENES = {
    "fractal_sphere": (fractal_sphere, [0.6, 1.5]),
    "displaced_spheres": (displaced_spheres, [1.4, 3.3]),
    "curves": (curves, [1.8, 5.5]),
    "triangles": (triangles, [0.9, 4.6]),
    "subdivision": (subdivision, [0.5, 1.0]),
    "points": (points, [0.4, 0.7]),
    "transparent_spheres": (transparent_spheres, [16.5, 26]),
    "moving_spheres": (lambda: moving_spheres(4, 320, 240), [8, 20]),
    "moving_spheres_fine": (lambda: moving_spheres(8, 640, 480), [120, None]),
}


def run(tomales, folder, name):
    """Returns the user seconds and statistics of one render."""
    stats = folder / "stats.json"
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    subprocess.run([tomales, "render", folder / f"{name}.rib", "-o", folder / f"{name}.exr", "-q", "-t", "1", "--stats", stats],
                   check=True)
    return resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before, json.loads(stats.read_text())


def measure(tomales, folder, name, runs):
    make, classic = SCENES[name]
    (folder / f"{name}.rib").write_text(make())
    results = sorted((run(tomales, folder, name) for _ in range(runs)), key=lambda r: r[0])
    user, stats = results[len(results) // 2]
    return {"user_s": round(user, 3), "classic_s": classic, "faster": round(classic[0] / user, 2),
            "micropolygons_diced": stats["geometry"]["micropolygons_diced"],
            "micropolygons_visible": stats["geometry"]["micropolygons_visible"],
            "peak_rss_mb": round(stats["memory_bytes"]["peak_rss"] / 1e6),
            "stages_s": {k: round(v, 3) for k, v in stats["time_s"].items()}}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("tomales")
    parser.add_argument("--runs", type=int, default=3)
    parser.add_argument("--only", nargs="*", choices=SCENES, default=list(SCENES))
    parser.add_argument("--keep", type=pathlib.Path, help="leave scenes and pictures here")
    options = parser.parse_args()
    tomales = os.path.abspath(options.tomales)
    with tempfile.TemporaryDirectory() as temporary:
        folder = options.keep or pathlib.Path(temporary)
        folder.mkdir(parents=True, exist_ok=True)
        results = {name: measure(tomales, folder, name, options.runs) for name in options.only}
    mean = math.exp(statistics.fmean(math.log(r["faster"]) for r in results.values()))
    json.dump({"scenes": results, "geometric_mean_faster": round(mean, 2)}, sys.stdout, indent=1)
    print()


if __name__ == "__main__":
    main()
