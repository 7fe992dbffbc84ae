"""Submits many tiny frames to a real Slurm cluster on this machine (tests/slurm/cluster.py, which needs root, slurm-wlm and
munge). It measures the controller's CPU time and memory, the time to submit, and the time until all frames are finished.
    batch_controller.py build/release/tomales [FRAMES]"""
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import time

sys.path[:0] = [str(pathlib.Path(__file__).resolve().parent.parent / folder) for folder in ("cli", "slurm")]
from cluster import Cluster, missing  # noqa: E402
from moving_ball import frame, head  # noqa: E402

if lost := missing():
    sys.exit(lost)
program, frames = pathlib.Path(sys.argv[1]).resolve(), int(sys.argv[2]) if len(sys.argv) > 2 else 1000
TICKS = os.sysconf("SC_CLK_TCK")


def run(*arguments):
    return subprocess.run([program, *arguments], cwd=work, capture_output=True, text=True)


def controller():
    """Returns the CPU seconds and resident megabytes of slurmctld."""
    process = pathlib.Path("/proc") / str(cluster.daemons["slurmctld"].pid)
    used = (process / "stat").read_text().rsplit(")", 1)[1].split()
    return (int(used[11]) + int(used[12])) / TICKS, int((process / "statm").read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE") / 1e6


with tempfile.TemporaryDirectory() as folder:
    cluster, work = Cluster(pathlib.Path(folder) / "cluster"), pathlib.Path(folder) / "work"
    work.mkdir()
    (work / "tiny.rib").write_text(head(16, 12) + "".join(frame(i, 4, 0.001) for i in range(1, frames + 1)))
    try:
        cluster.start()
        before, begun = controller()[0], time.monotonic()
        sent = run("batch", "tiny.rib", "-o", "t.####.exr", "--engine", "slurm")
        print(f"{sent.stdout.strip()}{sent.stderr.strip()} after {time.monotonic() - begun:.1f} s", flush=True)
        finished = 0
        while finished < frames and time.monotonic() - begun < 3600:
            time.sleep(5)
            finished = json.loads(run("batch", "status", "tiny.batch", "--json").stdout)["finished"]
        cpu, memory = controller()
        print(f"{finished} frames are finished after {time.monotonic() - begun:.0f} s; slurmctld took {cpu - before:.1f} CPU s and {memory:.0f} MB")
        print(" ".join(line.strip() for line in cluster.say("sdiag").splitlines() if "Jobs submitted" in line or "Jobs completed" in line))
    finally:
        cluster.stop()
