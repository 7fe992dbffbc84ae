"""Tests several textured frames in one stream: they have the same bits for any number of threads, and pictures that are rewritten
between frames are read again."""
import random
import re
import struct
import subprocess
import threading
import zlib

from program import Suite

suite = Suite()


def png(name, size, texel):
    rows = b"".join(b"\0" + b"".join(bytes(texel(x, y)) for x in range(size)) for y in range(size))
    chunk = lambda kind, data: struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    header = struct.pack(">IIBBBBB", size, size, 8, 2, 0, 0, 0)
    return suite.write(name, b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


def frame(number, texture, before=""):
    return f"""FrameBegin {number}
{before}
Display "frame.{number:02}.exr" "file" "rgb"
Format 48 48 1
PixelSamples 1 1
Projection "orthographic"
WorldBegin
LightSource "ambientlight" 1
Surface "paintedplastic" "Kd" [0] "Ks" [0] "Ka" [1] "texturename" ["{texture}"]
Translate 0 0 5
Patch "bilinear" "P" [-1 -1 0  1 -1 0  -1 1 0  1 1 0]
WorldEnd
FrameEnd
"""


def pixels(first, last):
    """Returns a hash of the pixels of each frame."""
    names = [f"frame.{n:02}.exr" for n in range(first, last + 1)]
    said = subprocess.run(["oiiotool", "--hash", "--info", "-v", *names], cwd=suite.folder, capture_output=True, text=True).stdout
    return [part.split()[0] for part in said.split("SHA-1:")[1:]]


FRAMES = 20
for t in range(4):
    png(f"{t}.png", 128, lambda x, y: ((x * (t + 1)) % 256, (y * (t + 2)) % 256, (x ^ y) % 256))
suite.write("many.rib", "".join(frame(n, f"{n % 4}.png") for n in range(1, FRAMES + 1)))
suite.expect_run("twenty textured frames", ["many.rib", "-t", "1", "--texture-memory", "1M"], 0)
whole = pixels(1, FRAMES)
suite.expect(len(set(whole)) == 4, "four textures make four different pictures")
for threads in (2, 4, 2, 4):
    suite.expect_run(f"the same with {threads} threads", ["many.rib", "-t", str(threads), "--texture-memory", "1M", "--bucket-size", "8"], 0)
    suite.expect(pixels(1, FRAMES) == whole, "has the same bits")

# Several processes want one picture at the same moment. The first one converts it, and the others wait.
noise = random.Random(1)
png("large.png", 768, lambda x, y: noise.randbytes(3))
suite.write("shared.rib", "".join(frame(n, "large.png") for n in range(1, 5)))
seen, over = set(), threading.Event()


def watch():
    """Watches that conversions are made in scratch folders of their own."""
    while not over.is_set():
        seen.update(p.name for p in (suite.folder / "textures").iterdir() if not re.fullmatch("[0-9a-f]{2}", p.name))


watcher = threading.Thread(target=watch)
watcher.start()
suite.expect_run("a batch whose frames share a picture", ["batch", "shared.rib", "-o", "shared.#.exr", "-j", "4"], 0, "finished 4 of 4")
over.set()
watcher.join()
suite.expect(len(seen) == 1, f"converts it once: {seen}")

# One name stands for two different files.
png("red.png", 64, lambda x, y: (255, 0, 0))
png("green.png", 64, lambda x, y: (0, 255, 0))
make = 'MakeTexture "{}.png" "now.tex" "periodic" "periodic" "box" 1 1'
suite.write("rewritten.rib", "".join(frame(n, "now.tex", make.format("red" if n % 2 else "green")) for n in range(1, 5)))
for threads in (1, 2):
    suite.expect_run(f"a texture that is made anew for each frame, -t {threads}", ["rewritten.rib", "-t", str(threads)], 0)
    odd, even, *later = pixels(1, 4)
    suite.expect(odd != even and later == [odd, even], "shows in each frame what it holds then")

# The folder of converted pictures is tested.
suite.expect_run("the first of many", ["many.rib", "--frames", "1"], 0)
good = pixels(1, 1)
for what, damage in (("cut off", lambda d: d[:len(d) // 2]), ("empty", lambda d: b""), ("of something else", lambda d: b"no picture" * 100),
                     ("rotten in the middle", lambda d: d[:len(d) // 2] + bytes(64) + d[len(d) // 2 + 64:]),
                     ("rotten at the end", lambda d: d[:-200] + bytes([b ^ 255 for b in d[-200:-100]]) + d[-100:])):
    for path in (suite.folder / "textures").rglob("*.tx"):
        path.write_bytes(damage(path.read_bytes()))
    suite.expect_run(f"cached textures that are {what} are made anew", ["many.rib", "--frames", "1"], 0, "damaged", "converted anew", "texture-cache")
    suite.expect(pixels(1, 1) == good, "and the picture is the same")
again = suite.expect_run("what was made anew", ["many.rib", "--frames", "1"], 0)
suite.expect("anew" not in again.stderr, "is whole after that")
suite.finish()
