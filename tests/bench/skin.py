"""Figure 4 of "An Approximate Global Illumination System" again (scenes/skin): rays against coarse polygons, with the hit list and
without, compared with rays against all displaced micropolygons.
    skin.py TOMALES [FOLDER to keep the pictures in] [further arguments of each render]"""
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

tomales = sys.argv[1]
keep = pathlib.Path(sys.argv[2]) if len(sys.argv) > 2 else None
further = sys.argv[3:]


def render(name, *arguments):
    with tempfile.TemporaryDirectory() as folder:
        out = (keep or pathlib.Path(folder)) / f"{name}.exr"
        stats = out.with_suffix(".json")
        subprocess.run([tomales, "render", root / "scenes/skin/skin.rib", *arguments, *further, "-o", out, "--stats", stats, "-q"], check=True)
        figures = json.loads(stats.read_text())
        trace, cache = figures["raytrace"], figures["geometry_cache"]
        print(f"{name}: {trace['coarse_polygons']} polygons in {trace['bytes'] / 1e6:.1f} MB, {cache['fine_polygons']} fine ones of which the cache "
              f"held {cache['bytes'] / 1e6:.1f} MB (hit rate {cache['hit_rate']:.4f}), {figures['cpu_s']:.0f} CPU s")
        return {key: 0.2126 * p[0] + 0.7152 * p[1] + 0.0722 * p[2] for key, p in pixels(out).items()}


full = render("full", "--ray-geometry", "full", "--geometry-cache", "300M")
size = max(x for x, _ in full) + 1
ball = [(x, y) for x, y in full if (x - 0.5 * size) ** 2 + (y - 0.487 * size) ** 2 < (0.36 * size) ** 2]
for name, arguments in (("on", []), ("off", ["--no-hit-list"])):
    picture = render(name, *arguments)
    errors = {k: abs(picture[k] - full[k]) / (full[k] + 1e-3) for k in full}
    closed = [errors[k] for k in ball]
    print(f"{name}: mean absolute relative error {100 * statistics.fmean(errors.values()):.2f} %, on the surface {100 * statistics.fmean(closed):.2f} %; "
          f"{sum(e > 0.5 for e in closed)} of its {len(closed)} pixels wrong by more than half, the worst by {100 * max(closed):.0f} %")
