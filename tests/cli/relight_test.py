"""Tests the server of tomales relight: who may send requests, what it answers, and that a saved edit gives the picture of the page."""
import array
import json
import os
import pathlib
import random
import socket
import sys
import time

from program import Suite
from relight_server import SCENE, Server, layers

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "image"))
from pictures import pixels  # noqa: E402

suite = Suite()

suite.write("box.rib", SCENE)
suite.run("hide", "box.rib", "-o", "box.dfb", "-q")
suite.run("gather", "box.dfb", "-o", "box.icf", "--by-light", "-q")
suite.run("gather", "box.dfb", "-o", "plain.icf", "-q")
(suite.folder / "edits").mkdir()
server = Server(suite, "--irradiance", "box.icf", "--folder", "edits")

# The server refuses strangers.
page = f"/{server.token}/"
suite.expect(server.ask("GET", page)[0] == 200, "the page is there")
suite.expect("default-src 'none'" in server.ask("GET", page)[1].get("Content-Security-Policy", ""), "it may load nothing from elsewhere")
for name in ("main.js", "mixer.js", "stage.js", "handles.js", "panel.js", "edit.js", "server.js", "page.css"):
    suite.expect(server.get(name)[0] == 200, f"{name} is there")
for path in ("/", "/scene", f"/{'0' * 32}/", f"/{server.token[:-1]}x/", f"/{server.token}", f"/{server.token}x/scene"):
    suite.expect(server.ask("GET", path)[0] == 403, f"without the token {path[:12]} is refused")
for host in ("evil.example", f"evil.example:{server.port}", "127.0.0.1", f"127.0.0.1.evil.example:{server.port}", ""):
    suite.expect(server.ask("GET", page, headers={"Host": host})[0] in (400, 403), f"Host {host!r} is refused")
suite.expect(server.ask("GET", page, headers={"Host": f"localhost:{server.port}"})[0] == 200, "localhost is the same host")
for origin in ("http://evil.example", "null", f"https://{server.host}", f"http://{server.host}.evil.example"):
    suite.expect(server.ask("POST", page + "edit", {}, {"Origin": origin})[0] == 403, f"Origin {origin!r} is refused")
suite.expect(server.ask("POST", page + "edit", {}, {"Origin": f"http://{server.host}"})[0] == 200, "the page's own origin is not")

# The page learns about the scene.
scene = server.json("scene")
suite.expect((scene["width"], scene["height"]) == (48, 36) and scene["exposure"] == [1.5, 1], "the size and the exposure")
suite.expect([layer["name"] for layer in scene["layers"]] == ["everything", "glow", "key", "rim"] and scene["sharesBounces"],
             "a layer for each light, with what it bounces")
rim = next(light for light in scene["lights"] if light["owner"] == "rim")
matrix, p = rim["pixelFromShader"], [0.3, -0.6, 0.3, 1]
x, y, w = (sum(matrix[4 * c + row] * p[c] for c in range(4)) for row in (0, 1, 3))
# Screen space is +-1 along the shorter side of 36 pixels. With fov 60 it shows 1 / tan(30 degrees) at a distance of 1.
focal = 18 * 3 ** 0.5
suite.expect(abs(x / w - (24 + focal * 0.3 / 1.7)) < 1e-3 and abs(y / w - (18 + focal * 0.6 / 1.7)) < 1e-3, "a light's points have a place in the picture")
suite.expect(server.settled() is not None, "all layers are shaded")
suite.expect(server.whole() is not None, "and the whole picture is")
status, blocks = server.news()
found = layers(blocks, 48, 36)
suite.run("shade", "box.dfb", "--irradiance", "box.icf", "-o", "box.exr", "-q")
suite.expect(sorted(found) == [0, 1, 2, 3] and all(len(layer) == 48 * 36 for layer in found.values()), "they come as blocks")
truth = pixels(suite.folder / "box.exr")
for what, of in (("the whole", lambda p: found[0][p]), ("the sum of the lights", lambda p: [sum(found[i][p][c] for i in (1, 2, 3)) for c in range(3)])):
    worst = max(abs(1.5 * of(p)[c] - truth[p][c]) / (truth[p][c] + 0.01) for p in truth for c in range(3))
    suite.expect(worst < 2e-3, f"{what} is the picture but for the rounding of half floats ({worst:.1e})")
suite.expect(status["notLinear"] == [], "light adds up everywhere")
suite.expect(server.json("object?x=33&y=26") == {"object": "ball", "shader": "plastic"}, "a pixel tells its object and shader")

# Edits are refused, shaded, saved and loaded.
key = {"lights": {"key": {"intensity": [0.2], "lightcolor": [1, 0.5, 0.25]}, "rim": {"coneangle": [0.3]}},
       "surfaces": {"ball": {"Ks": [0.9]}}, "exposure": [1.25, 1]}
for bad in ([], {"rib": "Surface"}, {"lights": {"sun": {}}}, {"lights": {"key": {"mapname": ["x"]}}}, {"lights": {"key": {"intensity": [1, 2]}}},
            {"lights": {"key": {"intensity": ["1"]}}}, {"lights": {"key": {"intensity": [1e99]}}}, {"lights": {"key": [1]}},
            {"surfaces": {"ball": {"no": [1]}}}, {"exposure": [1, 0]}, {"exposure": [-1, 1]}, b"{", b"", b"\xff" * 9, b"[" * 5000):
    suite.expect(server.post("edit", bad)[0] == 400, f"an edit of {str(bad)[:40]} is refused")
suite.expect(server.post("edit", b" " * (1 << 19))[0] == 413, "so is one that is too large")
suite.expect(server.post("edit", key)[0] == 200 and server.settled() is not None, "an edit is shaded")
whole = server.whole()
suite.expect(server.post("save", {"name": "warm"})[0] == 200 and (suite.folder / "edits/warm.rib").is_file(), "and saved")
suite.run("shade", "box.dfb", "--irradiance", "box.icf", "--edit", "edits/warm.rib", "-o", "warm.exr", "-q")
warm = pixels(suite.folder / "warm.exr")
suite.expect(whole is not None and all(whole[3 * (48 * y + x) + c] == warm[x, y][c] for x, y in warm for c in range(3)),
             "shade --edit gives the bits of the page's picture")
status, blocks = server.news()
found = layers(blocks, 48, 36)
# The page multiplies the layer of a light by the ratio of the light's present output to the output with which the layer
# was shaded.
unit = status["layers"][2]["unit"]
suite.expect(all(abs(u - 0.7) < 1e-6 for u in unit), "layers are as bright as the scene's lights")
key_weight = [0.2 * tint / u for tint, u in zip((1, 0.5, 0.25), unit)]
worst = max(abs(1.25 * (found[1][p][c] + key_weight[c] * found[2][p][c] + found[3][p][c]) - warm[p][c]) / (warm[p][c] + 0.01) for p in warm for c in range(3))
suite.expect(worst < 3e-3, f"its layers add up to it ({worst:.1e})")
single = {"lights": {"rim": {"coneangle": [0.3]}}, "surfaces": {"ball": {"Ks": [0.9]}}, "exposure": [1.25, 1]}
before = [layer["version"] for layer in status["layers"]]
server.post("edit", single)
after = [layer["version"] for layer in server.settled()["layers"]]
suite.expect(before[1:] == after[1:], "a change of intensity and colour shades no layer again")
suite.expect(json.loads(server.post("load", {"name": "warm"})[2])["surfaces"] == {"ball": {"Ks": [array.array("f", [0.9])[0]]}}, "a saved edit is loaded")
suite.expect(server.json("scene")["present"]["exposure"] == [1.25, 1], "another page learns the present edit")
for what, path, status in (("the first page that edits", "edit?page=5", 200), ("a second one only watches", "edit?page=6", 409),
                           ("until it takes over", "edit?page=6&take=1", 200), ("then the first one watches", "edit?page=5", 409),
                           ("and so does one without a number", "edit", 409)):
    suite.expect(server.post(path, single)[0] == status, what)
suite.expect(server.post("leave?page=5", {})[0] == 200 and server.post("edit?page=5", single)[0] == 409, "one that watches may go")
suite.expect(server.news()[0]["editor"] == 6 and server.news()[0]["present"]["exposure"] == [1.25, 1], "all learn who edits, and what")
suite.expect(server.post("leave?page=6", {})[0] == 200 and server.post("edit?page=7", single)[0] == 200, "when the one that edits has gone, the next may")
suite.expect(server.json("edits") == ["warm"], "the folder's edits are listed")
for name in ("../warm", "..", "", "a/b", "/etc/passwd", "a" * 65, "a.b", "a\0", "%2e%2e%2fwarm"):
    suite.expect(server.post("save", {"name": name})[0] == 400 and server.post("load", {"name": name})[0] == 400, f"the name {name[:20]!r} leads nowhere")
for path in ("../box.rib", "..%2fbox.rib", "edits/warm.rib", "%2e%2e/box.rib", "//etc/passwd", "main.js/../../box.rib"):
    suite.expect(server.get(path)[0] in (403, 404), f"the path {path} leads nowhere")
suite.write("edits/own.rib", 'LightSource "pointlight" "key" "intensity" [2]\nColor [1 0 0]\n')
suite.expect(server.post("load", {"name": "own"})[0] == 400, "an edit that does more than the page can is refused")
own = (suite.folder / "edits/own.rib").read_bytes()
suite.expect(server.post("save", {"name": "own"})[0] == 400 and (suite.folder / "edits/own.rib").read_bytes() == own, "and a file that is no edit of this shot is never replaced")
for question in ("object", "object?x=99&y=0", "object?x=-1&y=0", "object?x=1e3&y=0", "object?x=99999999999999999999&y=1", "news", "news?after=x"):
    suite.expect(server.get(question)[0] == 400, f"the question {question} is refused")

saves = [server.post("save", {"name": "warm"})[0] for _ in range(80)]
suite.expect(saves[0] == 200 and 429 in saves, f"files are not written without end ({saves.count(200)} of 80 saves in a row)")
for address in ("127.0.0.2", socket.gethostbyname(socket.gethostname())):
    if address != "127.0.0.1":
        with socket.socket() as other:
            suite.expect(other.connect_ex((address, int(server.port))) != 0, "it listens at the loopback address alone")

with socket.socket() as other:
    other.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEPORT, 1)
    try:
        other.bind(("127.0.0.1", int(server.port)))
        shares = True
    except OSError:
        shares = False
suite.expect(not shares, "no other process can listen at its port")

# One client sends nonsense, and one sends nothing.
silent = [socket.create_connection(("127.0.0.1", int(server.port))) for _ in range(8)]
random.seed(36)
METHODS = ("GET", "POST", "PUT", "HEAD", "OPTIONS", "DELETE", "TRACE", "G\0T", "")
PATHS = ("/", page, page + "edit", page + "news?after=0", page + "news?after=%00", page + "load", page + "object?x=1&y=" + "9" * 400, "*", "/" + "a" * 9000)
LINES = ("Host: " + server.host, "Host: x", "Content-Length: 4", "Content-Length: -1", "Content-Length: 99999999999", "Transfer-Encoding: chunked",
         "Origin: null", "X: " + "y" * 5000, "Range: bytes=0-,5-1", "Connection: close", ": ", "\0\0", "Expect: 100-continue", "Content-Encoding: gzip",
         "Content-Type: multipart/form-data; boundary=" + "b" * 100, "Content-Type: application/x-www-form-urlencoded")


def nonsense():
    head = f"{random.choice(METHODS)} {random.choice(PATHS)} HTTP/{random.choice(('1.1', '1.0', '9', ''))}\r\n"
    text = head + "".join(random.choice(LINES) + "\r\n" for _ in range(random.randrange(6))) + random.choice(("\r\n", "", "\n")) + random.choice(("", "{}", "5\r\n{", "--b\r\n"))
    data = bytearray(text.encode())
    for _ in range(random.randrange(4)):
        data[random.randrange(len(data))] = random.randrange(256)
    return bytes(data)


# The suite sends some requests; TOMALES_REQUESTS=10000 is for a run overnight.
requests = int(os.environ.get("TOMALES_REQUESTS", "300"))
for _ in range(requests):
    with socket.create_connection(("127.0.0.1", int(server.port)), timeout=5) as connection:
        try:
            connection.sendall(nonsense())
            connection.shutdown(socket.SHUT_WR)
        except OSError:
            pass
start = time.time()
suite.expect(server.get("scene")[0] == 200 and server.json("scene")["lights"] == scene["lights"], f"after {requests} requests of nonsense it answers as before")
suite.expect(time.time() - start < 20, "and does not keep others waiting")
for connection in silent:
    connection.close()
suite.expect(server.end() == 0, "Ctrl-C ends it")

# Some records have no shares, and then there are no records.
server = Server(suite, "--irradiance", "plain.icf")
scene = server.json("scene")
suite.expect(not scene["sharesBounces"] and scene["layers"][-1]["name"] == "bounced light", "without shares bounced light is a layer of its own")
suite.expect(server.settled() is not None, "which is shaded")
found = layers(server.news()[1], 48, 36)
worst = max(abs(1.5 * sum(found[i][p][c] for i in (1, 2, 3, 4)) - truth[p][c]) / (truth[p][c] + 0.01) for p in truth for c in range(3))
suite.expect(worst < 3e-3, f"and adds up with the others ({worst:.1e})")
suite.expect(server.post("end", {})[0] == 200 and server.process.wait(20) == 0, "the page ends it")
suite.write("pair.rib", SCENE.replace('"from"', '"string __group" ["pair"] "from"'))
server = Server(suite, of="pair.rib")
suite.expect(server.json("scene")["sharesBounces"] and server.settled() is not None, "a scene is hidden, and its light gathered by lights, first")
suite.expect([layer["name"] for layer in server.json("scene")["layers"]] == ["everything", "glow", "pair"], "lights of one group are one layer")
before = [layer["version"] for layer in server.settled()["layers"]]
server.post("edit", {"lights": {"key": {"intensity": [0.2]}}})
after = [layer["version"] for layer in server.settled()["layers"]]
suite.expect(after[1] == before[1] and after[2] > before[2], "which is shaded again where only one of them is dimmed")
suite.expect(server.end() == 0, "and it ends")
suite.write("none.dfb", "no shot")
suite.expect_run("a shot that is none", ["relight", "none.dfb", "--no-browser"], 2, "dfb-read")
suite.expect_run("a scene that is none", ["relight", "none.rib", "--no-browser"], 2)
suite.finish()
