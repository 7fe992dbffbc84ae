"""Measures how far interpolated indirect light is from path tracing: its error and 99th percentile, the noise of the reference, time, and error maps.

    tests/bench/indirect_error.py build/release/tomales FOLDER [--scenes cornell film hot_spot sun_room box_ball] [--batches 2] [--bounces 1]
                                  [-t 1] [--json out.json] [-- ARGUMENTS OF tomales render ...]

Debian's packages: python3-numpy python3-openimageio. The reference is `--gi reference`, each batch with a seed of its own, in
square windows whose places depend on nothing but their number (Halton's points), because whole frames would take hours; only
their pixels count. FOLDER/SCENE keeps the reference, so that the next call is quick, and gets error.png. The error is |test -
reference| / (reference + 1 % of its mean) of the indirect light, over the colours of all pixels where the reference is not black.
It is also given with a tenth of the mean and with 0.01, which `tomales chart` uses. `noise` is the noise of the reference itself,
from the spread of its batches. Every figure contains this noise.
"""
import argparse
import dataclasses
import json
import pathlib
import subprocess
import sys

import numpy
import OpenImageIO

ROOT = pathlib.Path(__file__).parents[2]


@dataclasses.dataclass
class Case:
    scene: str
    size: tuple    # The size of the frame in pixels.
    windows: int   # The reference is traced in this number of squares,
    edge: int      # of this number of pixels each,
    samples: int   # with this number of paths per point and batch.


CASES = {
    "cornell": Case("scenes/cornell/cornell.rib", (512, 512), 64, 16, 512),
    "film": Case("scenes/film/film.rib", (1828, 1102), 64, 12, 48),
    "hot_spot": Case("tests/stability/irradiance_cache/hot_spot.rib", (256, 256), 64, 4, 65536),
    "sun_room": Case("tests/stability/irradiance_cache/sun_room.rib", (256, 192), 64, 4, 16384),
    "box_ball": Case("tests/stability/irradiance_cache/box_ball.rib", (512, 512), 64, 16, 1024),
}
FLOOR = 0.01


def halton(i, base):
    value, share = 0.0, 1.0 / base
    while i:
        value, i, share = value + share * (i % base), i // base, share / base
    return value


def windows(case):
    """Returns the corners of the squares."""
    return [(int(halton(i, 2) * (case.size[0] - case.edge)), int(halton(i, 3) * (case.size[1] - case.edge))) for i in range(1, case.windows + 1)]


def pixels(path):
    """Returns the pixels of the whole frame. It is black outside of a crop."""
    image = OpenImageIO.ImageInput.open(str(path))
    spec, data = image.spec(), image.read_image(OpenImageIO.FLOAT)
    out = numpy.zeros((spec.full_height, spec.full_width, 3), numpy.float32)
    out[spec.y - spec.full_y:spec.y - spec.full_y + spec.height, spec.x - spec.full_x:spec.x - spec.full_x + spec.width] = data[..., :3]
    return out


class Bench:
    def __init__(self, given, name):
        self.given, self.case, self.size = given, CASES[name], CASES[name].size
        self.folder = given.folder / name
        self.folder.mkdir(parents=True, exist_ok=True)

    def render(self, out, *arguments):
        """Renders and returns the statistics."""
        stats = self.folder / "stats.json"
        subprocess.run([self.given.tomales, "render", ROOT / self.case.scene, "-q", "--indirect-only", "--format", f"{self.size[0]}x{self.size[1]}", "-t", str(self.given.threads),
                        "--bounces", str(self.given.bounces), "-o", out, "--stats", stats, *map(str, arguments)], check=True, cwd=self.folder)
        return json.loads(stats.read_text())

    def reference(self, batch):
        """Returns the reference, and the pixels at which it is known."""
        (width, height), edge = self.size, self.case.edge
        whole, known = numpy.zeros((height, width, 3), numpy.float32), numpy.zeros((height, width), bool)
        for x, y in windows(self.case):
            out = self.folder / f"reference_{self.given.bounces}_{self.case.samples}_{batch}_{x}_{y}.exr"
            if not out.exists():
                crop = ",".join(f"{max(0, v):.9f}" for v in ((x - 0.01) / width, (x + edge - 0.01) / width, (y - 0.01) / height, (y + edge - 0.01) / height))
                part = out.with_suffix(".part.exr")
                self.render(part, *self.given.reference, "--samples", self.case.samples, "--light-seed", batch + 1, "--crop", crop)
                part.rename(out)
            whole[y:y + edge, x:x + edge] = pixels(out)[y:y + edge, x:x + edge]
            known[y:y + edge, x:x + edge] = True
        return whole, known


def figures(test, batches, counts):
    truth = sum(batches) / len(batches)
    lit = counts[..., None] & (truth.max(-1, keepdims=True) > 0) & numpy.ones(3, bool)

    light = float(truth[lit].mean())

    def error(a, b, floor=FLOOR * light):
        return (numpy.abs(a - b) / (numpy.abs(b) + floor))[lit]

    def mean_and_p99(off):
        return float(off.mean()), float(numpy.percentile(off, 99))

    mean, p99 = mean_and_p99(error(test, truth))
    n = len(batches)
    # The difference of a batch from the mean of the others is sqrt(n + n / (n - 1)) times the error of the mean of all.
    noise = [error(b, (truth * n - b) / (n - 1)) / (n + n / (n - 1)) ** 0.5 for b in batches] if n > 1 else [numpy.inf]
    return {"mean": mean, "p99": p99, "of_tenth": mean_and_p99(error(test, truth, 0.1 * light)), "of_chart": mean_and_p99(error(test, truth, 0.01)), "bias": float(test[lit].sum() / truth[lit].sum() - 1),
            "noise": float(numpy.mean(noise)), "noise_p99": float(numpy.percentile(noise, 99)), "pixels": int(counts.sum())}


def errorMap(path, test, truth, known, extent=0.1):
    """Draws the error. Red is too bright, blue too dark, and white right. Colours are full at `extent`, and grey is unknown."""
    grey = numpy.array([0.2126, 0.7152, 0.0722])
    light = truth @ grey
    off = numpy.clip((test @ grey - light) / (light + FLOOR * light[known].mean()) / extent, -1, 1)
    colors = numpy.stack([1 + numpy.minimum(off, 0), 1 - numpy.abs(off), 1 - numpy.maximum(off, 0)], -1)
    colors[~known] = 0.5
    out = OpenImageIO.ImageOutput.create(str(path))
    out.open(str(path), OpenImageIO.ImageSpec(test.shape[1], test.shape[0], 3, OpenImageIO.UINT8))
    out.write_image(numpy.ascontiguousarray(colors, numpy.float32))
    out.close()


def main():
    split = sys.argv.index("--") if "--" in sys.argv else len(sys.argv)
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("tomales", type=pathlib.Path)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--scenes", nargs="+", default=["cornell", "film", "hot_spot"], choices=CASES)
    parser.add_argument("--batches", type=int, default=2)
    parser.add_argument("--bounces", type=int, default=1)
    parser.add_argument("-t", dest="threads", type=int, default=1)
    parser.add_argument("--json", type=pathlib.Path)
    given = parser.parse_args(sys.argv[1:split])
    given.tomales, given.folder, given.reference = given.tomales.resolve(), given.folder.resolve(), ["--gi", "reference"]
    options, rows = sys.argv[split + 1:] or ["--gi", "gather"], []
    for name in given.scenes:
        bench = Bench(given, name)
        parts = [bench.reference(b) for b in range(given.batches)]
        out = bench.folder / "test.exr"
        stats = bench.render(out, *options)
        test, truth, known = pixels(out), sum(p[0] for p in parts) / given.batches, parts[0][1]
        errorMap(bench.folder / "error.png", test, truth, known)
        rows.append({"scene": name, "options": " ".join(options), "bounces": given.bounces, **figures(test, [p[0] for p in parts], known),
                     "records": stats["irradiance_cache"]["samples"], "cpu_s": stats["cpu_s"], "gather_s": stats["time_s"].get("gather", 0)})
        r = rows[-1]
        others = ", ".join("%.2f %.1f" % tuple(100 * v for v in r[which]) for which in ("of_tenth", "of_chart"))
        print(f"{name:<9} mean {100 * r['mean']:.2f} % p99 {100 * r['p99']:.1f} % ({others}) bias {100 * r['bias']:+.2f} % (reference: noise {100 * r['noise']:.2f} %, p99 {100 * r['noise_p99']:.1f} %; "
              f"{r['pixels']} pixels) {r['records']} records {r['cpu_s']:.1f} CPU s", r["options"], flush=True)
    if given.json:
        given.json.write_text(json.dumps(rows, indent=1))


if __name__ == "__main__":
    main()
