"""Tests that the page of tomales relight can change everything that shade --edit takes: shaders, strings, colours, the
atmosphere, links of lights, and the imager. The saved edit must be small and readable, and give the bits of the page's
picture."""
import json
import os
import pathlib
import subprocess
import sys

from program import Suite
from relight_server import SCENE, Server, layers

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "image"))
from pictures import pixels  # noqa: E402

suite = Suite()
suite.trust_shaders(str(suite.folder / "plugins"))
source = pathlib.Path(__file__).resolve().parents[2]
(suite.folder / "plugins").mkdir()
subprocess.run([os.environ["CXX"], "-std=c++17", "-shared", "-fPIC", "-I", source, source / "docs/example_plugin/dots.cpp", "-o",
                suite.folder / "plugins/dots.so"], check=True)
suite.write("stripes.sl", """surface stripes(float Kd = 0.7; color other = color(0.1, 0.2, 0.6); string look = "plain"; float steps[2] = {4, 0.5}) {
  color base = mod(steps[0] * s, 1) < steps[1] ? Cs : other;
  if (look == "dark") base *= 0.3;
  Ci = Kd * base * diffuse(faceforward(normalize(N), I)); Oi = Os;
}
""")
suite.write("flicker.sl", "light flicker(float intensity = 1; point at = point(0, 0, 0)) { illuminate(at) Cl = intensity / (L . L); }\n")
suite.write("broken.sl", "surface broken( { }\n")
suite.write("box.rib", SCENE.replace('Surface "matte"', 'Atmosphere "fog" "distance" [9]\nSurface "matte"'))
suite.run("hide", "box.rib", "-o", "box.dfb", "-q")
suite.run("gather", "box.dfb", "-o", "box.icf", "--by-light", "-q")
(suite.folder / "edits").mkdir()
server = Server(suite, "--irradiance", "box.icf", "--folder", "edits")

offered = server.json("offered")
suite.expect({"matte", "plastic", "stripes", "dots"} <= set(offered["surfaces"]) and not {"fog", "flicker"} & set(offered["surfaces"]),
             "surfaces that are built in, a text, and a plugin are offered")
suite.expect("flicker" in offered["lights"] and "pointlight" in offered["lights"] and "fog" in offered["atmospheres"], "so are lights and volumes")
described = {p["name"]: p for p in server.json("shader?kind=surfaces&name=stripes")["params"]}
suite.expect(described["look"]["type"] == "string" and described["look"]["value"] == ["plain"] and described["steps"]["type"] == "float[2]",
             "their parameters are told, texts and arrays too")
suite.expect(server.get("shader?kind=surfaces&name=dots")[0] == 200, "those of a plugin too")
for kind, name in (("surfaces", "../stripes"), ("surfaces", "/etc/passwd"), ("surfaces", "none"), ("surfaces", "flicker"), ("imagers", "matte"), ("no", "matte"),
                   ("surfaces", "broken")):
    suite.expect(server.get(f"shader?kind={kind}&name={name}")[0] == 400, f"{kind} {name} is no shader to choose")
key = next(light for light in server.json("scene")["lights"] if light["owner"] == "key")
suite.expect({"shadowname", "__nonspecular"} <= {p["name"] for p in key["params"]}, "lights have the parameters that all lights have")
suite.expect(server.settled() is not None, "the picture is shaded")

CHANGES = {
    "another surface, a text": {"shaders": {"surfaces": {"ball": "stripes"}}, "surfaces": {"ball": {"Kd": [0.5], "look": ["dark"], "steps": [6, 0.25]}}},
    "a surface of a plugin": {"shaders": {"surfaces": {"walls": "dots"}}, "surfaces": {"walls": {"frequency": [3]}}},
    "another light": {"shaders": {"lights": {"key": "flicker"}}, "lights": {"key": {"intensity": [0.4], "at": [0.2, 0.7, 0]}}},
    "a light by a text": {"lights": {"key": {"shadowname": ["raytrace"]}}},
    "a light elsewhere": {"lights": {"key": {"from": [-0.5, 0.2, 0]}}},
    "another colour": {"objects": {"ball": {"color": [0.2, 0.5, 0.9]}}},
    "a light that leaves an object out": {"objects": {"ball": {"lights": {"key": False}}}},
    "thicker air": {"atmospheres": {"walls": {"distance": [2]}}},
    "no air": {"shaders": {"atmospheres": {"ball": "null", "walls": "null"}}},
    "an imager": {"shaders": {"imagers": {"imager": "background"}}, "imagers": {"imager": {"color": [0.1, 0.2, 0.3]}}},
}
suite.run("shade", "box.dfb", "--irradiance", "box.icf", "-o", "box.exr", "-q")
before = pixels(suite.folder / "box.exr")
for what, edit in {**CHANGES, "all at once": {k: {a: b for c in CHANGES.values() for a, b in c.get(k, {}).items()} for k in
                                              ("shaders", "lights", "surfaces", "atmospheres", "objects", "imagers")}}.items():
    if what == "all at once":
        edit["shaders"] = {"surfaces": {"ball": "stripes", "walls": "dots"}, "lights": {"key": "flicker"}, "imagers": {"imager": "background"}}
        edit["lights"] = CHANGES["another light"]["lights"]
    status, _, answer = server.post("edit", edit)
    suite.expect(status == 200, f"{what}: it is taken {answer[:80] if status != 200 else ''}")
    whole = server.whole()
    server.post("save", {"name": "edit"})
    suite.run("shade", "box.dfb", "--irradiance", "box.icf", "--edit", "edits/edit.rib", "-o", "edit.exr", "-q")
    after = pixels(suite.folder / "edit.exr")
    suite.expect(whole is not None and all(whole[3 * (48 * y + x) + c] == after[x, y][c] for x, y in after for c in range(3)),
                 f"{what}: shade --edit gives the bits of the page's picture")
    suite.expect(sum(max(abs(a - b) for a, b in zip(after[p][:3], before[p][:3])) > 1e-3 for p in after) > 20, f"{what}: which is another one")
    loaded = json.loads(server.post("load", {"name": "edit"})[2])
    present = server.json("scene")["present"]
    suite.expect(loaded == present, f"{what}: the saved edit is loaded as it was")
    status = server.settled()
    suite.expect(status is not None, f"{what}: the layers are shaded")
    if "imager" not in json.dumps(edit):
        found = layers(server.news()[1], 48, 36)
        worst = max(abs(1.5 * sum(found[i][p][c] for i in (1, 2, 3)) - after[p][c]) / (after[p][c] + 0.01) for p in after for c in range(3))
        suite.expect(worst < 3e-3, f"{what}: they add up to the picture ({worst:.1e})")

server.post("edit", {"shaders": {"surfaces": {"ball": "stripes"}}, "surfaces": {"ball": {"look": ["dark"], "Kd": [0.5]}},
                     "objects": {"ball": {"lights": {"key": False}}}, "lights": {"key": {"intensity": [0.25]}}})
server.post("save", {"name": "small"})
suite.expect((suite.folder / "edits/small.rib").read_text() == """version 3.04
LightSource "pointlight" "key" "float intensity" [0.25]
Attribute "identifier" "name" ["ball"]
Illuminate "key" 0
Surface "stripes" "float Kd" [0.5] "string look" ["dark"]
""", "a saved edit holds what was changed, and no more")

# A page cannot reach other files.
for text in ("/etc/passwd", "../secret.tex", "a/../../b", "~/x", "|program", "x" * 300, "a\nb"):
    suite.expect(server.post("edit", {"lights": {"key": {"shadowname": [text]}}})[0] == 400, f"the text {text[:16]!r} is refused")
for bad in ({"shaders": {"surfaces": {"ball": "../stripes"}}}, {"shaders": {"surfaces": {"ball": 1}}}, {"shaders": {"no": {}}}, {"shaders": []},
            {"shaders": {"surfaces": {"nobody": "matte"}}}, {"objects": {"nobody": {}}}, {"objects": {"ball": {"color": [1]}}},
            {"objects": {"ball": {"lights": {"sun": True}}}}, {"objects": {"ball": {"lights": {"key": 1}}}}, {"objects": {"ball": {"opacity": [1, 1, 1]}}},
            {"lights": {"key": {"shadowname": [1]}}}, {"lights": {"key": {"__group": ["x"]}}},
            {"surfaces": {"ball": {"look": ["plain"]}}}):
    suite.expect(server.post("edit", bad)[0] == 400, f"an edit of {str(bad)[:60]} is refused")

# The folder holds scenes and other edits.
suite.write("edits/scene.rib", SCENE)
suite.write("edits/other.rib", 'LightSource "pointlight" "moon" "intensity" [2]\n')
suite.write("edits/hand.rib", '# by hand\nDeclare "Ks" "float"\nAttribute "identifier" "name" ["ball"]\nColor [1 0 0]\nSurface "plastic" "Ks" [0.9]\n')
suite.write("edits/nothing.rib", b"\0\1\2")
suite.expect(server.json("edits") == ["edit", "hand", "small"], "only edits of this shot are listed")
suite.expect(json.loads(server.post("load", {"name": "hand"})[2])["objects"] == {"ball": {"color": [1, 0, 0]}}, "one that was written by hand is loaded")
suite.expect(server.end() == 0, "it ends")

# The page begins with an edit of the command line.
server = Server(suite, "--irradiance", "box.icf", "--edit", "edits/hand.rib", "--folder", "edits")
suite.expect(server.json("scene")["present"]["objects"] == {"ball": {"color": [1, 0, 0]}}, "the page begins with an edit that is given")
server.post("save", {"name": "again"})
suite.expect("Color [1 0 0]" in (suite.folder / "edits/again.rib").read_text(), "which is saved with the others")
suite.expect(server.end() == 0, "it ends")
suite.finish()
