"""Tests converted textures: the same picture must make the same bytes, and the next conversion must remove what a killed one leaves."""
import signal
import subprocess
import time
import zlib
import struct

from program import Suite

t = Suite()


def png(name, width, height, seed=1):
    rows = b"".join(b"\0" + bytes((x * y * 7 + x * seed + c * 50) % 256 for x in range(width) for c in range(3)) for y in range(height))
    chunk = lambda kind, data: struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    header = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    return t.write(name, b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows, 1)) + chunk(b"IEND", b""))


def scene(texture):
    return t.write("scene.rib", f"""Display "o.exr" "file" "rgba"
Format 8 8 1
Projection "orthographic"
WorldBegin
Surface "paintedplastic" "Kd" [0] "Ks" [0] "Ka" [1] "texturename" ["{texture}"]
LightSource "ambientlight" 1
Translate 0 0 5
Patch "bilinear" "P" [-1 -1 0  1 -1 0  -1 1 0  1 1 0]
WorldEnd
""")


def files(folder):
    return {p.relative_to(t.folder / folder).as_posix(): p.read_bytes() for p in (t.folder / folder).rglob("*") if p.is_file()}


png("odd.png", 117, 83)
t.run(scene("odd.png"), "--texture-cache", "first", "-t", "2")
time.sleep(1.1)  # Time stamps have whole seconds.
for k in range(3):
    t.run("scene.rib", "--texture-cache", f"again{k}", "-t", "2")
    t.expect(len(files("first")) == 1 and files("first") == files(f"again{k}"), "a picture converted again has the same bytes")
for target in ("made.tx", "made.exr"):
    t.write("make.rib", f'MakeTexture "odd.png" "a_{target}" "periodic" "black" "gaussian" 1 1\nMakeTexture "odd.png" "b_{target}" "periodic" "black" "gaussian" 1 1\n')
    t.run("make.rib")
    first = (t.folder / f"a_{target}").read_bytes()
    time.sleep(1.1)
    t.run("make.rib")
    t.expect(first == (t.folder / f"a_{target}").read_bytes() == (t.folder / f"b_{target}").read_bytes(), f"MakeTexture makes the same bytes ({target})")

png("large.png", 3000, 2500)
scene("large.png")


def unfinished():
    return [p for p in (t.folder / "killed").rglob("*") if ".part" in p.name]


for attempt in range(5):
    process = subprocess.Popen([t.program, "scene.rib", "--texture-cache", "killed", "-t", "2"], cwd=t.folder, stderr=subprocess.DEVNULL)
    while not unfinished() and process.poll() is None:
        time.sleep(0.005)
    process.send_signal(signal.SIGKILL)
    process.wait()
    if unfinished():
        break
t.expect(unfinished(), "a conversion that is killed leaves something")
t.run(scene("odd.png"), "--texture-cache", "killed")
t.expect(not unfinished(), f"which the next conversion of any other picture removes ({unfinished()})")
t.finish()
