"""Tests bad scenes: each gives the right exit code and a message with file:line, and never a crash or a hang."""
import os
import random

from program import GOOD, Suite

t = Suite()
WORLD = 'Display "out.exr" "file" "rgba"\nFormat 16 16 1\nTranslate 0 0 4\nWorldBegin\n%s\nWorldEnd\n'

# There is nothing to read: exit 2.
t.write("empty.rib", "")
t.expect_run("an empty file", ["empty.rib"], 2, "empty.rib")
t.expect_run("a file that is not there", ["absent.rib"], 2, "absent.rib")
t.expect_run("a folder", ["."], 2)
t.write("prose.rib", "Dear renderer,\nthis is not a scene.\n")
t.expect_run("prose", ["prose.rib"], 2, "prose.rib")
t.write("options.rib", "Format 16 16 1\n")
t.expect_run("options without a world", ["options.rib"], 2, "options.rib")
t.write("cut.rib.gz", b"\x1f\x8b\x08\x00\x00\x00\x00\x00")
(t.folder / "folder.rib").mkdir()
(t.folder / "loop.rib").symlink_to("loop.rib")
t.expect_run("a folder", ["folder.rib"], 2, "folder.rib: error: the file cannot be opened: it is a folder")
t.expect_run("a link to itself", ["catrib", "loop.rib"], 2, "loop.rib: error: the file cannot be opened: ")
t.expect_run("a gzip header and nothing more", ["cut.rib.gz"], 2, "cut.rib.gz")

# Junk and truncated files end in some documented exit code.
random.seed(1)
for i in range(6):
    t.write("junk.rib", random.randbytes(4000) if i % 2 else GOOD.encode() + random.randbytes(2000))
    t.expect(t.run("junk.rib", "-q").returncode in (0, 2, 3), f"random bytes, number {i + 1}")
for end in range(0, len(GOOD), 23):
    t.write("cut.rib", GOOD[:end])
    t.expect(t.run("cut.rib", "-q").returncode in (0, 2, 3), f"a scene cut after {end} bytes")

# Errors inside a scene are repaired and reported with their line.
t.write("request.rib", WORLD % "Spheer 1 -1 1 360\nSphere 1 -1 1 360")
result = t.run("request.rib")
t.expect("request.rib:5" in result.stderr and "Spheer" in result.stderr, "an unknown request is named with its line")
t.expect((t.folder / "out.exr").exists(), "and the rest of the scene is rendered")
t.write("hider.rib", 'Hider "painter"\n' + WORLD % "Sphere 1 -1 1 360")
t.expect_run("an unknown hider is told of, and which one is used", ["hider.rib"], 0, 'rendered as by "hidden"')
t.write("filter.rib", 'PixelFilter "blurry" 2 2\n' + WORLD % "Sphere 1 -1 1 360")
t.expect(t.run("filter.rib").returncode == 0, "an unknown filter does not stop a frame")

# Values that are too high are limited.
t.write("bound.rib", WORLD % 'Attribute "displacementbound" "float sphere" [1e9]\nSphere 1 -1 1 360')
t.expect_run("a huge displacement bound", ["bound.rib"], 0)
t.write("samples.rib", WORLD % 'LightSource "indirectlight" 1 "float samples" [1e9]\nLightSource "distantlight" 2\nSphere .1 -.1 .1 360')
t.expect_run("a thousand million rays", ["samples.rib"], 0, "samples.rib:5", "65536 is used")

# Messages about what was repaired name it.
t.write("filter.rib", 'PixelFilter "box" 0.5 40\n' + GOOD)
said = t.expect_run("widths of filters that are not used are reported", ["filter.rib"], 0, "filter.rib:1", "0.5 is out of range, 1 is used", "40 is out of range, 32 is used")
t.write("grid.rib", 'Option "limits" "gridsize" [0]\n' + GOOD)
t.expect_run("an option out of range is named", ["grid.rib"], 0, 'grid.rib:1', '"limits": 0 is out of range')
t.write("times.rib", WORLD % "MotionBegin [1 0]\nTranslate 0 0 0\nTranslate 1 0 0\nMotionEnd\nSphere 1 -1 1 360")
t.expect(t.run("times.rib").stderr.count("[rib-motion]") == 1, "times that do not increase are one message")
t.write("once.rib", WORLD % "MotionBegin [0]\nTranslate 0 0 0\nTranslate 1 0 0\nMotionEnd\nSphere 1 -1 1 360")
t.expect_run("more requests than times", ["once.rib"], 0, "1 time, but more requests")
t.write("channel.rib", 'DisplayChannel "float[100000000] d"\n' + GOOD)
t.expect_run("a channel of too many numbers is no declaration", ["channel.rib"], 0, "channel.rib:1", '"float[100000000] d" is no declaration of a channel; ignored')
t.write("long.rib", 'Surface "' + "a" * 3000000 + '"\n' + GOOD)
t.expect_run("after a string that is too long the file is read on", ["long.rib"], 0, "long.rib:1", "a string that is too long")
t.write("bright.rib", GOOD.replace("Surface", "Color [1e38 1e38 1e38]\nExposure 1e30 1\nSurface"))
t.expect("nan" not in t.run("bright.rib").stderr, "infinite light has no uncertain share")

# Nothing is visible: the frame is what the scene asks for, but hardly what its author wanted.
for what, change, says in (("behind the camera", ("0 0 4", "0 0 -4"), "behind the camera"),
                           ("beyond the far plane", ("Translate", "Clipping 0.1 2\nTranslate"), "far clipping plane"),
                           ("out of view", ("0 0 4", "9 0 4"), "outside the view"), ("hidden", ("matte", "null"), "is hidden"),
                           ("not there", ("Sphere", "#"), "no geometry")):
    t.write("empty.rib", GOOD.replace(*change))
    t.expect_run("a scene whose geometry is " + what, ["empty.rib"], 3, "nothing is visible", says)
t.write("good.rib", GOOD)
for verb, output in (("render", "sliver.exr"), ("hide", "sliver.dfb")):
    t.expect_run(f"a crop between two pixels, {verb}", [verb, "good.rib", "--format", "24x20", "--crop", "0,1,0.801,0.814", "-o", output], 3,
                 "CropWindow 0 1 0.801 0.814 holds none of the 24 x 20 pixels")
    t.expect(not (t.folder / output).exists(), "has no picture")
result = t.expect_run("a crop without anything in it", ["good.rib", "--crop", "0,0.1,0,0.1"], 0)
t.expect("nothing" not in result.stderr, "is no reason for a warning")

# Methods warn at their limits.
ROOM = 'Translate %s %s 0\nSurface "matte"\nLightSource "indirectlight" 1 "float samples" [%d]\nLightSource "pointlight" 2 "point from" [1 1 -3]\n' \
       'Sphere 1 -1 1 360\nSphere 9 -9 9 360\n'  # A ball lies in a hollow ball.
def room(away, samples):
    return (WORLD % (ROOM % (away, away, samples))).replace("WorldBegin", f"Translate {-away} {-away} 0\nWorldBegin")
for what, away, samples, says in (("far from the origin", 1000000, 256, "float-range"), ("with few rays", 0, 3, "gather-noise")):
    t.write("limit.rib", room(away, samples))
    t.expect_run("a scene " + what, ["limit.rib", "-o", "limit.exr", "--format", "64x64"], 0, says)
t.write("limit.rib", room(1000, 256))
t.expect(not t.run("limit.rib", "-o", "limit.exr", "--format", "64x64").stderr, "a scene near the origin and with rays enough is no reason for a warning")

# Something is missing: the frame is complete, and the exit code is 3.
t.write("archive.rib", WORLD % 'Sphere 1 -1 1 360\nReadArchive "nowhere.rib"')
t.expect_run("a missing archive", ["archive.rib"], 3, "archive.rib:6", "nowhere.rib")
t.write("shader.rib", WORLD % 'Surface "unobtainium"\nSphere 1 -1 1 360')
t.expect_run("a missing shader", ["shader.rib"], 3, "shader.rib:5", "unobtainium")
t.write("light.rib", WORLD % 'LightSource "nolight" 1\nSphere 1 -1 1 360')
t.expect_run("a missing light shader", ["light.rib"], 3, "light.rib:5", "nolight")

# Output cannot be written: exit 4, before hours are spent on it.
nowhere = str(t.folder / "no" / "where")  # Relative folders are made.
t.expect_run("-o into a folder that does not exist", ["good.rib", "-o", nowhere + "/a.exr"], 4, "no/where/a.exr")
t.expect_run("-o into what is no folder", ["good.rib", "-o", "good.rib/a.exr"], 4, "good.rib/a.exr")
t.write("display.rib", GOOD.replace("good.exr", nowhere + "/b.exr"))
t.expect_run("a Display in a folder that does not exist", ["display.rib"], 4, "display.rib:1", "no/where/b.exr")
os.mkdir(t.folder / "taken.exr")
t.expect_run("-o onto a folder", ["good.rib", "-o", "taken.exr"], 4, "taken.exr")
t.expect_run("--stats into a folder that does not exist", ["good.rib", "--stats", "no/where.json"], 4, "no/where.json")
t.expect(not [f for f in os.listdir(t.folder) if f.endswith(".part")], "no temporary file is left behind")

# Plugins and pictures have the wrong contents.
t.write("fake.so", "not a library")
t.expect_run("a plugin that is no library", ["info", "fake.so"], 2, "fake.so")
t.write("fake.exr", "not a picture")
t.expect_run("a picture that is none", ["info", "fake.exr"], 2, "fake.exr")
t.expect_run("comparing with a picture that is none", ["compare", "fake.exr", "fake.exr"], 2, "fake.exr")
t.expect_run("a map of depth", [t.write("depth.rib", 'Display "depth.z" "zfile" "z"\nFormat 8 8 1\nWorldBegin\nTranslate 0 0 3\nSphere 1 -1 1 360\nWorldEnd\n')], 0)
t.expect_run("is nothing to compare by colour", ["compare", "depth.z", "depth.z"], 2, "depth.z", "has no colours to compare, but Z", "[image-size]")
t.finish()
