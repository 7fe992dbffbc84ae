"""Renders random scenes that nobody would write, and checks that each ends soon, in little memory and with an exit code.

    random_scenes.py TOMALES [--count 200] [--seed 1] [--keep FOLDER] [-- OPTION...]

Each scene is made of requests of the request table (reyes/rib/request_table.cpp). The table's letters say what arguments a
request takes, and primitives get arrays of lengths that fit. Most numbers are reasonable; some are enormous, tiny, missing or not
a number. Pictures have 24 x 20 pixels. A scene that takes more than 10 CPU s or 1 GB, or ends by a signal or an unknown exit
code, is a finding: its number, command and figures are printed, and the exit code is 1. The same seed makes the same scenes.
Options after `--` are those of `tomales render`; without them, each scene draws its own options (--gi, --memory-limit).
"""
import argparse
import os
import pathlib
import random
import re
import resource
import subprocess
import sys
import tempfile

CPU_LIMIT_S, CPU_KILL_S, MEMORY_LIMIT_MB = 10, 60, 1024
TABLE = pathlib.Path(__file__).resolve().parent.parent.parent / "reyes/rib/request_table.cpp"
SIGNATURES = dict(re.findall(r'^    \{"(\w+)", "([^"]*)", k', TABLE.read_text(), re.M))

EXTREME = ["1e4", "-1e4", "1e6", "1e9", "-1e12", "1e20", "1e30", "-1e37", "3e38", "1e-6", "1e-20", "1e-40", "0", "-0", "nan", "inf", "-inf", "1e999"]
STRINGS = {"Projection": ["perspective", "orthographic"], "Orientation": ["outside", "inside", "lh", "rh"],
           "GeometricApproximation": ["flatness"], "ShadingInterpolation": ["constant", "smooth"], "CoordinateSystem": ["here"],
           "ScopedCoordinateSystem": ["here"], "CoordSysTransform": ["here", "camera", "raster"], "Hider": ["hidden", "raytrace"],
           "Surface": ["matte", "plastic", "constant", "glass", "mirror", "disney", "metal", "nowhere"],
           "Displacement": ["bumpy", "nowhere"], "Atmosphere": ["fog", "depthcue"], "Imager": ["background"],
           "LightSource": ["pointlight", "distantlight", "spotlight", "ambientlight", "indirectlight", "skylight", "arealight"],
           "AreaLightSource": ["arealight"], "SolidBegin": ["primitive", "union", "intersection", "difference"]}
BASES = ['"bezier" 3', '"b-spline" 1', '"catmull-rom" 1', '"hermite" 2', '"power" 4']
OPTIONS = ["ScreenWindow", "CropWindow", "FrameAspectRatio", "Clipping", "DepthOfField", "Shutter", "PixelSamples", "PixelFilter",
           "Exposure", "Quantize", "RelativeDetail", "Hider", "ClippingPlane", "Imager"]
ATTRIBUTES = ["Color", "Opacity", "TextureCoordinates", "Surface", "Displacement", "Atmosphere", "Interior", "Exterior", "ShadingRate",
              "ShadingInterpolation", "Matte", "Bound", "Detail", "DetailRange", "GeometricApproximation", "Orientation",
              "ReverseOrientation", "Sides"]
TRANSFORMS = ["Identity", "Transform", "ConcatTransform", "Perspective", "Translate", "Rotate", "Scale", "Skew", "CoordinateSystem",
              "CoordSysTransform"]


class Scene:
    def __init__(self, seed):
        self.random = random.Random(seed)
        self.extreme = self.random.choice([0.01, 0.05, 0.2])  # A number is unreasonable this often.
        self.lines = []

    def number(self, low=-3.0, high=3.0):
        r = self.random
        if r.random() < self.extreme:
            return r.choice(EXTREME)
        return f"{r.uniform(low, high):.3g}"

    def numbers(self, count, low=-3.0, high=3.0):
        return "[" + " ".join(self.number(low, high) for _ in range(count)) + "]"

    def whole(self, low, high):
        r = self.random
        return r.choice([0, -1, 100000, 2**31 - 1]) if r.random() < self.extreme / 5 else r.randint(low, high)

    def maybe(self, chance):
        return self.random.random() < chance

    def say(self, text):
        self.lines.append(text)

    def arguments(self, name):
        """Returns arguments of the kinds that the letters of the request's signature name."""
        out = []
        letters = SIGNATURES[name]
        if letters.startswith("?"):
            letters = letters[1:] if self.maybe(0.7) else ""
        for letter in letters:
            if letter == "f":
                out.append(self.number(0, 2))
            elif letter == "i":
                out.append(str(self.whole(0, 3)))
            elif letter == "s":
                out.append('"' + self.random.choice(STRINGS.get(name, ["a"])) + '"')
            elif letter == "h":
                out.append(str(self.random.randint(1, 4)))
            elif letter == "c":
                out.append(self.numbers(3, 0, 1))
            elif letter == "m":
                out.append(self.matrix())
            elif letter.isdigit():
                out.append(" ".join(self.number(*((0, 1) if name in ("CropWindow", "Detail") else (-2, 4))) for _ in range(int(letter))))
        return " ".join(out)

    def matrix(self):
        if self.maybe(0.3):
            return self.numbers(16)
        return f"[1 0 0 0 0 1 0 0 0 0 1 0 {self.number()} {self.number()} {self.number()} 1]"

    def parameters(self, name):
        r, out = self.random, ""
        if name == "Projection" and self.maybe(0.7):
            out += f' "fov" {self.number(20, 120)}'
        if name in ("LightSource", "AreaLightSource"):
            out += f' "intensity" {self.number(0, 30)}'
            if self.maybe(0.5):
                out += f' "from" {self.numbers(3)} "to" {self.numbers(3)}'
            if self.maybe(0.2):
                out += f' "samples" {self.whole(1, 64)}'
        if name == "Displacement" and self.maybe(0.7):
            out += f' "Km" {self.number(0, 1)}'
        if name == "Surface" and self.maybe(0.3):
            out += f' "float roughness" {self.number(0, 1)} "color specularcolor" {self.numbers(3, 0, 1)}'
        return out

    def request(self, name):
        if name == "PixelSamples":
            return self.say(f"PixelSamples {self.random.randint(1, 4)} {self.random.randint(1, 4)}")
        if name == "PixelFilter":
            return self.say(f'PixelFilter "{self.random.choice(["box", "gaussian", "sinc", "catmull-rom"])}" {self.number(1, 4)} {self.number(1, 4)}')
        if name == "Quantize":
            return self.say(f'Quantize "rgba" {self.number(0, 255)} 0 255 {self.number(0, 1)}')
        self.say(f"{name} {self.arguments(name)}{self.parameters(name)}")

    def attribute(self):
        r = self.random
        if self.maybe(0.5):
            return self.request(r.choice(ATTRIBUTES))
        self.say("Attribute " + r.choice([
            f'"displacementbound" "float sphere" {self.number(0, 1)} "string coordinatesystem" "{r.choice(["shader", "object", "camera", "raster"])}"',
            f'"identifier" "string name" "thing {len(self.lines)}"',
            f'"visibility" "int camera" {r.randint(0, 1)} "int diffuse" 1 "int specular" 1 "int transmission" 1',
            f'"trace" "int displacements" {r.randint(0, 1)} "float bias" {self.number(0, .1)} "int samplemotion" {r.randint(0, 1)}',
            f'"dice" "int rasterorient" {r.randint(0, 1)} "int binary" {r.randint(0, 1)} "int roundcurve" {r.randint(0, 1)}',
            f'"irradiance" "float maxerror" {self.number(0, 1)} "float maxpixeldist" {self.number(0, 30)}',
            f'"radiosity" "float screentexels" {self.number(0, 2)} "float worldtexels" {self.number(0, 2)}',
            f'"stochastic" "int sigma" 1', f'"cull" "int hidden" {r.randint(0, 1)} "int backfacing" {r.randint(0, 1)}']))

    # The arrays of primitives have the lengths that the request asks for.
    def variables(self, points, spread=1.5):
        out = f' "P" {self.numbers(3 * points, -spread, spread)}'
        if self.maybe(0.2):
            out += f' "varying float roughness" {self.numbers(points, 0, 1)}'
        if self.maybe(0.2):
            out += f' "vertex color Cs" {self.numbers(3 * points, 0, 1)}'
        return out

    def polygons(self, kind):
        counts = [self.random.randint(3, 6) for _ in range(self.random.randint(1, 5))]
        points = self.random.randint(4, 12)
        indices = " ".join(str(self.random.randint(0, points - 1)) for _ in range(sum(counts)))
        sizes = " ".join(map(str, counts))
        if kind == "Polygon":
            return "Polygon" + self.variables(counts[0])
        if kind == "GeneralPolygon":
            return f"GeneralPolygon [{sizes}]" + self.variables(sum(counts))
        if kind == "PointsPolygons":
            return f"PointsPolygons [{sizes}] [{indices}]" + self.variables(points)
        if kind == "PointsGeneralPolygons":
            return f"PointsGeneralPolygons [{len(counts)}] [{sizes}] [{indices}]" + self.variables(points)
        tags = f' ["crease" "hole" "interpolateboundary"] [3 1 1 0 0 0] [0 1 2 0] [{self.number(0, 5)}]' if self.maybe(0.4) else ""
        scheme = self.random.choice(["catmull-clark", "loop", "bilinear"])
        if scheme == "loop":
            sizes, indices = " ".join("3" for _ in counts), " ".join(indices.split()[: 3 * len(counts)])
        return f'SubdivisionMesh "{scheme}" [{sizes}] [{indices}]{tags}' + self.variables(points)

    def patch_mesh(self):
        u, v = self.random.randint(4, 8), self.random.randint(4, 8)
        if self.maybe(0.5):
            u, v = 4 + 3 * self.random.randint(0, 2), 4 + 3 * self.random.randint(0, 2)
        kind, wraps = self.random.choice(["bilinear", "bicubic"]), ["nonperiodic", "nonperiodic", "periodic"]
        return f'PatchMesh "{kind}" {u} "{self.random.choice(wraps)}" {v} "{self.random.choice(wraps)}"' + self.variables(u * v)

    def nurbs(self):
        u, v, uo, vo = *(self.random.randint(3, 6) for _ in range(2)), *(self.random.randint(2, 3) for _ in range(2))
        knots = [" ".join(sorted((f"{self.random.uniform(0, 1):.2f}" for _ in range(n + o)))) for n, o in ((u, uo), (v, vo))]
        points = f'"Pw" {self.numbers(4 * u * v)}' if self.maybe(0.5) else f'"P" {self.numbers(3 * u * v)}'
        return f"NuPatch {u} {uo} [{knots[0]}] {self.number(0, .3)} {self.number(.7, 1)} {v} {vo} [{knots[1]}] {self.number(0, .3)} {self.number(.7, 1)} {points}"

    def curves(self):
        counts = [self.random.choice([2, 4, 7, 10]) for _ in range(self.random.randint(1, 6))]
        width = f' "constantwidth" {self.number(0, .5)}' if self.maybe(0.6) else f' "varying float width" {self.numbers(2 * len(counts), 0, 1)}'
        return (f'Curves "{self.random.choice(["linear", "cubic"])}" [{" ".join(map(str, counts))}] '
                f'"{self.random.choice(["nonperiodic", "periodic"])}"' + self.variables(sum(counts)) + width)

    def blobby(self):
        leaves = self.random.randint(1, 6)
        codes, floats = [], []
        for k in range(leaves):
            codes += ["1001", str(16 * k)]
            scale = self.number(.3, 1)
            floats += [scale, "0 0 0 0", scale, "0 0 0 0", scale, "0", self.number(-1, 1), self.number(-1, 1), self.number(-1, 1), "1"]
        codes += [str(self.random.choice([0, 1, 2, 3])), str(leaves), *map(str, range(leaves))]
        return f'Blobby {leaves} [{" ".join(codes)}] [{" ".join(floats)}] [""]'

    def quadric(self):
        n = self.number
        sweep = n(90, 360)
        return self.random.choice([
            f"Sphere {n(.2, 2)} {n(-1, 0)} {n(0, 1)} {sweep}", f"Cone {n(.5, 2)} {n(.2, 2)} {sweep}", f"Cylinder {n(.2, 2)} {n(-1, 0)} {n(0, 1)} {sweep}",
            f"Hyperboloid {n()} {n()} {n()} {n()} {n()} {n()} {sweep}", f"Paraboloid {n(.2, 2)} {n(0, .5)} {n(.5, 1)} {sweep}",
            f"Disk {n(-1, 1)} {n(.2, 2)} {sweep}", f"Torus {n(.5, 2)} {n(.1, .5)} {n(0, 90)} {n(180, 360)} {sweep}"])

    def primitive_text(self):
        kind = self.random.choice(["quadric", "quadric", "Polygon", "GeneralPolygon", "PointsPolygons", "PointsGeneralPolygons", "SubdivisionMesh",
                                   "Patch", "PatchMesh", "NuPatch", "Points", "Curves", "Blobby", "Geometry"])
        if kind == "quadric":
            return self.quadric()
        if kind in ("Polygon", "GeneralPolygon", "PointsPolygons", "PointsGeneralPolygons", "SubdivisionMesh"):
            return self.polygons(kind)
        if kind == "Patch":
            bilinear = self.maybe(0.5)
            return f'Patch "{"bilinear" if bilinear else "bicubic"}"' + self.variables(4 if bilinear else 16)
        if kind == "Points":
            count = self.random.randint(1, 40)
            return "Points" + self.variables(count) + (f' "constantwidth" {self.number(0, .5)}' if self.maybe(0.7) else "")
        return {"PatchMesh": self.patch_mesh, "NuPatch": self.nurbs, "Curves": self.curves, "Blobby": self.blobby,
                "Geometry": lambda: 'Geometry "teapot"'}[kind]()

    def primitive(self):
        text = self.primitive_text()
        if not self.maybe(0.15):
            return self.say(text)
        other = text
        for value in re.findall(r'(?<=[\[ ])-?\d\.\d+(?=[\] ])', text)[:6]:
            other = other.replace(value, self.number(), 1)
        self.say(f"MotionBegin [0 1]\n{text}\n{other}\nMotionEnd")

    def block(self, depth):
        r = self.random
        self.say("AttributeBegin")
        for _ in range(r.randint(0, 3)):
            if self.maybe(0.15):
                self.say("MotionBegin [0 1]")
                name = r.choice(["Translate", "Rotate", "Scale"])
                self.request(name), self.request(name)
                self.say("MotionEnd")
            else:
                self.request(r.choice(TRANSFORMS)) if self.maybe(0.4) else self.attribute()
        if self.maybe(0.1):
            self.say(f'SolidBegin "{r.choice(["union", "intersection", "difference"])}"')
            for _ in range(2):
                self.say('SolidBegin "primitive"\n' + self.quadric() + "\nSolidEnd")
            self.say("SolidEnd")
        for _ in range(r.randint(1, 3)):
            self.block(depth - 1) if depth > 0 and self.maybe(0.3) else self.primitive()
        self.say("AttributeEnd")

    def text(self):
        r = self.random
        self.say('Display "o.exr" "file" "rgba"\nFormat 24 20 1')
        self.say(f'Projection "{r.choice(["perspective", "orthographic"])}" "fov" {self.number(20, 120)}' if self.maybe(0.8) else "")
        for _ in range(r.randint(0, 3)):
            self.request(r.choice(OPTIONS))
        if self.maybe(0.3):
            self.say("Shutter 0 1")
        self.say(f"Translate 0 0 {self.number(2, 6)}\nWorldBegin")
        for k in range(r.randint(0, 3)):
            self.request(r.choice(["LightSource", "LightSource", "AreaLightSource"]))
        if self.maybe(0.5):
            self.say('Attribute "visibility" "int diffuse" 1 "int specular" 1 "int transmission" 1')
        for _ in range(r.randint(1, 5)):
            self.block(2)
        self.say("WorldEnd")
        return "\n".join(self.lines) + "\n"

    def options(self):
        r = self.random
        out = [] if self.maybe(0.4) else ["--gi", r.choice(["gather", "reference", "radiosity", "atlas", "none"])]
        out += ["--photons", "2000", "--samples", str(r.choice([1, 16, 64]))] if out else []
        return out + (["--memory-limit", "256M"] if self.maybe(0.3) else [])


def limited():
    resource.setrlimit(resource.RLIMIT_CPU, (CPU_KILL_S, CPU_KILL_S + 1))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    os.nice(10)


def run(program, folder, scene, options):
    """Returns CPU seconds, memory in MB, the exit code and the messages."""
    with open(folder / "messages", "wb") as messages:
        process = subprocess.Popen([program, "render", scene, "-t", "1", *options], cwd=folder, stdout=messages, stderr=messages, preexec_fn=limited)
        _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    return usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024, process.returncode, (folder / "messages").read_text(errors="replace")


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("program", type=pathlib.Path)
    arguments.add_argument("--count", type=int, default=200)
    arguments.add_argument("--seed", type=int, default=1)
    arguments.add_argument("--keep", type=pathlib.Path, help="the scenes of findings go there")
    arguments.add_argument("options", nargs="*")
    a = arguments.parse_args()
    findings, slowest, largest = 0, 0.0, 0.0
    with tempfile.TemporaryDirectory() as temporary:
        folder = pathlib.Path(temporary)
        for seed in range(a.seed, a.seed + a.count):
            scene = Scene(seed)
            (folder / "scene.rib").write_text(scene.text())
            options = a.options or scene.options()
            seconds, megabytes, code, messages = run(a.program.resolve(), folder, "scene.rib", options)
            slowest, largest = max(slowest, seconds), max(largest, megabytes)
            if seconds <= CPU_LIMIT_S and megabytes <= MEMORY_LIMIT_MB and code in (0, 2, 3):
                continue
            findings += 1
            last = messages.strip().splitlines()[-1:] or [""]
            print(f"seed {seed}: {seconds:.1f} CPU s, {megabytes:.0f} MB, exit {code}: render {' '.join(options)}: {last[0][:200]}", flush=True)
            if a.keep:
                a.keep.mkdir(parents=True, exist_ok=True)
                (a.keep / f"{seed}.rib").write_text((folder / "scene.rib").read_text())
    print(f"{a.count} scenes: {findings} findings; at most {slowest:.1f} CPU s and {largest:.0f} MB")
    return bool(findings)


if __name__ == "__main__":
    sys.exit(main())
