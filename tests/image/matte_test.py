"""Reads Cryptomatte by a decoder written from the public specification, and compares it with deep pixels that oiiotool flattens."""
import json
import pathlib
import re
import struct
import subprocess
import sys
import tempfile

import exr
from pictures import pixels

tomales, root = str(pathlib.Path(sys.argv[1]).absolute()), pathlib.Path(sys.argv[2]).absolute()
failures = []


def check(good, what):
    print(("ok      " if good else "FAILED  ") + what)
    if not good:
        failures.append(what)


def murmur(key):
    """Returns MurmurHash3_x86_32 with seed 0."""
    mask, h = 0xFFFFFFFF, 0
    data = key.encode()
    for i in range(0, len(data), 4):
        k = int.from_bytes(data[i:i + 4], "little") * 0xCC9E2D51 & mask
        k = (k << 15 | k >> 17) & mask
        h ^= k * 0x1B873593 & mask
        if len(data) - i >= 4:
            h = (h << 13 | h >> 19) & mask
            h = (h * 5 + 0xE6546B64) & mask
    h ^= len(data)
    for shift, factor in ((16, 0x85EBCA6B), (13, 0xC2B2AE35)):
        h = (h ^ h >> shift) * factor & mask
    return h ^ h >> 16


check(murmur("hello") == 0x248BFA47 and murmur("hello, world") == 0x149BBB7F, "the decoder's hash")


def as_id(name):
    bits = murmur(name)
    if bits >> 23 & 255 in (0, 255):
        bits ^= 1 << 23
    return bits, struct.unpack("<f", struct.pack("<I", bits))[0]


def layer(path, name):
    """Returns (manifest, {(x, y): {id: coverage}}, number of ranks) of a Cryptomatte layer."""
    info = exr.texts(path)
    key = f"cryptomatte/{murmur(name):08x}"[:len("cryptomatte/") + 7]
    assert info[f"{key}/name"] == name and info[f"{key}/hash"] == "MurmurHash3_32", info
    assert info[f"{key}/conversion"] == "uint32_to_float32"
    manifest = json.loads(info[f"{key}/manifest"])
    channels = [f"{name}{rank // 2:02d}.{c}" for rank in range(0, 6, 2) for c in "RGBA"]
    found = {}
    for at, p in exr.read(path, channels)[1].items():
        found[at] = {p[i]: p[i + 1] for i in range(0, 12, 2) if p[i + 1] > 0}
        coverage = [p[i] for i in range(1, 12, 2)]
        assert coverage == sorted(coverage, reverse=True), "ranks are not in order"
    return manifest, found


def render(folder, *options):
    subprocess.run([tomales, "render", str(root / "scenes/displays/matte.rib"), "-q", *options], check=True, cwd=folder)


with tempfile.TemporaryDirectory() as name:
    folder = pathlib.Path(name)
    render(folder)
    alpha = {at: p[3] for at, p in pixels(folder / "matte.exr").items()}
    manifest, mattes = layer(folder / "matte.exr", "CryptoObject")
    check(manifest == {n: f"{as_id(n)[0]:08x}" for n in ("ball", "glass", 'a "floor"')}, f"manifest {manifest}")
    worst = max(abs(sum(mattes[at].values()) - alpha[at]) for at in alpha)
    check(worst < 1e-5, f"mattes add up to alpha within {worst:.1e}")
    known = {as_id(n)[1] for n in manifest}
    check(all(i in known for p in mattes.values() for i in p), "every id is in the manifest")
    check(abs(mattes[235, 140].get(as_id("glass")[1], 0) - 0.75) < 1e-5, "two walls of glass cover three quarters of what they are before")
    check(abs(mattes[120, 120].get(as_id("ball")[1], 0) - 1) < 1e-5, "the ball covers all of its middle")
    materials, shades = layer(folder / "matte.exr", "CryptoMaterial")
    check(set(materials) == {"paint", "plastic", "matte"}, f"materials {sorted(materials)}")
    check(max(abs(sum(shades[at].values()) - alpha[at]) for at in alpha) < 1e-5, "materials add up to alpha")

    subprocess.run(["oiiotool", str(folder / "deep.exr"), "--flatten", "--ch", "R,G,B,A", "-o", str(folder / "flat.exr")], check=True)
    flat, picture = pixels(folder / "flat.exr"), pixels(folder / "matte.exr")
    worst = max(abs(a - b) for at in flat for a, b in zip(flat[at], picture[at][:4]))
    check(worst < 2e-5, f"the flattened deep picture is the picture within {worst:.1e}")
    whole_deep = subprocess.run(["oiiotool", "--dumpdata", str(folder / "deep.exr")], capture_output=True, text=True).stdout
    whole_picture = picture

    render(folder, "--crop", "0.25,0.75,0.5,1", "--overwrite", "--bucket-size", "40", "-t", "1")
    crop = pixels(folder / "matte.exr")
    inside = [(x, y) for x in range(80, 240) for y in range(120, 240)]
    check(all(crop[at] == whole_picture[at] for at in inside), "mattes in a crop window, large buckets and one thread are the same bits")

    def deep_pixels(text):
        return {(int(m[1]), int(m[2])): m[3] for m in re.finditer(r"Pixel \((\d+), (\d+)\): *(.*)", text)}

    whole = deep_pixels(whole_deep)
    part = deep_pixels(subprocess.run(["oiiotool", "--dumpdata", str(folder / "deep.exr")], capture_output=True, text=True).stdout)
    same = sum(1 for at in inside if at in part and part[at].split() == whole.get(at, "").split())
    check(same == len(inside) and len(part) == len(inside), f"deep pixels in a crop window: {same} of {len(inside)} the same")
sys.exit(bool(failures))
