"""Runs tomales relight for a test, and asks it what its page asks."""
import array
import http.client
import json
import re
import select
import signal
import struct
import subprocess
import time

SCENE = """Display "box.exr" "openexr" "rgba"
Format 48 36 1
PixelSamples 2 2
Exposure 1.5 1
Projection "perspective" "fov" [60]
Translate 0 0 1.4
WorldBegin
LightSource "indirectlight" "gi" "float samples" [64]
LightSource "pointlight" "key" "from" [0.5 0.6 -0.3] "intensity" [0.7]
LightSource "spotlight" "rim" "from" [-0.8 0.8 0] "to" [0.5 -1 0] "intensity" [1] "coneangle" [0.5]
Attribute "identifier" "name" ["walls"]
Surface "matte"
Color [0.7 0.6 0.5]
Polygon "P" [-1 -1 -1 1 -1 -1 1 -1 1 -1 -1 1]
Polygon "P" [-1 -1 1 1 -1 1 1 1 1 -1 1 1]
Attribute "identifier" "name" ["ball"]
Surface "plastic" "Ks" [0.4]
Translate 0.3 -0.6 0.3
Sphere 0.4 -0.4 0.4 360
WorldEnd
"""
PATIENCE_S = 60


class Server:
    def __init__(self, suite, *options, of="box.dfb"):
        self.process = subprocess.Popen([suite.program, "relight", of, "--no-browser", *options], cwd=suite.folder, text=True,
                                        stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        ready, _, _ = select.select([self.process.stdout], [], [], PATIENCE_S)
        line = self.process.stdout.readline() if ready else ""
        self.port, self.token = re.fullmatch(r"http://127\.0\.0\.1:(\d+)/([0-9a-f]{32})/\n", line).groups()
        self.host = f"127.0.0.1:{self.port}"

    def ask(self, method, path, body=None, headers=None):
        """Returns the status, the headers and the bytes of the answer. The path is sent unchanged."""
        connection = http.client.HTTPConnection("127.0.0.1", int(self.port), timeout=30)
        connection.putrequest(method, path, skip_host=headers is not None and "Host" in headers)
        data = body if isinstance(body, bytes) or body is None else json.dumps(body).encode()
        for name, value in (headers or {}).items():
            connection.putheader(name, value)
        if data is not None:
            connection.putheader("Content-Length", str(len(data)))
        connection.endheaders(data)
        answer = connection.getresponse()
        out = answer.status, dict(answer.getheaders()), answer.read()
        connection.close()
        return out

    def get(self, path):
        return self.ask("GET", f"/{self.token}/{path}")

    def post(self, path, body):
        return self.ask("POST", f"/{self.token}/{path}", body)

    def json(self, path):
        return json.loads(self.get(path)[2])

    def news(self, after=0, told=0):
        code, _, data = self.get(f"news?after={after}&told={told}")
        while code == 429:  # A client that asks too often gets an answer that says so.
            time.sleep(0.1)
            code, _, data = self.get(f"news?after={after}&told={told}")
        length = struct.unpack_from("<I", data)[0]
        return json.loads(data[4:4 + length]), data[4 + length:]

    def settled(self):
        """Waits until every layer belongs to the present edit, and the check has been made."""
        end, after, told = time.time() + PATIENCE_S, 0, 0
        while time.time() < end:
            status, _ = self.news(after, told)
            after, told = status["after"], status["told"]
            if status["checked"] and not any(layer["old"] for layer in status["layers"][1:]) and not status["doing"]:
                return status
        return None

    def whole(self):
        self.post("ask", {})
        end = time.time() + PATIENCE_S
        while time.time() < end:
            status, _, data = self.get("whole")
            if status == 200:
                return array.array("f", data)
            time.sleep(0.05)
        return None

    def end(self):
        self.process.send_signal(signal.SIGINT)
        return self.process.wait(20)


def parts(blocks):
    """Returns the blocks of news, as reyes/app/relight/layers.h describes them."""
    out, at = [], 0
    while at < len(blocks):
        layer, x, y, w, h, version, serial, step = struct.unpack_from("<8I", blocks, at)
        count = -(-w // step) * -(-h // step)
        values = struct.unpack_from(f"<{3 * count}e", blocks, at + 32)
        out.append({"layer": layer, "x": x, "y": y, "width": w, "height": h, "version": version, "serial": serial, "step": step,
                    "values": [values[3 * i:3 * i + 3] for i in range(count)]})
        at += 32 + (6 * count + 3) // 4 * 4
    return out


def layers(blocks, width, height):
    """Returns {layer: {(x, y): (r, g, b)}} of the blocks of news at full size."""
    out = {}
    for b in parts(blocks):
        if b["step"] == 1:
            for i, color in enumerate(b["values"]):
                out.setdefault(b["layer"], {})[b["x"] + i % b["width"], b["y"] + i // b["width"]] = color
    return out
