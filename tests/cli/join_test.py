"""Tests that joined tiles of one frame are the file that one run writes, and that tiles of different frames are refused."""
import itertools
import subprocess

from program import Suite

SCENE = """Display "scene.exr" "file" "rgbaz" "string exrpixeltype" ["%s"] %s
Display "+deep.exr" "deepexr" "rgbaz"
Format 70 90 1
PixelSamples 2 2
Projection "perspective" "fov" [40]
Translate 0 0 4.5
WorldBegin
LightSource "pointlight" "key" "from" [2 3 -3] "intensity" [12] "string shadowname" ["raytrace"]
%s
Attribute "identifier" "name" ["ball"]
Surface "plastic"
Sphere 1 -1 1 360
Attribute "identifier" "name" ["floor"]
Surface "matte"
Color [0.5 0.7 0.5]
Polygon "P" [-4 -1 -4 -4 -1 4 4 -1 4 4 -1 -4]
WorldEnd
"""
DIRECT = SCENE % ("half", "", "")
INDIRECT = SCENE % ("float", '"string compression" ["piz"]', 'LightSource "indirectlight" "gi" "float samples" [32]')
CROPS = [f"{x0},{x1},{y0},{y1}" for (y0, y1), (x0, x1) in itertools.product(((0, 0.3), (0.3, 1)), ((0, 0.41), (0.41, 1)))]
t = Suite()


def content(name):
    return (t.folder / name).read_bytes()


def tiles(command, crops=CROPS, prefix="tile"):
    for i, crop in enumerate(crops):
        t.expect(t.run(*command, "-o", f"{prefix}{i}.exr", "--crop", crop, "-q").returncode == 0, f"{prefix}{i} is made")
    return [f"{prefix}{i}.exr" for i in range(len(crops))]


t.write("direct.rib", DIRECT)
t.run("render", "direct.rib", "-o", "whole.exr", "-q")
made = tiles(["render", "direct.rib"])
t.expect_run("tiles are joined", ["join", *reversed(made), "-o", "joined.exr"], 0)
t.expect(content("joined.exr") == content("whole.exr"), "to the bytes that one run writes")
t.expect_run("deep tiles are joined", ["join", *(m.replace(".exr", "_deep.exr") for m in made), "-o", "joined_deep.exr"], 0)
t.expect(content("joined_deep.exr") == content("whole_deep.exr"), "to the bytes that one run writes")
t.expect(t.run("render", "direct.rib", "-o", "joined.exr", "--skip-finished").stderr.count("is finished") == 1, "and are known as finished")
for end in ("", "_deep"):
    t.write(f"part{end}.exr", content(f"tile0{end}.exr"))
t.expect(t.run("render", "direct.rib", "-o", "part.exr", "--skip-finished").stderr.count("is finished") == 0, "which a tile is not")

# The picture has several parts and Cryptomatte.
t.write("parts.rib", 'Display "parts.exr" "openexr" "rgba" "int multipart" [1]\nDisplay "+id.exr" "openexr" "cryptoobject"\n'
        + "\n".join(DIRECT.splitlines()[2:]) + "\n")
t.run("render", "parts.rib", "-o", "parts.exr", "-q")
made_parts = tiles(["render", "parts.rib"], prefix="p")
for end in ("", "_id"):
    t.expect_run("pictures of objects and parts are joined", ["join", *(m.replace(".exr", end + ".exr") for m in made_parts), "-o", "parts_joined.exr"], 0)
    t.expect(content("parts_joined.exr") == content(f"parts{end}.exr"), f"parts{end}.exr: to the bytes that one run writes")

# These are tiles of a shot: indirect light has no seams, and other compressions and tiled files keep their form.
t.write("indirect.rib", INDIRECT)
t.run("hide", "indirect.rib", "-o", "shot.dfb", "-q")
t.run("gather", "shot.dfb", "-o", "shot.icf", "-q")
shade = ["shade", "shot.dfb", "--irradiance", "shot.icf"]
t.run(*shade, "-o", "shot.exr", "-q")
shaded = tiles(shade, prefix="s")
t.expect_run("tiles of a shot are joined", ["join", *shaded, "-o", "shot_joined.exr"], 0)
t.expect(content("shot_joined.exr") == content("shot.exr"), "to the bytes that one run writes")
t.run("hide", "indirect.rib", "-o", "told.dfb", "-q", "--stats-header")
t.expect(content("told.dfb") == content("shot.dfb"), "a shot has no room for statistics, so it stays the same")
told = tiles([*shade, "--stats-header"], prefix="t")
t.expect(all(b"tomales:statistics" in content(name) for name in told), "tiles have statistics in their headers")
t.expect_run("which differ, and tiles are joined nevertheless", ["join", *told, "-o", "told.exr"], 0)
t.expect(content("told.exr") == content("shot.exr"), "to a picture without statistics, because none are those of the frame")
overlapping = tiles(shade, ["0,0.7,0,0.6", "0.3,1,0,0.6", "0,1,0.5,1"], prefix="o")
t.run("join", *overlapping, "-o", "overlapping.exr")
t.expect(content("overlapping.exr") == content("shot.exr"), "tiles may overlap where they agree")
t.run(*shade, "-o", "window.exr", "--crop", "0,0.41,0,1", "-q")
t.expect_run("a frame may have a window of its own", ["join", "s0.exr", "s2.exr", "--crop", "0,0.41,0,1", "-o", "half.exr"], 0)
t.expect(content("half.exr") == content("window.exr"), "and is joined to that")

# These tiles do not belong together.
seamed = tiles(["render", "indirect.rib"], CROPS[:2] + ["0,1,0.3,1"], prefix="g")
t.expect_run("tiles that gathered for themselves", ["join", *seamed, "-o", "no.exr"], 2, "gathered light for its own window", "hide, gather and shade")
t.expect_run("a tile is missing", ["join", *made[:3], "-o", "no.exr"], 2, "no tile has the pixel 29,28")
t.run("render", "direct.rib", "-o", "other.exr", "--crop", CROPS[3], "-q", "--light-samples", "3")
t.expect_run("other settings", ["join", *made[:3], "other.exr", "-o", "no.exr"], 2, '"other.exr" is no tile of the frame of "tile0.exr"', "different settings")
t.run("render", "direct.rib", "-o", "other.exr", "--crop", CROPS[3], "-q", "--format", "80x90")
t.expect_run("another size", ["join", *made[:3], "other.exr", "-o", "no.exr"], 2, "different sizes")
t.write("moved.rib", INDIRECT.replace("[2 3 -3]", "[2 3 -2]"))
t.run("hide", "moved.rib", "-o", "moved.dfb", "-q")
t.run("gather", "moved.dfb", "-o", "moved.icf", "-q")
for what, shot, cache in (("another shot", "moved.dfb", "moved.icf"), ("another cache", "shot.dfb", "moved.icf")):
    t.run("shade", shot, "--irradiance", cache, "-o", "other.exr", "--crop", CROPS[3], "-q")
    t.expect_run(what, ["join", *shaded[:3], "other.exr", "-o", "no.exr"], 2, "different shots, caches or edits" if what == "another cache" else "no tile")
subprocess.run(["oiiotool", "o1.exr", "--addc", "0.5,0.5,0.5,0,0", "-o", "o1.exr"], cwd=t.folder, check=True)
t.expect_run("a tile from another program", ["join", *overlapping, "-o", "no.exr"], 2, "o1.exr")
t.write("cut.exr", content("tile3.exr")[:-400])
t.expect_run("a tile that is cut off", ["join", *made[:3], "cut.exr", "-o", "no.exr"], 2, "cut.exr")
t.expect_run("no picture", ["join", "direct.rib", "-o", "no.exr"], 2, "cannot be read as an OpenEXR picture")
t.expect_run("a tile as output", ["join", *made, "-o", "tile0.exr"], 4, "is one of the tiles")
t.expect_run("a folder that is missing", ["join", *made, "-o", "nowhere/a.exr"], 4, "could not be written")
t.expect(not (t.folder / "no.exr").exists() and not list(t.folder.glob(".*part")), "what is refused leaves no file")
t.finish()
