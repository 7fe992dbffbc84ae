"""Tests that the hit-list origin offset leaves no speckle of self-intersection on a displaced sphere, and that a bias alone
does. A pixel is speckle if it differs by more than 30 % from the median of its 5x5 neighbours, and does not in the picture made
with fully displaced ray geometry."""
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
full = render("full", scene, "--ray-geometry", "full")
on = render("on", scene)
off = render("off", scene, "--no-hit-list")
natural = outliers(full)
speckle = {"hit list": outliers(on) - natural, "bias alone": outliers(off) - natural}


def on_the_ball(found):
    """Counts the pixels inside the silhouette, away from its edge. On the floor the contact shadow is near black, and its
    noise would count double."""
    return sum((x - 128) ** 2 + (y - 115) ** 2 < 80**2 for x, y in found)


error = statistics.fmean(abs(on[k] - full[k]) / (full[k] + 0.01) for k in full)
for method, found in speckle.items():
    print(f"{method}: {on_the_ball(found)} speckles on the ball, {len(found)} in all {len(full)} pixels")
print(f"mean absolute relative error that the coarse geometry costs: {error:.4f}")
sys.exit(not (on_the_ball(speckle["bias alone"]) > 1000 and on_the_ball(speckle["hit list"]) <= 5 and error < 0.06))
