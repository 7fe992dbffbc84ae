"""Tests whether `tomales render --target-error` reaches its target. It compares the stated error with the true one, over rooms of
tests/stability, of the gallery, and generated ones.

    tests/bench/target_scenes.py build/release/tomales ROWS.jsonl [--scenes cornell lamp_slot generated1] [--targets 8 4 2 1] [--seeds 1 2] [--format 64x48] [--paths 1024]
    tests/bench/target_scenes.py --table ROWS.jsonl

The pictures have direct and indirect light. The truth of each is the mean of two pictures with different random numbers, by `--gi
reference`, or with 1024 samples of each light if there is no indirect light. Its noise, which is half of their difference, is
subtracted from squared errors. All pictures share the pixels' samples, so edges are the same. Each frame is a line of ROWS.jsonl
and is made once, so the same command continues where it stopped. The second form prints the table and the totals of
docs/measured/error.md.
"""
import argparse
import collections
import json
import os
import pathlib
import random
import re
import subprocess
import sys
import tempfile

from error_rooms import LABORATORY, ROOT, random_room, true_error

sys.path.insert(0, str(ROOT / "tests/image"))
from pictures import pixels  # noqa: E402

ROOMS = ["box_ball", "bumps", "contact", "grazing", "hair", "hot_spot", "lamp_slot", "sun_room", "thin_blades", "thin_wall"]
GALLERY = ["cornell", "cornell_ball", "furnace", "interior", "rectlight", "still_life", "shading/sky", "shading/materials"]
SCENES = ROOMS + GALLERY + [f"generated{i}" for i in range(1, 15)]
MORE_PATHS = {"hot_spot": 4}
TRUTH_SEED = 1000


def generated_room(seed):
    """Returns random_room() with lamps that have an area, a sky, and other materials. No constant of the program was chosen by
    these rooms."""
    r = random.Random(100 + seed)
    text = random_room(100 + seed)

    def material(found):
        kind = r.choice(["matte", "matte", 'plastic" "Ks" [0.3] "roughness" [0.2', 'metal" "roughness" [0.3', 'plastic" "Kd" [0.8] "Ks" [0.1'])
        return f'{found[0]}Surface "{kind}{"]" if "[" in kind else chr(34)}\n'

    text = re.sub(r"AttributeBegin\n", material, text)
    lights = ""
    if r.random() < 0.6:
        x, z, w, h = r.uniform(0.3, 1.2), r.uniform(0.3, 1.2), r.uniform(0.1, 0.6), r.uniform(0.1, 0.6)
        y = r.uniform(1.2, 1.9)
        lights += (f'AttributeBegin\nAttribute "visibility" "int camera" [0]\nAreaLightSource "arealight" "lamp" "intensity" [{r.uniform(2, 12):.2f}] "samples" [{r.choice([1, 4, 16])}]\n'
                   f'Surface "constant"\nPolygon "P" [{x} {y} {z}  {x + w} {y} {z}  {x + w} {y} {z + h}  {x} {y} {z + h}]\nAttributeEnd\nIlluminate "lamp" 1\n')
    if r.random() < 0.3:
        lights += (f'LightSource "environmentlight" "sky" "intensity" [{r.uniform(0.2, 1):.2f}] "color lightcolor" [0.7 0.85 1] "float samples" [{r.choice([4, 16])}]\n'
                   'Attribute "light" "shadows" "on"\n')
    return text.replace('Surface "matte"\n', lights + 'Surface "matte"\n', 1)


class Scenes:
    def __init__(self, tomales, folder, given):
        self.tomales, self.folder, self.given = tomales, pathlib.Path(folder), given

    def rib(self, scene):
        """Copies the scene so that its pixels are those that audits see: no filter across pixels, no exposure and no imager."""
        if scene.startswith("generated"):
            text, home = generated_room(int(scene.removeprefix("generated"))), self.folder
        else:
            path = LABORATORY / f"{scene}.rib" if scene in ROOMS else ROOT / "scenes" / (f"{scene}.rib" if "/" in scene else f"{scene}/{scene}.rib")
            text, home = path.read_text(), path.parent
        text = re.sub(r"^\s*(PixelFilter|Exposure|Imager|Quantize|Display) .*\n", "", text, flags=re.M)
        out = self.folder / f"{scene.replace('/', '_')}.rib"
        out.write_text('PixelFilter "box" 1 1\nDisplay "out.exr" "openexr" "rgba"\n' + text)
        return out, home

    def render(self, scene, out, *arguments):
        rib, home = self.rib(scene)
        stats = self.folder / "stats.json"
        run = subprocess.run([self.tomales, "render", rib, "-t", "1", "--format", self.given.format, "--pixel-samples", "2x2", "--bucket-size", "16", "-o", out,
                              "--stats", stats, *arguments], capture_output=True, text=True, cwd=home, env={**os.environ, "TOMALES_SHADERS": str(home)})
        if not stats.exists() or not out.exists():
            raise RuntimeError(f"{scene}: {run.stderr[-600:]}")
        return pixels(out), json.loads(stats.read_text()), run.stderr

    def truth(self, scene):
        paths = str(self.given.paths * MORE_PATHS.get(scene, 1))
        gathers = '"indirectlight"' in self.rib(scene)[0].read_text()  # The reference would add such a light.
        method = ["--gi", "reference", "--ray-geometry", "scene", "--samples", paths] if gathers else ["--light-samples", "1024"]
        return [self.render(scene, self.folder / "truth.exr", "-q", *method, "--light-seed", str(TRUTH_SEED + i))[0] for i in range(2)]

    def frame(self, scene, truth, target, seed):
        """Returns the figures of one frame."""
        picture, stats, said = self.render(scene, self.folder / "picture.exr", "--target-error", f"{target}%", "--light-seed", str(seed))
        true, noise = true_error(picture, truth)
        stated = stats["audit"]["picture"]
        chosen = re.search(r"chose (.*?) for", said)
        missed = re.search(r"[^\n]*after (\d) of at most", said)
        return {"scene": scene, "target": target, "seed": seed, "true": true, "truth_noise": noise, "stated": stated["mean"], "low": stated["low"], "high": stated["high"],
                "noise": stated["noise"], "smudges": stats["audit"].get("smudges_8", {}).get("mean"), "missed": "[target-missed]" in said, "unproved": "[target-unproved]" in said,
                "unused": "[target-unused]" in said, "attempts": int(missed[1]) if missed else None, "first": chosen and chosen[1], "cpu_s": stats["cpu_s"],
                "time_s": {k: v for k, v in stats["time_s"].items() if k in ("trials", "audit", "gather", "shade", "total")}}


def percents(values):
    return " ".join(f"{100 * v:.2f}" for v in values)


def told(row):
    """Returns whether the statement is a number, and not a bound."""
    return row["stated"] >= row["noise"]


def print_table(rows):
    print("| scene | target, % | true, % | stated, % | interval holds it | CPU s |\n|---|---|---|---|---|---|")
    groups = collections.defaultdict(list)
    for row in rows:
        groups[row["scene"], row["target"]].append(row)
    for (scene, target), some in groups.items():
        inside = sum(r["low"] <= r["true"] <= r["high"] for r in some)
        stated = " ".join(f"{100 * r['stated']:.2f}" if told(r) else f"under {100 * r['high']:.2f}" for r in some)
        cpu = " ".join(f"{r['cpu_s']:.1f}" for r in some)
        print(f"| {scene} | {target:g} | {percents(r['true'] for r in some)} | {stated} | {inside} of {len(some)} | {cpu} |")
    total = len(rows)
    ratios = [max(r["stated"], 1e-9) / max(r["true"], 1e-9) for r in rows]
    near = sum(1 / 1.5 <= x <= 1.5 for x in ratios)
    far = sum(not 1 / 2 <= x <= 2 for x in ratios)
    below = sum(x < 1 / 1.5 for x in ratios)
    inside = sum(r["low"] <= r["true"] <= r["high"] for r in rows)
    reached = sum(100 * r["true"] <= 1.2 * r["target"] for r in rows)
    silent = sum(100 * r["true"] > 1.2 * r["target"] and not r["missed"] and not r["unproved"] for r in rows)

    def share(n):
        return f"{n} of {total} ({100 * n / max(1, total):.0f} %)"
    print(f"\nstated within 1.5 times of the truth: {share(near)}, off by more than twice: {share(far)}, understated by more than 1.5 times: {share(below)}; "
          f"the interval holds the truth: {share(inside)}; at most 1.2 times the target: {share(reached)}, more than that without a warning: {share(silent)}")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("tomales", nargs="?", type=lambda p: pathlib.Path(p).resolve())
    parser.add_argument("rows", type=pathlib.Path)
    parser.add_argument("--scenes", nargs="+", default=SCENES)
    parser.add_argument("--targets", nargs="+", type=float, default=[8, 4, 2, 1])
    parser.add_argument("--seeds", nargs="+", type=int, default=[1, 2])
    parser.add_argument("--format", default="64x48")
    parser.add_argument("--paths", type=int, default=1024)
    parser.add_argument("--table", action="store_true")
    given = parser.parse_args()
    rows = [json.loads(line) for line in given.rows.read_text().splitlines()] if given.rows.exists() else []
    if given.table:
        return print_table(rows)
    done = {(r["scene"], r["target"], r["seed"]) for r in rows}
    with tempfile.TemporaryDirectory() as folder, given.rows.open("a") as out:
        scenes = Scenes(given.tomales, folder, given)
        truths, failed = {}, set()
        for seed in given.seeds:
            for scene in given.scenes:
                targets = [t for t in given.targets if (scene, t, seed) not in done and scene not in failed]
                try:
                    if targets and scene not in truths:
                        truths[scene] = scenes.truth(scene)
                    for target in targets:
                        out.write(json.dumps(scenes.frame(scene, truths[scene], target, seed)) + "\n")
                        out.flush()
                except (RuntimeError, KeyError) as e:
                    failed.add(scene)
                    print(f"{scene} is left out: {e}", file=sys.stderr, flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
