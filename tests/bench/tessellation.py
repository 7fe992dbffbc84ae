"""What coarse ray geometry costs and brings (docs/performance.md): scenes/film with its shadows by rays at each rate of Attribute "trace"
"tessellation", against rays that meet its displacement at half a pixel a polygon.
    tessellation.py TOMALES [--truth FILE.exr: of an earlier run]"""
import argparse
import json
import pathlib
import re
import subprocess
import tempfile

root = pathlib.Path(__file__).resolve().parents[2]
parser = argparse.ArgumentParser()
parser.add_argument("tomales")
parser.add_argument("--scene", default=str(root / "scenes/film/film.rib"))
parser.add_argument("--format", default="914x551")
parser.add_argument("--truth")
a = parser.parse_args()

RATES = 8, 4, 2, 1, 0.5, 0.25, 0.125


def render(folder, tessellation, displacements, pixels, *further):
    rates = folder / "rates.rib"
    rates.write_text(f'Attribute "trace" "float tessellation" [{tessellation}] "int displacements" [{displacements}]\n')
    out, stats = folder / "out.exr", folder / "stats.json"
    subprocess.run([a.tomales, "render", rates, a.scene, "--format", pixels, *further, "-o", out, "--stats", stats, "-q", "-t", "1"], check=True, cwd=folder)
    return out, json.loads(stats.read_text())


def error(picture, truth):
    out = subprocess.run([a.tomales, "compare", picture, truth], check=True, capture_output=True, text=True).stdout
    return float(re.search(r"mean_absolute_relative_error\s+(\S+)", out).group(1))


with tempfile.TemporaryDirectory() as name:
    folder = pathlib.Path(name)
    truth = a.truth
    if not truth:
        truth = folder / "truth.exr"
        render(folder, 32, 1, a.format, "--gi", "none")[0].rename(truth)
    print("| rate | coarse polygons | geometry and BVH | error | million rays a CPU second, their hits shaded |\n|---|---|---|---|---|")
    for rate in RATES:
        picture, stats = render(folder, rate, 0, a.format, "--gi", "none")
        wrong = error(picture, truth)
        few, many = (render(folder, rate, 0, "228x138", "--gi", "gather", "--samples", str(n))[1] for n in (64, 512))
        rays = sum(many["rays"][kind] - few["rays"][kind] for kind in ("gather", "transmission"))
        print(f"| {rate} | {stats['raytrace']['coarse_polygons']:,} | {stats['raytrace']['bytes'] / 1e6:.1f} MB | {100 * wrong:.2f} % "
              f"| {rays / (many['cpu_s'] - few['cpu_s']) / 1e6:.2f} |", flush=True)
