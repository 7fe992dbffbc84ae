"""Ends a render at random moments by SIGTERM and SIGKILL in turn, resumes it, and tells what is done again (--resume): the CPU
time of both runs together, against that of one, and the share of the gather rays of the first run that are traced again.
    interruptions.py build/release/tomales [SCENE.rib [KILLS [OPTIONS...]]]
Counted rays have no noise, but a killed program tells none, so they are said for SIGTERM alone. They are those of gathering: the
partial picture that SIGTERM leaves is shaded after the signal, with direct light and rays of its own."""
import json
import os
import pathlib
import random
import resource
import signal
import statistics
import subprocess
import sys
import tempfile

program = str(pathlib.Path(sys.argv[1]).resolve())
scene = pathlib.Path(sys.argv[2] if len(sys.argv) > 2 else pathlib.Path(__file__).parents[2] / "scenes/cornell/cornell.rib").resolve()
kills = int(sys.argv[3]) if len(sys.argv) > 3 else 30
options = sys.argv[4:]
folder = pathlib.Path(tempfile.mkdtemp())


def cpu_s():
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def render(picture, *more, after_s=None, number=None):
    """CPU seconds, gather rays (None if they are not told) and the exit code."""
    stats, before = folder / "stats.json", cpu_s()
    stats.unlink(missing_ok=True)
    process = subprocess.Popen([program, scene.name, "-o", folder / picture, "--one-picture", "-q", "--stats", stats, *options, *more], cwd=scene.parent, stderr=subprocess.DEVNULL)
    try:
        process.wait(after_s)
    except subprocess.TimeoutExpired:
        process.send_signal(number)
        process.wait()
    rays = json.loads(stats.read_text())["rays"]["gather"] if stats.exists() else None
    return cpu_s() - before, rays, process.returncode


start = os.times().elapsed
whole_s, whole_rays, _ = render("whole.exr")
elapsed_s = os.times().elapsed - start
whole = (folder / "whole.exr").read_bytes()
print(f"uninterrupted: {whole_s:.1f} CPU s, {whole_rays} gather rays; with --resume {render('cut.exr', '--resume')[0]:.1f} CPU s")
chance = random.Random(1)
both_s, again_rays, different = [], [], 0
for k in range(kills):
    number = (signal.SIGTERM, signal.SIGKILL)[k % 2]
    spent_s, spent_rays, code = render("cut.exr", "--resume", after_s=chance.uniform(0.1, 0.95) * elapsed_s, number=number)
    rest_s, rest_rays, _ = render("cut.exr", "--resume")
    different += (folder / "cut.exr").read_bytes() != whole
    if code == 0:
        continue  # it was done before the signal came
    both_s.append(spent_s + rest_s)
    said = f"{number.name} after {spent_s:.2f} CPU s: {rest_s:.2f} for the rest"
    if spent_rays:
        again_rays.append((spent_rays + rest_rays - whole_rays) / spent_rays)
        said += f"; {100 * again_rays[-1]:.1f} % of the gather rays again"
    print(said, flush=True)
print(f"{len(both_s)} interruptions: {different} pictures differ; both runs together: median {statistics.median(both_s):.2f} CPU s, "
      f"{min(both_s):.2f} to {max(both_s):.2f}; gather rays again: at most {100 * max(again_rays):.1f} %")
