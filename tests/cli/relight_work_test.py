"""Tests the order of work of tomales relight: coarse pictures come first. It also tests regions, variables, bounced light that is
gathered again, blocks that fit a slow link, and a scene that is hidden and gathered while the page waits."""
import json
import pathlib
import struct
import sys
import time

from program import Suite
from relight_server import PATIENCE_S, SCENE, Server, layers, parts

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "image"))
from pictures import pixels  # noqa: E402

WIDTH, HEIGHT, X0, Y0 = 240, 160, 30, 20
suite = Suite()
# A window of the frame, so that its pixels are not those of the raster.
suite.write("box.rib", SCENE.replace("Format 48 36 1", "Format 300 200 1\nCropWindow 0.1 0.9 0.1 0.9")
            .replace('"float samples" [64]', '"float samples" [32]').replace('"intensity" [1] "coneangle"', '"intensity" [0] "coneangle"').replace('"key"', '"key" "shadowname" ["raytrace"]')
            .replace('Display "box', 'DisplayChannel "color mine" "string source" ["Cs"]\nDisplay "box'))
suite.run("hide", "box.rib", "-o", "box.dfb", "-q", "--bucket-size", "16")
suite.run("gather", "box.dfb", "-o", "box.icf", "--by-light", "-q")
(suite.folder / "edits").mkdir()
server = Server(suite, "--irradiance", "box.icf", "--folder", "edits")


def window(name):
    """Returns the pixels of the window, counted from its corner."""
    made = pixels(suite.folder / name)
    return {(x - X0, y - Y0): v for (x, y), v in made.items() if X0 <= x < X0 + WIDTH and Y0 <= y < Y0 + HEIGHT}


def same(whole, made):
    return whole is not None and all(whole[3 * (WIDTH * y + x) + c] == made[x, y][c] for x, y in made for c in range(3))


scene = server.json("scene")
suite.expect((scene["width"], scene["height"]) == (WIDTH, HEIGHT), "a window of the frame is shown")
status = server.settled()
suite.expect(status is not None, "all layers are shaded")
data = server.news()[1]
found = layers(data, WIDTH, HEIGHT)
suite.run("shade", "box.dfb", "--irradiance", "box.icf", "-o", "made.exr", "-q")
truth = window("made.exr")
off = max(abs(1.5 * (found[1][p][c] + found[2][p][c]) - truth[p][c]) / (truth[p][c] + 0.01) for p in truth for c in range(3))
suite.expect(off < 2e-3, f"the lights that are on add up to the picture ({off:.1e})")
suite.expect(status["layers"][3]["unit"] == [1, 1, 1] and max(max(c) for c in found[3].values()) > 0.1, "a light that is off has a layer that can be turned up")
on = {"lights": {"rim": {"intensity": [1.5]}}}
before = [layer["version"] for layer in status["layers"]]
server.post("edit", on)
server.post("save", {"name": "on"})
status = server.settled()
suite.expect([layer["version"] for layer in status["layers"]][1:] == before[1:], "which shades nothing again")
suite.expect("rim" in str(status["stale"]), "its bounced light is known to be missing")

# Coarse blocks of the present edit come before fine ones, and only for the light that has changed.
after = server.news()[0]["newest"]
server.post("pointer?x=200&y=30", {})
moved = {"lights": {"key": {"from": [-0.5, 0.5, 0.2]}}}
server.post("edit", moved)
seen, end = [], time.time() + PATIENCE_S
while time.time() < end:
    status, blocks = server.news(after)
    after = status["after"]
    seen += parts(blocks)
    if not status["doing"] and not any(layer["old"] for layer in status["layers"][1:]):
        break
whose = [(b["layer"], b["step"]) for b in seen]
suite.expect({layer for layer, _ in whose} == {2}, f"a light that moves has its layer shaded alone {set(whose)}")
suite.expect(seen[0]["step"] in (1, 16) and [b["step"] for b in seen[1:]] == [1] * (len(seen) - 1), "first the squares, if they were not finished before")
fine = [b for b in seen if b["step"] == 1]
suite.expect(abs(fine[0]["x"] + fine[0]["width"] / 2 - 200) < 64 and abs(fine[0]["y"] + fine[0]["height"] / 2 - 30) < 64, "then the part at the pointer")
suite.expect(sum(b["width"] * b["height"] for b in fine) == WIDTH * HEIGHT, "each part once")
coarse = [b for b in seen if b["step"] == 16]
now = layers(server.news()[1], WIDTH, HEIGHT)
if coarse:
    columns = -(-WIDTH // 16)
    inside = [(x, y) for y in range(1, 9) for x in range(1, 14)]
    off = sorted(max(abs(coarse[0]["values"][y * columns + x][c] - now[2][16 * x + 8, 16 * y + 8][c]) for c in range(3)) for x, y in inside)
    suite.expect(off[len(off) // 2] < 0.02 * max(max(v) for v in now[2].values()), f"a square has the colour in its middle (median {off[len(off) // 2]:.1e})")

# Blocks fit the bytes that a link carries, and those of full size follow.
status, everything = server.news()
for least in (20_000, 200_000):
    data = server.get(f"news?after=0&bytes={least}")[2]
    reduced = parts(data[4 + struct.unpack_from("<I", data)[0]:])
    suite.expect(len(data) < least + 6000 and {b["layer"] for b in reduced} == {0, 1, 2, 3} and reduced[0]["step"] > 1, f"all layers come in {least} bytes, coarser")
    step = reduced[0]["step"]
    b = next(b for b in reduced if b["layer"] == 2 and b["width"] > 2 * step and b["height"] > 2 * step)
    mean = [sum(now[2][b["x"] + i, b["y"] + j][c] for i in range(step) for j in range(step)) / step**2 for c in range(3)]
    suite.expect(all(abs(m - v) < 2e-3 * (m + 0.01) for m, v in zip(mean, b["values"][0])), "a square of pixels is their mean")
after, full, most = 0, b"", 0
while after < status["newest"]:
    data = server.get(f"news?after={after}&last={status['newest']}&bytes=30000")[2]
    size = struct.unpack_from("<I", data)[0]
    after = json.loads(data[4:4 + size])["after"]
    full += data[4 + size:]
    most = max(most, len(data) - size)
suite.expect(most < 30_000 + 64 * 64 * 6 + 100, "parts at full size come a few at a time")
suite.expect(layers(full, WIDTH, HEIGHT) == now, "and are all of it")

# The page shows a variable of surfaces, and a channel of the scene.
for name, of in (("z", "Z"), ("a", "A"), ("N", None), ("mine", None)):
    suite.expect(server.post(f"variable?name={name}", {})[0] == 200, f"{name} may be asked for")
    end = time.time() + PATIENCE_S
    while time.time() < end and (server.news(0)[0]["variable"]["left"] > 0 or server.news(0)[0]["variable"]["name"] != name):
        pass
    shown = layers(server.news()[1], WIDTH, HEIGHT)[4]
    suite.expect(len(shown) == WIDTH * HEIGHT, f"{name} is shown")
    ball = shown[int(300 * 0.5 + 100 * 3**0.5 * 0.3 / 1.7 - 30), int(100 + 100 * 3**0.5 * 0.6 / 1.7 - 20)]
    want = {"z": lambda v: all(abs(c - (1.7 - 0.4)) < 0.05 for c in v), "a": lambda v: list(v) == [1, 1, 1], "N": lambda v: abs(sum(c * c for c in v) - 1) < 0.01,
            "mine": lambda v: all(abs(c - w) < 1e-3 for c, w in zip(v, (0.7, 0.6, 0.5)))}[name]
    suite.expect(want(ball), f"{name} of the ball's middle is {[round(c, 3) for c in ball]}")
for bad in ("none", "Ci,a", "../x", "N%00"):
    suite.expect(server.post(f"variable?name={bad}", {})[0] == 400, f"the variable {bad} is refused")
server.post("variable?name=", {})

# Only one region is shaded.
suite.expect(server.post("only?x=0&y=0&width=40&height=40", {})[0] == 200, "a region is chosen")
server.post("edit", {"surfaces": {"walls": {"Kd": [0.4]}}})
end = time.time() + PATIENCE_S
while time.time() < end and (server.news(0)[0]["doing"] or server.news(0)[0]["layers"][2]["left"] == 1):
    time.sleep(0.02)
left = server.news()[0]["layers"][2]["left"]
suite.expect(0.7 < left < 1, f"the rest stays old ({left:.2f})")
suite.expect(server.post("only", {})[0] == 200 and server.settled() is not None, "until all is asked for again")
for bad in ("only?x=1", "only?x=0&y=0&width=0&height=5", "only?x=9999&y=0&width=1&height=1", "gather", "gather?x=0&y=0&width=-1&height=1"):
    suite.expect(server.post(bad, {})[0] == 400, f"{bad} is refused")

# Bounced light is gathered again in a region.
dark = {"surfaces": {"walls": {"Kd": [0.1]}}}
server.post("edit", dark)
suite.expect("walls" in str(server.settled()["stale"]), "bounced light of a surface that has changed is known to be stale")
server.whole()
old = layers(server.news()[1], WIDTH, HEIGHT)[0]
suite.expect(server.post("gather?x=0&y=80&width=120&height=80", {})[0] == 200, "it is gathered in a region")
end = time.time() + PATIENCE_S
while time.time() < end and (server.news(0)[0]["gathering"] or not server.news(0)[0]["gathered"]):
    time.sleep(0.02)
suite.expect(server.settled()["gathered"] == [[0, 80, 120, 160]], "the page learns where")
whole = server.whole()
taken = suite.folder / "edits/taken.icf"
suite.write("edits/taken.icf", "records of another pass")
suite.expect(server.post("save", {"name": "taken"})[0] == 400 and taken.read_text() == "records of another pass" and not taken.with_suffix(".rib").exists(),
             "records that others have gathered are never replaced")
saved = json.loads(server.post("save", {"name": "dark"})[2])
suite.expect(server.post("save", {"name": "dark"})[0] == 200, "those of an edit are, by the same edit")
suite.expect(saved.get("irradiance", "").endswith("dark.icf"), "what was gathered is saved with the edit")
suite.run("shade", "box.dfb", "--irradiance", "edits/dark.icf", "--edit", "edits/dark.rib", "-o", "made.exr", "-q")
suite.expect(same(whole, window("made.exr")), "with both shade --edit gives the bits of the page's picture")
suite.write("fresh.rib", (suite.folder / "box.rib").read_text().replace('Surface "matte"', 'Surface "matte" "Kd" [0.1]'))
suite.run("hide", "fresh.rib", "-o", "fresh.dfb", "-q", "--bucket-size", "16")
suite.run("gather", "fresh.dfb", "-o", "fresh.icf", "-q")
suite.run("shade", "fresh.dfb", "--irradiance", "fresh.icf", "-o", "fresh.exr", "-q")
fresh = window("fresh.exr")


def off(picture, gain):
    """Returns the mean error inside of the region, which has the light on the ball's side."""
    inside = [(x, y) for x in range(20, 100, 5) for y in range(100, 155, 5)]
    return sum(abs(gain * picture(x, y)[c] - fresh[x, y][c]) for x, y in inside for c in range(3)) / (3 * len(inside))


before, after = off(lambda x, y: old[x, y], 1.5), off(lambda x, y: whole[3 * (WIDTH * y + x):][:3], 1)
suite.expect(after < 0.2 * before, f"and there the light is that of a new gathering ({before:.1e} off before, {after:.1e} after)")
suite.expect(server.end() == 0, "it ends")

# A scene is hidden and gathered while the page is open.
suite.write("slow.rib", SCENE.replace("Format 48 36 1", "Format 320 240 1").replace('"float samples" [64]', '"float samples" [256]'))
server = Server(suite, of="slow.rib")
page = server.get("")[0]
heard, end = set(), time.time() + PATIENCE_S
while time.time() < end:
    told = server.json("preparation")
    if told["ready"]:
        break
    heard.add(told["doing"])
    time.sleep(0.02)  # The server refuses more questions per second than a page has.
suite.expect(page == 200 and "gathering" in heard, f"the page is there first, and tells what is done {sorted(heard)}")
suite.expect(server.json("scene")["width"] == 320, "then the scene")
suite.expect(server.post("end", {})[0] == 200 and server.process.wait(20) == 0, "the page ends it")
server = Server(suite, of="slow.rib")
server.json("preparation")
suite.expect(server.post("end", {})[0] == 200 and server.process.wait(20) is not None, "it can be ended before it is ready")
suite.finish()
