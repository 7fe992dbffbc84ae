"""Flicker of interpolated indirect light over frames in which the camera, then an object, moves slowly.

flicker_test.py TOMALES [SIZE SAMPLES FRAMES]. Flicker is the temporal high-pass of what a picture is off from a gather at every point:
the rms over pixels and frames of e(t) - (e(t-1) + e(t+1)) / 2, e over the mean of the truth, divided by sqrt(3/2) so that independent noise
keeps its size. Caches are made for each frame, or shared: each frame adds records where those of the frames before leave points uncovered.
"""
import pathlib
import subprocess
import sys
import tempfile

FOLDER = pathlib.Path(__file__).parent
sys.path.insert(0, str(FOLDER.parent / "image"))
from pictures import pixels  # noqa: E402

tomales = pathlib.Path(sys.argv[1]).resolve()
size, samples, frames = [int(x) for x in sys.argv[2:5]] if len(sys.argv) > 4 else (24, 128, 4)
# As many points as rate 1 gave before ShadingRate was taken as an area (docs/decisions/0050); at rate 1, with fewer, it is 3.3 % in four frames of 24 x 24.
RATE = 0.66
LIMIT = 0.03 if len(sys.argv) <= 4 else 0.01  # few rays and large pixels make a coarser picture
SCENE = (FOLDER / "irradiance_cache" / "box_ball.rib").read_text()
EYE, BALL = "Translate 0 0 3.95", "Translate 0.4 -0.65 -0.3"
LAMP = 5  # shines more than any surface reflects
MOVES = {"camera": (EYE, lambda f: f"Translate {0.01 * f:.4f} 0 {3.95 - 0.01 * f:.4f}"),
         "object": (BALL, lambda f: f"Translate {0.4 - 0.01 * f:.4f} -0.65 {-0.3 - 0.005 * f:.4f}")}


def run(*arguments):
    subprocess.run([tomales, *map(str, arguments)], check=True, timeout=3000)


class Shot:
    """One frame of a move, from its RIB to pictures."""

    def __init__(self, folder, move, frame):
        old, new = MOVES[move]
        self.folder, self.rib = folder, folder / f"{move}{frame}.rib"
        self.rib.write_text(SCENE.replace(old, new(frame)))
        self.dfb = self.rib.with_suffix(".dfb")
        run("hide", self.rib, "-q", "-o", self.dfb, "--format", f"{size}x{size}", "--pixel-samples", "2x2", "--shading-rate", RATE)

    def picture(self, name, *arguments, given=None):
        icf, out = self.rib.with_suffix(f".{name}.icf"), self.folder / "picture.exr"
        run("gather", self.dfb, "-q", "-o", icf, *arguments, *(["--irradiance", given] if given else []))
        run("shade", self.dfb, "-q", "--irradiance", icf, "--indirect-only", "-o", out, *arguments)  # what no record serves is gathered as the truth is
        return [v if v < LAMP else 0 for color in pixels(out).values() for v in color[:3]], icf


def flicker(pictures, truths):
    mean = sum(map(sum, truths)) / len(truths) / len(truths[0])
    off = [[(p - t) / mean for p, t in zip(picture, truth)] for picture, truth in zip(pictures, truths)]
    squares = [(now - 0.5 * (before + after)) ** 2 for b, n, a in zip(off, off[1:], off[2:]) for before, now, after in zip(b, n, a)]
    return (sum(squares) / len(squares) / 1.5) ** 0.5


failures = 0
with tempfile.TemporaryDirectory() as name:
    for move in MOVES:
        truths, own, shared, kept = [], [], [], None
        for frame in range(frames):
            shot = Shot(pathlib.Path(name), move, frame)
            truths.append(shot.picture("truth", "--max-error", 0, "--samples", 4 * samples, "--light-seed", 1)[0])
            own.append(shot.picture("own", "--samples", samples)[0])
            picture, kept = shot.picture("shared", "--samples", samples, given=kept)
            shared.append(picture)
        for kind, pictures in (("own", own), ("shared", shared)):
            value = flicker(pictures, truths)
            failures += value > LIMIT
            print(f"{'ok     ' if value <= LIMIT else 'FAILED '} moving {move}, {kind} caches: flicker {100 * value:.2f} % of the mean", flush=True)
sys.exit(bool(failures))
