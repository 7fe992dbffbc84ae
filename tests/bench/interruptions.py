"""Ends a render at random moments by SIGTERM and SIGKILL in turn, resumes it with --resume, and tells what is done again: the CPU time of both runs
together against that of one, and the share of the first run's gather rays that are traced again.
    interruptions.py build/release/tomales [SCENE.rib [KILLS [OPTIONS...]]]
    interruptions.py build/release/tomales --animation
The second form ends an animation of 20 frames 5 times, and tells how many finished frames are rendered again (--skip-finished). Counts of rays have
no noise, but a killed program tells none, so they are given for SIGTERM alone. Only rays of gathering count, because the partial picture that SIGTERM
leaves is shaded after the signal, with direct light and rays of its own."""
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
import time

arguments = [a for a in sys.argv[1:] if a != "--animation"]
program = str(pathlib.Path(arguments[0]).resolve())
scene = pathlib.Path(arguments[1] if len(arguments) > 1 else pathlib.Path(__file__).parents[2] / "scenes/cornell/cornell.rib").resolve()
kills = int(arguments[2]) if len(arguments) > 2 else 30
options = arguments[3:]
folder = pathlib.Path(tempfile.mkdtemp())


def cpu_s():
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def render(picture, *more, after_s=None, number=None):
    """Returns CPU seconds, gather rays (None if they are not told) and the exit code."""
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


def animation(frames=20, kills=5):
    """Ends and resumes frames of a Cornell box, seen by a camera that goes from the left to the right."""
    text = scene.read_text()
    head, world = text[:text.index("WorldBegin")], text[text.index("WorldBegin"):]
    (folder / "turn.rib").write_text(head + "".join(f"FrameBegin {k}\nTranslate {0.02 * k - 0.2:.2f} 0 0\n{world}\nFrameEnd\n" for k in range(1, frames + 1)))
    command = [program, "turn.rib", "-o", "turn.####.exr", "--one-picture", "--format", "96x96", "--samples", "300", "--skip-finished", "--resume", "-q"]

    def finished():
        return {p.name: p.stat().st_mtime_ns for p in folder.glob("turn.????.exr")}
    chance, again, before = random.Random(2), 0, {}
    for k in range(kills + 1):
        process = subprocess.Popen(command, cwd=folder, stderr=subprocess.DEVNULL)
        wanted = frames if k == kills else chance.randint(3, 5) + len(before)
        while process.poll() is None and (len(finished()) < wanted or k == kills):
            time.sleep(0.01)
        time.sleep(0 if k == kills else chance.uniform(0, 0.3))  # This stops within a frame.
        process.send_signal((signal.SIGTERM, signal.SIGKILL)[k % 2])
        process.wait()
        now = finished()
        again += sum(now[name] != stamp for name, stamp in before.items())
        print(f"run {k + 1}: {len(before)} frames were finished, {len(now)} are; {again} were rendered again so far", flush=True)
        before = now


if "--animation" in sys.argv:
    animation()
    sys.exit()
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
        continue  # The frame was done before the signal came.
    both_s.append(spent_s + rest_s)
    said = f"{number.name} after {spent_s:.2f} CPU s: {rest_s:.2f} for the rest"
    if spent_rays:
        again_rays.append((spent_rays + rest_rays - whole_rays) / spent_rays)
        said += f"; {100 * again_rays[-1]:.1f} % of the gather rays again"
    print(said, flush=True)
print(f"{len(both_s)} interruptions: {different} pictures differ; both runs together: median {statistics.median(both_s):.2f} CPU s, "
      f"{min(both_s):.2f} to {max(both_s):.2f}; gather rays again: at most {100 * max(again_rays):.1f} %")
