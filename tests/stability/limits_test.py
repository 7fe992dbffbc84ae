"""Tests that the renderer warns at the limits of a method. A scene of tests/stability/knobs with a limit has a line ##lab limit CODE: VALUE. Some
method must report that code at the value, and none at the value before it.

    limits_test.py TOMALES [part of a scene's name]
"""
import json
import pathlib
import re
import subprocess
import sys
import tempfile

tomales = pathlib.Path(sys.argv[1]).resolve()
only = sys.argv[2] if len(sys.argv) > 2 else ""
failures = 0


class LabScene:
    def __init__(self, path, folder):
        self.text, self.folder = path.read_text(), folder
        said = re.findall(r"^##lab (\w+) (.*)$", self.text, re.M)
        self.of = {word: [rest for w, rest in said if w == word] for word, _ in said}
        self.values = self.of["knob"][0].rsplit(": ", 1)[1].split()
        self.limit = self.of["limit"][0].rsplit(": ", 1) if "limit" in self.of else None

    def warns(self, value):
        """Returns whether any method reports the code of the limit."""
        scene, statistics = self.folder / "scene.rib", self.folder / "stats.json"
        scene.write_text(self.text.replace("$knob", value).replace("$truth", "0"))
        for method in self.of["method"]:
            arguments = " ".join([*self.of.get("common", []), method.rsplit(": ", 1)[1].replace("$knob", value)]).split()
            subprocess.run([tomales, "render", scene, "-q", "-t", "2", *arguments, "-o", self.folder / "out.exr", "--stats", statistics], check=True, timeout=300)
            if any(w["code"] == self.limit[0] for w in json.loads(statistics.read_text())["warnings"]):
                return True
        return False


checked = 0
with tempfile.TemporaryDirectory() as temporary:
    for path in sorted((pathlib.Path(__file__).parent / "knobs").glob("*.rib")):
        scene = LabScene(path, pathlib.Path(temporary))
        if not scene.limit or only not in path.name:
            continue
        code, value = scene.limit
        at = scene.values.index(value)
        assert at > 0, f"{path}: nothing harmless comes before the limit"
        before = scene.values[at - 1]
        beyond, within = scene.warns(value), scene.warns(before)
        print(("ok      " if beyond and not within else "FAILED  ") + f"{path.stem}: {code} at {value}: {beyond}; at {before}: {within}", flush=True)
        failures += not beyond or within
        checked += 1
sys.exit(bool(failures) or checked == 0)
