"""Compiles plugins of ABI 1 against its headers and renders them: they must work today as they did then."""
import json
import os
import pathlib
import struct
import subprocess
import sys
import zlib

from program import Suite

here = pathlib.Path(__file__).resolve().parent
t = Suite()
(t.folder / "shaders").mkdir()
for source in sorted((here / "plugins").iterdir()):
    compiler = [os.environ["CC"], "-std=c99"] if source.suffix == ".c" else [os.environ["CXX"], "-std=c++17"]
    subprocess.run([*compiler, "-O1", "-Wall", "-Wextra", "-Wno-missing-field-initializers", "-Werror", "-shared", "-fPIC", "-I", here / "1", source,
                    "-o", t.folder / "shaders" / (source.stem + ".so")], check=True)


def png(name, size, level):
    rows = b"".join(b"\0" + bytes([level] * 3 * size) for _ in range(size))
    chunk = lambda kind, data: struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    header = struct.pack(">IIBBBBB", size, size, 8, 2, 0, 0, 0)
    return t.write(name, b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


def channels(name):
    return {c["name"]: c for c in json.loads(t.run("info", "--json", name).stdout)["channels"]}


def expect_even(picture, channel, value):
    c = channels(picture)[channel]
    t.expect(abs(c["min"] - value) < 1e-3 and abs(c["max"] - value) < 1e-3, f"{picture} {channel} is {value} everywhere: {c['min']} to {c['max']}")


# The scene is a lit square before the eye, seen from the front, and behind the eye a wall of constant colour that its rays meet.
png("fifth.png", 16, 51)
SCENE = """DisplayChannel "varying color traced"
Display "o.exr" "file" "rgb"
Display "+traced.exr" "file" "traced"
Format 16 16 1
PixelSamples 2 2
Projection "orthographic"
WorldBegin
LightSource "frozen_light" "l" "float power" [0.4] "color tint" [1 1 0.5]
%s
AttributeBegin
Attribute "visibility" "int diffuse" [1] "int specular" [1]
Surface "constant"
Color 0.125 0.25 0.5
Translate 0 0 -3
Patch "bilinear" "P" [-9 -9 0  9 -9 0  -9 9 0  9 9 0]
AttributeEnd
Surface "frozen_surface" "string texturename" ["fifth.png"] "float coverweight" [0.5] "vector axis" [0 0 -1] "float[3] scales" [1 1 2]
Translate 0 0 5
Patch "bilinear" "P" [-2 -2 0  2 -2 0  -2 2 0  2 2 0]
WorldEnd
"""
t.write("clear.rib", SCENE % "")
result = t.expect_run("a surface and a light of ABI 1", ["clear.rib", "--shaders", "shaders"], 0)
t.expect(not result.stderr, "render without a word: " + result.stderr)
expect_even("o.exr", "R", 0.2)   # This is the picture.
expect_even("o.exr", "G", 0.75)  # This is the wall's green, and half of what it covers.
expect_even("o.exr", "B", 0.4)   # This is the light, twice.
for channel, value in zip(sorted(channels("traced.exr"), key=lambda name: "RGB".find(name[-1].upper())), (0.125, 0.25, 0.5)):
    expect_even("traced.exr", channel, value)

t.write("murky.rib", SCENE % 'Atmosphere "frozen_volume" "float glow" [0.1]')
result = t.expect_run("a volume of ABI 1 before them", ["murky.rib", "--shaders", "shaders"], 0)
t.expect(not result.stderr, "renders without a word: " + result.stderr)
expect_even("o.exr", "R", 0.5 * 0.2 + 0.1 * 0.4)
expect_even("o.exr", "B", 0.5 * 0.4 + 0.1 * 0.2)
for source in sorted((here / "plugins").iterdir()):
    t.expect_run(f"{source.stem} does what it declares", ["shadetest", f"shaders/{source.stem}.so", "--check"], 0, "faults: 0")
t.finish()
