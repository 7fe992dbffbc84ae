"""Tests that frames that are made row by row, or are kept in a file, have the bits of frames in memory. Memory must not grow with their area."""
import json

from program import Suite

SCENE = """Display "picture.exr" "openexr" "rgba"
Display "+deep.exr" "deepexr" "rgba"
Display "+names.exr" "openexr" "cryptoobject"
DisplayChannel "color direct" "string source" ["lightgroup:key"]
DisplayChannel "normal N" "string filter" ["catmull-rom"] "float[2] filterwidth" [6 6]
Display "+more.exr" "openexr" "direct,N,z"
Option "bucket" "string order" ["%s"]
Option "limits" "int[2] bucketsize" [%s]
Format 70 50 1
PixelSamples 2 2
PixelFilter "%s" 3 3
Projection "perspective" "fov" [40]
Translate 0 0 5
WorldBegin
LightSource "distantlight" "key" "string __group" ["key"] "from" [1 3 -3] "to" [0 0 0]
%s
Surface "matte"
Attribute "identifier" "name" ["floor"]
Polygon "P" [-4 -1 -4 -4 -1 4 4 -1 4 4 -1 -4]
Attribute "identifier" "name" ["glass"]
Opacity [0.4 0.5 0.6]
ShadingInterpolation "smooth"
Sphere 1 -1 1 360
WorldEnd
"""
INDIRECT = 'LightSource "indirectlight" "gi" "float samples" [32]'
FILES = ("picture.exr", "more.exr", "names.exr", "deep.exr")
suite = Suite()


def pictures():
    return [(suite.folder / name).read_bytes() for name in FILES]


for light in ("", INDIRECT):
    kind = "a frame with indirect light" if light else "a frame"
    suite.write("scene.rib", SCENE % ("horizontal", "16 16", "gaussian", light))
    suite.expect_run(f"{kind} in memory", ["scene.rib", "-v"], 0)
    whole = pictures()
    for order, size in (("horizontal", "16 16"), ("vertical", "7 5"), ("spacefill", "9 16"), ("spiral", "16 11"), ("random", "16 16")):
        suite.write("scene.rib", SCENE % (order, size, "gaussian", light))
        says = "buckets rested in a file" if light else "made row by row"
        suite.expect_run(f"{kind}, {order}, with little memory", ["scene.rib", "--memory-limit", "1K", "-v", "-t", "3"], 0, says)
        suite.expect(pictures() == whole, f"has the same bits in buckets {size}, {order}")
    suite.expect(not [f for f in suite.folder.iterdir() if ".part" in f.name], "no file is left behind")

# A picture four times as wide and high takes little more memory.
suite.write("large.rib", SCENE[SCENE.index("Option"):].replace("Format 70 50 1\nPixelSamples 2 2", "PixelSamples 1 1") % ("horizontal", "16 16", "gaussian", ""))


def peak(size):
    suite.expect_run(f"a frame of {size}", ["large.rib", "-o", "large.exr", "--format", size, "--memory-limit", "1M", "--stats", "s.json", "-t", "2"], 0)
    return json.loads((suite.folder / "s.json").read_text())["memory_bytes"]["peak_rss"] / 1e6


suite.expect_run("what cannot be kept is said", ["large.rib", "-o", "large.exr", "--memory-limit", "1M"], 0, "cannot be kept", "geometry took")
suite.expect_run("what can be is not", ["large.rib", "-o", "large.exr", "--memory-limit", "1G", "-v"], 0, "textures get 268 MB at most")
small, large = peak("400x400"), peak("1600x1600")
print(f"        {small:.0f} MB, {large:.0f} MB")
suite.expect(large < small + 60, "sixteen times the area takes less than 60 MB more")
ballast = b"x" * 300_000_000
suite.expect(peak("400x400") < small + 60, f"what the starting program has in memory ({len(ballast)} bytes) does not count")


def grids(primvar):
    suite.write("grids.rib", f'Format 300 300 1\nWorldBegin\nPatch "bilinear" "P" [-1 -1 1 1 -1 1 -1 1 1 1 1 1] {primvar}\nWorldEnd\n')
    suite.expect_run(f"a patch {primvar}", ["grids.rib", "-o", "grids.exr", "--stats", "s.json", "-t", "1"], 0)
    return json.loads((suite.folder / "s.json").read_text())["memory_bytes"]["grids"]


suite.expect(grids('"varying float wear" [1 2 3 4]') < 1.3 * grids(""), "a number more at each vertex, which has a dozen, takes a grid less than a third more")
suite.finish()
