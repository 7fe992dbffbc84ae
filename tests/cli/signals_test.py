"""Tests signals: every pass must end soon, keep what is finished, and leave nothing else behind."""
import json
import os
import re
import signal
import subprocess
import time

from program import GOOD, Suite

t = Suite()
SOON = 20  # These are seconds: the test looks for hangs.
ROOM = """Display "room.exr" "file" "rgba"
Format 64 64 1
PixelSamples 1 1
Projection "perspective" "fov" [60]
WorldBegin
LightSource "indirectlight" 1
LightSource "pointlight" 2 "from" [0 0.5 3] "intensity" [4]
Surface "matte"
Polygon "P" [-2 -2 5  2 -2 5  2 2 5  -2 2 5]
Polygon "P" [-2 -1 1  2 -1 1  2 -1 5  -2 -1 5]
Polygon "P" [-2 -1 1  -2 -1 5  -2 2 5  -2 2 1]
Polygon "P" [2 -1 1  2 -1 5  2 2 5  2 2 1]
WorldEnd
"""
t.write("good.rib", GOOD)
t.write("room.rib", ROOM)
t.write("frames.rib", "".join(f"FrameBegin {n}\n{GOOD.replace('good', f'frame{n}')}FrameEnd\n" for n in range(1, 400)))


def start(*line, **more):
    return subprocess.Popen([t.program, *line], cwd=t.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, **more)


def wait_for(condition):
    end = time.time() + 60
    while not condition() and time.time() < end:
        time.sleep(0.01)
    return condition()


def parts(folder=None):
    return [p for p in (folder or t.folder).rglob("*") if re.search(r"\.part(?!ial)", p.name)]


def expect_soon(what, process, code, number=signal.SIGTERM):
    begin = time.time()
    process.send_signal(number)
    try:
        messages = process.communicate(timeout=SOON)[1]
    except subprocess.TimeoutExpired:
        process.kill()
        messages = "still running; " + process.communicate()[1]
    t.expect(process.returncode == code, f"{what} ends with {code} ({time.time() - begin:.1f} s)")
    if process.returncode != code:
        print(f"        exit {process.returncode}: {messages[:500]}")
    return messages


# Every pass gets a signal. Each would take minutes.
for threads in ("1", "2"):
    process = start("room.rib", "--gi", "atlas", "--photons", "1000000000", "--atlas", "atlas", "-o", "photons.exr", "-t", threads)
    wait_for(lambda: (t.folder / "atlas/photons").exists() and parts(t.folder / "atlas"))
    time.sleep(0.3)
    expect_soon(f"the photon pass of a frame, {threads} threads", process, 143)
    t.expect((t.folder / "photons.partial.exr").exists() and not parts(), "with a picture of what was hidden and nothing unfinished")
    (t.folder / "photons.partial.exr").unlink()
# Shaders ask for indirect light themselves. What is hidden when the signal comes is shaded without it.
t.write("asks.sl", "surface asks() { normal n = normalize(N); color c = 0, h = 0; "
        'gather("illuminance", P, n, 1.5, 500, "surface:Ci", h) c += h; '
        "Ci = Cs * diffuse(n) + indirectdiffuse(P, n, 500) + c / 500; Oi = 1; }")
t.write("asks.rib", ROOM.replace("matte", "asks").replace("64 64 1", "200 150 1"))
process = start("asks.rib", "-o", "asks.exr", "--progress", "--stats", "asks.json")
for said in process.stdout:
    if said.startswith("R90000") and int(said.split()[1].rstrip("%")) >= 35:
        break
expect_soon("a frame whose shaders ask for indirect light", process, 143)
t.expect((t.folder / "asks.partial.exr").exists() and not parts(), "with a picture")
rays = json.loads((t.folder / "asks.json").read_text())["rays"]
t.expect(rays["gather"] < 1e6, f"and few rays ({rays})")
(t.folder / "asks.partial.exr").unlink()
process = start("photons", "room.rib", "--photons", "1000000000", "-o", "photons")
wait_for(lambda: parts(t.folder / "photons"))
expect_soon("the photon command", process, 143)
t.expect(not parts(), "and leaves nothing unfinished")
t.run("photons", "room.rib", "--photons", "600000", "-o", "few", "-q")
process = start("irradiance", "few", "-o", "points", "--nearest", "20000", "--every", "1")
time.sleep(1)
expect_soon("irradiance of photons", process, 143)
t.run("irradiance", "few", "-o", "points", "--every", "1")
process = start("brickmake", "points", "-o", "bricks", "--maxerror", "0", "--maxdepth", "20", "--radiusscale", "0.001")
wait_for(lambda: parts(t.folder / "bricks"))
expect_soon("bricks", process, 143)
process = start("room.rib", "--format", "400x400", "--gi", "radiosity", "--radiosity-texels", "300", "-o", "radiosity.exr")
time.sleep(1)
expect_soon("radiosity", process, 143)
process = start("room.rib", "--gi", "gather", "--samples", "60000", "--max-error", "0.01", "-o", "gather.exr")
time.sleep(1)
expect_soon("gathering", process, 143)
process = start("room.rib", "--gi", "reference", "--samples", "20000", "-o", "reference.exr")
time.sleep(1)
expect_soon("the reference", process, 143)
process = start("chart", "room.rib", "-o", "chart.html", "--cache", "measured", "--budget", "10m")
time.sleep(1)
expect_soon("a chart", process, 143)
t.expect(not parts(), f"and nothing unfinished is left: {parts()}")
t.run("hide", "room.rib", "-o", "room.dfb", "-q")
process = start("gather", "room.dfb", "--gi", "gather", "--samples", "60000", "--max-error", "0.01", "-o", "room.icf")
time.sleep(1)
expect_soon("the gather command", process, 143)
process = start("shade", "room.dfb", "--gi", "reference", "--samples", "20000", "-o", "shade.exr")
time.sleep(1)
expect_soon("the shade command", process, 143)
silent, writer = os.pipe()  # This pipe stays open. The function communicate() would close a pipe of its own, and the program might see that first.
process = start("-", stdin=silent)
time.sleep(0.3)
expect_soon("waiting for a scene", process, 143)
os.close(writer)
os.close(silent)

# Some single steps take long. The work after a signal must be less than a second of CPU time, whatever else the machine does.
CLOCK = os.sysconf("SC_CLK_TCK")


def cpu_seconds(pid):
    with open(f"/proc/{pid}/stat") as file:
        fields = file.read().rsplit(")", 1)[1].split()
    return (int(fields[11]) + int(fields[12])) / CLOCK


def expect_at_once(what, process, after_s=1):
    wait_for(lambda: process.poll() is not None or cpu_seconds(process.pid) > after_s)
    before = cpu_seconds(process.pid)
    process.send_signal(signal.SIGTERM)
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    spent = usage.ru_utime + usage.ru_stime - before
    t.expect(process.returncode == 143 and spent < 1, f"{what} ends with 143 after {spent:.2f} CPU s more")


balls = " ".join(f"1001 {16 * n}" for n in range(4000))
floats = " ".join(f".02 0 0 0 0 .02 0 0 0 0 .02 0 {n % 20 / 10 - 1} {n // 20 % 20 / 10 - 1} {n // 400 / 5 - 1} 1" for n in range(4000))
blobby = f"Blobby 4000 [{balls} 0 4000 {' '.join(map(str, range(4000)))}] [{floats}] [\"\"]"
t.write("blobby.rib", GOOD.replace("Format 24 24", "Format 8000 8000").replace("Sphere 1 -1 1 360", blobby))
expect_at_once("a Blobby of many cells", start("blobby.rib", "-o", "blobby.exr", "-t", "1"))
t.write("inner.rib", "AttributeBegin Color [1 0 0] AttributeEnd\n" * 100000)
t.write("archives.rib", GOOD.replace("Sphere 1 -1 1 360", 'ReadArchive "inner.rib"\n' * 50))
expect_at_once("the reading of archives", start("archives.rib", "-o", "archives.exr", "-t", "1"), .3)

# With many frames, finished ones stay, and no other is begun.
for number, code in ((signal.SIGHUP, 129), (signal.SIGINT, 130), (signal.SIGTERM, 143)):
    process = start("frames.rib", "-t", "2", "--stats", "frames.json")
    wait_for(lambda: (t.folder / "frame3.exr").exists())
    expect_soon(f"a sequence that gets {number.name}", process, code, number)
    for n in (1, 2, 3):
        t.expect_run(f"keeps frame {n}", ["info", f"frame{n}.exr"], 0)
    t.expect(not (t.folder / "frame399.exr").exists() and not parts(), "and leaves nothing unfinished")
    for picture in t.folder.glob("frame*.exr"):
        picture.unlink()
process = start("good.rib", "-o", "cut.exr", "--format", "3000x3000", "--progress", "-t", "1")
process.stdout.readline()
expect_soon("a picture that gets SIGHUP", process, 129, signal.SIGHUP)
t.expect_run("is written as far as it is finished", ["info", "cut.partial.exr"], 0)
process = start("good.rib", "-o", "nohup.exr", "--format", "300x300", "--progress", "-t", "1", preexec_fn=lambda: signal.signal(signal.SIGHUP, signal.SIG_IGN))
process.stdout.readline()
expect_soon("SIGHUP that is ignored does not end it: it", process, 0, signal.SIGHUP)

# A second signal ends what finishes too slowly. SIGKILL leaves files that the next run removes.
process = start("good.rib", "-o", "twice.exr", "--format", "6000x6000", "--pixel-samples", "16x16", "--progress", "-t", "1")
process.stdout.readline()
for _ in range(20):
    if process.poll() is None:
        process.send_signal(signal.SIGTERM)
        time.sleep(0.001)
process.communicate(timeout=SOON)
t.expect(process.returncode == 143 and not parts(), "two signals leave nothing unfinished")
process = start("good.rib", "-o", "killed.exr", "--format", "3000x3000", "--progress", "-t", "1")
process.stdout.readline()
wait_for(parts)
process.kill()
process.communicate()
t.expect(len(parts()) == 1, "SIGKILL leaves an unfinished file")
t.expect_run("the next run", ["good.rib", "-o", "killed.exr"], 0)
t.expect(not parts(), "removes it")

# The renderer has started other programs.
t.write("program.rib", GOOD.replace("Sphere 1 -1 1 360", 'Procedural "RunProgram" ["./program.sh" "1"] [-1 1 -1 1 -1 1]'))


def lives(pid):
    try:
        with open(f"/proc/{pid}/stat") as file:
            return file.read().rsplit(")", 1)[1].split()[0] != "Z"
    except FileNotFoundError:
        return False


# Processes that such a program starts are found by its process group. Nobody can kill that after SIGKILL.
for number, code, work in ((signal.SIGTERM, 143, "sleep 1000 & wait"), (signal.SIGKILL, -9, "exec sleep 1000")):
    t.write("program.sh", f"#!/bin/sh\necho $$ >> pids\nread line\n{work}\n")
    os.chmod(t.folder / "program.sh", 0o755)
    (t.folder / "pids").unlink(missing_ok=True)
    process = start("program.rib", "-o", "program.exr", "--allow-system")
    wait_for(lambda: (t.folder / "pids").exists() and (t.folder / "pids").read_text().endswith("\n"))
    time.sleep(0.2)
    expect_soon(f"a program that does not answer, {number.name}: it", process, code, number)
    t.expect(wait_for(lambda: not lives(int((t.folder / "pids").read_text()))), "and its program ends too")

# Nobody reads the messages.
process = subprocess.Popen([t.program, "good.rib", "-o", "unread.exr", "--format", "400x400", "--progress", "-t", "1"], cwd=t.folder, stdout=subprocess.PIPE)
process.stdout.readline()
process.stdout.close()
t.expect(process.wait(timeout=60) == 0, "a frame whose progress nobody reads any more is finished")
t.expect_run("and its picture is there", ["info", "unread.exr"], 0)
result = subprocess.run(["sh", "-c", '"$0" catrib frames.rib | head -1', t.program], cwd=t.folder, capture_output=True, text=True, timeout=60)
t.expect(result.stderr == "", "catrib into a pipe that is closed ends silently")
t.finish()
