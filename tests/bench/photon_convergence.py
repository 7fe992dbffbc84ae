"""Prints the noise and the bias of counted photons against their number, on scenes with a caustic, and the exponents with which they fall.

    photon_convergence.py TOMALES FOLDER [--scenes pool glass ring] [--photons 1e4 1e5 1e6 1e7] [--seeds 8] [--method progressive]
                          [--truth-photons 1e8] [--truths 4] [--threads 2]

Light bounces at most four times. The truth is the mean of `--gi reference` with several seeds, whose disks have the area of a
micropolygon. Errors are rms over all pixels, relative to the mean of the truth. The noise is estimated from the differences
between seeds. The bias is the error that is left when the noise of both is subtracted. FOLDER keeps pictures for the next call.
"""
import argparse
import math
import pathlib
import statistics
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path[:0] = [str(ROOT / "tests/cli"), str(ROOT / "tests/image")]
import caustic_scenes  # noqa: E402
from pictures import pixels  # noqa: E402

# The water of the pool covers this floor. Otherwise paths would bring light from where the sun shines past the water. At hits of paths, glass
# leaves weak reflections out, and photons do not.
FLOOR = 1.5

parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
parser.add_argument("tomales", type=pathlib.Path)
parser.add_argument("folder", type=pathlib.Path)
parser.add_argument("--scenes", nargs="+", default=["pool"], choices=caustic_scenes.SCENES)
parser.add_argument("--photons", nargs="+", type=float, default=[1e4, 1e5, 1e6, 1e7])
parser.add_argument("--seeds", type=int, default=8)
parser.add_argument("--method", default="progressive")
parser.add_argument("--truth-photons", type=float, default=1e8)
parser.add_argument("--truths", type=int, default=4)
parser.add_argument("--threads", type=int, default=2)
args = parser.parse_args()
if min(args.seeds, args.truths) < 2:
    parser.error("noise is what several seeds tell: give two or more")
args.folder.mkdir(parents=True, exist_ok=True)


def picture(scene, method, photons, seed):
    """Returns the mean of the channels of each pixel, in the order of positions."""
    name = f"{scene}-{method}-{photons:g}-{seed}.exr"
    if not (args.folder / name).exists():
        (args.folder / (scene + ".rib")).write_text(caustic_scenes.text(scene, FLOOR))
        subprocess.run([args.tomales.resolve(), scene + ".rib", "--gi", method, "--indirect-only", "--bounces", "4", "--photons", f"{photons:.0f}", "--samples", "1",
                        "--light-seed", str(seed), "-t", str(args.threads), "-q", "-o", name], cwd=args.folder, check=True)
    return [sum(p[:3]) / 3 for _, p in sorted(pixels(args.folder / name).items())]


def mean_of(pictures):
    """Returns the mean picture, and the variance of its pixels in the mean over the picture."""
    columns = list(zip(*pictures))
    return [statistics.fmean(c) for c in columns], statistics.fmean(statistics.variance(c) for c in columns) / len(pictures)


for scene in args.scenes:
    truth, truth_variance = mean_of([picture(scene, "reference", args.truth_photons, 1000 + s) for s in range(args.truths)])
    level = statistics.fmean(truth)
    print(f"{scene}: truth {level:.5f}, its noise {math.sqrt(truth_variance) / level:.3%}")
    before = None
    for photons in args.photons:
        seen, variance = mean_of([picture(scene, args.method, photons, 1 + s) for s in range(args.seeds)])
        noise = math.sqrt(variance * args.seeds) / level
        square = statistics.fmean((a - b) ** 2 for a, b in zip(seen, truth)) - variance - truth_variance
        bias = math.copysign(math.sqrt(abs(square)), square) / level
        line = f"  {photons:8.0e}  noise {noise:7.3%}  bias {bias:7.3%}  mean {statistics.fmean(seen) / level - 1:+.3%}"
        if before:
            decades = math.log(photons / before[0])
            line += f"  exponents {math.log(noise / before[1]) / decades:+.2f}"
            if bias > 0 and before[2] > 0:
                line += f" {math.log(bias / before[2]) / decades:+.2f}"
        print(line, flush=True)
        before = photons, noise, bias
