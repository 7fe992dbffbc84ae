"""Tests batches in trouble: full disks, truncated files, machines that died, and clusters that refuse jobs. Finished files stay, unfinished ones are
made again, and what cannot work is reported before anything begins."""
import json
import os
import pathlib
import resource
import signal
import subprocess
import time

from moving_ball import frame, head
from program import Suite

t = Suite()
t.folder = t.folder / "with blanks"
t.folder.mkdir()
t.write("shot.rib", head(64, 48) + "".join(frame(i, 32, 0.2) for i in range(1, 4)))
t.run("shot.rib", "-o", "one.#.exr", "-q")


def same(prefix, other="one", frames=range(1, 4)):
    return all(json.loads(t.run("compare", f"{prefix}.{f}.exr", f"{other}.{f}.exr", "--json").stdout or "{}").get("different_pixels") == 0 for f in frames)


def limited(size, *arguments):
    """Runs the command with files of no more than `size` bytes, as beyond a quota."""
    def limit():
        signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
        resource.setrlimit(resource.RLIMIT_FSIZE, (size, size))
    return subprocess.run([t.program, *arguments], cwd=t.folder, capture_output=True, text=True, preexec_fn=limit, timeout=120)


def left(pattern):
    return sorted(p.name for p in t.folder.glob(pattern))


# A disk or a quota is full.
result = limited(100, "batch", "shot.rib", "-o", "q.#.exr", "--plan", "quota")
t.expect(result.returncode == 4 and "plan.json" in result.stderr and "could not be written" in result.stderr, f"no room for the plan: {result.stderr.strip()}")
t.expect(not left("q.*") and not left("quota/plan.json"), "begins nothing")
result = limited(6000, "batch", "shot.rib", "-o", "q.#.exr", "--plan", "quota", "-j", "2")
t.expect(result.returncode == 4 and "finished 0 of 3" in result.stdout and "task 0001.render failed" in result.stdout, f"no room for pictures: exit {result.returncode}")
t.expect("could not be written" in result.stdout and not left("q.*"), "is said by the last lines of each log, and leaves no half picture")
t.expect_run("once there is room", ["batch", "retry", "quota"], 0, "finished 3 of 3")
t.expect(same("q"), "all of them are made")
small = t.folder / "small"
small.mkdir()
script = f'mount -t tmpfs -o size=64k none small && cp shot.rib small && cd small && "{t.program}" batch shot.rib -o s.#.exr -j 1; code=$?; ls; exit $code'
result = subprocess.run(["unshare", "-m", "sh", "-c", script], cwd=t.folder, capture_output=True, text=True, timeout=120)
if "permitted" in result.stderr or "mount" in result.stderr:
    print("        no file system can be mounted here: " + result.stderr.splitlines()[0])
else:
    t.expect(result.returncode == 4 and "No space left on device" in result.stdout + result.stderr, f"a full disk: exit {result.returncode}")
    t.expect(not [n for n in result.stdout.splitlines() if n.endswith((".part", ".tmp"))], "leaves no file that looks finished")

# Truncated files are made again, with the files that depend on them.
t.expect_run("a plan alone", ["batch", "shot.rib", "-o", "h.#.exr", "--tiles", "2x1", "--plan", "half", "--plan-only"], 0, "15 tasks are in")
t.expect(not left("half/state/*") and not left("h.*"), "runs nothing")
plan = json.loads((t.folder / "half/plan.json").read_text())
for task in plan["tasks"]:
    task.pop("removes", None)
t.write("half/plan.json", json.dumps(plan))
t.expect_run("it is edited, and run", ["batch", "half", "-j", "2"], 0, "finished 3 of 3")
for file, victim in (("half/work/0002.icf", "h.2.exr"), ("half/work/0003.t001.exr", "h.3.exr")):
    whole = (t.folder / file).read_bytes()
    t.write(file, whole[:len(whole) // 2])
    (t.folder / victim).unlink()
before = (t.folder / "half/work/0002.dfb").stat().st_mtime_ns
t.expect_run("half of a file between", ["batch", "half", "-j", "2"], 0, "finished 3 of 3")
t.expect(same("h") and (t.folder / "half/work/0002.dfb").stat().st_mtime_ns == before, "is not taken for a whole one, and nothing else is made")

# One of two pictures is lost after the tiles from which it was joined have been removed.
t.write("pair.rib", (t.folder / "shot.rib").read_text().replace("WorldBegin", 'Display "p.exr" "openexr" "rgba"\nDisplay "+p_ids.exr" "openexr" "cryptoobject"\nWorldBegin'))
t.expect_run("two pictures a frame", ["batch", "pair.rib", "-o", "p.#.exr", "--tiles", "2x1", "--plan", "pair", "-j", "2"], 0, "finished 3 of 3")
pictures = {name: (t.folder / name).read_bytes() for name in left("p.*.exr")}
stamps = {name: (t.folder / name).stat().st_mtime_ns for name in pictures}
tiles = pathlib.Path("pair", "work", "*").as_posix()
t.expect(len(pictures) == 6 and not left(tiles), f"are there, and nothing else ({left('p.*')}, {left(tiles)})")
for lost in ("p.2_ids.exr", "p.3.exr"):
    (t.folder / lost).unlink()
t.expect_run("one of them is lost", ["batch", "pair", "-j", "2"], 0, "finished 3 of 3")
t.expect({name: (t.folder / name).read_bytes() for name in left("p.*.exr")} == pictures, "and is made again")
again = {name for name, stamp in stamps.items() if (t.folder / name).stat().st_mtime_ns != stamp}
t.expect({"p.2_ids.exr", "p.3.exr"} <= again <= {"p.2_ids.exr", "p.3.exr", "p.3_ids.exr"}, f"alone ({again})")
t.expect(not left(tiles), f"and its tiles are removed again ({left(tiles)})")

# One machine has died, and one lives.
t.write("half/owner", "4711 elsewhere\n")
(t.folder / "h.1.exr").unlink()
t.expect_run("another machine works on the plan", ["batch", "half"], 2, "process 4711 of elsewhere works on the plan", "if that machine has died")
old = time.time() - 100
os.utime(t.folder / "half/owner", (old, old))
t.expect_run("it has died", ["batch", "half"], 0, "finished 3 of 3")
t.expect(not left("half/owner*"), "and nobody owns the plan now")
t.expect_run("cancel of a plan that rests", ["batch", "cancel", "half"], 2, "nothing works on the plan")

# If two machines begin a task at the same moment, one of them does the work.
runs = [subprocess.Popen([t.program, "batch", "shot.rib", "-o", "b.#.exr", "--plan", "both", "-j", "1"], cwd=t.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) for _ in range(2)]
codes = sorted((run.communicate(timeout=120)[1].count("another process works") or run.returncode * 10) for run in runs)
t.expect(codes in ([0, 1], [0, 0]) and same("b"), f"two submissions of one plan: one of them says so, or finds all done {codes}")

# One frame always fails. Others finish, and the page shows it in red.
(t.folder / "closed").write_text("a file where a folder must be")
t.write("two.rib", head(64, 48) + 'Display "ok.exr" "file" "rgba"\n' + frame(1, 32, 0.2) + 'Display "closed/no.exr" "file" "rgba"\n' + frame(2, 32, 0.2))
t.expect_run("a frame fails", ["batch", "two.rib", "--html", "page.html", "-j", "1"], 4, "finished 1 of 2", "task 0002.render failed", "output-folder")
page = (t.folder / "page.html").read_text()
t.expect('<tr class="failed"><td>2' in page and ".failed{color:#c00}" in page and page.count("data:image/png") == 1, "the page shows it in red, and the other as a picture")
told = json.loads(t.run("batch", "status", "two.batch", "--json").stdout)
t.expect((told["finished"], told["failed"], told["waiting"]) == (1, 1, 0) and "output-folder" in told["failures"][0]["last_lines"], "as JSON, too")
log = t.run("batch", "log", "two.batch", "2").stdout
t.expect(log.count("output-folder") == 3, "its log has three attempts")
t.expect_run("a frame that the plan lacks", ["batch", "log", "two.batch", "9"], 2, "no frame 9")
t.write("same.rib", head(64, 48) + 'Display "same.exr" "file" "rgba"\n' + frame(1, 32, 0.2) + frame(2, 32, 0.2))
t.expect_run("a scene that writes one file from every frame", ["batch", "same.rib"], 2, "frames 1 and 2 both write \"same.exr\"")
t.expect(not left("same.*exr") and not left("same.batch"), "begins nothing")

# Frames share a chain of records, as they would if the commands were typed by hand.
t.expect_run("records in groups of two", ["batch", "shot.rib", "-o", "c.#.exr", "--share-records", "2", "--plan", "chain", "-j", "2"], 0, "finished 3 of 3")
for f in (1, 2):
    t.run("hide", "shot.rib", "-o", f"c{f}.dfb", "--frames", str(f), "-q")
    t.run("gather", f"c{f}.dfb", "-o", f"c{f}.icf", *(["--irradiance", "c1.icf"] if f == 2 else []), "-q")
for f in (1, 2):
    t.run("shade", f"c{f}.dfb", "--irradiance", "c2.icf", "-o", f"d.{f}.exr", "-q")
t.expect(same("c", "d", (1, 2)) and same("c", "one", (3,)), "have the bits of the chain, and of one run where a group ends")
t.expect_run("records of frames without a picture in OpenEXR", ["batch", "shot.rib", "-o", "c.#.png", "--share-records", "2", "--plan", "png"], 2, "--share-records: frame 1 has")

# Scripts act as a cluster that refuses jobs.
fakes = pathlib.Path(t.temporary.name) / "bin"
fakes.mkdir()


def fake(name, text):
    (fakes / name).write_text("#!/bin/sh\n" + text)
    (fakes / name).chmod(0o755)


path = os.environ["PATH"]
os.environ["PATH"] = f"{fakes}:{path}"
submit = ["batch", "shot.rib", "-o", "f.#.exr", "--tiles", "2x1", "--plan", "cluster", "--engine", "slurm"]
fake("sinfo", "echo slurm_load_partitions: Unable to contact slurm controller >&2; exit 1")
t.expect_run("a controller that does not answer", submit, 2, "Slurm does not answer", "Unable to contact")
fake("sinfo", "echo render; echo night")
t.expect_run("a partition that is not there", [*submit, "--partition", "day"], 2, 'no partition "day"; it has render, night')
t.expect(not left("cluster"), "leaves no plan")
fake("squeue", "exit 1")
fake("scancel", 'echo "$@" > cancelled')
fake("sbatch", 'n=$(cat count 2>/dev/null || echo 0); echo $((n + 1)) > count; [ $n -lt 2 ] || { echo "sbatch: error: AssocMaxSubmitJobLimit" >&2; exit 1; }; echo $((100 + n))')
t.expect_run("a limit of jobs", submit, 2, "AssocMaxSubmitJobLimit", "nothing is on the cluster")
t.expect((t.folder / "cancelled").read_text().split() == ["100", "101"], "what was submitted before is taken back")
fake("sbatch", 'echo "$@" >> submitted; n=$(cat count); echo $((n + 1)) > count; echo $((100 + n))')
t.expect_run("a cluster that takes the jobs", submit, 0, "15 tasks are on the cluster")
lines = (t.folder / "submitted").read_text().splitlines()
t.expect(len(lines) == 5 and "--dependency=aftercorr:105:106" in lines[4], f"frames and their tiles are five arrays, of which the last waits for both tiles: {lines}")
fake("squeue", "echo 103")
t.expect_run("the same plan here while they are there", ["batch", "cluster"], 2, "on the cluster already")
t.expect_run("and once more there", ["batch", "cluster", "--engine", "slurm"], 2, "on the cluster already")
(fakes / "squeue").unlink()
os.environ["PATH"] = str(fakes)
t.expect_run("nobody can tell whether they are there", ["batch", "cluster"], 2, 'there is no "squeue" here to ask', "remove")
os.environ["PATH"] = path
task = json.loads((t.folder / "cluster/0000.hide.json").read_text())["tasks"][1]["name"]
t.expect_run("a task as a job runs it", ["batch", "task", "cluster/0000.hide.json", task], 0)
t.expect(task == "0002.hide" and json.loads((t.folder / "cluster/state/0002.hide.json").read_text())["state"] == "done", "leaves its state in the plan")
t.finish()
