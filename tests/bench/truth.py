"""Compares small scenes on which methods of indirect light are known to go wrong with a path tracer that shares no code with the renderer
(tests/bench/truth_tracer.cpp, compiled here), or with closed forms.

    tests/bench/truth.py build/release/tomales [--scenes thin_walls niche] [--methods atlas] [--paths 0.1] [--keep FOLDER] [-t 2] [-- ...]

Each scene and method has a row: the relative errors of the picture's mean and of the 99th percentile of its blocks of 8 x 8 pixels, three times the
noise of the truth at that percentile, CPU seconds, and the codes of warnings. These are the rows of docs/measured/truth.md.
"""
import argparse
import json
import pathlib
import resource
import subprocess
import sys
import tempfile

from truth_scenes import SCENES, SHADERS

HERE = pathlib.Path(__file__).parent
sys.path.insert(0, str(HERE.parent / "image"))
from pictures import pixels  # noqa: E402

BLOCK = 8
METHODS = {"atlas": ["--gi", "atlas"], "gather": ["--gi", "gather", "--bounces", "12"], "radiosity": ["--gi", "radiosity", "--bounces", "12"],
           "reference": ["--gi", "reference", "--bounces", "12", "--samples", "24"]}


def blocks(picture):
    """Returns the mean of each block. All scenes are grey."""
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
        for name, text in SHADERS.items():
            (self.folder / f"{name}.sl").write_text(text)

    def truth(self, name, share=1):
        """Returns block means and their standard errors, by a formula or by the tracer. Results of the tracer are kept beside the
        scene."""
        make, paths = SCENES[name]
        scene = make()
        (self.folder / f"{name}.rib").write_text(scene.text())
        return [(scene.known, 0)] * (scene.size // BLOCK) ** 2 if scene.known is not None else self.traced(name, int(paths * share))

    def traced(self, name, paths):
        """The same by the tracer alone, kept beside the scene."""
        lines, kept = "\n".join(SCENES[name][0]().lines), self.folder / f"{name}.{paths}.truth"
        if not kept.exists():
            out = subprocess.run([self.tracer, str(paths), self.threads], input=lines, capture_output=True, text=True, check=True).stdout
            kept.write_text(out)
        return [tuple(map(float, row.split())) for row in kept.read_text().splitlines()]

    def render(self, name, method, *more):
        """Returns block means, CPU seconds and the codes of warnings."""
        out, stats = self.folder / f"{name}_{method}.exr", self.folder / "stats.json"
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        subprocess.run([self.tomales, "render", self.folder / f"{name}.rib", "-q", "-t", self.threads, *METHODS[method], *SCENES[name][0]().more, *more, "-o", out, "--stats", stats], check=False)
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
