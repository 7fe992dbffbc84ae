"""Tests tomales chart: it makes a page that stands alone with figures beside it, and measures nothing twice."""
import html.parser
import json
import os
import pathlib
import re
import shutil
import signal
import subprocess
import time

from program import Suite

SCENE = """Format 24 24 1
PixelSamples 2 2
Display "scene.exr" "openexr" "rgb"
Display "+beside.png" "png" "rgb"
Projection "perspective" "fov" [40]
Translate 0 0 4
WorldBegin
LightSource "indirectlight" 1 "samples" [32]
LightSource "pointlight" 2 "from" [2 3 -3] "intensity" [12]
Surface "matte"
Sphere 1 -1 1 360
Polygon "P" [-3 -1 -3 -3 -1 3 3 -1 3 3 -1 -3]
WorldEnd
"""


class Page(html.parser.HTMLParser):
    """Finds the tags that are left open, where links lead, and what is loaded from elsewhere."""

    VOID = {"meta", "img", "br", "input"}

    def __init__(self, text):
        super().__init__()
        self.open, self.ids, self.links, self.loads, self.wrong = [], set(), [], [], []
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        values = dict(attributes)
        if tag not in self.VOID:
            self.open.append(tag)
        self.ids.add(values.get("id"))
        if tag == "a":
            self.links.append(values["href"])
        self.loads += [values[k] for k in ("src", "srcset", "data") if k in values]

    def handle_startendtag(self, tag, attributes):
        pass

    def handle_endtag(self, tag):
        if not self.open or self.open.pop() != tag:
            self.wrong.append(tag)


suite = Suite()
suite.write("scene.rib", SCENE)
chart = ["chart", "scene.rib", "-o", "report.html", "--sweep", "samples", "--cache", "cache", "--budget", "60s", "--batches", "2"]


def measured():
    return len(list((suite.folder / "cache").glob("????????????????.json")))


def broken_off(by, at):
    """Returns the exit code of a chart that gets this signal when this much is measured."""
    process = subprocess.Popen([suite.program, *chart], cwd=suite.folder, stderr=subprocess.PIPE, text=True)
    while measured() < at and process.poll() is None:
        time.sleep(0.02)
    process.send_signal(by)
    process.communicate(timeout=60)
    return process.returncode


def left_behind():
    """Returns the programs that still render in this folder."""
    def folder(process):
        try:
            return (process / "cwd").resolve()
        except OSError:
            return None
    return [p.name for p in pathlib.Path("/proc").glob("[0-9]*") if folder(p) == suite.folder.resolve()]


def within_two_seconds(condition):
    for _ in range(100):
        if condition():
            return True
        time.sleep(0.02)
    return False


code = broken_off(signal.SIGKILL, 1)
suite.expect(code == -signal.SIGKILL and 1 <= measured() < 9, f"a chart that is killed keeps what was measured ({code}, {measured()})")
suite.expect(within_two_seconds(lambda: not left_behind()), "and its renderer ends")
# The picture would take minutes, so the test does not wait for it.
suite.write("long.rib", SCENE.replace("24 24", "2048 2048").replace("PixelSamples 2 2", "PixelSamples 16 16"))
charting = subprocess.Popen([suite.program, "chart", "long.rib", *chart[2:]], cwd=suite.folder, stderr=subprocess.DEVNULL)
suite.expect(within_two_seconds(lambda: len(left_behind()) == 2), "a chart of a long picture renders in a process of its own")
time.sleep(0.5)  # The chart is being made at this moment.
charting.kill()
charting.wait()
ended = within_two_seconds(lambda: not left_behind())
suite.expect(ended, "which ends when the chart is killed")
for process in left_behind():
    os.kill(int(process), signal.SIGKILL)
code = broken_off(signal.SIGINT, 2)
suite.expect(code == 130, f"an interrupted chart ends as one ({code})")
kept = measured()
suite.expect(2 <= kept < 9, f"and keeps what was measured ({kept})")

suite.expect("inf" not in suite.expect_run("a tiny chart", chart, 0, "reference, batch 2, noise").stderr, "tells no noise of a single batch")
suite.expect(measured() == 9, "measures what is left: a trial, two batches, six settings")
suite.expect(not (suite.folder / "beside.png").exists(), "leaves the scene's other pictures alone")
report = json.loads((suite.folder / "report.json").read_text())
points = report["points"]
suite.expect(len(points) == 6, "every setting is in the figures")
errors = [p["mean_absolute_relative_error"] for p in points]
suite.expect(all(e > 0 for e in errors) and errors[-1] < errors[0] / 3, f"more rays, less error: {errors}")
suite.expect(all(p["cpu_s"] > 0 and p["peak_bytes"] > 1e6 for p in points), "every setting has a cost")
suite.expect(report["reference"]["noise_floor"] < errors[0], "the reference is quieter than the worst")
suite.expect(any(p["best_in_time"] for p in points), "some point is on the Pareto front")

text = (suite.folder / "report.html").read_text()
page = Page(text)
suite.expect(not page.wrong and not page.open, f"tags are closed: {page.wrong} {page.open}")
own = re.sub(r"/\*!.*?\*/", "", text, flags=re.S)  # Licences name where a library comes from.
suite.expect(not re.search(r"https?:|@import|url\((?!#)|<script[^>]+src|<link|fetch\(|XMLHttp", own) and "Released under the MIT License" in text, "nothing comes from a network")
suite.expect(all(s.startswith("data:image/png;base64,iVBOR") for s in page.loads) and len(page.loads) == 13, "thumbnails and error maps are inside")
suite.expect(len(re.findall(r'class="picture" data-name="', text)) == 7 and 'filter id="exposure"' in text, "pictures have an exposure and a place to be flipped in")
broken = [link for link in page.links if link.lstrip("#") not in page.ids and link != "report.json"]
suite.expect(not broken, f"links lead somewhere: {broken}")
drawings = [json.loads(s) for s in re.findall(r'<script type="application/json">(.*?)</script>', text)]
suite.expect([d["title"] for d in drawings] == ["Error against CPU time", "Error against memory", "Error against the setting"], "three plots")
suite.expect([p["value"] for p in points] == [16, 50, 150, 450, 1350, 4000], "the last against what varies")
for drawing, costs in zip(drawings, ([p["cpu_s"] for p in points], [p["peak_bytes"] / 2**20 for p in points], [p["value"] for p in points])):
    shown, = (c["points"] for c in drawing["curves"])
    suite.expect(all(abs(p["x"] / cost - 1) < 1e-5 and abs(p["y"] / error - 1) < 1e-5 for p, cost, error in zip(shown, costs, errors, strict=True)), "its points are the figures")
    suite.expect(all(p["tip"] and p["link"][1:] in page.ids for p in shown), "they say what they are, and lead to their pictures")

before = {f: f.stat().st_mtime_ns for f in (suite.folder / "cache").glob("*.exr")}
suite.expect_run("the same chart again", chart, 0, "recalled")
again = json.loads((suite.folder / "report.json").read_text())["points"]
suite.expect(all(p["recalled"] for p in again), "recalls everything")
suite.expect(all(f.stat().st_mtime_ns == t for f, t in before.items()), "and renders nothing anew")
suite.expect_run("a sweep that does not exist", chart[:4] + ["--sweep", "beauty"], 1, "shadingrate")
suite.expect_run("a scene that does not exist", ["chart", "no.rib", "-o", "report.html"], 1, "no.rib")
suite.expect_run("a folder that does not exist", ["chart", "scene.rib", "-o", "no/report.html"], 4, "no/report.html", "its folder is missing")
suite.expect_run("a folder for figures that cannot be made", ["chart", "scene.rib", "-o", "report.html", "--cache", "scene.rib/cache"], 4, "scene.rib/cache")
suite.write("dark.rib", "".join(line + "\n" for line in SCENE.splitlines() if "LightSource" not in line))
suite.expect_run("a scene without lamps", ["chart", "dark.rib", "-o", "dark.html", *chart[4:]], 2, "black", "needs lamps")
suite.write("wrong.rib", SCENE.replace('"matte"', '"nonesuch"'))
suite.expect_run("a scene with a wrong name", ["chart", "wrong.rib", "-o", "wrong.html", *chart[4:]], 0)
suite.expect("shader-missing" in (suite.folder / "wrong.html").read_text(), "is charted, and its page says what the renderer warned of")
suite.write("broken.rib", "# nothing\n")
suite.expect_run("a scene that cannot be rendered", ["chart", "broken.rib", "-o", "broken.html", *chart[4:]], 2, "no reference")

LAB = """##lab title Bars thinner than a pixel
##lab knob tenths of a pixel: 9 1
##lab common --gi none
##lab truth --pixel-samples 8x8 --seed @
##lab method few: --pixel-samples 2x2
##lab note A note & more.
Format 24 24 1
PixelFilter "box" 1 1
Projection "orthographic"
ScreenWindow 0 24 0 24
WorldBegin
Surface "constant"
Rotate -10 0 0 1
Polygon "P" [4 -9 5  4 40 5  4.$knob 40 5  4.$knob -9 5]
WorldEnd
"""
(suite.folder / "lab").mkdir()
suite.write("lab/bars.rib", LAB)
lab = ["chart", "--stability", "lab", "-o", "stability.html", "--cache", "cache", "--budget", "60s", "--batches", "2"]
suite.expect_run("a laboratory", lab, 0, "few, tenths of a pixel 1")
scene = json.loads((suite.folder / "stability.json").read_text())["scenes"][0]
wide, thin = (p["mean_absolute_relative_error"] for p in scene["points"])
suite.expect(0 < wide < thin, f"thin bars are worse: {wide}, {thin}")
page = Page((suite.folder / "stability.html").read_text())
suite.expect(not page.open and not page.wrong and all(load.startswith("data:") for load in page.loads), "its page is whole and stands alone")
suite.expect(all(link[1:] in page.ids for link in page.links if link.startswith("#")), "its links lead somewhere")
suite.write("lab/bars.rib", LAB.replace("##lab truth", "##lab tooth"))
suite.expect_run("a laboratory with a word that nobody knows", lab, 2, "cannot be understood: ##lab tooth")
suite.write("lab/bars.rib", LAB.replace("##lab knob", "# knob"))
suite.expect_run("a laboratory without a knob", lab, 2, "knob")
suite.write("lab/bars.rib", LAB.replace("##lab note", "##lab limit pixel-noise: 9\n##lab note"))
suite.expect_run("a laboratory whose limit is the first value", lab, 2, "none of the knob's values after the first")

if browser := shutil.which("chromium"):  # If there is a browser, the page is opened in it.
    seen = subprocess.run([browser, "--headless", "--no-sandbox", "--disable-gpu", "--dump-dom", (suite.folder / "report.html").as_uri()],
                          capture_output=True, text=True, timeout=120).stdout
    suite.expect(re.findall(r'aria-label="([^"]*)"', seen) == [f"{d['title']}: 6 points" for d in drawings], "a browser draws all points within the axes")
    suite.expect(seen.count("<option") == 14 and "A: reference" in seen, "and its script offers all pictures")
suite.finish()
