"""Measures how much noise `tomales denoise` removes from ten scenes at three levels of noise, and how accurate its stated errors are.

    tests/bench/denoise.py build/release/tomales [--format 160x120] [--only PART,PART] with parts of the scenes' names

Errors are root mean squares divided by the mean colour, of three pairs of halves. The truth is the mean of 8 pictures with 64
times the samples of the noisiest level. There are four errors: of the mean of the two halves and of the filtered picture, and
both as the command states them.
"""
import math
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.append(str(ROOT / "tests/image"))
from gallery import pictures_of  # noqa: E402
from pictures import pixels  # noqa: E402

GATHER = ("--gi", "gather", "--max-error", "2")
DIRECT = ("--gi", "none")
SCENES = {"cornell/cornell.rib": GATHER, "cornell_ball/cornell_ball.rib": GATHER, "interior/interior.rib": GATHER, "rectlight/rectlight.rib": DIRECT,
          "shading/sky.rib": DIRECT, "shading/materials.rib": DIRECT, "spheres/spheres.rib": DIRECT, "still_life/still_life.rib": DIRECT,
          "rays/traced.rib": DIRECT, "ris/ris.rib": DIRECT}
LEVELS = (1, 4, 16)  # These are the samples of a light. A record has 16 times as many rays.
TRUTHS, PAIRS = 8, 3

program = str(pathlib.Path(sys.argv[1]).resolve())
only = sys.argv[sys.argv.index("--only") + 1].split(",") if "--only" in sys.argv else []
size = sys.argv[sys.argv.index("--format") + 1] if "--format" in sys.argv else "160x120"


def render(folder, path, level, seed, out, options):
    subprocess.run([program, "render", str(folder / "scene.rib"), "--format", size, "--one-picture", "--light-samples", str(level), "--samples",
                    str(16 * level), "--light-seed", str(seed), "-o", str(folder / out), "-q", *options], cwd=path.parent)
    return pixels(folder / out)


def rms(picture, truth, mean):
    return math.sqrt(sum((a - b) ** 2 for p in truth for a, b in zip(picture[p][:3], truth[p])) / (3 * len(truth))) / mean


with tempfile.TemporaryDirectory() as name:
    folder = pathlib.Path(name)
    print(f"{'scene':28}" + "".join(f"{f'{n} samples: before, after':>26}{'stated':>16}" for n in LEVELS))
    for scene, options in SCENES.items():
        if only and not any(o in scene for o in only):
            continue
        path = ROOT / "scenes" / scene
        text = pictures_of(path, ROOT)[0].text
        text = re.sub(r'^(\s*Display "[^"]*") "[^"]*" "[^"]*"', r'\1 "openexr" "Ci,a,z,albedo,normal"', text, count=1, flags=re.M)
        (folder / "scene.rib").write_text(text)
        many = [render(folder, path, 64, 100 + k, "truth.exr", options) for k in range(TRUTHS)]
        truth = {p: [sum(m[p][c] for m in many) / len(many) for c in range(3)] for p in many[0]}
        mean = sum(sum(v) for v in truth.values()) / (3 * len(truth))
        line = f"{scene:28}"
        for level in LEVELS:
            squares = [[], [], [], []]  # The order is: true before and after, stated before and after.
            for pair in range(PAIRS):
                a, b = (render(folder, path, level, 2 * pair + k, f"{k}.exr", options) for k in (1, 2))
                half = {p: [(x + y) / 2 for x, y in zip(a[p][:3], b[p][:3])] for p in a}
                said = subprocess.run([program, "denoise", "1.exr", "2.exr", "-o", "clean.exr"], cwd=folder, capture_output=True, text=True)
                if said.returncode:
                    line += f"{said.stderr.strip()[-60:]}"
                    break
                after, before = re.search(r"error ([\d.]+) % of the mean, ([\d.]+) % before", said.stdout).groups()
                for row, error in zip(squares, (100 * rms(half, truth, mean), 100 * rms(pixels(folder / "clean.exr"), truth, mean), float(before), float(after))):
                    row.append(error ** 2)
            else:
                found = [math.sqrt(sum(row) / PAIRS) for row in squares]
                line += f"{found[0]:15.2f}{found[1]:10.2f}%{found[2]:8.2f}{found[3]:7.2f}%"
        print(line, flush=True)
