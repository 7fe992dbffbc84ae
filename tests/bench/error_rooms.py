"""Measures how accurate the error is that `tomales render --audit` states, on rooms of tests/stability and random rooms, against
many paths at every pixel.

    tests/bench/error_rooms.py build/release/tomales [--rooms box_ball hot_spot random1 random2] [--seeds 5] [--size 32] [--paths 2048] [-t 1]
                               [--settings "--samples 150" "--samples 600 --max-error 2"]

It writes the rows of the table in docs/measured/error.md. The truth is the mean of two pictures by `--gi reference`. Its own
noise, which is half of their difference, is subtracted from squared errors. hot_spot gets four times the paths. With settings of
`--gi none` direct light is compared, against 1024 light samples. Otherwise indirect light alone is compared, so that its error is
the error of the picture.
"""
import argparse
import json
import math
import pathlib
import random
import shlex
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).parents[2]
LABORATORY = ROOT / "tests/stability/irradiance_cache"
sys.path.insert(0, str(ROOT / "tests/image"))
from pictures import pixels  # noqa: E402

ROOMS = ["box_ball", "lamp_slot", "thin_blades", "contact", "hot_spot"] + [f"random{i}" for i in range(1, 7)]
SETTINGS = ["--samples 150", "--samples 600 --max-error 2"]
MORE_PATHS = {"hot_spot": 4}
FLOOR = 0.01


def box(low, high):
    (a, b, c), (d, e, f) = low, high
    faces = [(a, b, c, a, b, f, a, e, f, a, e, c), (d, b, c, d, e, c, d, e, f, d, b, f), (a, b, c, d, b, c, d, b, f, a, b, f),
             (a, e, c, a, e, f, d, e, f, d, e, c), (a, b, c, a, e, c, d, e, c, d, b, c), (a, b, f, d, b, f, d, e, f, a, e, f)]
    return "".join("Polygon \"P\" [%s]\n" % " ".join(f"{v:.4f}" for v in face) for face in faces)


def random_room(seed):
    """Returns the RIB of a room with boxes and balls, lit by one to three lamps. The camera looks in from somewhere in front of the open side."""
    r = random.Random(seed)
    width, height, depth = r.uniform(2, 5), r.uniform(2, 3.5), r.uniform(2, 5)

    def color(low=0.2, high=0.85):
        return "Color %.3f %.3f %.3f\n" % tuple(r.uniform(low, high) for _ in range(3))

    lamps = ""
    for i in range(r.randint(1, 3)):
        x, y, z = r.uniform(0.2, 0.8) * width, r.uniform(0.6, 0.95) * height, r.uniform(0.2, 0.9) * depth
        to = [r.uniform(0, 1) * width, r.choice([0, height]), r.uniform(0.3, 1) * depth]
        if i == 0 or r.random() < 0.4:
            lamps += f'LightSource "pointlight" {i + 1} "from" [{x:.3f} {y:.3f} {z:.3f}] "intensity" [{r.uniform(0.5, 4):.3f}]\n'
        else:
            lamps += (f'LightSource "spotlight" {i + 1} "from" [{x:.3f} {y:.3f} {z:.3f}] "to" [{to[0]:.3f} {to[1]:.3f} {to[2]:.3f}] '
                      f'"intensity" [{r.uniform(5, 20):.3f}] "coneangle" [{r.uniform(0.2, 0.8):.3f}] "conedeltaangle" [0.1]\n')
    things = ""
    for _ in range(r.randint(2, 6)):
        size = r.uniform(0.06, 0.18) * min(width, height, depth)
        x, z = r.uniform(size, width - size), r.uniform(0.3 * depth, depth - size)
        y = r.choice([0, r.uniform(0, 0.5) * height])
        shape = f"TransformBegin Translate 0 {size} 0 Sphere {size:.3f} {-size:.3f} {size:.3f} 360 TransformEnd\n" if r.random() < 0.4 else box(
            (-size, 0, -size), (size, 2 * size * r.uniform(0.5, 2), size))
        things += (f"AttributeBegin\n{color()}Translate {x:.3f} {y:.3f} {z:.3f} Rotate {r.uniform(0, 90):.1f} 0 1 0\n{shape}AttributeEnd\n")
    eye = (r.uniform(0.3, 0.7) * width, r.uniform(0.3, 0.7) * height)
    walls = [(0, 0, 0, 0, 0, depth, width, 0, depth, width, 0, 0), (0, height, 0, width, height, 0, width, height, depth, 0, height, depth),
             (0, 0, depth, 0, height, depth, width, height, depth, width, 0, depth), (0, 0, 0, 0, height, 0, 0, height, depth, 0, 0, depth),
             (width, 0, 0, width, 0, depth, width, height, depth, width, height, 0)]
    room = "".join(color(0.4, 0.85) + "Polygon \"P\" [%s]\n" % " ".join(f"{v:.4f}" for v in w) for w in walls)
    return (f'Format 48 48 1\nPixelFilter "box" 1 1\nProjection "perspective" "fov" [{r.uniform(45, 65):.1f}]\nDisplay "room.exr" "file" "rgba"\n'
            f'Rotate {r.uniform(-12, 12):.1f} 0 1 0\nTranslate {-eye[0]:.3f} {-eye[1]:.3f} {r.uniform(0.5, 1.5):.3f}\nWorldBegin\n'
            f'LightSource "indirectlight" "gi" "float samples" [600]\n{lamps}Surface "matte"\n{room}{things}WorldEnd\n')


class Rooms:
    def __init__(self, tomales, folder, size, threads="1"):
        self.tomales, self.folder, self.size, self.threads = tomales, pathlib.Path(folder), size, str(threads)

    def scene(self, room):
        if not room.startswith("random"):
            return LABORATORY / f"{room}.rib"
        path = self.folder / f"{room}.rib"
        path.write_text(random_room(int(room.removeprefix("random"))))
        return path

    def render(self, room, *arguments):
        """Returns the picture, and what the audit says if there is one."""
        out, stats = self.folder / "picture.exr", self.folder / "stats.json"
        subprocess.run([self.tomales, "render", self.scene(room), "-q", "-t", self.threads, *self.light(arguments), "--format", f"{self.size}x{self.size}",
                        "--pixel-samples", "2x2", "-o", out, "--stats", stats, *arguments], check=True)
        return pixels(out), json.loads(stats.read_text()).get("audit")

    @staticmethod
    def light(arguments):
        return [] if "none" in arguments else ["--indirect-only"]

    def truth(self, room, paths, direct=False):
        """Returns two pictures with different random numbers."""
        count = str(paths * MORE_PATHS.get(room, 1))
        method = ["--gi", "none", "--light-samples", "1024"] if direct else ["--gi", "reference", "--ray-geometry", "scene", "--samples", count]
        return [self.render(room, *method, "--light-seed", str(1000 + i))[0] for i in range(2)]


def true_error(picture, truth):
    """Returns the mean relative error, and the noise of the truth that has been subtracted."""
    error = noise = count = 0
    for xy, a in truth[0].items():
        b = truth[1][xy]
        if max(a[:3]) == 0 and max(b[:3]) == 0:
            continue
        for c in range(3):
            right = (a[c] + b[c]) / 2
            error += abs(picture[xy][c] - right) / (right + FLOOR)
            noise += abs(a[c] - b[c]) / 2 / (right + FLOOR)
            count += 1
    return math.sqrt(max(0, error ** 2 - noise ** 2)) / count, noise / count


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("tomales", type=lambda p: pathlib.Path(p).resolve())
    parser.add_argument("--rooms", nargs="+", default=ROOMS)
    parser.add_argument("--settings", nargs="+", default=SETTINGS)
    parser.add_argument("--seeds", type=int, default=5)
    parser.add_argument("--size", type=int, default=32)
    parser.add_argument("--paths", type=int, default=2048)
    parser.add_argument("-t", dest="threads", default="1")
    given = parser.parse_args()
    trials = near = far = covered = 0
    print("| room | settings | true, % | noise of the truth, % | stated, % | covered | paths |\n|---|---|---|---|---|---|---|", flush=True)
    with tempfile.TemporaryDirectory() as folder:
        rooms = Rooms(given.tomales, folder, given.size, given.threads)
        for room in given.rooms:
            truths = {}
            for settings in given.settings:
                kind = "direct" if "none" in shlex.split(settings) else "indirect"
                truth = truths[kind] = truths.get(kind) or rooms.truth(room, given.paths, kind == "direct")
                trues, stated, inside, paths = [], [], 0, 0
                for seed in range(1, given.seeds + 1):
                    picture, audit = rooms.render(room, "--audit", "--light-seed", str(seed), *shlex.split(settings))
                    true, noise = true_error(picture, truth)
                    said = audit[kind]
                    trues.append(true), stated.append(said["mean"])
                    inside += said["low"] <= true <= said["high"]
                    ratio = max(said["mean"], 1e-9) / max(true, 1e-9)
                    trials, near, far = trials + 1, near + (1 / 1.5 <= ratio <= 1.5), far + (ratio > 2 or ratio < 0.5)
                    paths = max(paths, audit["paths"])
                covered += inside

                def percents(values):
                    return " ".join(f"{100 * v:.2f}" for v in values)
                print(f"| {room} | {settings} | {percents(trues)} | {100 * noise:.2f} | {percents(stated)} | {inside} of {given.seeds} | {paths} |", flush=True)
    print(f"\n{trials} trials: within 1.5 times of the truth {100 * near / trials:.0f} %, beyond 2 times {100 * far / trials:.0f} %, "
          f"the interval covers {100 * covered / trials:.0f} %")


if __name__ == "__main__":
    main()
