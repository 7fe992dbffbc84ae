"""Charts all methods of indirect light on scenes of several kinds, and prints a table of the CPU seconds after which each method has reached an error.

    tests/bench/methods.py build/release/tomales FOLDER [--scenes cornell interior pool glass ring lamps leaves] [--bounces 4] [--size 48]
                           [--budget 180s] [--errors 10 5 2]

FOLDER gets the scenes and the pages. Measurements are kept there, so the same command continues where it stopped.
"""
import argparse
import json
import math
import pathlib
import random
import subprocess
import sys

import many_lights

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "tests/cli"))
import caustic_scenes  # noqa: E402

LAMPS = 1000
LEAVES, LONG, WIDE, BALL = 8000, 0.12, 0.07, 1.6  # metres; the ball's radius


def unit(rng):
    z, turn = rng.uniform(-1, 1), rng.uniform(0, 2 * math.pi)
    r = math.sqrt(1 - z * z)
    return r * math.cos(turn), r * math.sin(turn), z


def cross(a, b):
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


def leaf(rng):
    """Returns the corners of a rhombus at a random place in the ball, turned at random."""
    along, other = unit(rng), unit(rng)
    across = cross(along, other)
    length = math.sqrt(sum(x * x for x in across))
    distance, toward = BALL * rng.random() ** (1 / 3), unit(rng)
    middle = [distance * x for x in toward]
    middle[1] += 1.2 * BALL
    ends = [LONG / 2 * x for x in along], [WIDE / 2 * x / length for x in across]
    return [[m + s * e for m, e in zip(middle, end)] for end, s in ((ends[0], 1), (ends[1], 1), (ends[0], -1), (ends[1], -1))]


def leaves():
    rng = random.Random(1)
    points = " ".join(f"{x:.4f}" for _ in range(LEAVES) for corner in leaf(rng) for x in corner)
    return f"""Display "leaves.exr" "openexr" "rgb"
PixelSamples 3 3
Projection "perspective" "fov" [40]
Translate 0 -1.7 5.5
WorldBegin
Attribute "light" "shadows" "on"
LightSource "distantlight" "sun" "from" [1 2 -1.5] "to" [0 0 0]
LightSource "indirectlight" "bounce" "float samples" [256]
Surface "matte"
Color 0.5 0.45 0.4
Polygon "P" [-20 0 -20  -20 0 20  20 0 20  20 0 -20]
Color 0.3 0.6 0.2
PointsPolygons [{"4 " * LEAVES}] [{" ".join(str(k) for k in range(4 * LEAVES))}] "P" [{points}]
WorldEnd
"""


def written(folder, name, text):
    path = folder / f"{name}.rib"
    path.write_text(text)
    return path


def scene_file(name, folder, size):
    if name in ("cornell", "interior"):
        return ROOT / "scenes" / name / f"{name}.rib"
    if name == "lamps":
        return written(folder, name, many_lights.scene("area", LAMPS, 32, "lamps.exr", size, True))
    return written(folder, name, leaves() if name == "leaves" else caustic_scenes.text(name))


def seconds_to(points, error):
    """Returns the CPU seconds at which a curve first has the error. They are interpolated in logarithms between the first point
    that has the error and the point before it."""
    best, before = None, None
    for p in points:
        e, s = max(p["mean_absolute_relative_error"], 1e-9), p["cpu_s"]
        if e <= error:
            if before and before[0] > error and before[1] < s:
                s *= (before[1] / s) ** (math.log(error / e) / math.log(before[0] / e))
            best = s if best is None else min(best, s)
        before = e, p["cpu_s"]
    return best


def chart(program, folder, name, arguments):
    page = folder / f"{name}_{arguments.bounces}.html"
    width, height = arguments.size, round(arguments.size * 9 / 16) if name == "interior" else arguments.size
    scene = scene_file(name, folder, arguments.size)
    subprocess.run([program, "chart", scene, "-o", page, "--format", f"{width}x{height}", "--bounces", str(arguments.bounces), "--budget", arguments.budget,
                    "--cache", folder / "cache", "-t", "1"], cwd=folder, stdout=subprocess.DEVNULL)
    return json.loads(page.with_suffix(".json").read_text())


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("folder")
    parser.add_argument("--scenes", nargs="+", default=["cornell", "interior", *caustic_scenes.SCENES, "lamps", "leaves"])
    parser.add_argument("--bounces", type=int, default=4)
    parser.add_argument("--size", type=int, default=48)
    parser.add_argument("--budget", default="180s")
    parser.add_argument("--errors", nargs="+", type=float, default=[10, 5, 2])
    arguments = parser.parse_args()
    folder = pathlib.Path(arguments.folder).resolve()
    folder.mkdir(exist_ok=True)
    for name in arguments.scenes:
        report = chart(pathlib.Path(arguments.program).resolve(), folder, name, arguments)
        print(f"{name}: noise of the reference {100 * report['reference']['noise_floor']:.2g} %")
        for method in dict.fromkeys(p["method"] for p in report["points"]):
            points = [p for p in report["points"] if p["method"] == method]
            found = [seconds_to(points, error / 100) for error in arguments.errors]
            least = min(points, key=lambda p: p["mean_absolute_relative_error"])
            print(f"  {method:22}", *(f"{s:7.2f}" if s else "      -" for s in found),
                  f"  least {100 * least['mean_absolute_relative_error']:.2f} % in {least['cpu_s']:.2f} s", flush=True)


if __name__ == "__main__":
    main()
