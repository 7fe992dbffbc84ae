"""Compares scenes on which indirect light once went wrong with a path tracer that shares no code with the renderer. It is a small
tests/bench/truth.py.

    truth_test.py TOMALES TRACER
"""
import pathlib
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "bench"))
from truth import Bench  # noqa: E402
from truth_scenes import Scene  # noqa: E402

Scene.size = 64
# A row has the share of the truth's paths, and the greatest errors of the mean and of the 99th percentile of blocks. Of
# the latter, three times the noise of the truth is subtracted.
LIMITS = {("thin_walls", "atlas"): (0.5, 0.05, 0.20), ("thin_walls", "gather"): (0.5, 0.03, 0.05), ("displaced_ball", "gather"): (1, 0.02, 0.10), ("plastic", "gather"): (1, 0.01, 0.05),
          ("mirrored_sky", "reference"): (1, 0.003, 0.01), ("mirrored_dome", "reference"): (1, 0.003, 0.01), ("mirrored_dome", "gather"): (1, 0.003, 0.01)}
failures = 0


def check(good, line):
    global failures
    failures += not good
    print("ok      " if good else "FAILED ", line)


with tempfile.TemporaryDirectory() as folder:
    bench = Bench(pathlib.Path(sys.argv[1]).resolve(), folder, "2", pathlib.Path(sys.argv[2]).resolve())
    for (scene, method), (share, most, mostOfBlocks) in LIMITS.items():
        mean, worst, noise, _, said = bench.compare(scene, method, share)
        check(abs(mean) < most and worst < mostOfBlocks + noise, f"{scene}, {method}: mean {100 * mean:+.1f} %, blocks {100 * worst:.1f} % (noise {100 * noise:.1f} %) {said}")
    for scene in ("mirrored_sky", "mirrored_dome"):  # the judge is judged by the formula
        known, traced = bench.truth(scene)[0][0], bench.traced(scene, 256)
        off = max(abs(value / known - 1) for value, _ in traced)
        check(off < 0.002, f"{scene}, tracer: blocks {100 * off:.2f} %")
sys.exit(bool(failures))
