"""Repeats figure 4 of "An Approximate Global Illumination System". It compares rays that meet coarse polygons, with the hit list and with a bias
alone, with rays that meet all displaced micropolygons. Only pixels on the ball count as "on the surface", because the shadow of a coarse ball around
it has another shape.
    hit_list.py TOMALES [--scene soft|skin] [--keep FOLDER for the pictures] [further arguments of each render]"""
import argparse
import json
import pathlib
import statistics
import subprocess
import sys
import tempfile

root = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(root / "tests/image"))
sys.dont_write_bytecode = True
from pictures import pixels  # noqa: E402

# The centre and radius of the ball are in picture heights.
SCENES = {"soft": ("scenes/displaced/soft.rib", (0.5, 0.45), 0.3), "skin": ("scenes/skin/skin.rib", (0.5, 0.487), 0.36)}

parser = argparse.ArgumentParser()
parser.add_argument("tomales")
parser.add_argument("--scene", choices=SCENES, default="soft")
parser.add_argument("--keep", type=pathlib.Path)
a, further = parser.parse_known_args()
scene, center, radius = SCENES[a.scene]


def render(name, *arguments):
    with tempfile.TemporaryDirectory() as folder:
        out = (a.keep or pathlib.Path(folder)) / f"{name}.exr"
        stats = out.with_suffix(".json")
        subprocess.run([a.tomales, "render", root / scene, *arguments, *further, "-o", out, "--stats", stats, "-q"], check=True)
        figures = json.loads(stats.read_text())
        trace, cache = figures["raytrace"], figures["geometry_cache"]
        print(f"{name}: {trace['coarse_polygons']} polygons in {trace['bytes'] / 1e6:.1f} MB, {cache['fine_polygons']} fine ones of which the cache "
              f"held {cache['bytes'] / 1e6:.1f} MB (hit rate {cache['hit_rate']:.4f}), {figures['cpu_s']:.0f} CPU s", flush=True)
        return {key: 0.2126 * p[0] + 0.7152 * p[1] + 0.0722 * p[2] for key, p in pixels(out).items()}


full = render("full", "--ray-geometry", "full", "--geometry-cache", "300M")
size = max(y for _, y in full) + 1
ball = [(x, y) for x, y in full if (x / size - center[0]) ** 2 + (y / size - center[1]) ** 2 < radius**2]
for name, arguments in (("on", []), ("off", ["--no-hit-list"])):
    picture = render(name, *arguments)
    errors = {k: abs(picture[k] - full[k]) / (full[k] + 0.01) for k in full}  # The error is defined as in docs/chart.md.
    closed = [errors[k] for k in ball]
    print(f"{name}: mean absolute relative error {100 * statistics.fmean(errors.values()):.2f} %, on the surface {100 * statistics.fmean(closed):.2f} %; "
          f"{sum(e > 0.5 for e in closed)} of its {len(closed)} pixels wrong by more than half, the worst by {100 * max(closed):.0f} %", flush=True)
