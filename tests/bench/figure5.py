"""Shows where irradiance records lie in scenes/cornell_ball (figure 5 of Tabellion and Lamorlette 2004), with pictures of (d), (e), (f) and counts by place.

    figure5.py TOMALES FOLDER [--size 512] [--samples 1000] [-t 2]

(d) is equation 5 with kappa = 0.5, and (e) is the same with bumped normals in equation 4. (f) is the error function of Ward and
Heckbert 1992 with the same number of records as (d); it has no limits in pixels and refines nothing. "limited" is (f) with R- and
R+ of equation 3, and has the same number of records. This needs ImageMagick. FOLDER gets pictures and figure5.png, whose rows are
picture, closeup, (d) and (e), (f), limited.
"""
import argparse
import math
import pathlib
import struct
import subprocess

SCENE = (pathlib.Path(__file__).parents[2] / "scenes/cornell_ball/cornell_ball.rib").read_text()
BALL, RADIUS = (0, -0.15, 0), 0.5
BUMP = 'Displacement "noisybump"'
# An object with a displacement bound has points that move, so its records have the normals of the displaced surface. A
# bound this small changes nothing else.
BUMPED = SCENE.replace(BUMP, 'Attribute "displacementbound" "float sphere" [1e-6] ' + BUMP)
TILE = 400  # This is the number of pixels along each edge of the pictures in figure5.png.
NEAR = (0.02, 0.04, 0.08, 0.16)  # These are distances from an edge of the box.

parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
parser.add_argument("tomales", type=pathlib.Path)
parser.add_argument("folder", type=pathlib.Path)
parser.add_argument("--size", type=int, default=512)
parser.add_argument("--samples", type=int, default=1000)
parser.add_argument("-t", default="2")
options = parser.parse_args()


def run(*arguments):
    subprocess.run([options.tomales.resolve(), *map(str, arguments)], check=True, cwd=options.folder, stdout=subprocess.DEVNULL)


class Variant:
    """A deep frame buffer that is gathered with several error functions."""

    def __init__(self, name, rib):
        self.name = name
        (options.folder / f"{name}.rib").write_text(rib)
        run("hide", f"{name}.rib", "-q", "-o", f"{name}.dfb", "--format", f"{options.size}x{options.size}", "-t", options.t)

    def records(self, *arguments):
        """Returns the records' positions by way of .ptc and .ply, whose first three floats they are."""
        run("gather", f"{self.name}.dfb", "-q", "-o", f"{self.name}.icf", "--samples", options.samples, "-t", options.t, *arguments)
        run("convert", f"{self.name}.icf", f"{self.name}.ptc")
        run("convert", f"{self.name}.ptc", f"{self.name}.ply")
        header, _, data = (options.folder / f"{self.name}.ply").read_bytes().partition(b"end_header\n")
        width = header.count(b"property float")
        return [p[:3] for p in struct.iter_unpack(f"<{width}f", data)]

    def as_many(self, count, function):
        """Returns records of another error function and their maxerror. Their number is within 1 %, or as near as bisection comes."""
        low, high = math.log(0.25), math.log(10)
        for _ in range(12):
            middle = (low + high) / 2
            found = self.records("--error-function", function, "--max-error", math.exp(middle))
            if abs(len(found) - count) <= 0.01 * count:
                break
            low, high = (middle, high) if len(found) > count else (low, middle)
        return found, math.exp(middle)

    def draw(self):
        run("view", f"{self.name}.icf", "--camera", f"{self.name}.rib", "--format", f"{TILE}x{TILE}", "-o", f"{self.name}.png", "--channel", "record")


def on_ball(p):
    return math.dist(p, BALL) < RADIUS + 0.01


def from_edge(p):
    """Returns the distance from an edge of the box, which has none in front."""
    return math.hypot(*sorted((1 - abs(p[0]), 1 - abs(p[1]), 1 - p[2]))[:2])


def report(variant, records, max_error):
    box = [p for p in records if not on_ball(p)]
    shares = ", ".join(f"{100 * sum(from_edge(p) < d for p in box) / len(records):.0f} % within {d}" for d in NEAR)
    print(f"{variant.name:<8} maxerror {max_error:5.3f} {len(records):6} records, {len(records) - len(box):5} on the ball; of an edge: {shares}", flush=True)
    variant.draw()


def main():
    options.folder.mkdir(parents=True, exist_ok=True)
    d = Variant("d", SCENE)
    of_d = d.records("--max-error", 2)
    report(d, of_d, 2)
    e = Variant("e", BUMPED)
    report(e, e.records("--max-error", 2), 2)
    for name, function in (("f", "split"), ("limited", "ward")):
        variant = Variant(name, SCENE)
        report(variant, *variant.as_many(len(of_d), function))
    given = ("render", "d.rib", "-q", "--irradiance", "d.icf", "-t", options.t)
    run(*given, "--format", f"{TILE}x{TILE}", "-o", "picture.png")
    run(*given, "--format", "1000x1000", "--crop", "0.3,0.7,0.36,0.76", "-o", "closeup.png")  # This is TILE pixels, too.
    tiles = [f"{name}.png" for name in ("picture", "closeup", "d", "e", "f", "limited")]
    subprocess.run(["montage", *tiles, "-tile", "3x2", "-geometry", "+4+4", "-background", "black", "figure5.png"], check=True, cwd=options.folder)


if __name__ == "__main__":
    main()
