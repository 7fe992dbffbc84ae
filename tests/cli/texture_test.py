"""Tests pictures on surfaces: they are filtered where they are small, RIB requests make them, and broken ones have a conspicuous
substitute."""
import json
import struct
import subprocess
import zlib

from program import Suite

suite = Suite()


def png(name, size, texel):
    rows = b"".join(b"\0" + b"".join(bytes(texel(x, y)) for x in range(size)) for y in range(size))
    chunk = lambda kind, data: struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    header = struct.pack(">IIBBBBB", size, size, 8, 2, 0, 0, 0)
    return suite.write(name, b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


def scene(name, texture, before="", coordinates="", surface=None):
    surface = surface or f'Surface "paintedplastic" "Kd" [0] "Ks" [0] "Ka" [1] "texturename" ["{texture}"]'
    return suite.write(name + ".rib", f"""{before}
Display "{name}.exr" "file" "rgba"
Format 32 32 1
Projection "orthographic"
WorldBegin
LightSource "ambientlight" 1
{surface}
Translate 0 0 5
Patch "bilinear" "P" [-2 -2 0  2 -2 0  -2 2 0  2 2 0] {coordinates}
WorldEnd
""")


def red(name):
    info = json.loads(suite.run("info", "--json", name + ".exr").stdout)
    return next(c for c in info["channels"] if c["name"] == "R")


grain = png("grain.png", 512, lambda x, y: (255 * ((x + y) % 2),) * 3)
suite.expect_run("a fine checker renders", [scene("st", "grain.png")], 0)
suite.expect(abs(red("st")["mean"] - 0.5) < 0.01 and red("st")["max"] - red("st")["min"] < 0.05,
             "texels finer than pixels are averaged by the standard s and t")
suite.expect_run("and by primitive variables", [scene("own", "grain.png", coordinates='"st" [0.1 0.2  0.9 0.1  0.2 0.8  0.8 0.9]')], 0)
suite.expect(red("own")["max"] - red("own")["min"] < 0.05, "texels are averaged by s and t of the primitive")
suite.expect(len(list((suite.folder / "textures").rglob("*.tx"))) == 1, "one conversion serves both")

suite.expect_run("MakeTexture makes what a later world reads",
                 [scene("made", "made.tex", 'MakeTexture "grain.png" "made.tex" "periodic" "periodic" "box" 1 1')], 0)
suite.expect((suite.folder / "made.tex").exists(), "the file is there under its own name")
suite.expect_run("a picture that is not there cannot be made into a texture",
                 [scene("none", "grain.png", 'MakeTexture "absent.png" "b.tex" "black" "black" "box" 1 1')], 3, "MakeTexture", "absent.png")
subprocess.run(["oiiotool", "grain.png", "--attrib", "wrapmodes", "periodic,clamp", "-o", "grain.tif"], cwd=suite.folder, check=True)
suite.expect_run("a picture that wraps by what its file says", [scene("wrapping", "grain.tif", coordinates='"st" [3.1 0.2  3.9 0.1  3.2 0.8  3.8 0.9]')], 0)
suite.expect_run("and one whose file says nothing", [scene("ending", "grain.png", coordinates='"st" [3.1 0.2  3.9 0.1  3.2 0.8  3.8 0.9]')], 0)
suite.expect(abs(red("wrapping")["mean"] - red("own")["mean"]) < 0.01 and red("ending")["max"] == 0, "goes on beyond its edge, where the other is black")
subprocess.run(["oiiotool", "--pattern", "constant:color=0.5", "32x32", "1", "-o", "grey.tif"], cwd=suite.folder, check=True)
suite.expect_run("a picture of one channel", [scene("grey", "grey.tif")], 0)
means = [c["mean"] for c in json.loads(suite.run("info", "--json", "grey.exr").stdout)["channels"] if c["name"] in "RGB"]
suite.expect(len(means) == 3 and all(abs(m - 0.5) < 0.01 for m in means), f"is grey where a colour is asked for: {means}")
suite.expect_run("six faces make an environment", [scene("cube", "cube.env", 'MakeCubeFaceEnvironment '
                 + '"grain.png" ' * 6 + '"cube.env" 90 "box" 1 1')], 0)
suite.expect_run("a wrong filter and wrap mode are named",
                 [scene("odd", "o.tex", 'MakeTexture "grain.png" "o.tex" "round" "black" "star" 1 1')], 0, '"round"', '"star"')

suite.expect_run("folders are made, and a parameter that there is not is named",
                 [scene("deep", "maps/of/grain.tex", 'MakeTexture "grain.png" "maps/of/grain.tex" "black" "black" "box" 1 1 "string shape" "round"')],
                 0, '"shape"')

suite.run("st.rib", "-o", "st.tif")
for whole in ("grain.png", "st.tif", "st.exr", "made.tex"):
    data = (suite.folder / whole).read_bytes()
    suite.write("cut" + whole, data[:len(data) // 2])
    suite.expect_run(f"half of {whole} is loud and says where", [scene("cut", "cut" + whole)], 3, "cut" + whole, "cut.rib:7", "magenta")
suite.expect_run("a missing one too", [scene("absent", "absent.png")], 3, "absent.png", "absent.rib:7", "magenta")

# Filters that are flat or very long. OpenImageIO aborts where they have blur.
png("ramp.png", 64, lambda x, y: (4 * x,) * 3)
for k, (at, wanted) in enumerate((("s, s", 0.5), ("s, s + t * 1e-6", 0.5), ("s, 0.5 + (s - t) * 1e-3", 0.5), ("s * 1e12, t", None), ("s * 1e25, t * 1e25", None),
                                  ("s * 1e-20, s * 1e20", None))):
    for widths in ('"blur", 0.02', '"blur", 0.02, "swidth", 0', '"width", 1'):
        suite.write(f"flat{k}.sl", f'surface flat{k}() {{ Ci = float texture("ramp.png", {at}, {widths}); Oi = 1; }}')
        suite.expect_run(f"texture at {at} with {widths}", [scene(f"flat{k}", "", surface=f'Surface "flat{k}"')], 0)
        mean = red(f"flat{k}")["mean"]
        suite.expect(0 <= mean <= 1 if wanted is None else abs(mean - wanted) < 0.04, f"has a mean that makes sense: {mean}")

suite.expect_run("little memory changes no picture", ["--texture-memory", "1M", scene("small", "grain.png")], 0)
suite.expect(red("small") == red("st"), "the same texels")
suite.finish()
