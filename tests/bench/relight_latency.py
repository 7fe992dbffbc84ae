"""Measures how fast the page of tomales relight answers in Chromium without a window: the first picture, a light's brightness, and the first squares
and the whole picture of a light that moves, with and without WebGL2.
Usage: relight_latency.py TOMALES CHROMIUM SHOT.dfb SHOT.icf [LIGHT POINT [MOVES]]    the light moves by its parameter POINT"""
import os
import pathlib
import select
import statistics
import subprocess
import sys
import time

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "browser"))
import chromium as driver  # noqa: E402
from chromium import Page  # noqa: E402

driver.PATIENCE_S = 600  # This light moves in a film frame.

SLIDE = """(async (to) => { const s = document.querySelector("#lights .light:has(button[title=solo]) input[type=range]");
s.value = to; s.dispatchEvent(new Event("input")); const start = performance.getEntriesByName("changed").at(-1).startTime;
while (!performance.getEntriesByName("painted").some((m) => m.startTime > start)) await new Promise(requestAnimationFrame);
const took = performance.getEntriesByName("painted").find((m) => m.startTime > start).startTime - start; performance.clearMarks(); return took; })(%s)"""
# This is the first picture after blocks of the light have come, and the last one.
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
        taken = [page.run(MOVE % (*light, 0.2)) for _ in range(4)]
        print(f"{kind}: a light that moves: first squares {statistics.median(t[0] for t in taken):.0f} ms ({max(t[0] for t in taken):.0f} at most), "
              f"whole picture {statistics.median(t[1] for t in taken) / 1000:.1f} s", flush=True)
    page.close()


program, chromium, shot, cache = sys.argv[1:5]
light, moves = sys.argv[5:7], int(sys.argv[7]) if len(sys.argv) > 7 else 200
begun = time.time()
server = subprocess.Popen([program, "relight", shot, "--irradiance", cache, "--no-browser"], stdout=subprocess.PIPE, text=True)
select.select([server.stdout], [], [], 120)
url = server.stdout.readline().strip()
print(f"address after {time.time() - begun:.2f} s, load {os.getloadavg()[0]:.1f}")
for kind, query in (("JavaScript", "?plain"), ("WebGL2", "?webgl")):
    measure(kind, url + query, light, moves)
memory = [line for line in pathlib.Path(f"/proc/{server.pid}/status").read_text().splitlines() if line.startswith("VmHWM")]
print(f"memory {memory[0].split(':')[1].strip()}, load {os.getloadavg()[0]:.1f}")
server.terminate()
server.wait(60)
