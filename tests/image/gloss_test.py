"""Tests that rays of one glossy point share the light samples and gather rays of that point. More rays must not need more of
these, and must bring the same light."""
import json
import pathlib
import subprocess
import sys
import tempfile

from pictures import pixels

program = pathlib.Path(sys.argv[1]).resolve()
SCENE = """Display "x.exr" "openexr" "rgb"
Format 48 36 1
PixelSamples 2 2
Projection "perspective" "fov" [40]
Translate 0 -0.3 5
Rotate -20 1 0 0
WorldBegin
AttributeBegin
AreaLightSource "arealight" "lamp" "intensity" [3] "samples" [64]
Surface "matte"
Translate 0 3 0 Rotate 90 1 0 0
Patch "bilinear" "P" [-1 -1 0 1 -1 0 -1 1 0 1 1 0]
AttributeEnd
Illuminate "lamp" 1
LightSource "environmentlight" "sky" "intensity" [0.4] "samples" [64]
LightSource "indirectlight" "bounce" "samples" [256]
LightSource "occlusionlight" "room" "samples" [64] "intensity" [0.1]
Surface "matte" Color [0.7 0.4 0.3]
Sphere 0.7 -0.7 0.7 360
Surface "disney" %s "roughness" [0.4] "reflections" [%d]
Color [0.9 0.9 0.9]
Polygon "P" [-4 -0.7 -4 -4 -0.7 4 4 -0.7 4 4 -0.7 -4]
WorldEnd
"""
failures = 0


def expect(condition, message):
    global failures
    print(("ok      " if condition else "FAILED  ") + message)
    failures += not condition


def render(folder, material, reflections, *options):
    (folder / "x.rib").write_text(SCENE % (material, reflections))
    subprocess.run([program, "x.rib", "-q", "--stats", "x.json", *options], cwd=folder, check=True)
    picture = pixels(folder / "x.exr")
    return json.loads((folder / "x.json").read_text())["rays"], [sum(v[c] for v in picture.values()) / len(picture) for c in range(3)]


with tempfile.TemporaryDirectory() as name:
    folder = pathlib.Path(name)
    for material in ('"metallic" [1]', '"specular" [1]'):
        none, _ = render(folder, material, 0)
        one, single = render(folder, material, 1)
        many, mean = render(folder, material, 128)
        expect(one["specular"] > 64 * 300, f"{material}: each point sends at least as many rays as lights have samples")
        expect(many["specular"] > 1.5 * one["specular"], "and more if more are asked for")
        for kind in ("transmission", "gather"):
            expect(one[kind] < 2.5 * none[kind],
                   f"and all of them cost about as many {kind} rays as the point: {none[kind]}, {one[kind]}")
        expect(all(abs(a - b) < 0.01 * b for a, b in zip(single, mean)), f"and bring the same light: {single}, {mean}")
    traced = [render(folder, '"metallic" [1]', n, "--gi", "reference", "--samples", "64") for n in (0, 1, 128)]
    expect(traced[1][0]["reference"] < 3 * traced[0][0]["reference"], "paths are shared too")
    expect(all(abs(a - b) < 0.02 * b for a, b in zip(traced[1][1], traced[2][1])), f"and bring the same light: {traced[1][1]}, {traced[2][1]}")
sys.exit(bool(failures))
