"""Compares the irradiance cache with a gather at every point, on scenes where irradiance caches are known to fail. Only indirect light counts.

irradiance_cache_test.py TOMALES [SIZE SAMPLES [ARGUMENTS...]]: at a larger size with more rays, it makes the table of
docs/measured/irradiance_cache.md.
"""
import json
import pathlib
import subprocess
import sys
import tempfile

FOLDER = pathlib.Path(__file__).parent
sys.path.insert(0, str(FOLDER.parent / "image"))
from pictures import pixels  # noqa: E402

# These bounds are for the mean and the 99th percentile of the relative error, and for the share of pixels that should be black and get light. They
# hold at the size and with the rays of the test: 40 x 40 pixels of up to 6 cm, so that the wall of 2 cm is thinner than the least reach of a record.
# They are 1.3 times today's figures. The method `plain`, without the amendments, exceeds them in box_ball, lamp_slot and thin_wall.
LIMITS = {
    "box_ball": (0.0244, 0.121, 0.001),
    "bumps": (0.0185, 0.087, 0.001),
    "contact": (0.0252, 0.194, 0.001),
    "grazing": (0.0161, 0.094, 0.001),
    "hair": (0.0192, 0.092, 0.001),
    "hot_spot": (0.0982, 0.576, 0.182),
    "sun_room": (0.0898, 0.441, 0.511),
    "lamp_slot": (0.0266, 0.139, 0.001),
    "thin_blades": (0.0309, 0.152, 0.001),
    "thin_wall": (0.0133, 0.094, 0.015),
}
FLOOR = 0.01

tomales = pathlib.Path(sys.argv[1]).resolve()
size, samples = (sys.argv[2], sys.argv[3]) if len(sys.argv) > 3 else ("40", "200")
extra = sys.argv[4:]


def render(folder, scene, *arguments):
    out = folder / "picture.exr"
    subprocess.run([tomales, "render", FOLDER / "irradiance_cache" / f"{scene}.rib", "-q", "--gi", "gather", "--indirect-only", "--format",
                    f"{size}x{size}", "--pixel-samples", "2x2", "-o", out, "--stats", folder / "stats.json", *arguments], check=True, timeout=3000)
    records = json.loads((folder / "stats.json").read_text())["irradiance_cache"]["samples"]
    return pixels(out), records


def errors(picture, truth):
    """Returns two sorted lists: the errors of all colours of all pixels that have light, and the light in pixels that should have
    none."""
    lit = [abs(p - t) / (t + FLOOR) for xy, color in truth.items() for p, t in zip(picture[xy][:3], color[:3]) if max(color[:3]) > 0]
    dark = [max(picture[xy][:3]) for xy, color in truth.items() if max(color[:3]) == 0]
    return sorted(lit), sorted(dark)


failures = 0
with tempfile.TemporaryDirectory() as name:
    for scene, (mean_limit, p99_limit, leak_limit) in LIMITS.items():
        truth, _ = render(pathlib.Path(name), scene, "--max-error", "0", "--samples", str(2 * int(samples)), "--light-seed", "1")
        picture, records = render(pathlib.Path(name), scene, "--samples", samples, *extra)
        lit, dark = errors(picture, truth)
        mean, p99 = sum(lit) / len(lit), lit[int(0.99 * len(lit))]
        leaks = sum(d > 1e-4 for d in dark) / max(len(dark), 1)
        good = extra or (mean < mean_limit and p99 < p99_limit and leaks < leak_limit)
        failures += not good
        print(f"{'ok     ' if good else 'FAILED '} {scene:<12} {records:6} records, mean {100 * mean:5.2f} %, p99 {100 * p99:5.1f} %, "
              f"dark pixels that got light {100 * leaks:.2f} %", flush=True)
sys.exit(bool(failures))
