"""Measures how often `tomales render --target-error` reaches the requested error, on the rooms of error_rooms.py.

    tests/bench/target_rooms.py build/release/tomales [--rooms box_ball hot_spot random1 random2] [--targets 8 4 2 1] [--seeds 2] [--size 64] [--paths 1024]

Pictures of indirect light alone are compared with two path-traced ones. Each room and target has a row: the true errors, the stated errors, how many
frames are within 1.2 times the target, how many had to be lit again or say that they missed it, and CPU seconds of the frame and of its trials. It
writes the table of docs/measured/error.md.
"""
import argparse
import json
import pathlib
import re
import subprocess
import sys
import tempfile

from error_rooms import ROOMS, Rooms, true_error

sys.path.insert(0, str(pathlib.Path(__file__).parents[1] / "image"))
from pictures import pixels  # noqa: E402


class Targets(Rooms):
    def reach(self, room, percent, seed):
        """Returns the picture, the statistics and the messages of a frame."""
        out, stats = self.folder / "picture.exr", self.folder / "stats.json"
        run = subprocess.run([self.tomales, "render", self.scene(room), "-t", self.threads, "--indirect-only", "--format", f"{self.size}x{self.size}",
                              "--pixel-samples", "2x2", "--bucket-size", "16", "-o", out, "--stats", stats, "--target-error", f"{percent}%",
                              "--light-seed", str(seed)], check=True, capture_output=True, text=True)
        return pixels(out), json.loads(stats.read_text()), run.stderr


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("tomales", type=lambda p: pathlib.Path(p).resolve())
    parser.add_argument("--rooms", nargs="+", default=ROOMS)
    parser.add_argument("--targets", nargs="+", type=float, default=[8, 4, 2, 1])
    parser.add_argument("--seeds", type=int, default=2)
    parser.add_argument("--size", type=int, default=64)
    parser.add_argument("--paths", type=int, default=1024)
    parser.add_argument("-t", dest="threads", default="1")
    given = parser.parse_args()
    trials = reached = near = 0
    print("| room | target, % | true, % | stated, % | within 1.2 | missed, said | CPU s | of trials | settings |\n|---|---|---|---|---|---|---|---|---|", flush=True)
    with tempfile.TemporaryDirectory() as folder:
        rooms = Targets(given.tomales, folder, given.size, given.threads)
        for room in given.rooms:
            truth = rooms.truth(room, given.paths)
            for target in given.targets:
                trues, stated, missed, cpu, tried, settings = [], [], 0, [], [], ""
                for seed in range(1, given.seeds + 1):
                    picture, stats, said = rooms.reach(room, target, seed)
                    trues.append(true_error(picture, truth)[0])
                    stated.append(stats["audit"]["picture"]["mean"])
                    missed += "[target-missed]" in said
                    cpu.append(stats["cpu_s"]), tried.append(stats["time_s"].get("trials", 0))
                    settings = (re.search(r"chose (.*?) for", said) or ["", "the scene's"])[1]
                good = sum(100 * e <= 1.2 * target for e in trues)
                trials, reached = trials + given.seeds, reached + good
                near += sum(1 / 1.5 <= s / t <= 1.5 for s, t in zip(stated, trues))

                def percents(values):
                    return " ".join(f"{100 * v:.2f}" for v in values)
                print(f"| {room} | {target:g} | {percents(trues)} | {percents(stated)} | {good} of {given.seeds} | {missed} | "
                      f"{' '.join(f'{c:.1f}' for c in cpu)} | {' '.join(f'{c:.1f}' for c in tried)} | `{settings}` |", flush=True)
    print(f"{trials} frames: {reached} within 1.2 times of the target; {near} stated within 1.5 times of the truth")


if __name__ == "__main__":
    main()
