"""Measures the flicker of interpolated indirect light over frames in which the camera, then an object, moves slowly.

flicker_test.py TOMALES [SIZE SAMPLES FRAMES] [--moves camera,object] [--crop X0,X1,Y0,Y1] [--truth RAYS] [--groups 2,4] [-- OPTIONS OF GATHER]

Let e(t) be the difference of a picture from a gather at every point, over the mean of that truth. Flicker is the rms over pixels
and frames of its temporal high-pass h(t) = e(t) - (e(t-1) + e(t+1)) / 2, divided by sqrt(3/2) so that independent noise keeps its
size. The truth is gathered twice with different rays, and each square is the product of the two h, so the noise of the truth does not
bias the mean. Two more figures are one standard error below and above that mean. It is estimated from tiles of 8 x 8 pixels,
whose errors are taken as independent. "On fixed points" means the light that the records of each frame give in the view of the
first frame. A static scene should not change it, and it needs no truth, so --truth 0 leaves the truth out. Caches are made for
each frame, or shared: then each frame adds records where those of earlier frames leave points uncovered or disagree. With
--groups, this number of successive frames also shares a cache, and all their pictures use the last state of it, as with `batch
--share-records`. The CPU seconds of gathering are printed.
"""
import argparse
import pathlib
import resource
import statistics
import subprocess
import sys
import tempfile

FOLDER = pathlib.Path(__file__).parent
sys.path.insert(0, str(FOLDER.parent / "image"))
from pictures import pixels  # noqa: E402

# This gives the number of points that rate 1 gave before ShadingRate was an area (docs/decisions/0050). At rate 1 there
# are fewer, and flicker is 3.3 % in four frames of 24 x 24.
RATE = 0.66
SCENE = (FOLDER / "irradiance_cache" / "box_ball.rib").read_text()
EYE, BALL = "Translate 0 0 3.95", "Translate 0.4 -0.65 -0.3"
TILE = 8  # This is wider than most records reach.
LAMP = 1  # Surfaces reflect less than this, and a lamp that covers a quarter of a pixel sends more.
MOVES = {"camera": (EYE, lambda f: f"Translate {0.01 * f:.4f} 0 {3.95 - 0.01 * f:.4f}"),
         "object": (BALL, lambda f: f"Translate {0.4 - 0.01 * f:.4f} -0.65 {-0.3 - 0.005 * f:.4f}")}

parser = argparse.ArgumentParser()
parser.add_argument("tomales", type=pathlib.Path)
parser.add_argument("numbers", nargs="*", type=int, help="size, samples, frames")
parser.add_argument("--moves", default=",".join(MOVES))
parser.add_argument("--crop", help="of the pictures that are compared; caches are of the whole frame")
parser.add_argument("--truth", type=int, help="rays a point, twice")
parser.add_argument("--groups", default="", help="frames that share a cache")
own_arguments, _, gather = " ".join(sys.argv[1:]).partition(" -- ")
options = parser.parse_args(own_arguments.split())
size, samples, frames = options.numbers or (24, 128, 4)
rays = samples if options.truth is None else options.truth
LIMITS = {"own": 0.01, "shared": 0.01} if options.numbers else {"own": 0.06, "shared": 0.024}  # Few rays and large pixels make a coarser picture.
edges = [size * float(x) for x in options.crop.split(",")] if options.crop else [0, size, 0, size]


def cpu_s():
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def run(*arguments):
    subprocess.run([options.tomales.resolve(), *map(str, arguments)], check=True, timeout=3000)


class Shot:
    """One frame of a move, from its RIB to pictures."""

    def __init__(self, folder, move, frame):
        old, new = MOVES[move]
        self.folder, self.rib = folder, folder / f"{move}{frame}.rib"
        self.rib.write_text(SCENE.replace(old, new(frame)))
        self.dfb = self.rib.with_suffix(".dfb")
        run("hide", self.rib, "-q", "-o", self.dfb, "--format", f"{size}x{size}", "--pixel-samples", "2x2", "--shading-rate", RATE)

    def gather(self, name, given=None):
        icf = self.rib.with_suffix(f".{name}.icf")
        run("gather", self.dfb, "-q", "-o", icf, "--samples", samples, *gather.split(), *(["--irradiance", given] if given else []))
        return icf

    def picture(self, *arguments):
        out = self.folder / "picture.exr"
        run("shade", self.dfb, "-q", "--indirect-only", "-o", out, *(["--crop", options.crop] if options.crop else []), *arguments)
        seen = {(x, y): color[:3] for (x, y), color in pixels(out).items() if edges[0] <= x < edges[1] and edges[2] <= y < edges[3]}
        return [v if v < LAMP else 0 for xy in sorted(seen, key=tile_of) for v in seen[xy]]  # This keeps the pixels of a tile together.

    def lit_by(self, icf):
        return self.picture("--irradiance", icf, "--samples", samples, *gather.split())  # The picture is shaded with this many rays where no record serves.

    def truth(self, seed):
        return self.picture("--max-error", 0, "--samples", rays, "--light-seed", seed)


def tile_of(xy):
    return [v // TILE for v in xy], xy


def batched(values, count):
    return [values[i:i + count] for i in range(0, len(values), count)]


def mean(pictures):
    return sum(map(sum, pictures)) / sum(map(len, pictures))


def high_pass(series):
    return [now - 0.5 * (before + after) for b, n, a in zip(series, series[1:], series[2:]) for before, now, after in zip(b, n, a)]


def flicker(some, others):
    """Returns the flicker of two series of differences: the figure, and one standard error below and above it."""
    squares = [a * b / 1.5 for a, b in zip(high_pass(some), high_pass(others))]
    tiles = [statistics.fmean(part) for frame in range(0, len(squares), len(some[0]))
             for part in batched(squares[frame:frame + len(some[0])], 3 * TILE * TILE)]
    middle, error = statistics.fmean(squares), statistics.stdev(tiles) / len(tiles) ** 0.5
    return [max(0, square) ** 0.5 for square in (middle, middle - error, middle + error)]


def minus(pictures, truths):
    return [[p - t for p, t in zip(picture, truth)] for picture, truth in zip(pictures, truths)]


def over(light, figures):
    return [figure / light for figure in figures]


def of_move(folder, move):
    """Returns {kind: figures over the mean}, of pixels and on fixed points. None means that it was not measured."""
    shots = [Shot(folder, move, frame) for frame in range(frames)]
    truths = [[shot.truth(seed) for shot in shots] for seed in (1, 2)] if rays else []
    found = {}
    for kind, group in {"own": 1, "shared": frames, **{f"{g} frames share": int(g) for g in options.groups.split(",") if g}}.items():
        caches, before = [], cpu_s()
        for number, shot in enumerate(shots):
            caches.append(shot.gather(kind.replace(" ", "_"), caches[-1] if number % group else None))
        taken = cpu_s() - before
        if kind not in LIMITS:  # The last cache of a group serves all its frames.
            caches = [caches[min(number // group * group + group, frames) - 1] for number in range(frames)]
        pictures = [shot.lit_by(icf) for shot, icf in zip(shots, caches)]
        seen = over(mean(truths[0] + truths[1]), flicker(*(minus(pictures, t) for t in truths))) if rays else None
        first = [shots[0].lit_by(icf) for icf in caches] if move == "camera" else None
        found[kind] = seen, over(mean(first), flicker(first, first)) if first else None, taken
    return found


failures = 0
with tempfile.TemporaryDirectory() as name:
    for move in options.moves.split(","):
        for kind, (seen, fixed, taken) in of_move(pathlib.Path(name), move).items():
            failed = seen is not None and kind in LIMITS and seen[0] > LIMITS[kind]
            failures += failed
            parts = ["%.2f %% of the mean (%.2f to %.2f)%s" % (*(100 * v for v in figures), where)
                     for figures, where in ((seen, ""), (fixed, " on fixed points")) if figures is not None]
            print(f"{'FAILED ' if failed else 'ok     ' if seen else 'seen   '} moving {move}, {kind} caches: flicker {', '.join(parts)}; {taken:.1f} CPU s", flush=True)
sys.exit(bool(failures))
