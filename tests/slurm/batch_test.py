"""Renders a moving scene with indirect light, in tiles, on a real Slurm cluster of two nodes. One node is killed while it works,
a task is killed, and the folder of pictures is read-only for a while. The pictures must still have the bits of one run on one
machine. A lost node delays its tasks by about two and a half minutes."""
import json
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "cli"))
from moving_ball import frame, head  # noqa: E402
from cluster import Cluster, missing  # noqa: E402

FRAMES, TILES = 24, "2x2"

if lost := missing():
    print("skipped: " + lost)
    sys.exit(77)
program = pathlib.Path(sys.argv[1]).resolve()
failures = 0


def expect(condition, message):
    global failures
    print(("ok      " if condition else "FAILED  ") + message, flush=True)
    failures += not condition


def run(*arguments):
    return subprocess.run([program, *arguments], cwd=work, capture_output=True, text=True)


def status():
    return json.loads(run("batch", "status", "shot.batch", "--json").stdout)


def wait_for(condition, patience_s):
    end = time.monotonic() + patience_s
    while not condition() and time.monotonic() < end:
        time.sleep(0.05)
    return condition()


def close_folder(path):
    """Makes a folder read-only, as a file server does while it is repaired. Root may not write there either."""
    return all(subprocess.run(["mount", *how, path, *to], capture_output=True).returncode == 0
               for how, to in ((["--bind"], [path]), (["-o", "remount,bind,ro"], [])))


def open_folder(path):
    subprocess.run(["mount", "-o", "remount,bind,rw", path], check=True)
    subprocess.run(["umount", "-l", path], check=True)


with tempfile.TemporaryDirectory() as folder:
    cluster = Cluster(pathlib.Path(folder) / "cluster")
    work = pathlib.Path(folder) / "a shot's folder"
    work.mkdir()
    (work / "out").mkdir()
    (work / "shot.rib").write_text(head(160, 120) + "".join(frame(i, 400, 0.03) for i in range(1, FRAMES + 1)))
    try:
        cluster.start()
        run("shot.rib", "-o", "one.####.exr", "-q", "-t", "1")
        submit = ["batch", "shot.rib", "-o", "out/s.####.exr", "--tiles", TILES, "--engine", "slurm"]
        wrong = run(*submit, "--partition", "nowhere")
        expect(wrong.returncode == 2 and 'no partition "nowhere"; it has render' in wrong.stderr, "a wrong partition is told before anything begins")
        expect(not (work / "shot.batch").exists(), "and leaves no plan")
        begun = time.monotonic()
        sent = run(*submit, "--partition", "render", "--mem", "150M")
        expect(sent.returncode == 0 and "tasks are on the cluster" in sent.stdout, "the plan is submitted " + sent.stderr)
        print(f"        {sent.stdout.strip()} after {time.monotonic() - begun:.1f} s", flush=True)
        again = run(*submit)
        expect(again.returncode == 2 and "on the cluster already" in again.stderr, "and not submitted twice")
        closed = close_folder(work / "out")
        print("        the folder of pictures is read-only" if closed else "        the folder of pictures cannot be made read-only here", flush=True)
        expect(wait_for(lambda: len(list((work / "shot.batch" / "work").glob("*.icf"))) >= 3, 120), "frames are gathered")
        wait_for(lambda: cluster.steps_of("n2") and cluster.steps_of("n1"), 30)
        victims = cluster.steps_of("n2")
        cluster.kill_node("n2")
        expect(bool(victims), f"a node is killed while it works on {len(victims)} processes")
        renderers = [p for p in cluster.steps_of("n1") if pathlib.Path(f"/proc/{p}/comm").read_text().startswith(("tomales", "exe"))]
        for process in renderers[:1]:
            os.kill(process, signal.SIGKILL)
        expect(bool(renderers), "and a task on the other one")
        if closed:
            expect(wait_for(lambda: status()["failures"] or status()["finished"], 200) and not list((work / "out").iterdir()), "no picture is finished in a closed folder")
            open_folder(work / "out")
        done = wait_for(lambda: status()["finished"] == FRAMES or not cluster.say("squeue", "-h"), 600)
        if status()["finished"] < FRAMES:  # Slurm gives up jobs whose launch failed with the node.
            print("        " + run(*submit).stdout.strip() + " once more", flush=True)
        done = wait_for(lambda: status()["finished"] == FRAMES, 300)
        expect(done, f"all frames are finished after {time.monotonic() - begun:.0f} s")
        if not done:
            print(run("batch", "status", "shot.batch").stdout, cluster.say("squeue"), sep="\n")
        different = [f for f in range(1, FRAMES + 1) if json.loads(run("compare", f"out/s.{f:04}.exr", f"one.{f:04}.exr", "--json").stdout or "{}").get("different_pixels") != 0]
        expect(not different, f"with the bits of one run on one machine {different or ''}")
        jobs = cluster.say("sdiag")
        print("        " + " ".join(line.strip() for line in jobs.splitlines() if "Jobs submitted" in line or "Jobs completed" in line))
    finally:
        subprocess.run(["umount", "-l", work / "out"], capture_output=True)
        cluster.stop()
sys.exit(bool(failures))
