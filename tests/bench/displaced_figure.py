"""The figure 4 of "An Approximate Global Illumination System" (docs/performance.md): a ball of two million displaced micropolygons in soft light, whose
rays meet four thousand coarse polygons, with the hit list and with a bias alone, against rays that meet all of the displacement.
    displaced_figure.py TOMALES [--keep FOLDER: for the pictures]
Error: |test - truth| / (truth + 0.01) of luminance. The ball is the closed surface; on the floor the contact shadow is another shape."""
import argparse
import json
import pathlib
import statistics
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "image"))
from pictures import pixels  # noqa: E402

parser = argparse.ArgumentParser()
parser.add_argument("tomales")
parser.add_argument("--keep")
a = parser.parse_args()

SIZE = 600
FINE, COARSE = 23.0, 1.02  # Attribute "trace" "tessellation"
SCENE = f"""
Format {SIZE} {SIZE} 1
PixelSamples 4 4
PixelFilter "box" 1 1
Projection "perspective" "fov" [32]
Clipping 0.1 100
Translate 0 0.1 4.6
Rotate -12 1 0 0
WorldBegin
LightSource "indirectlight" "gi" "float samples" [256]
AttributeBegin
AreaLightSource "arealight" "lamp" "float intensity" [4] "float samples" [64]
Patch "bilinear" "P" [-2.8 2.4 -2  -0.4 2.4 -2  -2.8 2.4 0.4  -0.4 2.4 0.4]
AttributeEnd
Illuminate "lamp" 1
Surface "matte"
Color 0.7 0.7 0.7
Polygon "P" [-4 -1 -4  -4 -1 4  4 -1 4  4 -1 -4]
Polygon "P" [-4 -1 2.5  -4 4 2.5  4 4 2.5  4 -1 2.5]
Attribute "displacementbound" "float sphere" [0.08]
Displacement "noisybump" "float Km" [0.05] "float frequency" [4] "float octaves" [4]
Color 0.8 0.75 0.65
Rotate -90 1 0 0
Sphere 0.95 -0.95 0 360  # two patches, because one has at most a million polygons
Sphere 0.95 0 0.95 360
WorldEnd
"""
ROUND = [(x, y) for y in range(SIZE) for x in range(SIZE) if (x / SIZE - 0.5) ** 2 + (y / SIZE - 0.45) ** 2 < 0.3**2]


def render(folder, name, tessellation, displacements, *further):
    rib, out, stats = folder / f"{name}.rib", folder / f"{name}.exr", folder / "stats.json"
    rib.write_text(f'Attribute "trace" "float tessellation" [{tessellation}] "int displacements" [{displacements}]' + SCENE)
    subprocess.run([a.tomales, "render", rib, *further, "-o", out, "--stats", stats, "-q"], check=True)
    figures = json.loads(stats.read_text())
    picture = {k: 0.2126 * p[0] + 0.7152 * p[1] + 0.0722 * p[2] for k, p in pixels(out).items()}
    return picture, f"{figures['raytrace']['coarse_polygons']:,} polygons, {figures['raytrace']['bytes'] / 1e6:.1f} MB, {figures['cpu_s']:.0f} CPU s"


with tempfile.TemporaryDirectory() as name:
    folder = pathlib.Path(a.keep or name)
    truth, cost = render(folder, "full", FINE, 1)
    print(f"all of the displacement: {cost}", flush=True)
    for name, further in (("hit list", []), ("bias alone", ["--no-hit-list"])):
        picture, cost = render(folder, name.split()[0], COARSE, 0, *further)
        errors = {k: abs(picture[k] - truth[k]) / (truth[k] + 0.01) for k in truth}
        ball = [errors[k] for k in ROUND]
        print(f"{name}: {cost}; mean absolute relative error of the ball {100 * statistics.fmean(ball):.2f} %, at most {100 * max(ball):.1f} %, "
              f"{sum(e > 0.5 for e in ball)} of {len(ball)} pixels wrong by more than 50 %; of the whole picture {100 * statistics.fmean(errors.values()):.2f} %",
              flush=True)
