"""Tests what a run reports about itself: -v, --log, --stats for each frame, and passes that go from 0 to 100 %."""
import json
import re
import socket

from program import GOOD, Suite

t = Suite()
FRAME = """FrameBegin %d
Display "f%d.exr" "file" "rgba"
Display "+f%d_z.exr" "file" "z"
WorldBegin
LightSource "indirectlight" 1 "samples" [32]
LightSource "distantlight" 2
Surface "%s"
%s
WorldEnd
FrameEnd
"""
BALL = "Translate 0.3 0 0 Sphere 1 -1 1 360"
HEAD = 'Format 40 30 1\nProjection "perspective" "fov" [40]\nTranslate 0 0 5\n'
FRAMES = [(1, "matte", BALL), (2, "unknown", BALL + " " + BALL), (3, "plastic", BALL)]
t.write("turn.rib", HEAD + "".join(FRAME % (n, n, n, surface, body) for n, surface, body in FRAMES))


def read(name):
    return json.loads((t.folder / name).read_text())


def counts(figures):
    """Returns the figures that do not depend on clocks and on the memory of the process."""
    figures = json.loads(json.dumps(figures))
    for key in ("command", "written", "time_s", "cpu_s", "memory_bytes"):
        del figures[key]
    for shader in figures["shade"]["by_shader"].values():
        del shader["time_s"]
    return figures


# Each frame's file has the figures of that frame alone.
t.run("turn.rib", "--stats", "all.##.json", "-t", "2")
together = {n: read(f"all.0{n}.json") for n in (1, 2, 3)}
for n in (1, 2, 3):
    t.run("turn.rib", "--frames", str(n), "--stats", "one.#.json", "-t", "2")
    alone = read(f"one.{n}.json")
    t.expect(counts(together[n]) == counts(alone), f"frame {n} has the figures that it has alone")
    t.expect(together[n]["frame"] == n and together[n]["outputs"] == [f"f{n}.exr", f"f{n}_z.exr"], "and names its pictures")
    t.expect(0 < together[n]["cpu_s"] < 20 and 0 < together[n]["time_s"]["total"] < 20, "and its own time")
t.expect(["shader-missing" in [w["code"] for w in together[n]["warnings"]] for n in (1, 2, 3)] == [False, True, False],
         "a message is in the file of its frame alone")
t.run("turn.rib", "--stats", "run.json")
run = read("run.json")
t.expect(run["geometry"]["micropolygons_diced"] == sum(f["geometry"]["micropolygons_diced"] for f in together.values()), "one file sums up the run")
t.expect(len(run["outputs"]) == 6 and run["host"] == socket.gethostname(), "with all its pictures and the host")

# On request the pictures hold them too, in all their parts.
t.run("turn.rib", "--stats-header", "-t", "2")
for n in (1, 2, 3):
    for name in (f"f{n}.exr", f"f{n}_z.exr"):
        told = re.search(rb"tomales:statistics\0string\0\x00\x20\0\0({.{8191})", (t.folder / name).read_bytes(), re.S)
        figures = json.loads(told[1]) if told else {}
        t.expect(figures.get("geometry") == together[n]["geometry"] and figures.get("cpu_s", 0) > 0, f"{name} has the frame's figures in its header")
t.run("turn.rib")
t.expect(b"tomales:statistics" not in (t.folder / "f1.exr").read_bytes(), "and has none unasked")

# A history grows by a line for each frame.
for _ in range(2):
    t.run("turn.rib", "--frames", "1,3", "--stats", "history.jsonl")
history = [json.loads(line) for line in (t.folder / "history.jsonl").read_text().splitlines()]
t.expect([h["frame"] for h in history] == [1, 3, 1, 3], "a history has a line for each frame of each run")
t.expect(counts(history[0]) == counts(history[2]), "with the figures of the frame")
before = (t.folder / "all.01.json").read_bytes()
t.run("turn.rib", "--skip-finished", "--stats", "all.##.json")
t.expect((t.folder / "all.01.json").read_bytes() == before, "a frame that is left out keeps its figures")

# A successful run says so on request, and prints nothing else.
quiet = t.expect_run("a run without a word", ["turn.rib", "--frames", "1"], 0)
t.expect(quiet.stdout + quiet.stderr == "", "says nothing")
told = t.expect_run("-v", ["turn.rib", "--frames", "1,3", "-v"], 0).stderr
done = re.findall(r'info: frame (\d) of "turn.rib" wrote "f\d.exr", "f\d_z.exr"; it took ([\d.]+) s \(([\d.]+) CPU s\) and (\d+) MB on (\S+) \[frame-done\]', told)
t.expect([d[0] for d in done] == ["1", "3"] and all(int(d[3]) > 5 and d[4] == socket.gethostname() for d in done), f"names frames, pictures, time, memory, host: {told!r}")
t.write("many.rib", HEAD + "".join(FRAME % (n, n, n, "matte", "") for n in range(1, 131)))
t.expect(t.run("many.rib", "--format", "8x8", "--gi", "none", "-v").stderr.count("[frame-done]") == 130, "for every frame, however many")

# The log has everything, whatever is printed.
for _ in range(2):
    printed = t.expect_run("--log", ["turn.rib", "--log", "farm.log", "-q"], 3).stderr
log = (t.folder / "farm.log").read_text()
t.expect("frame-done" not in printed and log.count("[frame-done]") == 6 and log.count("[shader-missing]") == 2, "has the frames and messages of both runs")
t.expect(log.count("--log farm.log -q [run]") == 2, "and their command lines")
t.expect(all(re.match(r"\d{4}-\d\d-\d\dT\d\d:\d\d:\d\dZ ", line) for line in log.splitlines()), "each line with the time")
t.write("good.rib", GOOD)
t.expect_run("a log that is the scene", ["good.rib", "--log", "good.rib"], 4, "would replace what is read", "[log-write]")
t.expect((t.folder / "good.rib").read_text() == GOOD, "leaves the scene alone")
t.expect_run("a log on a full disk", ["good.rib", "--log", "/dev/full"], 4, "the log could not be written", "[log-write]")
t.expect_run("a history on a full disk", ["good.rib", "--stats", "full.jsonl", "--log", "no/where.log"], 4, "no/where.log")


def passes(*arguments):
    """Returns the passes of a command with their messages, in order, and the shares of the frame."""
    said = t.expect_run(" ".join(arguments[:2]), [*arguments, "--progress", "-t", "2"], 0).stdout.splitlines()
    out, frame = {}, []
    for line in said:
        if "emitted" in line:
            continue
        if line.startswith("R90000"):
            frame.append(int(line.split()[1].rstrip("%")))
        else:
            name, percent = re.fullmatch(r"(.*?) +(\d+) %", line).groups()
            out.setdefault(name, []).append(int(percent))
    for name, shares in out.items():
        t.expect(shares[0] == 0 and shares[-1] == 100 and shares == sorted(shares), f"    {name} goes from 0 to 100 %: {shares}")
    t.expect(frame == sorted(frame) and frame[-1] == 100, "    and the whole never goes back, and ends at 100 %")
    return list(out)


scene = ["turn.rib", "--frames", "1", "--format", "100x80"]
t.expect(passes("render", *scene) == ["hiding", "gathering", "shading"], "a frame with indirect light has three passes")
t.expect(passes("render", *scene, "--gi", "none") == ["hiding and shading"], "one without is made in one")
t.expect(passes("render", *scene, "--gi", "atlas", "--photons", "20000") == ["hiding", "gathering", "making maps of light", "shading"], "an atlas is made on the way")
t.expect(passes("hide", *scene, "-o", "f.dfb") == ["hiding"], "commands of a shot go from 0 to 100 % each")
t.expect(passes("gather", "f.dfb", "-o", "f.icf") == ["gathering", "shading"], "gathering shades once, for the answers of rays")
t.expect(passes("shade", "f.dfb", "-o", "f.exr") == ["gathering", "shading"], "shade without a cache gathers")
t.expect(passes("shade", "f.dfb", "--irradiance", "f.icf", "-o", "f.exr") == ["shading"], "and with one does not")
t.expect(passes("photons", "turn.rib", "-o", "maps", "--photons", "20000") == ["tracing photons"], "photons too")
said = t.expect_run("figures of a shot", ["shade", "f.dfb", "--irradiance", "f.icf", "-o", "g.exr", "--stats", "shot.#.json", "-v"], 0, 'frame 1 of "f.dfb" wrote "g.exr"')
t.expect(read("shot.1.json")["outputs"] == ["g.exr", "g_z.exr"], "are told likewise")
t.finish()
