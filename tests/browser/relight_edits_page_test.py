"""Tests the page of tomales relight in Chromium, which begins with a scene. It must say what is being prepared, and accept other
shaders, strings, colours and links of lights. It must show variables, regions and ages, gather again, and get coarse pictures
first over a slow link. Usage: relight_edits_page_test.py TOMALES CHROMIUM FOLDER"""
import pathlib
import re
import select
import subprocess
import sys
import time

here = pathlib.Path(__file__).parent
sys.path[:0] = [str(here.parent / "cli")]
from chromium import Page  # noqa: E402
from program import Suite  # noqa: E402

suite = Suite()
chromium, folder = sys.argv[2], pathlib.Path(sys.argv[3]).resolve()
suite.write("box.rib", re.sub(r"Format \d+ \d+", "Format 140 140", (here.parents[1] / "scenes/cornell/cornell.rib").read_text()))
suite.write("stripes.sl", """surface stripes(float Kd = 0.8; string look = "plain";) {
  color base = mod(10 * s, 1) < 0.5 ? color(1, 0, 0) : Cs;
  if (look == "dark") base *= 0.1;
  Ci = Kd * base * diffuse(faceforward(normalize(N), I)); Oi = Os;
}
""")
page = Page(chromium)  # Chromium starts before the server, because the server gathers at once, and a browser may take longer to start than a small scene to gather.
server = subprocess.Popen([suite.program, "relight", "box.rib", "--samples", "256", "--no-browser"], cwd=suite.folder,
                          stdout=subprocess.PIPE, text=True)
ready, _, _ = select.select([server.stdout], [], [], 60)
url = server.stdout.readline().strip()
page.open(url)
heard, end = set(), time.time() + 120
while time.time() < end and not page.run("!!document.querySelector('#lights .light')"):
    heard.add(page.run("document.querySelector('#preparing span')?.textContent ?? ''"))
suite.expect("gathering" in heard, f"the page tells what is prepared {sorted(heard)}")
DONE = "document.body.dataset.ready === '1' && document.getElementById('what').textContent === 'up to date'"
RIB = "document.getElementById('rib').textContent"
suite.expect(page.wait(DONE), "then the picture is there")


def color(x, y):
    """Returns the mean of some pixels, from 0 to 255."""
    return page.run(f"""(() => {{ const from = document.getElementById("picture"), c = document.createElement("canvas"); c.width = from.width; c.height = from.height;
const g = c.getContext("2d"); g.drawImage(from, 0, 0); const d = g.getImageData({x} * from.width - 4, {y} * from.height - 4, 8, 8).data, s = [0, 0, 0];
for (let i = 0; i < d.length; ++i) if (i % 4 < 3) s[i % 4] += d[i] / 64; return s; }})()""")


def settle():
    page.wait(f"new Promise((then) => setTimeout(then, 150)).then(() => {DONE})")


def card(name):
    return f'[...document.querySelectorAll("#surfaces .surface")].find((c) => c.querySelector("strong").textContent === "{name}")'


# The surface gets another shader, and a string.
page.run(f"document.getElementById('surfaces').closest('details').open = true; ({card('back wall')}).querySelector('details').open = true")
page.wait(f"({card('back wall')}).querySelector('input.shader')")
CHOOSER = f"({card('back wall')}).querySelector('input.shader')"
page.run(f"{CHOOSER}.dispatchEvent(new Event('focus'))")
suite.expect(page.wait("[...document.querySelectorAll('#offered-surfaces option')].some((o) => o.value === 'stripes')"), "a shader beside the scene is offered")
before = color(0.5, 0.4)
page.run(f"(() => {{ {CHOOSER}.value = 'stripes'; {CHOOSER}.dispatchEvent(new Event('change')); }})()")
suite.expect(page.wait(f"{RIB}.includes('Surface \"stripes\"')"), "it is taken")
settle()
suite.expect(page.run(f"({card('back wall')}).textContent.includes('look')"), "its parameters are there")
striped = color(0.5, 0.4)
suite.expect(sum(abs(a - b) for a, b in zip(before, striped)) > 20, f"the wall looks otherwise ({before} to {striped})")
TEXT = f"({card('back wall')}).querySelector('.texts input')"
page.run(f"(() => {{ {TEXT}.value = 'dark'; {TEXT}.dispatchEvent(new Event('change')); }})()")
suite.expect(page.wait(f"{RIB}.includes('\"string look\" [\"dark\"]')"), "a text is changed")
settle()
suite.expect(sum(color(0.5, 0.4)) < 0.7 * sum(striped), "and seen")
suite.expect(page.wait("!document.getElementById('stale').hidden && document.getElementById('stale').textContent.includes('back wall')"), "bounced light is known to be old")
page.run(f"(() => {{ {CHOOSER}.value = 'nonsense'; {CHOOSER}.dispatchEvent(new Event('change')); }})()")
suite.expect(page.wait(f"document.getElementById('notes').textContent.includes('no such shader') && {CHOOSER}.value === 'stripes'"), "a shader that is none is refused")

# Bounced light of a region is gathered again.
box = page.run("(() => { const b = document.getElementById('picture').getBoundingClientRect(); return [b.left, b.top, b.width, b.height]; })()")


def drag(x0, y0, x1, y1):
    at = [(box[0] + x * box[2], box[1] + y * box[3]) for x, y in ((x0, y0), ((x0 + x1) / 2, (y0 + y1) / 2), (x1, y1))]
    page.mouse("mousePressed", *at[0], button="left", clickCount=1)
    for p in at[1:]:
        page.mouse("mouseMoved", *p, button="left", buttons=1)
    page.mouse("mouseReleased", *at[2], button="left", clickCount=1)


page.run("document.activeElement.blur()")
page.key("r")
drag(0.3, 0.3, 0.7, 0.6)
suite.expect(page.wait("!document.getElementById('chosen').hidden && document.getElementById('region').classList.contains('on')"), "a region is dragged")
page.key("g")
GATHERED = """fetch("news?after=0&bytes=50000").then((r) => r.arrayBuffer()).then((b) => JSON.parse(new TextDecoder().decode(new Uint8Array(b, 4,
new Uint32Array(b, 0, 1)[0]))).gathered)"""
suite.expect(page.wait(f"{GATHERED}.then((g) => g.length > 0)"), f"its light is gathered {page.run(GATHERED)}")
page.key("r")
suite.expect(page.wait("document.getElementById('chosen').hidden"), "and the region ends")
settle()
page.key("a")
suite.expect(page.wait("!document.getElementById('ages').hidden"), "ages are shown")
page.key("a")

# A light leaves an object out, and a variable is shown.
page.run(f"({card('left wall')}).querySelector('details').open = true")
LINK = f"""[...({card('left wall')}).querySelectorAll(".link")].find((l) => l.textContent === "lamp")?.querySelector("input")"""
suite.expect(page.wait(f"!!{LINK}"), "an object lists the lights that shine on it")
lit = color(0.05, 0.5)
page.run(f"{LINK}.click()")
suite.expect(page.wait(f"{RIB}.includes('Illuminate \"lamp\" 0')"), "one is taken off")
settle()
suite.expect(sum(color(0.05, 0.5)) < 0.9 * sum(lit), "and the wall is darker")
page.run("(() => { const s = document.getElementById('shown'); s.value = 'N'; s.dispatchEvent(new Event('change')); })()")
page.wait("document.getElementById('what').textContent === 'up to date'")
time.sleep(0.5)
normal = color(0.5, 0.4)
suite.expect(normal[2] < 30 and abs(normal[0] - 127) < 20, f"a variable is shown ({normal})")
page.run("(() => { const s = document.getElementById('shown'); s.value = ''; s.dispatchEvent(new Event('change')); })()")
page.run("(() => { const s = document.getElementById('transform'); s.value = 'linear'; s.dispatchEvent(new Event('change')); })()")
time.sleep(0.3)
suite.expect(sum(color(0.3, 0.8)) < 0.9 * 765, "a view transform is chosen")
page.run("(() => { const s = document.getElementById('search'); s.value = 'right'; s.dispatchEvent(new Event('input')); })()")
suite.expect(page.run("[...document.querySelectorAll('#surfaces .surface')].filter((c) => !c.hidden).length") == 1, "a search finds an object")
page.run("(() => { const s = document.getElementById('search'); s.value = ''; s.dispatchEvent(new Event('input')); })()")

# A slow link carries 100 kB/s.
page.call("Network.enable")
page.call("Network.emulateNetworkConditions", offline=False, latency=40, downloadThroughput=100e3, uploadThroughput=100e3)
other = f"({card('back wall')}).querySelector('input[type=range]')"
page.run("""window.steps = []; performance.clearResourceTimings();""")
page.run(f"(() => {{ {other}.value = 0.2; {other}.dispatchEvent(new Event('input')); }})()")
settle()
SAID = "document.querySelector('#work p').textContent"
suite.expect(page.wait(f"{SAID}.includes('present edit') && !{SAID}.includes('coarse')", 120), "over a slow link the picture comes, and then all of it at full size")
sizes = page.run("performance.getEntriesByType('resource').filter((r) => r.name.includes('news?')).map((r) => [r.encodedBodySize, r.duration])")
middle = sorted(s for s, _ in sizes)[len(sizes) // 2]
suite.expect(len(sizes) > 2 and middle < 80e3, f"in small pieces, {middle / 1000:.0f} kB in the median of {len(sizes)}")
page.call("Network.emulateNetworkConditions", offline=False, latency=0, downloadThroughput=-1, uploadThroughput=-1)
settle()

folder.mkdir(exist_ok=True)
for name, size in {"edits_wide": (1280, 800), "edits_tablet": (820, 1180)}.items():
    page.resize(*size)
    time.sleep(0.5)
    page.screenshot(folder / f"{name}.png")
    suite.expect(page.run("[document.documentElement, document.querySelector('aside')].every((e) => e.scrollWidth <= e.clientWidth)"), f"{name}: nothing reaches over the edge of the window")
mistakes = [c for c in page.complaints() if "shader?" not in str(c)]
suite.expect(mistakes == [], f"the browser complains of nothing else than the shader that is none {mistakes[:2]}")
page.run("document.getElementById('end').click()")
suite.expect(server.wait(20) == 0, "the page ends the program")
page.close()
suite.finish()
