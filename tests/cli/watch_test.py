"""Tests looking at a frame while it is made: --preview in a viewer of the tev protocol, and --pixel. It also tests frames that are interrupted and
resumed row by row."""
import re
import signal
import socket
import subprocess
import time

from program import GOOD, Suite
from tev import Viewer

t = Suite()
t.write("good.rib", GOOD.replace("Format 24 24 1", "Format 90 150 1").replace("Sphere", 'Attribute "identifier" "name" ["ball"] Color [0.8 0.4 0.2]\nSphere'))

viewer = Viewer()
t.expect_run("a render with a viewer", ["good.rib", "-o", "seen.exr", f"--preview={viewer.address}"], 0)
viewer.join(10)
t.expect(viewer.name == "seen.exr" and (viewer.width, viewer.height, viewer.channels) == (90, 150, 4), "the viewer knows the picture")
t.expect(viewer.updates >= 3 and len(viewer.pixels) == 90 * 150, "and got all of it, piece by piece")
dump = subprocess.run(["oiiotool", "--dumpdata", "--info", "-v", "seen.exr"], cwd=t.folder, capture_output=True, text=True).stdout
dumped = {(int(x), int(y)): tuple(float(v) for v in rest.split()) for x, y, rest in re.findall(r"Pixel \((\d+), (\d+)\): ([^\n]*)", dump)}
wrong = sum(any(abs(a - b) > 1e-5 for a, b in zip(viewer.pixels.get(at, (9,) * 4), value)) for at, value in dumped.items())
t.expect(len(dumped) == 90 * 150 and wrong == 0, "which is what the file holds")
t.run("good.rib", "-o", "unseen.exr", "-q")
t.expect_run("the picture is the same without", ["compare", "seen.exr", "unseen.exr"], 0, "different_pixels               0")
t.expect_run("a crop has its own corner", ["good.rib", "-o", "crop.exr", "--crop", "0.5,1,0.5,1", f"--preview={(part := Viewer()).address}"], 0)
part.join(10)
t.expect(len(part.pixels) == 45 * 75 and (0, 0) in part.pixels, "which is that of the viewer's picture")

# A gather pass shows the part that it has covered, in ever smaller squares, before any row is done.
t.write("gathered.rib", """Display "gathered.exr" "openexr" "rgba"
Format 96 96 1
Projection "perspective" "fov" [60]
WorldBegin
LightSource "indirectlight" "gi" "float samples" [64]
LightSource "pointlight" "key" "from" [0 0.5 2] "intensity" [2]
Surface "matte"
Polygon "P" [-4 -1 0  -4 -1 9  4 -1 9  4 -1 0]
Polygon "P" [-4 -1 5  -4 4 5  4 4 5  4 -1 5]
WorldEnd
""")
gathering = Viewer()
t.expect_run("a gather pass with a viewer", ["gathered.rib", "-q", "--gi", "gather", f"--preview={gathering.address}"], 0)
gathering.join(10)
t.expect(len(gathering.sketches) == 4, f"four pictures come before the rows ({len(gathering.sketches)})")
for stride, picture in zip((16, 8, 4, 2), gathering.sketches):
    t.expect(all(picture[x, y] == picture[x - x % stride, y - y % stride] for x, y in picture), f"in squares of {stride} pixels")
    off = sorted(abs(picture[x, y][0] - gathering.pixels[x, y][0]) / gathering.pixels[x, y][0] for x in range(0, 96, stride) for y in range(0, 96, stride))
    most = off[int(0.75 * len(off))]  # Pixels along an edge see both sides.
    t.expect(most < 0.1, f"whose corners look as the finished picture does ({most:.3f})")
t.run("gathered.rib", "-o", "ungathered.exr", "-q", "--gi", "gather")
t.expect_run("and the picture is the same without", ["compare", "gathered.exr", "ungathered.exr"], 0, "different_pixels               0")

closed = socket.create_server(("127.0.0.1", 0))
port = closed.getsockname()[1]
closed.close()
t.expect_run("nobody listens", ["good.rib", "-o", "alone.exr", f"--preview=127.0.0.1:{port}"], 0, "nobody listens")
t.expect_run("no such host", ["good.rib", "-o", "alone.exr", "--preview=no.host.invalid:1"], 0, "nobody listens")
deaf = Viewer(reads=False)
start = time.time()
t.expect_run("a viewer that does not read", ["good.rib", "-o", "deaf.exr", "--format", "1200x1200", "--pixel-samples", "1x1", f"--preview={deaf.address}"], 0)
t.expect_run("has not changed the picture", ["info", "deaf.exr"], 0)

# --pixel prints what a pixel sees.
seen = t.expect_run("--pixel", ["good.rib", "-o", "seen.exr", "--pixel", "45,75", "--pixel", "0,0"], 0, "pixel 45,75: 4 samples see",
                    "pixel 0,0: 4 samples see 0 micropolygons", '"ball" (', "good.rib:9", "matte", "Oi 1 1 1")
depth = float(re.search(r"z ([0-9.]+)", seen.stdout)[1])
mean = [float(v) for v in re.search(r"75: .*?mean of its samples: (\S+) (\S+) (\S+)", seen.stdout, re.S).groups()]
t.expect(abs(depth - 3) < 0.01, f"at its depth ({depth})")
t.expect(all(abs(a - b) < 0.02 for a, b in zip(mean, dumped[45, 75])), f"and nearly the colour of the picture ({mean}, {dumped[45, 75][:3]})")
t.expect_run("--pixel that is none", ["good.rib", "--pixel", "12"], 1, "X,Y")
for outside in (["--pixel", "900,75"], ["--pixel", "5,5", "--crop", "0.5,1,0.5,1"]):
    t.expect_run("--pixel outside of the picture", ["good.rib", "-o", "part.exr", *outside], 0, "lies outside of the picture")
t.run("hide", "good.rib", "-o", "good.dfb", "-q")
again = t.expect_run("--pixel of a shot", ["shade", "good.dfb", "-o", "again.exr", "--pixel", "45,75"], 0, '"ball" (', "good.rib:9")
t.expect(mean == [float(v) for v in re.search(r"mean of its samples: (\S+) (\S+) (\S+)", again.stdout).groups()], "sees the same")

# A frame is made row by row, interrupted, and resumed.
for number, code in ((signal.SIGINT, 130), (signal.SIGTERM, 143), (signal.SIGKILL, -9)):
    line = ["good.rib", "-o", f"cut{code}.exr", "--format", "500x500", "--memory-limit", "1M", "--resume", "-t", "2"]
    process = subprocess.Popen([t.program, *line, "--progress", "-q"], cwd=t.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    for _ in range(25):
        process.stdout.readline()
    process.send_signal(number)
    process.communicate(timeout=200)
    t.expect(process.returncode == code, f"signal {int(number)} ends with {code}")
    t.expect((t.folder / f"cut{code}.partial.exr").exists() == (number != signal.SIGKILL) and not (t.folder / f"cut{code}.exr").exists(), "with what is finished in a picture, if it can")
    kept = t.expect_run("--resume", line + ["-v"], 0, "buckets were finished before")
    t.expect(int(re.search(r"(\d+) of \d+ buckets were finished", kept.stderr)[1]) >= 25, "finds finished buckets")
    t.expect(not (t.folder / f"cut{code}.partial.exr").exists(), "and the whole picture takes the place of the partial one")
    t.run("good.rib", "-o", "whole.exr", "--format", "500x500", "-q")
    t.expect_run("and gives the same bits", ["compare", f"cut{code}.exr", "whole.exr"], 0, "different_pixels               0")
t.expect(not list(t.folder.glob("*.dfb.part")), "no buckets are left behind")
t.finish()
