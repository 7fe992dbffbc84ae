"""Tests a batch, which renders frames as tasks of a plan. The pictures must have the bits of one run although tasks fail, runs are killed and plans
are edited. What cannot work is reported before anything begins."""
import base64
import json
import os
import pathlib
import pty
import re
import shutil
import signal
import subprocess
import time

from moving_ball import frame, head
from program import Suite

HEAD = head(64, 48)
SCENE = HEAD + "".join(frame(i, 32, 0.2) for i in range(1, 5))
t = Suite()
t.folder = t.folder / "a folder's name"  # Paths have blanks and quotes.
t.folder.mkdir()
t.write("my shot.rib", SCENE)
t.run("my shot.rib", "-o", "one.####.exr", "-q")


def same(prefix, frames=range(1, 5)):
    return all(json.loads(t.run("compare", f"{prefix}.{f:04}.exr", f"one.{f:04}.exr", "--json").stdout or "{}").get("different_pixels") == 0
               for f in frames)


def status(plan):
    return json.loads(t.run("batch", "status", plan, "--json").stdout)


t.expect_run("frames", ["batch", "my shot.rib", "-o", "f.####.exr", "-j", "2"], 0, "R90000  100%", "finished 4 of 4 frames")
t.expect(same("f"), "have the bits of one run")
master, slave = pty.openpty()
code = subprocess.run([t.program, "batch", "my shot.rib", "-o", "seen.####.exr", "--plan", "seen", "-j", "2"], cwd=t.folder, stdout=slave, timeout=60).returncode
shown = os.read(master, 10000).decode()
t.expect(code == 0 and "4 of 4 frames are finished\r\n" in shown and "R90000" not in shown, f"on a terminal their number is told ({shown!r})")
t.expect_run("tiles", ["batch", "my shot.rib", "-o", "t.####.exr", "--tiles", "3x2", "--plan", "tiles", "-j", "2", "--html", "page.html"], 0, "[batch-tiles-cost]")
t.expect(same("t"), "have the bits of one run, indirect light included")
gathers = [task for task in json.loads((t.folder / "tiles/plan.json").read_text())["tasks"] if task["stage"] == "gather"]
t.expect(all("--no-answers" in task["arguments"] for task in gathers), "whose rays are traced by the tiles that ask for them")
t.expect(not list((t.folder / "tiles/work").iterdir()), "what nobody needs any more is gone")
page = (t.folder / "page.html").read_text()
shown = [base64.b64decode(text) for text in re.findall(r"data:image/png;base64,([^\"]+)", page)]
t.expect(len(shown) == 4 and len(set(shown)) == 4 and all(s.startswith(b"\x89PNG") for s in shown), "the page holds small pictures of the frames itself")
before = (t.folder / "t.0001.exr").stat().st_mtime_ns
(t.folder / "t.0003.exr").unlink()
t.expect_run("the plan once more", ["batch", "tiles"], 0, "finished 4 of 4")
t.expect(same("t") and (t.folder / "t.0001.exr").stat().st_mtime_ns == before, "makes what is missing, and nothing else")
t.expect(status("tiles")["finished"] == 4, "status tells so")
t.expect_run("the log of a frame", ["batch", "log", "tiles", "3"], 0, "0003.hide:", "0003.join:")

# Two more things must be kept with the records: where light is bright, and its further bounces. Mirrors show the latter.
t.write("bounces.rib", HEAD.replace("Format 64 48", "Format 96 72") + """WorldBegin
LightSource "indirectlight" 1 "samples" [64] "float bounces" [3]
Attribute "light" "shadows" ["on"]
LightSource "pointlight" 2 "from" [0 1.8 0] "intensity" [3]
Surface "matte"
Sides 2
Color 0.7 0.6 0.5
Polygon "P" [-2 -2 -2 2 -2 -2 2 -2 2 -2 -2 2]
Polygon "P" [-2 2 -2 2 2 -2 2 2 2 -2 2 2]
Color 0.8 0.2 0.2
Polygon "P" [-2 -2 -2 -2 2 -2 -2 2 2 -2 -2 2]
Color 0.9 0.9 0.9
Polygon "P" [-2 -2 2 2 -2 2 2 2 2 -2 2 2]
Translate -1 -1.2 0
Sphere 0.6 -0.6 0.6 360
Translate 1.7 0 0
Surface "disney" "metallic" [1] "roughness" [0.1] "reflections" [2]
Sphere 0.7 -0.7 0.7 360
WorldEnd
""")
t.run("bounces.rib", "-o", "bounces.exr", "-q")
t.expect_run("tiles of a room with a mirror", ["batch", "bounces.rib", "-o", "tiled bounces.exr", "--tiles", "2x2", "--plan", "bounces", "-j", "2"], 0)
t.expect("batch-tiles-cost" not in t.run("batch", "bounces.rib", "-o", "x.exr", "--tiles", "2x2", "--plan", "more", "-j", "2", "--plan-only").stderr, "cost nothing that is told where tasks are more than frames")
t.run("hide", "bounces.rib", "-o", "bounces.dfb", "-q")
t.run("gather", "bounces.dfb", "-o", "answers.icf", "-q")
t.run("gather", "bounces.dfb", "-o", "records.icf", "--no-answers", "-q")
t.expect((t.folder / "records.icf").stat().st_size < (t.folder / "answers.icf").stat().st_size, "records alone are a smaller file")
for name in ("answers", "records"):
    t.run("shade", "bounces.dfb", "--irradiance", f"{name}.icf", "-o", f"{name}.exr", "-q")
for name in ("tiled bounces", "answers", "records"):
    different = json.loads(t.run("compare", f"{name}.exr", "bounces.exr", "--json").stdout)["different_pixels"]
    t.expect(different == 0, f"{name}: the bits of one run, {different} pixels differ")

# What cannot work is reported before anything begins.
for what, arguments, code, says in (
        ("one file for all frames", ["my shot.rib", "-o", "x.exr"], 2, "batch-same-file"),
        ("no frame", ["my shot.rib", "-o", "x.#.exr", "--frames", "77"], 2, "there is no frame"),
        ("tiles of PNG", ["my shot.rib", "-o", "x.#.png", "--tiles", "2x2"], 2, "batch-tiles"),
        ("tiles without -o", ["my shot.rib", "--tiles", "2x2"], 1, "-o"),
        ("no scene", ["nowhere.rib", "-o", "x.#.exr"], 2, "nowhere.rib"),
        ("no plan", ["status", "nowhere"], 2, "there is no plan"),
        ("another plan of the name", ["my shot.rib", "-o", "x.#.exr", "--plan", "tiles"], 2, "is another plan")):
    t.expect_run(what, ["batch", *arguments, *(["--plan", "no"] if "--plan" not in arguments and what != "no plan" else [])], code, says)
path, os.environ["PATH"] = os.environ["PATH"], "/nowhere"
t.expect_run("no Slurm", ["batch", "my shot.rib", "-o", "x.#.exr", "--plan", "slurm", "--engine", "slurm"], 2, 'there is no "sinfo" here')
os.environ["PATH"] = path
t.expect(not (t.folder / "no").exists() and not (t.folder / "slurm").exists() and not list(t.folder.glob("x.*")), "and nothing was begun")

# Plans are edited.
plan = json.loads((t.folder / "tiles/plan.json").read_text())


def edited(name, change):
    copy = json.loads(json.dumps(plan))
    change(copy["tasks"])
    (t.folder / name).mkdir(exist_ok=True)
    t.write(f"{name}/plan.json", json.dumps(copy))


edited("circle", lambda all: all[0]["needs"].append("0001.join"))
t.expect_run("a circle", ["batch", "circle"], 2, "waits for itself")
edited("unknown", lambda all: all[0]["needs"].append("nobody"))
t.expect_run("a need that is not there", ["batch", "unknown"], 2, 'needs "nobody"')
edited("twice", lambda all: all.append(dict(all[0])))
t.expect_run("a task twice", ["batch", "twice"], 2, "two tasks are called")
edited("outside", lambda all: all[0].update(name="../x"))
t.expect_run("a name that leads elsewhere", ["batch", "outside"], 2, "is no name of a task")
t.write("circle/plan.json", "{ this is no plan")
t.expect_run("no JSON", ["batch", "circle"], 2, "cannot be run")

# A task that fails is tried three times; the others finish, and it is tried again later.
(t.folder / "closed").write_text("a file where a folder must be")
t.write("two.rib", HEAD + 'Display "ok.exr" "file" "rgba"\n' + frame(1, 32, 0.2) + 'Display "closed/no.exr" "file" "rgba"\n' + frame(2, 32, 0.2))
t.expect_run("a frame fails", ["batch", "two.rib"], 4, "finished 1 of 2", "failed 1: 2", "task 0002.render failed", "output-folder", "tried 3 times")
t.expect(len(status("two.batch")["failures"]) == 1 and status("two.batch")["by_frame"][1]["state"] == "failed", "status names it")
(t.folder / "closed").unlink()
(t.folder / "closed").mkdir()
t.expect_run("and is tried again", ["batch", "retry", "two.batch"], 0, "finished 2 of 2")

# The program takes what Slurm grants.
grant = {"SLURM_JOB_ID": "1", "SLURM_CPUS_PER_TASK": "1", "SLURM_MEM_PER_CPU": "500"}
os.environ.update(grant)
t.expect_run("a job takes what it was granted", ["two.rib", "-o", "grant.#.exr", "-v", "--stats", "grant.json"], 0, "set -t 1 and --memory-limit 400M")
t.expect(json.loads((t.folder / "grant.json").read_text())["threads"] == 1, "its threads are as many")
t.expect_run("or what is asked for", ["two.rib", "-o", "grant.#.exr", "-v", "-t", "2", "--memory-limit", "900M"], 0)
t.expect("slurm-grant" not in t.run("two.rib", "-o", "grant.#.exr", "-v", "-t", "2", "--memory-limit", "900M").stderr, "which is not told")
t.write("round.rib", 'Display "round.exr" "file" "rgba" Format 16 16 1 Projection "perspective" "fov" 40 Translate 0 0 5 WorldBegin Surface "matte"\n'
        + 'Attribute "trace" "tessellation" 20\n' + "".join(f"Translate 0.{i + 1} 0 0 Sphere 1 -1 1 360\n" for i in range(9)) + "WorldEnd\n")
os.environ["SLURM_MEM_PER_CPU"] = "1"
t.expect("[trace-memory]" not in t.run("round.rib", "--gi", "gather", "--samples", "4").stderr, "what is granted changes no polygon, as another node grants more")
t.expect("[trace-memory]" in t.run("round.rib", "--gi", "gather", "--samples", "4", "--memory-limit", "1M").stderr, "what is asked for does")
for name in grant:
    del os.environ[name]

# The process that works on a plan is killed or cancelled, or another process works on the same plan.
t.write("slow.rib", head(200, 150) + "".join(frame(i, 300, 0.2) for i in range(1, 5)))
t.run("slow.rib", "-o", "one.####.exr", "-q")


def begin():
    run = subprocess.Popen([t.program, "batch", "slow.rib", "-o", "s.####.exr", "--plan", "slow", "-j", "1"], cwd=t.folder,
                           stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    while not list(t.folder.glob("slow/state/*.json")) and run.poll() is None:
        time.sleep(0.01)
    return run


run = begin()
t.expect_run("two runs of a plan", ["batch", "slow"], 2, "another process works on the plan")
t.expect_run("cancel", ["batch", "cancel", "slow"], 0)
run.communicate(timeout=60)
t.expect(run.returncode == 128 + signal.SIGTERM, "ends the run")
t.expect_run("cancel again", ["batch", "cancel", "slow"], 2, "nothing works on the plan")
shutil.rmtree(t.folder / "slow")
for file in t.folder.glob("s.*"):
    file.unlink()
run = begin()


def at_work():
    """Returns the processes of the program in this folder."""
    out = []
    for process in pathlib.Path("/proc").glob("[0-9]*"):
        try:
            out += [process.name] if (process / "exe").resolve() == t.program and (process / "cwd").resolve() == t.folder.resolve() else []
        except OSError:
            pass
    return out


end = time.monotonic() + 10
while len(at_work()) < 3 and time.monotonic() < end:
    time.sleep(0.01)
t.expect(len(at_work()) >= 3, "tasks are processes of their own, beside the batch and the one that they begin in")
run.send_signal(signal.SIGKILL)
run.communicate(timeout=60)
end = time.monotonic() + 10
while at_work() and time.monotonic() < end:
    time.sleep(0.05)
t.expect(not at_work(), "which end with a run that is killed")
t.expect_run("after a kill the plan goes on", ["batch", "slow"], 0, "finished 4 of 4")
t.expect(same("s"), "to the bits of one run")
t.finish()
