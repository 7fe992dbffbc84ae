"""Measures what coarse ray geometry costs and saves (docs/measured/rays.md). scenes/film has ray-traced shadows at each rate of Attribute "trace"
"tessellation", and is compared with rays that meet its displacement as polygons of half a pixel.
    tessellation.py TOMALES [--truth FILE.exr of an earlier run] [--chart FILE.svg]"""
import argparse
import json
import math
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
parser.add_argument("--chart")
a = parser.parse_args()

DEFAULT = 1
RATES = 8, 4, 2, 1, 0.5, 0.25, 0.125


def render(folder, tessellation, displacements, pixels, *further):
    rates = folder / "rates.rib"
    rates.write_text(f'Attribute "trace" "float tessellation" [{tessellation}] "int displacements" [{displacements}]\n')
    scene = folder / "scene.rib"
    scene.write_text(re.sub(r'Attribute "trace" .*\n', "", pathlib.Path(a.scene).read_text()))  # The film sets its own rates.
    out, stats = folder / "out.exr", folder / "stats.json"
    subprocess.run([a.tomales, "render", rates, scene, "--format", pixels, *further, "-o", out, "--stats", stats, "-q", "-t", "1"], check=True, cwd=folder)
    return out, json.loads(stats.read_text())


def error(picture, truth):
    out = subprocess.run([a.tomales, "compare", picture, truth], check=True, capture_output=True, text=True).stdout
    return float(re.search(r"mean_absolute_relative_error\s+(\S+)", out).group(1))


def chart(rows, path):
    """Draws error against memory. Each rate has a dot, and the default's is filled."""
    width, height, margin = 560, 300, 50
    most_mb, least_mb = max(mb for _, mb, _ in rows), min(mb for _, mb, _ in rows)
    most = max(wrong for _, _, wrong in rows)
    least = min(wrong for _, _, wrong in rows)
    at = [(margin + (width - 2 * margin) * math.log(mb / least_mb) / math.log(most_mb / least_mb),
           margin + (height - 2 * margin) * (most - wrong) / (most - least)) for _, mb, wrong in rows]
    line = " ".join(f"{x:.1f},{y:.1f}" for x, y in at)
    dots = "".join(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="5" fill="{"#3070b0" if rate == DEFAULT else "white"}" stroke="#3070b0"/>'
                   f'<text x="{x:.1f}" y="{y - 10:.1f}">{rate}</text>' for (x, y), (rate, _, _) in zip(at, rows))
    bottom = height - margin + 28
    pathlib.Path(path).write_text(
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" font-family="sans-serif" font-size="12" text-anchor="middle">'
        f'<rect width="{width}" height="{height}" fill="white"/><polyline points="{line}" fill="none" stroke="#3070b0"/>{dots}'
        f'<text x="{margin}" y="{bottom}">{least_mb:.1f} MB</text><text x="{width - margin}" y="{bottom}">{most_mb:.1f} MB</text>'
        f'<text x="{width / 2}" y="{bottom}">geometry and BVH</text>'
        f'<text x="26" y="{margin + 4}">{100 * most:.2f} %</text><text x="26" y="{height - margin + 4}">{100 * least:.2f} %</text>'
        f'<text x="{width / 2}" y="20">mean absolute relative error; rates of Attribute "trace" "tessellation", the default filled</text></svg>\n')


with tempfile.TemporaryDirectory() as name:
    folder = pathlib.Path(name)
    truth = a.truth
    if not truth:
        truth = folder / "truth.exr"
        render(folder, 32, 1, a.format, "--gi", "none")[0].rename(truth)
    print("| rate | coarse polygons | geometry and BVH | error | million rays a CPU second, their hits shaded |\n|---|---|---|---|---|")
    rows = []
    for rate in RATES:
        picture, stats = render(folder, rate, 0, a.format, "--gi", "none")
        wrong = error(picture, truth)
        few, many = (render(folder, rate, 0, "228x138", "--gi", "gather", "--samples", str(n))[1] for n in (64, 512))
        rays = sum(many["rays"][kind] - few["rays"][kind] for kind in ("gather", "transmission"))
        print(f"| {rate} | {stats['raytrace']['coarse_polygons']:,} | {stats['raytrace']['bytes'] / 1e6:.1f} MB | {100 * wrong:.2f} % "
              f"| {rays / (many['cpu_s'] - few['cpu_s']) / 1e6:.2f} |", flush=True)
        rows.append((rate, stats["raytrace"]["bytes"] / 1e6, wrong))
    if a.chart:
        chart(rows, a.chart)
