"""Finds pictures that are wrong although `--audit` states a small error and no warning is given, over every scene with a knob in
tests/stability/knobs.

    tests/bench/error_lab.py build/release/tomales [--scenes irradiance_spot dice_rate] [--values first last] [-t 1]

It renders each method of tests/stability/knobs at the first and the last value of its knob, against two truths as `tomales chart
--stability` makes them, and writes the rows of the table in docs/measured/error.md. A picture is called silent if its true error
is more than twice the largest stated error, pixel samples included, and more than 5 %, and no warning says that something is
wrong.
"""
import argparse
import json
import pathlib
import re
import subprocess
import sys
import tempfile

from error_rooms import ROOT, true_error

sys.path.insert(0, str(ROOT / "tests/image"))
from pictures import pixels  # noqa: E402

WRONG = 0.05


class Scene:
    def __init__(self, path, tomales, folder, threads):
        self.text, self.tomales, self.folder, self.threads = path.read_text(), tomales, folder, threads
        said = re.findall(r"^##lab (\w+) (.*)$", self.text, re.M)
        self.of = {word: [rest for w, rest in said if w == word] for word, _ in said}
        self.values = self.of["knob"][0].rsplit(": ", 1)[1].split()

    def render(self, arguments, value, truth):
        scene, stats, out = (self.folder / name for name in ("scene.rib", "stats.json", "out.exr"))
        scene.write_text(self.text.replace("$knob", value).replace("$truth", str(truth)))
        words = [*" ".join(self.of.get("common", [])).split(), *arguments.replace("$knob", value).split()]
        subprocess.run([self.tomales, "render", scene, "-q", "-t", self.threads, *words, "-o", out, "--stats", stats], check=True, timeout=900)
        return pixels(out), json.loads(stats.read_text())

    def measure(self, value):
        """Returns rows: method, true error and its noise, the stated error, what pixel samples add, the codes of warnings."""
        truths = [self.render(self.of["truth"][0].replace("@", str(i)), value, 1)[0] for i in (1, 2)]
        for method in self.of["method"]:
            name, arguments = method.rsplit(": ", 1)
            picture, stats = self.render(arguments + " --audit", value, 0)
            error, noise = true_error(picture, truths)
            yield name, error, noise, stats["audit"]["picture"], stats["audit"].get("pixel_samples", {}).get("mean", 0), sorted({w["code"] for w in stats["warnings"]} - {"audit"})


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("tomales", type=lambda p: pathlib.Path(p).resolve())
    parser.add_argument("--scenes", nargs="+")
    parser.add_argument("--values", nargs="+", choices=["first", "last"], default=["first", "last"])
    parser.add_argument("-t", dest="threads", default="1")
    given = parser.parse_args()
    count = silent = 0
    print("| scene | knob | method | true, % | stated, % | at most, % | pixel samples up to about, % | warnings | silent |\n|---|---|---|---|---|---|---|---|---|", flush=True)
    with tempfile.TemporaryDirectory() as folder:
        for path in sorted((ROOT / "tests/stability/knobs").glob("*.rib")):
            if given.scenes and path.stem not in given.scenes:
                continue
            scene = Scene(path, given.tomales, pathlib.Path(folder), given.threads)
            for value in [scene.values[0 if v == "first" else -1] for v in given.values]:
                try:
                    rows = list(scene.measure(value))
                except (subprocess.SubprocessError, ValueError) as failure:
                    print(f"| {path.stem} | {value} | not measured: {failure} |", flush=True)
                    continue
                for name, error, noise, stated, samples, warnings in rows:
                    is_silent = error > WRONG and error > 2 * (max(stated["high"], stated["noise"]) + samples) and not warnings
                    count, silent = count + 1, silent + is_silent
                    print(f"| {path.stem} | {value} | {name} | {100 * error:.2f} ({100 * noise:.2f}) | {100 * stated['mean']:.2f} | {100 * stated['high']:.2f} | {100 * samples:.2f} | "
                          f"{' '.join(f'`{w}`' for w in warnings)} | {'SILENT' if is_silent else ''} |", flush=True)
    print(f"\n{count} pictures, {silent} of them silent")


if __name__ == "__main__":
    main()
