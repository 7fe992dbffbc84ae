"""Measures what each amendment of the irradiance cache (gi/cache/amendments/switches.h) improves and costs. Each one is switched
off alone, over the scenes of tests/stability/irradiance_cache and cornell.
    amendments.py TOMALES [--size 48] [--samples 200] [--scenes ...] [--without ...] [--error-function screen] [--keep FOLDER] [-t 1]
Indirect light is compared with a gather at every point with six times the rays. Each row has the mean error, the error of the
worst window of 8 x 8 pixels, the share of pixels that should be black but get light, records and CPU seconds. Flicker is that of
tests/stability/flicker_test.py on fixed points, for box_ball alone."""
import argparse
import json
import os
import pathlib
import re
import statistics
import subprocess
import sys
import tempfile

TESTS = pathlib.Path(__file__).resolve().parents[1]
sys.path.insert(0, str(TESTS / "image"))
from pictures import pixels  # noqa: E402

LABORATORY = TESTS / "stability" / "irradiance_cache"
NAMES = re.findall(r'"([a-z-]+)"', re.search(r"kAmendments = \{(.*?)\}", (TESTS.parent / "gi/cache/amendments/switches.h").read_text(), re.S)[1])
FLOOR, WINDOW = 0.01, 8

parser = argparse.ArgumentParser()
parser.add_argument("tomales", type=pathlib.Path)
parser.add_argument("--size", type=int, default=48)
parser.add_argument("--samples", type=int, default=200)
parser.add_argument("--seeds", type=int, default=4, help="light seeds that are averaged")
parser.add_argument("--no-flicker", action="store_true")
parser.add_argument("--scenes", nargs="+", default=[*sorted(f.stem for f in LABORATORY.glob("*.rib")), "cornell"])
parser.add_argument("--without", nargs="+", default=["nothing", *NAMES])
parser.add_argument("--error-function", default="screen")
parser.add_argument("--keep", type=pathlib.Path, help="truths stay there, and those that are there are used")
parser.add_argument("-t", default="1")
options = parser.parse_args()
options.tomales = options.tomales.resolve()


def render(folder, scene, without, *arguments):
    rib = LABORATORY / f"{scene}.rib" if scene != "cornell" else TESTS.parent / "scenes/cornell/cornell.rib"
    out, stats = folder / "picture.exr", folder / "stats.json"
    subprocess.run([options.tomales, "render", rib, "-q", "--gi", "gather", "--indirect-only", "--format", f"{options.size}x{options.size}", "--pixel-samples", "2x2",
                    "-t", options.t, "-o", out, "--stats", stats, *map(str, arguments)], check=True, env={**os.environ, "TOMALES_WITHOUT": without}, cwd=folder)
    return pixels(out), json.loads(stats.read_text())


def truth_of(folder, scene):
    kept = folder / f"{scene}_{options.size}_{options.samples}.exr"
    if not kept.exists():
        render(folder, scene, "", "--max-error", 0, "--samples", 6 * options.samples, "--light-seed", 1)
        (folder / "picture.exr").rename(kept)
    return pixels(kept)


def figures(picture, truth):
    windows, errors, dark = {}, [], []
    for (x, y), color in truth.items():
        if max(color[:3]) <= 0:
            dark.append(max(picture[x, y][:3]) > 1e-4)
            continue
        errors += [abs(p - t) / (t + FLOOR) for p, t in zip(picture[x, y][:3], color[:3])]
        sums = windows.setdefault((x // WINDOW, y // WINDOW), [0, 0])
        sums[0] += sum(picture[x, y][:3])
        sums[1] += sum(color[:3])
    return (100 * sum(errors) / len(errors), max(100 * abs(p - t) / (t + FLOOR) for p, t in windows.values()), 100 * sum(dark) / max(1, len(dark)))


def flicker(without):
    said = subprocess.run([sys.executable, TESTS / "stability/flicker_test.py", options.tomales, "32", "128", "4", "--moves", "camera", "--truth", "0", "--", "--error-function",
                           options.error_function], check=False, capture_output=True, text=True, env={**os.environ, "TOMALES_WITHOUT": without}).stdout
    return re.search(r"own caches: flicker ([0-9.]+) %", said)[1]


with tempfile.TemporaryDirectory() as name:
    folder = options.keep or pathlib.Path(name)
    folder.mkdir(parents=True, exist_ok=True)
    truths = {scene: truth_of(folder, scene) for scene in options.scenes}
    for without in options.without:
        for scene, truth in truths.items():
            rows = []
            for seed in range(2, 2 + options.seeds):  # Seed 1 is the seed of the truth.
                picture, stats = render(folder, scene, without, "--samples", options.samples, "--error-function", options.error_function, "--light-seed", seed)
                rows.append((*figures(picture, truth), stats["irradiance_cache"]["samples"], stats["cpu_s"]))
            print("without %-13s %-12s mean %5.2f %%, worst window %5.1f %%, black that gets light %5.2f %%, %5.0f records, %.2f CPU s" %
                  (without, scene, *map(statistics.fmean, zip(*rows))), flush=True)
        if not options.no_flicker:
            print(f"without {without:<13} flicker {flicker(without)} %", flush=True)
