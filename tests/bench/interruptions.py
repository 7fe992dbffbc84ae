"""Ends renders at random moments by SIGTERM and SIGKILL in turn, each six times, resumes them with --resume, and prints how much
work is done again.
    interruptions.py build/release/tomales [SCENE.rib [KILLS [OPTIONS...]]]
    interruptions.py build/release/tomales --animation
The second form ends an animation of 20 frames 5 times, and prints how many finished frames are rendered again (--skip-finished).
CPU seconds of equal work differ on a busy machine, so the work that is done again is given for a whole frame: the CPU time of its
seven runs beyond that of one run, divided by the sum of the CPU times before each signal. The gather rays of each run are
printed, except for those that were killed (0)."""
import json
import math
import os
import pathlib
import random
import resource
import signal
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


def used_s(process):
    """Returns the CPU seconds that a running process has used; infinity if it has ended."""
    try:
        fields = pathlib.Path(f"/proc/{process.pid}/stat").read_text().rsplit(")", 1)[1].split()
    except FileNotFoundError:
        return math.inf
    return math.inf if fields[0] == "Z" else (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def render(picture, *more, after_s=math.inf, number=None):
    """Sends the signal `number` after the given CPU seconds. Returns CPU seconds, gather rays (None if they are not reported),
    and the exit code."""
    stats, before = folder / "stats.json", cpu_s()
    stats.unlink(missing_ok=True)
    process = subprocess.Popen([program, scene.name, "-o", folder / picture, "--one-picture", "-q", "--stats", stats, *options, *more], cwd=scene.parent, stderr=subprocess.DEVNULL)
    if number:
        while used_s(process) < after_s:
            time.sleep(0.005)
        process.send_signal(number)
    process.wait()
    rays = json.loads(stats.read_text())["rays"]["gather"] if stats.exists() else None
    return cpu_s() - before, rays, process.returncode


def interrupted(chance, usual_s, numbers):
    """Ends a frame by these signals, at moments that are drawn from its usual CPU time. Returns the CPU seconds until each signal, and of all, and the
    gather rays of each run."""
    moments = sorted(chance.uniform(0.05, 0.95) * usual_s for _ in numbers)
    total_s, until_s, rays = 0, [], []
    for moment, number in zip(moments, numbers):
        used, told, code = render("cut.exr", "--resume", after_s=max(moment - total_s, 0.1), number=number)
        total_s += used
        if code == 0:
            raise SystemExit("the frame was finished before the signal")
        until_s.append(total_s)
        rays.append(told)
    used, told, _ = render("cut.exr", "--resume")
    return until_s, total_s + used, rays + [told]


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
        time.sleep(0 if k == kills else chance.uniform(0, 0.3))  # This stops in the middle of a frame.
        process.send_signal((signal.SIGTERM, signal.SIGKILL)[k % 2])
        process.wait()
        now = finished()
        again += sum(now[name] != stamp for name, stamp in before.items())
        print(f"run {k + 1}: {len(before)} frames were finished, {len(now)} are; {again} were rendered again so far", flush=True)
        before = now


if "--animation" in sys.argv:
    animation()
    sys.exit()
whole_s, whole_rays, _ = render("whole.exr")
whole = (folder / "whole.exr").read_bytes()
print(f"uninterrupted: {whole_s:.1f} CPU s, {whole_rays} gather rays")
chance, different = random.Random(1), 0
PER_FRAME = 6
for k in range(kills // PER_FRAME):
    usual_s = render("cut.exr", "--resume")[0]
    numbers = [(signal.SIGTERM, signal.SIGKILL)[n % 2] for n in range(PER_FRAME)] if k % 2 else [signal.SIGTERM] * 3 + [signal.SIGKILL] * 3
    until_s, total_s, rays = interrupted(chance, usual_s, numbers)
    different += (folder / "cut.exr").read_bytes() != whole
    print(f"{' '.join(n.name for n in numbers)} after {' '.join(f'{s:.1f}' for s in until_s)} CPU s: {total_s:.1f} in all, {usual_s:.1f} without; "
          f"done again {100 * (total_s - usual_s) / sum(until_s):.1f} %; gather rays {rays}", flush=True)
print(f"{different} pictures differ")
