"""Measures how many megabytes of a mesh Ri writes per CPU second: python3 tests/bench/python_rib.py (with numpy too if
it is installed)."""
import pathlib
import random
import sys
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent.parent / "reyes/bindings/python"))
import tomales  # noqa: E402

try:
    import numpy
except ImportError:
    numpy = None

POINTS, MESHES = 1_000_000, 5


class Nowhere:
    """Counts the bytes that are written to /dev/null."""

    def __init__(self):
        self.bytes, self.file = 0, open("/dev/null", "wb")

    def write(self, data):
        self.bytes += self.file.write(data)

    def flush(self):
        pass


def measure(what, counts, indices, points):
    for form in ("binary", "ascii"):
        out, ri = Nowhere(), tomales.Ri()
        ri.Option("rib", {"format": form})
        ri.Begin(out)
        start_s = time.process_time()
        for _ in range(MESHES):
            ri.PointsPolygons(counts, indices, {"P": points})
        ri.End()
        print(f"{what:<24} {form:<8} {out.bytes / 1e6 / (time.process_time() - start_s):6.0f} MB/s")


if numpy:
    points = numpy.random.default_rng(1).random((POINTS, 3))
    for kind in ("float32", "float64"):
        measure(f"numpy, {kind}", numpy.full(POINTS // 4, 4), numpy.arange(POINTS), points.astype(kind))
measure("lists", [4] * (POINTS // 4), list(range(POINTS)), [random.random() for _ in range(3 * POINTS)])
