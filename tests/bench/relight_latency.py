"""Measures how fast the page of tomales relight answers in Chromium without a window: the first picture, a light's brightness, and the first squares
and the whole picture of a light that moves, with and without WebGL2. Last, a client that draws nothing asks for that whole picture.
Usage: relight_latency.py TOMALES CHROMIUM SHOT.dfb SHOT.icf [LIGHT POINT [MOVES]]    the light moves by its parameter POINT"""
import json
import os
import pathlib
import select
import statistics
import struct
import subprocess
import sys
import time
import urllib.request

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "browser"))
import chromium as driver  # noqa: E402
from chromium import Page  # noqa: E402

driver.PATIENCE_S = 600  # A whole film frame may be shaded between two answers.

SLIDE = """(async (to) => { const s = document.querySelector("#lights .light:has(button[title=solo]) input[type=range]");
s.value = to; s.dispatchEvent(new Event("input")); const start = performance.getEntriesByName("changed").at(-1).startTime;
while (!performance.getEntriesByName("painted").some((m) => m.startTime > start)) await new Promise(requestAnimationFrame);
const took = performance.getEntriesByName("painted").find((m) => m.startTime > start).startTime - start; performance.clearMarks(); return took; })(%s)"""
# Returns the times of the first picture after blocks of the light have come, and of the last one.
MOVE = """(async () => { const inputs = () => [...document.querySelectorAll("#lights .light")].find((l) => l.querySelector("strong").textContent === "%s")
.querySelectorAll(".vector"); const row = [...inputs()].find((r) => r.querySelector("span").textContent === "%s"), input = row.querySelector("input");
performance.clearMarks(); input.value = Number(input.value) + %s; input.dispatchEvent(new Event("change"));
const start = performance.getEntriesByName("changed").at(-1).startTime, after = () => performance.getEntriesByName("shown").filter((m) => m.startTime > start);
while (after().length === 0) await new Promise((then) => setTimeout(then, 2));
const first = after()[0].startTime - start;
while (document.getElementById("what").textContent !== "up to date") await new Promise((then) => setTimeout(then, 20));
return [first, after().at(-1).startTime - start]; })()"""


def share(values, part):
    return sorted(values)[min(int(part * len(values)), len(values) - 1)]


def cpu_s(pid):
    """Returns the CPU seconds of a process and of all that descend from it."""
    parents, taken = {}, {}
    for stat in pathlib.Path("/proc").glob("[0-9]*/stat"):
        try:
            fields = stat.read_text().rsplit(")", 1)[1].split()
        except OSError:
            continue  # it has ended
        parents[int(stat.parent.name)], taken[int(stat.parent.name)] = int(fields[1]), int(fields[11]) + int(fields[12])

    def descends(process):
        while process > 1 and process != pid:
            process = parents.get(process, 0)
        return process == pid

    return sum(ticks for process, ticks in taken.items() if descends(process)) / os.sysconf("SC_CLK_TCK")


def measure(kind, url, light, moves):
    page, start = Page(chromium), time.time()
    page.open(url)
    page.wait("!!document.querySelector('#lights .light')", 600)
    print(f"{kind}: page {time.time() - start:.2f} s", flush=True)
    page.wait("performance.getEntriesByName('shown').length > 0", 600)
    first = time.time() - start
    page.wait("document.body.dataset.ready === '1' && document.getElementById('what').textContent === 'up to date'", 600)
    print(f"{kind}: first picture {first:.2f} s, all layers {time.time() - start:.1f} s", flush=True)
    page.run("document.getElementById('takeOver').click()")
    page.wait("document.getElementById('takeOver').hidden")
    times = [page.run(SLIDE % (3 * (i % 30) / 30 - 4)) for i in range(moves)]
    print(f"{kind}: brightness {statistics.median(times):.1f} ms in the median, {share(times, 0.99):.1f} ms for 99 %, {moves} moves", flush=True)
    if light:
        before = cpu_s(page.process.pid), cpu_s(server.pid)
        taken = [page.run(MOVE % (*light, 0.2)) for _ in range(4)]
        browser, own = ((cpu_s(p) - b) / 4 for p, b in zip((page.process.pid, server.pid), before))
        print(f"{kind}: a light that moves: first squares {statistics.median(t[0] for t in taken):.0f} ms ({max(t[0] for t in taken):.0f} at most), "
              f"whole picture {statistics.median(t[1] for t in taken) / 1000:.1f} s; "
              f"CPU time of the browser {browser:.1f} s, of the program {own:.1f} s", flush=True)
    page.close()


def ask(url, body=None):
    """Returns the bytes of an answer to a question, with a body to a request."""
    return urllib.request.urlopen(urllib.request.Request(url, data=body and json.dumps(body).encode()), timeout=600).read()


def measure_bare(url, light):
    """Moves the light, and takes all blocks without drawing them."""
    name, point = light
    owned = next(l for l in json.loads(ask(url + "scene"))["lights"] if l["owner"] == name)
    place = list(next(p for p in owned["params"] if p["name"] == point)["value"])
    times, after, told = [], 0, 0
    for _ in range(4):
        place[0] += 0.1
        ask(url + "edit?page=9&take=1", {"lights": {name: {point: place}}})
        begun, busy = time.time(), True
        while busy:
            data = ask(f"{url}news?after={after}&told={told}")
            status = json.loads(data[4:4 + struct.unpack_from("<I", data)[0]])
            after, told = status["after"], status["told"]
            busy = status["doing"] or any(layer["old"] for layer in status["layers"][1:])
        times.append(time.time() - begun)
    print(f"without a browser: a light that moves: whole picture {statistics.median(times):.1f} s ({max(times):.1f} s at most)", flush=True)


program, chromium, shot, cache = sys.argv[1:5]
light, moves = sys.argv[5:7], int(sys.argv[7]) if len(sys.argv) > 7 else 200
begun = time.time()
server = subprocess.Popen([program, "relight", shot, "--irradiance", cache, "--no-browser"], stdout=subprocess.PIPE, text=True)
select.select([server.stdout], [], [], 120)
url = server.stdout.readline().strip()
print(f"address after {time.time() - begun:.2f} s, load {os.getloadavg()[0]:.1f}")
for kind, query in (("JavaScript", "?plain"), ("WebGL2", "?webgl")):
    measure(kind, url + query, light, moves)
if light:
    measure_bare(url, light)
memory = [line for line in pathlib.Path(f"/proc/{server.pid}/status").read_text().splitlines() if line.startswith("VmHWM")]
print(f"memory {memory[0].split(':')[1].strip()}, load {os.getloadavg()[0]:.1f}")
server.terminate()
server.wait(60)
