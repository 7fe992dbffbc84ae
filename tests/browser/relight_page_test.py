"""Tests the page of tomales relight in Chromium. It must load, show the picture, follow its sliders without asking the server,
undo, save and reload. What it saves must be the picture that `tomales shade --edit` makes. The test leaves pictures of the page
in the given folder, for a look by eye. Usage: relight_page_test.py TOMALES CHROMIUM FOLDER [SHOT.dfb SHOT.icf]"""
import json
import pathlib
import select
import statistics
import subprocess
import sys
import time

here = pathlib.Path(__file__).parent
sys.path[:0] = [str(here.parent / "cli"), str(here.parent / "image")]
from chromium import Page  # noqa: E402
from pictures import pixels  # noqa: E402
from program import Suite  # noqa: E402

SIZES = {"wide": (1280, 800), "tablet": (820, 1180)}
MOVES = 30
suite = Suite()
chromium, folder, given = sys.argv[2], pathlib.Path(sys.argv[3]).resolve(), [pathlib.Path(p).resolve() for p in sys.argv[4:]]
scene = here.parents[1] / "scenes/cornell/cornell.rib"
if given:
    shot, cache = given
else:
    shot, cache = suite.folder / "shot.dfb", suite.folder / "shot.icf"
    lit = 'Illuminate "lamp" 1\nLightSource "spotlight" "spot" "from" [0.6 0.5 -0.6] "to" [-0.4 -0.6 0.3] "intensity" [0.6]'
    suite.write("box.rib", scene.read_text().replace('Illuminate "lamp" 1', lit))
    suite.run("hide", "box.rib", "-o", "shot.dfb", "--format", "128x128", "-q")
    suite.run("gather", "shot.dfb", "-o", "shot.icf", "--by-light", "--samples", "64", "-q")

server = subprocess.Popen([suite.program, "relight", shot, "--irradiance", cache, "--no-browser"], cwd=suite.folder, stdout=subprocess.PIPE, text=True)
ready, _, _ = select.select([server.stdout], [], [], 120)
url = server.stdout.readline().strip() if ready else ""
suite.expect(url.startswith("http://127.0.0.1:"), "the program tells the page's address")

AVERAGE = """(() => { const c = document.createElement("canvas"), from = document.getElementById("picture"); c.width = from.width; c.height = from.height;
const g = c.getContext("2d"); g.drawImage(from, 0, 0); const d = g.getImageData(0, 0, c.width, c.height).data; let s = 0;
for (let i = 0; i < d.length; i += 4) s += d[i] + d[i + 1] + d[i + 2]; return s / d.length; })()"""
SLIDE = """(async (to) => { const s = document.querySelector("#lights .light:has(button[title=solo]) input[type=range]"); performance.clearMarks();
s.value = to; s.dispatchEvent(new Event("input")); const start = performance.getEntriesByName("changed").at(-1).startTime;
while (!performance.getEntriesByName("painted").some((m) => m.startTime > start)) await new Promise(requestAnimationFrame);
return performance.getEntriesByName("painted").at(-1).startTime - start; })(%s)"""
NOISE = 0.5  # The error is out of 255.


def test(kind, query):
    page = Page(chromium)
    start = time.time()
    page.open(url + query)
    suite.expect(page.wait("!!document.querySelector('#lights .light')"), f"{kind}: the page loads")
    page.run("document.getElementById('takeOver').click()")  # The previous page may have been closed without a message to the server.
    suite.expect(page.wait(f"{AVERAGE} > 1"), f"{kind}: the first picture is there after {time.time() - start:.2f} s")
    suite.expect(page.wait("document.body.dataset.ready === '1' && document.getElementById('what').textContent === 'up to date'", 300),
                 f"{kind}: all layers are there after {time.time() - start:.2f} s")
    whole = page.run(AVERAGE)
    page.key("e")
    page.wait("document.getElementById('what').textContent === 'up to date'")
    time.sleep(0.5)
    suite.expect(abs(page.run(AVERAGE) - whole) < NOISE, f"{kind}: the exact picture is the mix ({whole:.1f})")
    page.key("e")
    times = [page.run(SLIDE % (3 * i / MOVES - 4)) for i in range(MOVES)]
    dark = page.run(AVERAGE)
    suite.expect(dark < 0.95 * whole, f"{kind}: a slider darkens the picture ({dark:.1f}); {statistics.median(times):.1f} ms in the median, {max(times):.1f} at most")
    state = page.run("document.getElementById('rib').textContent")
    suite.expect("intensity" in state, f"{kind}: and the edit says so")
    page.key("z")
    suite.expect(abs(page.run("new Promise(requestAnimationFrame).then(() => new Promise(requestAnimationFrame)).then(() => %s)" % AVERAGE) - whole) < NOISE,
                 f"{kind}: undo brings all of the slider's way back")
    page.key("Z", shift=True)
    page.run("new Promise(requestAnimationFrame).then(() => new Promise(requestAnimationFrame))")
    suite.expect(abs(page.run(AVERAGE) - dark) < NOISE and page.wait("document.getElementById('rib').textContent.includes('intensity')"), f"{kind}: and redo there again")
    return page, whole, dark


page, whole, dark = test("plain JavaScript", "?plain")
page.key("z")
suite.expect(page.wait("!document.getElementById('rib').textContent.includes('intensity')"), "the page's edit is that of the program")
page.close()
page, whole, dark = test("WebGL2", "?webgl")

# The saved edit gives the same picture with shade, and the page loads it again.
page.run("document.getElementById('name').value = 'dark'; document.getElementById('save').click()")
suite.expect(page.wait("[...document.querySelectorAll('#edits option')].some((o) => o.value === 'dark')"), "the edit is saved")
page.key("e")
page.run("fetch('ask', {method: 'POST', body: '{}'})")
suite.expect(page.wait("fetch('whole').then((r) => r.status === 200)"), "the exact picture of it is shaded")
page.run("fetch('whole').then((r) => r.arrayBuffer()).then((b) => { window.wholeFloats = new Float32Array(b); })")
suite.run("shade", str(shot), "--irradiance", str(cache), "--edit", "dark.rib", "-o", "dark.exr", "--one-picture", "-q")
made = pixels(suite.folder / "dark.exr")
width = max(x for x, _ in made) + 1
some = sorted(made)[::97]
seen = page.run(f"{json.dumps([3 * (width * y + x) for x, y in some])}.map((i) => [0, 1, 2].map((c) => window.wholeFloats[i + c]))")
suite.expect(all(list(made[p][:3]) == s for p, s in zip(some, seen)), "and has the bits of shade --edit")
page.run("document.getElementById('undo').click()")
page.run("document.getElementById('load').click()")
suite.expect(page.wait("document.getElementById('rib').textContent.includes('intensity')"), "it is loaded again")
page.key("e")

# A click chooses an object, and the pointer shows its name.
box = page.run("(() => { const b = document.getElementById('picture').getBoundingClientRect(); return [b.left + 0.3 * b.width, b.top + 0.7 * b.height]; })()")
page.click(*box)
suite.expect(page.wait("document.querySelectorAll('#probe .bar').length > 1"), "bars tell what each light brings to the pixel")
suite.expect(page.wait("document.getElementById('probe').textContent.includes('matte')"), "a click tells the shader")

# The places of lights are dragged.
HANDLE = """(() => { const h = [...document.querySelectorAll(".handle")].find((e) => !e.hidden); if (!h) return null;
const b = h.getBoundingClientRect(); return [(b.left + b.right) / 2, (b.top + b.bottom) / 2]; })()"""
page.key("h")
at = page.run(HANDLE)
suite.expect(at is not None or given, "the spot has a place in the picture")
if at:
    page.mouse("mousePressed", *at, button="left", clickCount=1)
    page.mouse("mouseMoved", at[0] + 20, at[1] + 30, button="left", buttons=1)
    page.mouse("mouseReleased", at[0] + 20, at[1] + 30, button="left", clickCount=1)
    now = page.run(HANDLE)
    suite.expect(abs(now[0] - at[0] - 20) < 1 and abs(now[1] - at[1] - 30) < 1, f"a light's point follows the pointer ({at} to {now})")
    suite.expect(page.wait("/\"point /.test(document.getElementById('rib').textContent)"), "and the edit says where it is")
    page.key("z")
    suite.expect(page.wait(f"Math.abs(({HANDLE})[0] - {at[0]}) < 0.1"), "undo brings it back")
page.key("h")

# A second page watches the first, until it takes over.
VALUE = "Number(document.querySelector('#lights .light:has(button[title=solo]) input[type=range]').value)"
other = Page(chromium)
other.open(url)
suite.expect(other.wait("!document.getElementById('takeOver').hidden"), "a second page watches")
page.run(SLIDE % -1.5)
suite.expect(other.wait(f"Math.abs({VALUE} + 1.5) < 0.02"), "its slider follows that of the first")
other.run("document.getElementById('takeOver').click()")
suite.expect(page.wait("!document.getElementById('takeOver').hidden"), "it takes over, and the first one watches")
page.run("document.getElementById('takeOver').click()")
suite.expect(other.wait("!document.getElementById('takeOver').hidden"), "and back")
other.close()

# Snapshots are kept, and the page has no flaws in its layout.
page.key("s")
page.run(SLIDE % 0.5)
page.key("w")
suite.expect(page.run("!document.getElementById('wipe').hidden"), "a snapshot is compared with")
folder.mkdir(exist_ok=True)
for name, size in SIZES.items():
    page.resize(*size)
    time.sleep(0.5)
    page.screenshot(folder / f"{name}.png")
    suite.expect(page.run("[document.documentElement, document.querySelector('aside')].every((e) => e.scrollWidth <= e.clientWidth)"), f"{name}: nothing reaches over the edge of the window")
suite.expect(page.complaints() == [], f"the browser complains of nothing {page.complaints()[:2]}")
page.run("document.getElementById('end').click()")
suite.expect(server.wait(20) == 0, "the page ends the program")
page.close()
suite.finish()
