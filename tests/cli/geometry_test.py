"""Renders the corpus of ugly geometry. The second line of each file has the expected exit code and warnings."""
import pathlib
import re
import sys

from program import Suite

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "image"))
from pictures import pixels  # noqa: E402

t = Suite()
files = sorted(pathlib.Path(__file__).parent.parent.glob("corpus/geometry/*.rib"))
for file in files:
    exit_code, codes = re.match(r"# exit (\d), warns (.*)", file.read_text().splitlines()[1]).groups()
    result = t.run(str(file), "-o", "ugly.exr")
    said = sorted(set(re.findall(r"\[([a-z0-9-]+)\]$", result.stderr, re.MULTILINE)) - {"frame-empty"})  # This warning follows from the others.
    if "[frame-empty]" in result.stderr:
        exit_code = max(int(exit_code), 3)
    good = result.returncode == int(exit_code) and (" ".join(said) or "nothing") == codes
    t.expect(good, f"{file.name}: {codes}")
    if not good:
        print(f"        exit {result.returncode}, expected {exit_code}\n        {result.stderr[:600]}")
t.expect(len(files) >= 60, "there are at least 60")

# Each instance of a Blobby is repelled by the ground where it stands.
GROUND = """Display "ground.z" "zfile" "z" Format 64 64 1 Projection "orthographic" ScreenWindow -3 3 -3 3 Clipping 1 20
Translate 0 0 10 Rotate 90 1 0 0 WorldBegin Surface "constant" Polygon "P" [-3 -1 -3  3 0.5 -3  3 0.5 3  -3 -1 3] WorldEnd
"""
BLOBBY = 'Blobby 2 [1001 0 1003 0 16 0 2 0 1] [1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1 .4 .01 .3 .08] ["ground.z"]\n'
PLACES = "".join(f"AttributeBegin Translate {x} 0 0 {{0}} AttributeEnd\n" for x in (-1, 1))
SCENE = """Display "{name}.exr" "openexr" "rgb" Format 64 48 1 PixelSamples 2 2 Projection "perspective" "fov" [40] Translate 0 0 6 WorldBegin
LightSource "distantlight" 1 "from" [0 1 -1] "to" [0 0 0] Surface "matte" {before}{places} WorldEnd
"""
t.write("ground.rib", GROUND)
t.expect_run("a map of the ground", ["ground.rib"], 0)
t.write("own.rib", SCENE.format(name="own", before="", places=PLACES.format(BLOBBY)))
t.write("shared.rib", SCENE.format(name="shared", before=f"ObjectBegin 1 {BLOBBY} ObjectEnd\n", places=PLACES.format("ObjectInstance 1")))
for name in ("own", "shared"):
    t.run(name + ".rib")
own, shared = (pixels(t.folder / f"{name}.exr") for name in ("own", "shared"))
t.expect(any(p[0] > 0.1 for p in own.values()) and own == shared, "instances of a Blobby over a ground look like Blobbies of their own")

t.finish()
