"""Small scenes on which methods of indirect light are known to go wrong, against a path tracer that shares no code with the renderer
(tests/bench/truth_tracer.cpp, compiled here).

    tests/bench/truth.py build/release/tomales [--scenes thin_walls niche] [--methods atlas] [--paths 0.1] [--keep FOLDER] [-t 2] [-- ...]

For each scene and method: mean of the picture and 99th percentile of its blocks of 8 x 8 pixels, both as relative errors; three times the noise of
the truth at that percentile; CPU seconds; and the codes of warnings. It writes the rows of docs/measured/truth.md.
"""
import argparse
import json
import math
import pathlib
import resource
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).parent
sys.path.insert(0, str(HERE.parent / "image"))
from pictures import pixels  # noqa: E402

SIZE = 64
BLOCK = 8


class Scene:
    """A scene that both programs read: RIB, and the lines of truth_tracer.cpp."""

    def __init__(self, eye, yaw=0, pitch=0, fov=70, shutter=False, samples=256):
        self.rib, self.lines, self.lights, self.count, self.shutter = [], [], "", 0, shutter
        a, b = math.radians(yaw), math.radians(pitch)
        forward = (math.sin(a) * math.cos(b), -math.sin(b), math.cos(a) * math.cos(b))
        up = (math.sin(a) * math.sin(b), math.cos(b), math.cos(a) * math.sin(b))
        right = (math.cos(a), 0, -math.sin(a))
        self.line("size", SIZE, SIZE)
        self.line("camera", fov, *eye, *right, *up, *forward)
        self.head = (f'Format {SIZE} {SIZE} 1\nPixelSamples 4 4\nPixelFilter "box" 1 1\nProjection "perspective" "fov" [{fov}]\n'
                     + "Shutter 0 1\n" * shutter + f"Rotate {-pitch} 1 0 0\nRotate {-yaw} 0 1 0\nTranslate {-eye[0]} {-eye[1]} {-eye[2]}\n")
        self.indirect = f'LightSource "indirectlight" "bounce" "samples" [{samples}]\n'

    def line(self, *words):
        self.lines.append(" ".join(str(w) for w in words))

    def color(self, albedo, name):
        named = f'Attribute "identifier" "name" ["{name}"]\n' if name else ""
        return f"{named}Color {albedo} {albedo} {albedo}\n"

    def quad(self, a, b, c, d, albedo=0.7, name=""):
        self.line("quad", *a, *b, *c, *d, albedo, 0)
        self.rib.append(self.color(albedo, name) + f'Polygon "P" [{" ".join(str(x) for p in (a, b, c, d) for x in p)}]\n')

    def box(self, low, high, albedo=0.7, name="", without=""):
        """Its six sides, but for those named (of -x +x -y +y -z +z)."""
        (x, y, z), (X, Y, Z) = low, high
        sides = {"-x": ((x, y, z), (x, Y, z), (x, Y, Z), (x, y, Z)), "+x": ((X, y, z), (X, y, Z), (X, Y, Z), (X, Y, z)),
                 "-y": ((x, y, z), (x, y, Z), (X, y, Z), (X, y, z)), "+y": ((x, Y, z), (X, Y, z), (X, Y, Z), (x, Y, Z)),
                 "-z": ((x, y, z), (X, y, z), (X, Y, z), (x, Y, z)), "+z": ((x, y, Z), (x, Y, Z), (X, Y, Z), (X, y, Z))}
        for side, corners in sides.items():
            if side not in without.split():
                self.quad(*corners, albedo, name)

    def ball(self, center, radius, albedo=0.7, motion=(0, 0, 0), name=""):
        self.line("sphere", *center, radius, albedo, 0, *motion)
        moves = "MotionBegin [0 1]\nTranslate 0 0 0\nTranslate {} {} {}\nMotionEnd\n".format(*motion) * any(motion)
        self.rib.append("AttributeBegin\n" + self.color(albedo, name) + moves + "Translate {} {} {}\n".format(*center)
                        + f"Sphere {radius} {-radius} {radius} 360\nAttributeEnd\n")

    def lamp(self, corner, u, v, radiance):
        """A rectangle that shines to the side of u x v."""
        a, b, d = corner, [p + q for p, q in zip(corner, u)], [p + q for p, q in zip(corner, v)]
        c = [p + q for p, q in zip(b, v)]
        self.line("lamp", *a, *b, *c, *d, 0, radiance)
        self.count += 1
        self.lights += (f'AttributeBegin\nAreaLightSource "arealight" {self.count} "intensity" [{radiance}] "samples" [16]\nColor 0 0 0\n'
                        f'Patch "bilinear" "P" [{" ".join(str(x) for p in (a, b, d, c) for x in p)}]\nAttributeEnd\nIlluminate {self.count} 1\n')

    def point(self, at, intensity):
        self.line("point", *at, intensity)
        self.lights += f'LightSource "pointlight" "bulb" "from" [{at[0]} {at[1]} {at[2]}] "intensity" [{intensity}]\n'

    def sky(self, radiance, more=""):
        self.line("sky", radiance)
        self.lights += f'LightSource "environmentlight" "sky" "intensity" [{radiance}] "samples" [64] {more}\n'

    def mesh(self, corners, triangles, albedo, rib):
        """The tracer gets triangles, the renderer what they stand for."""
        for t in triangles:
            self.line("triangle", *(x for i in t for x in corners[i]), albedo, 0)
        self.rib.append(rib)

    def text(self):
        return (self.head + 'WorldBegin\nAttribute "light" "shadows" ["on"]\n' + self.indirect + self.lights + 'Sides 2\nSurface "matte"\n'
                + "".join(self.rib) + "WorldEnd\n")


def thin_walls():
    s = Scene((2.6, 1.2, -1.2), yaw=-60, fov=80)
    s.box((-3, 0, -1.5), (3, 2.5, 1.5), name="room")
    s.box((-0.01, 0, -1.5), (0.01, 2.5, 1.5), name="thin wall", without="-y +y -z +z")
    s.line("point", -1.5, 2, 0, 8)
    s.line("point", 1.5, 2, 0, 0.05)
    s.lights += ('LightSource "pointlight" "bright" "from" [-1.5 2 0] "intensity" [8]\nLightSource "pointlight" "dim" "from" [1.5 2 0] "intensity" [0.05]\n')
    return s


def niche():
    """A lamp of 26 cm that shines upwards between walls of 40 cm."""
    s = Scene((-1.7, 1.5, -1.7), yaw=45, pitch=5, fov=80)
    s.box((-2, 0, -2), (2, 3, 2), name="room")
    s.lamp((0.87, 0.02, 0.87), (0, 0, 0.26), (0.26, 0, 0), 300)
    for low, high in (((0.8, 0, 0.8), (0.82, 0.4, 1.2)), ((1.18, 0, 0.8), (1.2, 0.4, 1.2)), ((0.82, 0, 0.8), (1.18, 0.4, 0.82)),
                      ((0.82, 0, 1.18), (1.18, 0.4, 1.2))):
        s.box(low, high, name="low wall")
    return s


def slot():
    """A room without a lamp beside one with a lamp, with a slot of 2 cm between them."""
    s = Scene((2.6, 1.2, -1.2), yaw=-60, fov=80)
    s.box((-3, 0, -1.5), (3, 2.5, 1.5), name="room")
    for low, high in ((0, 1), (1.02, 2.5)):
        s.box((-0.05, low, -1.5), (0.05, high, 1.5), name="wall")
    s.point((-1.5, 2, 0), 8)
    return s


def window(more=""):
    """A closed room with a window of 1 x 1 to an even sky."""
    s = Scene((-1.7, 1.5, -1.7), yaw=40, fov=80)
    s.box((-2, 0, -2), (2, 3, 2), name="room", without="+x")
    for (y, Y), (z, Z) in (((0, 1), (-2, 2)), ((2, 3), (-2, 2)), ((1, 2), (-2, -0.5)), ((1, 2), (0.5, 2))):
        s.quad((2, y, z), (2, y, Z), (2, Y, Z), (2, Y, z), name="wall with a window")
    s.sky(3, more)
    return s


def contact():
    s = Scene((0, 1.2, -3), pitch=18, fov=50)
    s.quad((-8, 0, -8), (-8, 0, 8), (8, 0, 8), (8, 0, -8), 0.6, "floor")
    s.ball((0, 0.7, 0), 0.7, 0.6, name="ball")
    s.sky(1)
    return s


def moving_ball():
    s = Scene((0, 1.6, -3), pitch=22, fov=50, shutter=True)
    s.quad((-8, 0, -8), (-8, 0, 8), (8, 0, 8), (8, 0, -8), 0.6, "floor")
    s.ball((-0.6, 0.8, 0), 0.4, 0.6, (1.2, 0, 0), name="ball")
    s.lamp((-0.2, 4, -0.2), (0.4, 0, 0), (0, 0, 0.4), 60)
    return s


def displaced_ball(amplitude=0.08, waves=9, more=""):
    """A ball of radius 0.7 with bumps; the tracer gets 320 x 160 x 2 triangles of it."""
    s = Scene((0, 1.2, -3), pitch=12, fov=50)
    s.quad((-8, 0, -8), (-8, 0, 8), (8, 0, 8), (8, 0, -8), 0.6, "floor")
    s.lamp((-2.5, 3, -1.5), (0.8, 0, 0), (0, 0, 0.8), 20)
    rings, sectors = 160, 320
    corners = []
    for j in range(rings + 1):
        for i in range(sectors):
            t, p = math.pi * j / rings, 2 * math.pi * i / sectors
            n = (math.sin(t) * math.cos(p), math.sin(t) * math.sin(p), math.cos(t))
            r = 0.7 + amplitude * math.prod(math.sin(waves * x) for x in n)
            corners.append((r * n[0], 0.8 + r * n[1], r * n[2]))
    triangles = []
    for j in range(rings):
        for i in range(sectors):
            a, b = j * sectors + i, j * sectors + (i + 1) % sectors
            triangles += [(a, b, b + sectors), (a, b + sectors, a + sectors)]
    s.mesh(corners, triangles, 0.6,
           f'AttributeBegin\n{s.color(0.6, "displaced ball")}{more}Translate 0 0.8 0\nAttribute "displacementbound" "float sphere" [{amplitude}] "coordinatesystem" ["object"]\n'
           f'Displacement "bumps" "amplitude" [{amplitude}] "waves" [{waves}]\nSphere 0.7 -0.7 0.7 360\nAttributeEnd\n')
    return s


BUMPS = """displacement bumps(float amplitude = 0.1; float waves = 9) {
  vector n = normalize(vector transform("shader", P));
  normal out = normalize(N);
  P += out * amplitude * sin(waves * xcomp(n)) * sin(waves * ycomp(n)) * sin(waves * zcomp(n));
  N = calculatenormal(P);
}
"""
GATHER, MANY, ATLAS = ["--gi", "gather"], ["--gi", "gather", "--bounces", "12"], ["--gi", "atlas"]
RADIOSITY, REFERENCE = ["--gi", "radiosity"], ["--gi", "reference", "--bounces", "12", "--samples", "64"]
SCENES = {"thin_walls": thin_walls, "niche": niche, "slot": slot, "window": window, "contact": contact, "moving_ball": moving_ball,
          "displaced_ball": displaced_ball}
# A round of so many paths a pixel, at which the truth is better than what it judges.
PATHS = {"thin_walls": 1024, "niche": 8192, "slot": 16384, "window": 4096, "contact": 2048, "moving_ball": 2048, "displaced_ball": 2048}
METHODS = {"atlas": ATLAS, "gather": MANY, "reference": REFERENCE}


def blocks(picture):
    """The mean luminance of each block; all scenes are grey."""
    sums = {}
    for (x, y), value in pixels(picture).items():
        at = (y // BLOCK, x // BLOCK)
        sums[at] = sums.get(at, 0) + value[0] / BLOCK ** 2
    return [sums[at] for at in sorted(sums)]


def percentile(values, share=0.99):
    return sorted(values)[min(len(values) - 1, int(share * len(values)))]


class Bench:
    def __init__(self, tomales, folder, threads, tracer=None):
        self.tomales, self.folder, self.threads = tomales, pathlib.Path(folder), threads
        self.tracer = tracer or self.folder / "truth_tracer"
        if not self.tracer.exists():
            subprocess.run(["c++", "-O2", "-std=c++20", "-pthread", HERE / "truth_tracer.cpp", "-o", self.tracer], check=True)
        (self.folder / "bumps.sl").write_text(BUMPS)

    def truth(self, name, share=1):
        """Means and their standard errors, kept beside the scene."""
        scene, paths = SCENES[name](), int(PATHS[name] * share)
        (self.folder / f"{name}.rib").write_text(scene.text())
        lines, kept = "\n".join(scene.lines), self.folder / f"{name}.{paths}.truth"
        if not kept.exists():
            out = subprocess.run([self.tracer, str(paths), self.threads], input=lines, capture_output=True, text=True, check=True).stdout
            kept.write_text(out)
        return [tuple(map(float, row.split())) for row in kept.read_text().splitlines()]

    def render(self, name, method, *more):
        """Block means, CPU seconds, codes of warnings."""
        out, stats = self.folder / f"{name}_{method}.exr", self.folder / "stats.json"
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        subprocess.run([self.tomales, "render", self.folder / f"{name}.rib", "-q", "-t", self.threads, *METHODS[method], *more, "-o", out, "--stats", stats], check=False)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        said = sorted({w["code"] for w in json.loads(stats.read_text())["warnings"]})
        return blocks(out), after.ru_utime - before.ru_utime, said

    def compare(self, name, method, share, *more):
        truth = self.truth(name, share)
        got, seconds, said = self.render(name, method, *more)
        lit = [(g, t, n) for g, (t, n) in zip(got, truth) if t > 0]
        mean = sum(g for g, _, _ in lit) / sum(t for _, t, _ in lit) - 1
        worst = percentile([abs(g / t - 1) for g, t, _ in lit])
        noise = percentile([3 * n / t for _, t, n in lit])
        return mean, worst, noise, seconds, said


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("tomales", type=lambda p: pathlib.Path(p).resolve())
    parser.add_argument("--scenes", nargs="+", choices=SCENES, default=list(SCENES))
    parser.add_argument("--methods", nargs="+", choices=METHODS, default=list(METHODS))
    parser.add_argument("--paths", type=float, default=1, help="share of the paths of the truth")
    parser.add_argument("--keep", help="where scenes, truths and pictures stay")
    parser.add_argument("-t", default="2")
    parser.add_argument("more", nargs="*", help="further arguments of the renderer, after --")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as temporary:
        bench = Bench(arguments.tomales, arguments.keep or temporary, arguments.t)
        print("| scene | method | mean | 99th percentile of blocks | 3 x noise of the truth | CPU s | warnings |\n|---|---|---|---|---|---|---|")
        for name in arguments.scenes:
            for method in arguments.methods:
                mean, worst, noise, seconds, said = bench.compare(name, method, arguments.paths, *arguments.more)
                print(f"| {name} | {method} | {100 * mean:+.1f} % | {100 * worst:.1f} % | {100 * noise:.1f} % | {seconds:.1f} | {', '.join(said)} |", flush=True)


if __name__ == "__main__":
    main()
