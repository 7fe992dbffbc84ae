"""Compares error functions of the irradiance cache at equal numbers of records (docs/measured/irradiance_cache.md), for indirect light alone, with
two gathers at every point.
    placement.py TOMALES [--scenes flush_box spot_room box_ball contact grazing] [--size 128] [--samples 1600] [--truth 3000] [--crop X0,X1,Y0,Y1] [--keep FOLDER]
Corners are pixels whose hemisphere is open to less than 97 % within 0.12 units. `screen` has the records that it asks for at
maxerror 1, and the others have the same number."""
import argparse
import json
import math
import pathlib
import subprocess
import sys
import tempfile

TESTS = pathlib.Path(__file__).resolve().parents[1]
sys.path.insert(0, str(TESTS / "image"))
from pictures import pixels  # noqa: E402

NEAR, OPEN = 0.12, 0.97
FOLDERS = (TESTS / "bench" / "placement", TESTS / "stability" / "irradiance_cache")
FUNCTIONS = ("screen", "plain", "ward", "split", "hessian")

parser = argparse.ArgumentParser()
parser.add_argument("tomales")
parser.add_argument("--scenes", nargs="+", default=["flush_box", "spot_room", "box_ball", "contact", "grazing"])
parser.add_argument("--functions", nargs="+", default=FUNCTIONS)
parser.add_argument("--size", type=int, default=128)
parser.add_argument("--samples", type=int, default=1600)
parser.add_argument("--truth", type=int, default=3000)
parser.add_argument("--crop", default="0,1,0,1")
parser.add_argument("--records", type=int, default=0, help="instead of those of screen")
parser.add_argument("--keep", type=pathlib.Path, help="pictures stay there, and truths (SCENE_truth1.exr, SCENE_truth2.exr) that are there are used")
parser.add_argument("-t", default="2")
options = parser.parse_args()


def render(scene, out, *arguments):
    """Renders and returns the number of records."""
    stats = out.with_suffix(".json")
    subprocess.run([options.tomales, "render", scene, "-q", "--format", f"{options.size}x{options.size}", "--pixel-samples", "2x2", "--crop", options.crop, "-t", options.t,
                    "-o", out, "--stats", stats, *map(str, arguments)], check=True)
    return json.loads(stats.read_text())["irradiance_cache"]["samples"]


def gather(scene, out, function, max_error):
    return render(scene, out, "--gi", "gather", "--indirect-only", "--samples", options.samples, "--error-function", function, "--max-error", max_error)


def with_as_many(scene, out, function, records):
    """Returns maxerror and the number of records, which is within 1 % of the wanted number, or as near as possible."""
    low, high, at = math.log(0.05), math.log(20), 0.0
    tries = []
    for step in range(12):
        made = gather(scene, out, function, math.exp(at))
        tries.append((abs(made - records), at, made))
        if abs(made - records) <= 0.01 * records:
            break
        low, high = (at, high) if made > records else (low, at)
        guess = at + math.log(made / records) / 1.2  # The number of records is about proportional to maxerror to the power of -1.2.
        at = guess if step < 8 and low < guess < high else (low + high) / 2
    _, nearest, made = min(tries)
    if (nearest, made) != tries[-1][1:]:
        gather(scene, out, function, math.exp(nearest))  # This makes its picture.
    return math.exp(nearest), made


def corners_of(scene, folder):
    """Returns the pixels beside other geometry."""
    text = scene.read_text()
    begin = text.index('LightSource "indirectlight"')
    open_scene = folder / f"{scene.stem}_open.rib"
    light = f'LightSource "occlusionlight" "open" "float samples" [256] "float maxdist" [{NEAR}] "float maxvariation" [0]'
    plain = "\n".join(line for line in (text[:begin] + light + text[text.index("\n", begin):]).splitlines() if "AreaLightSource" not in line
                      and "spotlight" not in line and "Illuminate" not in line and "Color" not in line)
    open_scene.write_text(plain)
    picture = folder / f"{scene.stem}_open.exr"
    render(open_scene, picture)
    return {xy for xy, color in pixels(picture).items() if color[1] < OPEN}


def rms(squares):
    """Returns the rms error. The squares are products of the differences from two truths, so the truths' noise does not bias their mean."""
    return math.sqrt(max(0, sum(squares) / max(len(squares), 1)))


def describe(seen, truths, corners, mean):
    truth = {xy: [(a + b) / 2 for a, b in zip(truths[0][xy][:3], truths[1][xy][:3])] for xy in truths[0] if xy in truths[1]}
    squares = {xy: sum((s - a) * (s - b) for s, a, b in zip(seen[xy][:3], truths[0][xy][:3], truths[1][xy][:3])) / 3 / mean ** 2 for xy in truth}
    relative = sorted(abs(a - b) / (b + 0.01) for xy in truth for a, b in zip(seen[xy][:3], truth[xy]))
    parts = {"rms": squares, "outside corners": squares.keys() - corners, "in corners": squares.keys() & corners}
    text = ", ".join(f"{part} {100 * rms([squares[xy] for xy in places]):5.2f} %" for part, places in parts.items())
    return (f"mean {100 * sum(relative) / len(relative):5.2f} %, p99 {100 * relative[int(0.99 * len(relative))]:5.1f} %, {text}, worst pixel "
            f"{100 * math.sqrt(max(squares.values())):4.0f} % ({len(parts['in corners'])} of {len(squares)} pixels in corners)")


def truth_of(scene, folder, seed):
    """Returns the truth inside the crop."""
    picture = folder / f"{scene.stem}_truth{seed}.exr"
    if not picture.exists():
        render(scene, picture, "--gi", "gather", "--indirect-only", "--max-error", 0, "--samples", options.truth, "--light-seed", seed)
    return {xy: color for xy, color in pixels(picture).items() if max(color[:3]) > 0}


def report(scene, folder):
    truths = [truth_of(scene, folder, seed) for seed in (1, 2)]
    emission = folder / f"{scene.stem}_emission.exr"
    render(scene, emission, "--gi", "none", "--indirect-only")
    corners, lamps = corners_of(scene, folder), pixels(emission)
    mean = sum(sum(c[:3]) - sum(lamps[xy][:3]) for xy, c in truths[0].items()) / (3 * len(truths[0]))
    records = options.records
    for function in options.functions:
        out = folder / f"{scene.stem}_{function}.exr"
        max_error, made = with_as_many(scene, out, function, records) if records else (1, gather(scene, out, function, 1))
        records = records or made
        print(f"{scene.stem:<10} {function:<8} maxerror {max_error:5.3f} {made:6} records, {describe(pixels(out), truths, corners, mean)}", flush=True)


with tempfile.TemporaryDirectory() as name:
    folder = options.keep or pathlib.Path(name)
    folder.mkdir(parents=True, exist_ok=True)
    for name in options.scenes:
        report(next(f / f"{name}.rib" for f in FOLDERS if (f / f"{name}.rib").exists()), folder)
