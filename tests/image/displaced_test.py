"""The hit-list origin offset leaves no self-intersection speckle on a displaced sphere; a bias alone does.
Speckle: a pixel that differs by more than 30 % from the median of its 5x5 neighbours where the picture made with fully displaced
ray geometry does not."""
import pathlib
import statistics
import subprocess
import sys
import tempfile

from pictures import pixels

tomales, root = sys.argv[1], pathlib.Path(sys.argv[2]) / "scenes/displaced"
keep = pathlib.Path(sys.argv[3]) if len(sys.argv) > 3 else None


def render(name, *arguments):
    with tempfile.TemporaryDirectory() as folder:
        out = (keep or pathlib.Path(folder)) / f"{name}.exr"
        subprocess.run([tomales, "render", *map(str, arguments), "-o", str(out), "-q"], check=True)
        return {key: 0.2126 * p[0] + 0.7152 * p[1] + 0.0722 * p[2] for key, p in pixels(out).items()}


def outliers(picture):
    found = set()
    for (x, y), value in picture.items():
        around = [picture[x + i, y + j] for i in range(-2, 3) for j in range(-2, 3) if (x + i, y + j) in picture]
        median = statistics.median(around)
        if abs(value - median) > 0.3 * median:
            found.add((x, y))
    return found


scene = root / "displaced.rib"
full = render("full", root / "full.rib", scene)
on = render("on", scene)
off = render("off", scene, "--no-hit-list")
natural = outliers(full)
speckle_on, speckle_off = outliers(on) - natural, outliers(off) - natural
error = statistics.fmean(abs(on[k] - full[k]) / (full[k] + 0.01) for k in full)
print(f"outliers of the fully displaced picture itself: {len(natural)}")
print(f"speckle with the hit list: {len(speckle_on)}; with a bias alone: {len(speckle_off)}; of {len(full)} pixels")
print(f"mean absolute relative error that the coarse geometry costs: {error:.4f}")
sys.exit(not (len(speckle_off) > 200 and len(speckle_on) <= 0.001 * len(full)))
