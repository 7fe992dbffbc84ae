"""Measures how exactly a frame with `--time-budget` keeps its budget, in CPU seconds, so that other jobs of the machine do not count.

    tests/bench/budgets.py build/release/tomales [--scenes cornell interior random1] [--budgets 5 10 20] [--seeds 2] [--format 256x256] [--audit] [-v]

A preloaded library, which this script makes with the C compiler, replaces the program's clock by the CPU time of its process.
With one thread this is the time that the clock would show on a quiet machine. It writes the table in docs/measured/error.md.
"""
import argparse
import json
import os
import pathlib
import re
import subprocess
import tempfile

from error_rooms import LABORATORY, ROOT, random_room

CLOCK = r"""
#define _GNU_SOURCE
#include <dlfcn.h>
#include <time.h>
int clock_gettime(clockid_t clock, struct timespec* t) {
  static int (*real)(clockid_t, struct timespec*);
  if (!real) real = dlsym(RTLD_NEXT, "clock_gettime");
  return real(clock == CLOCK_MONOTONIC ? CLOCK_PROCESS_CPUTIME_ID : clock, t);
}
"""


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("tomales", type=lambda p: pathlib.Path(p).resolve())
    parser.add_argument("--scenes", nargs="+", default=["cornell", "interior", "cornell_ball", "box_ball", "lamp_slot", "contact"] + [f"random{i}" for i in range(1, 7)])
    parser.add_argument("--budgets", nargs="+", type=float, default=[5, 10, 20])
    parser.add_argument("--seeds", type=int, default=1)
    parser.add_argument("--format", default="256x256")
    parser.add_argument("--audit", action="store_true")
    parser.add_argument("-v", dest="verbose", action="store_true", help="say what each round was expected to take, and took")
    given = parser.parse_args()
    runs = near = early = late = 0
    print("| scene | budget, s | CPU s | of the budget | before shading, s | shading, s: expected | took | chosen |\n|---|---|---|---|---|---|---|---|", flush=True)
    with tempfile.TemporaryDirectory() as temporary:
        folder = pathlib.Path(temporary)
        (folder / "clock.c").write_text(CLOCK)
        subprocess.run(["cc", "-shared", "-fPIC", "-o", folder / "clock.so", folder / "clock.c", "-ldl"], check=True)
        for scene in given.scenes:
            if scene.startswith("random"):
                path = folder / f"{scene}.rib"
                path.write_text(random_room(int(scene.removeprefix("random"))))
            else:
                path = next(p for p in (LABORATORY / f"{scene}.rib", ROOT / "scenes" / scene / f"{scene}.rib") if p.exists())
            for budget in given.budgets:
                for seed in range(1, given.seeds + 1):
                    said = subprocess.run([given.tomales, "render", path, "-t", "1", "--format", given.format, "-o", folder / "out.exr", "--time-budget", str(budget),
                                           "--light-seed", str(seed), "--stats", folder / "stats.json", "-v", *(["--audit"] if given.audit else [])],
                                          check=True, capture_output=True, text=True, cwd=folder, env={**os.environ, "LD_PRELOAD": str(folder / "clock.so")}).stderr
                    stats = json.loads((folder / "stats.json").read_text())
                    cpu_s = stats["cpu_s"]
                    steps = re.search(r"shading begins after (\S+) s and takes about (\S+) s", said)
                    runs, near = runs + 1, near + (0.9 <= cpu_s / budget <= 1.1)
                    early, late = early + (cpu_s < 0.8 * budget), late + (cpu_s > 1.1 * budget)
                    chosen = (re.search(r"chose (.*?) for", said) or ["", "the scene's"])[1]
                    over = " time-over" if "[time-over]" in said else ""
                    print(f"| {scene} | {budget:g} | {cpu_s:.1f} | {cpu_s / budget:.2f} | {steps[1]} | {steps[2]} | {stats['time_s']['shade']:.1f} | `{chosen}`{over} |", flush=True)
                    if given.verbose:
                        print("".join(f"    {line}\n" for line in said.splitlines() if "was expected to take" in line), end="", flush=True)
    print(f"\n{runs} frames: {near} within 10 % of the budget, {early} before 80 % of it, {late} more than 10 % late")


if __name__ == "__main__":
    main()
