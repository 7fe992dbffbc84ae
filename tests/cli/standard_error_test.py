"""Tests that the variable `standarderror` of a Display is as large as the differences between pictures with different seeds, and
does not change the picture."""
import math
import subprocess
import sys
import pathlib

from lit_room import ROOM
from program import Suite

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "image"))
from pictures import pixels  # noqa: E402

t = Suite()
room = ROOM.replace("Format 20 16", 'PixelSamples 2 2\nPixelFilter "box" 1 1\nFormat 32 24')
shown = room.replace('"file" "rgba"', '"openexr" "Ci,a"\nDisplay "+noise.exr" "openexr" "standarderror"')
t.write("plain.rib", room)
t.write("room.rib", shown)
t.write("lamp.rib", shown.replace('LightSource "indirectlight"', "# "))
SEEDS = 12


def squares(values):
    """Returns the mean square of the colours of all pixels."""
    return sum(c * c for p in values.values() for c in p[:3]) / (3 * len(values))


def noise(scene, *arguments):
    """Returns the root mean square of the variable over some seeds, and how far pictures with these seeds are from their mean."""
    pictures, told = [], 0
    for seed in range(SEEDS):
        t.run(scene, "-q", "--light-seed", str(seed), *arguments)
        pictures.append(pixels(t.folder / "room.exr"))
        told += squares(pixels(t.folder / "noise.exr")) / SEEDS
    mean = {xy: tuple(sum(p[xy][c] for p in pictures) / SEEDS for c in range(3)) for xy in pictures[0]}
    spread = sum(squares({xy: tuple(p[xy][c] - mean[xy][c] for c in range(3)) for xy in mean}) for p in pictures) / (SEEDS - 1)
    return math.sqrt(told), math.sqrt(spread)


t.run("plain.rib", "-q")
plain = pixels(t.folder / "room.exr")
t.run("room.rib", "-q", "-t", "1")
t.expect(pixels(t.folder / "room.exr") == plain, "the picture keeps its bits")
first = pixels(t.folder / "noise.exr")
t.expect(all(c >= 0 for p in first.values() for c in p) and squares(first) > 0, "it has no signs")
for what, arguments in {"three threads": ("-t", "3"), "other buckets": ("--bucket-size", "7"), "little memory": ("--memory-limit", "1M")}.items():
    t.run("room.rib", "-q", *arguments)
    t.expect(pixels(t.folder / "noise.exr") == first, f"{what}: the same")
t.run("hide", "room.rib", "-o", "room.dfb")
t.run("shade", "room.dfb", "-q")
t.expect(pixels(t.folder / "noise.exr") == first, "and so has a shot that is shaded")

told, true = noise("lamp.rib")
t.expect(0.9 < told / true < 1.1, f"noise of a lamp is told as it is: {told:.5f}, true {true:.5f}")
told, true = noise("lamp.rib", "--light-samples", "16")
t.expect(0.9 < told / true < 1.1, f"and that of more samples: {told:.5f}, true {true:.5f}")
told, true = noise("room.rib", "--indirect-only", "--samples", "32")
t.expect(0.7 < told / true < 2.5, f"noise of records is told, at most a bound: {told:.5f}, true {true:.5f}")
told, true = noise("room.rib", "--indirect-only", "--gi", "reference", "--samples", "16")
t.expect(0.9 < told / true < 1.1, f"noise of paths is told: {told:.5f}, true {true:.5f}")
header = subprocess.run(["oiiotool", "--info", "-v", t.folder / "noise.exr"], capture_output=True, text=True).stdout
t.expect("standarderror.R" in header, "its channels are called by its name")
t.finish()
