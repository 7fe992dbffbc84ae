"""Compares equation 8 of Tabellion and Lamorlette 2004, on its bumped, glossy ball (scenes/cornell_ball), with a gather at every
point that uses the whole BRDF of plastic.

    equation8.py TOMALES FOLDER [--size 128] [--truth 4096]

The truth is a surface shader that sends rays over the hemisphere of the bumped normal, and passes the light of each to the
plastic's diffuse() and specular(). With fewer rays this shader is the other method of the comparison. Errors are rms over the
pixels of the ball, divided by the mean of the truth's whole light there. CPU seconds are those of the picture with both parts,
minus those without indirect light. Pictures stay in FOLDER. Needs a C++ compiler.
"""
import argparse
import json
import math
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/image"))
from pictures import pixels  # noqa: E402

PLUGIN = r"""#include <reyes/sl.h>
using namespace sl;
namespace {
rsl::FloatParam Kd("Kd", 0.6f, "weight of diffuse light"), Ks("Ks", 0.5f, "weight of highlights"), roughness("roughness", 0.15f, "width of highlights");
rsl::UniformFloatParam samples("samples", 256, "rays");

/// The cosine-weighted mean of the light from all sides is diffuse(). A highlight divides the light of each ray by its cosine, because specular() has none.
struct wholeplastic : Surface {
  void main() {
    Normal Nf = faceforward(normalize(N), I);
    Vector V = -normalize(I), direction;
    const int count = int(uniform(samples));
    Color seen, even, shine;
    gather("illuminance", P, Nf, rsl::kPi / 2, count, rays("distribution", "cosine"), {{"surface:Ci", &seen}, {"ray:direction", &direction}},
           [&] {
             Normal w = normalize(direction);
             even += seen / count;
             shine += seen * specularbrdf(w, Nf, V, roughness) / max(dot(w, Nf), 1e-3) / count;
           }, [&] {});
    Oi = Os;
    Ci = Os * (Cs * Kd * even + Ks * shine);
  }
};
const rsl::Shader shader(TM_SURFACE, "wholeplastic", "plastic in gathered light", TM_KEEPS_OPACITY | TM_TRACES, sl::shade<wholeplastic>, {&Kd, &Ks, &roughness, &samples});
}  // namespace
TM_SHADER_LIBRARY(shader)
"""
SCENE = (ROOT / "scenes/cornell_ball/cornell_ball.rib").read_text()
PLASTIC = 'Surface "plastic" "float Kd" [0.6] "float Ks" [0.5]'
PARTS = {"whole": (0.6, 0.5), "diffuse": (0.6, 0), "glossy": (0, 0.5)}
CROP = "0.3,0.7,0.35,0.76"
EYE, BALL, RADIUS, FOV = 3.95, -0.15, 0.5, 38

parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
parser.add_argument("tomales", type=pathlib.Path)
parser.add_argument("folder", type=pathlib.Path)
parser.add_argument("--size", type=int, default=128)
parser.add_argument("--truth", type=int, default=4096)
options = parser.parse_args()
folder = options.folder.resolve()


def on_ball(x, y):
    """Returns whether a pixel shows the ball, except for a rim of a pixel."""
    half = options.size / 2
    unit = half / math.tan(math.radians(FOV / 2))
    return math.hypot(x + 0.5 - half, y + 0.5 - half + unit * BALL / EYE) < unit * RADIUS / math.sqrt(EYE ** 2 - RADIUS ** 2) - 1.5


def render(name, surface, *arguments):
    """Returns the colours of the ball, and CPU seconds."""
    rib, out, stats = folder / f"{name}.rib", folder / f"{name}.exr", folder / f"{name}.json"
    rib.write_text(f'Option "searchpath" "string shader" ["{folder}:@"]\n' + SCENE.replace(PLASTIC, surface))
    subprocess.run([options.tomales.resolve(), "render", rib, "-q", "--plugin-path", folder, "-t", "1", "--format", f"{options.size}x{options.size}", "--crop", CROP, "-o", out, "--stats", stats,
                    *map(str, arguments)], check=True)
    return {xy: c[:3] for xy, c in pixels(out).items() if on_ball(*xy)}, json.loads(stats.read_text())["cpu_s"]


def gathered(rays, part):
    Kd, Ks = PARTS[part]
    return render(f"rays_{rays}_{part}", f'Surface "wholeplastic" "float samples" [{rays}] "float Kd" [{Kd}] "float Ks" [{Ks}]', "--gi", "none")


def cached(max_error, samples, part):
    Kd, Ks = PARTS[part]
    return render(f"cache_{max_error}_{samples}_{part}", f'Surface "plastic" "float Kd" [{Kd}] "float Ks" [{Ks}]', "--gi", "gather", "--indirect-only", "--max-error", max_error,
                  "--samples", samples)


def main():
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "wholeplastic.cpp").write_text(PLUGIN)
    subprocess.run(["g++", "-O2", "-std=c++17", "-fPIC", "-shared", "-I", ROOT, folder / "wholeplastic.cpp", "-o", folder / "wholeplastic.so"], check=True)
    truth = {part: gathered(options.truth, part)[0] for part in PARTS}
    mean = sum(map(sum, truth["whole"].values())) / (3 * len(truth["whole"]))
    shares = {part: sum(map(sum, truth[part].values())) / (3 * len(truth[part]) * mean) for part in PARTS}
    print(f"{len(truth['whole'])} pixels; of the light {100 * shares['diffuse']:.0f} % is diffuse, {100 * shares['glossy']:.0f} % glossy")
    bare = render("none", PLASTIC, "--gi", "none", "--indirect-only")[1]

    def report(name, method):
        line = []
        for part in PARTS:
            seen, cpu = method(part)
            if part == "whole":
                seconds = cpu - bare
            off = [s - t for xy, c in truth[part].items() for s, t in zip(seen[xy], c)]
            line.append(f"{part} {100 * math.sqrt(sum(d * d for d in off) / len(off)) / mean:5.1f} % (in the mean {100 * sum(off) / len(off) / mean:+5.1f} %)")
        print(f"{name:<34} {seconds:6.2f} CPU s, {', '.join(line)}", flush=True)

    for max_error, samples in ((2, 1000), (2, 256), (1, 256), (0, 256)):
        report(f"equation 8, maxerror {max_error}, {samples} rays", lambda part: cached(max_error, samples, part))
    for rays in (16, 64, 256, 1024):
        report(f"every point, {rays} rays", lambda part: gathered(rays, part))


if __name__ == "__main__":
    main()
