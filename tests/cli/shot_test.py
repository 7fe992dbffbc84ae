"""Tests that a picture in steps (hide, gather, shade) is the picture of one process, bit for bit. It also tests damaged files, full disks and killed
runs."""
import json
import pathlib
import random
import resource
import signal
import subprocess
import sys
import time

from program import Suite

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "image"))
from pictures import pixels  # noqa: E402

SCENE = """Display "scene.exr" "file" "rgba"
Format 48 40 1
PixelSamples 2 2
Projection "perspective" "fov" [40]
Translate 0 0 4.5
WorldBegin
LightSource "pointlight" "key" "from" [2 3 -3] "intensity" [12] "string shadowname" ["raytrace"]
LightSource "ambientlight" "fill" "intensity" [0.05]
%s
AttributeBegin
AttributeBegin
Translate 0 1.4 0
Rotate 90 1 0 0
AreaLightSource "arealight" "lamp" "float intensity" [3] "float samples" [4]
Scale 0.4 0.4 1
Polygon "P" [-1 -1 0 -1 1 0 1 1 0 1 -1 0]
AttributeEnd
Illuminate "lamp" 1
Attribute "identifier" "name" ["ball"]
Surface "plastic" "Ks" [0.4] "roughness" [0.2]
Color [0.9 0.3 0.2]
Displacement "noisybump" "float Km" [0.05] "float frequency" [3]
Attribute "displacementbound" "sphere" [0.1]
Sphere 1 -1 1 360
Attribute "identifier" "name" ["floor"]
Surface "matte"
Color [0.5 0.7 0.5]
Polygon "P" [-4 -1 -4 -4 -1 4 4 -1 4 4 -1 -4]
Opacity [0.4 0.5 0.6]
Attribute "identifier" "name" ["glass"]
ShadingInterpolation "smooth"
MotionBegin [0 1]
Translate 0.8 0.5 -1
Translate 1 0.6 -1
MotionEnd
Sphere 0.4 -0.4 0.4 360
AttributeEnd
WorldEnd
"""
DIRECT = "Shutter 0 1\n" + SCENE % ""
INDIRECT = SCENE % 'LightSource "indirectlight" "gi" "float samples" [48]'
OCCLUDED = SCENE % 'LightSource "occlusionlight" "sky" "float samples" [64] "float maxvariation" [0.1]'
suite = Suite()


def same(a, b):
    figures = json.loads(suite.run("compare", a, b, "--json").stdout or "{}")
    return figures.get("different_pixels") == 0 and figures.get("max_error") == 0


def rays(stats):
    return sum(json.loads((suite.folder / stats).read_text())["rays"].values())


def expect_same(what, a, b):
    suite.expect(same(a, b), what)


for name, text in (("direct", DIRECT), ("indirect", INDIRECT), ("occluded", OCCLUDED)):
    suite.write(f"{name}.rib", text)
    suite.run("render", f"{name}.rib", "-o", f"{name}.exr", "-q")
    suite.expect_run(f"{name}: hide", ["hide", f"{name}.rib", "-o", f"{name}.dfb", "-t", "2", "--bucket-size", "11"], 0)
    suite.expect_run(f"{name}: shade", ["shade", f"{name}.dfb", "-o", f"{name}.shaded.exr"], 0)
    expect_same(f"{name}: hide and shade give the bits of render", f"{name}.exr", f"{name}.shaded.exr")
    suite.expect_run(f"{name}: gather", ["gather", f"{name}.dfb", "-o", f"{name}.icf"], 0)
    suite.expect_run(f"{name}: shade with the cache",
                     ["shade", f"{name}.dfb", "--irradiance", f"{name}.icf", "-o", f"{name}.cached.exr", "--stats", "cached.json"], 0)
    expect_same(f"{name}: hide, gather and shade give the bits of render", f"{name}.exr", f"{name}.cached.exr")
    suite.expect(rays("cached.json") == 0, f"{name}: no ray is traced when the cache is given")

suite.run("hide", "indirect.rib", "-o", "one.dfb", "-t", "1", "--bucket-size", "11", "-q")
suite.run("gather", "one.dfb", "-o", "one.icf", "-t", "1", "-q")
suite.run("gather", "one.dfb", "-o", "two.icf", "-t", "2", "-q")
for one, two in (("one.dfb", "indirect.dfb"), ("one.icf", "two.icf")):
    suite.expect((suite.folder / one).read_bytes() == (suite.folder / two).read_bytes(), f"{one} has the same bytes for any number of threads")

suite.write("levels.rib", 'Attribute "trace" "int displacements" [1] "string tessellationmode" ["multiresolution"]\n' + DIRECT)
suite.run("hide", "levels.rib", "-o", "levels.dfb", "-q")
suite.run("shade", "levels.dfb", "-o", "levels.exr", "--stats", "levels.json", "-q")
suite.expect(json.loads((suite.folder / "levels.json").read_text())["geometry_cache"]["lookups"] > 0, "shading a deep frame buffer tells of the geometry cache")
suite.run("shade", "indirect.dfb", "--irradiance", "indirect.icf", "--crop", "0.25,0.75,0.5,1", "-o", "crop.exr", "--stats", "crop.json")
suite.run("render", "indirect.rib", "--crop", "0.25,0.75,0.5,1", "-o", "crop.render.exr", "-q", "--gi", "none")
window = subprocess.run(["oiiotool", "indirect.exr", "--crop", "24x20+12+20", "crop.exr", "--diff"], cwd=suite.folder, capture_output=True, text=True)
suite.expect(window.returncode == 0 and "PASS" in window.stdout, "a crop of a shot is that part of its picture " + window.stdout[-200:])

# An edit of a lighter is compared with the same change in the scene.
suite.write("edit.rib", """Attribute "identifier" "name" ["ball"]
Surface "plastic" "Ks" [0.9]
Color [0.2 0.3 0.9]
LightSource "pointlight" "key" "intensity" [30]
""")
suite.write("edited.rib", DIRECT.replace('"Ks" [0.4]', '"Ks" [0.9]').replace("Color [0.9 0.3 0.2]", "Color [0.2 0.3 0.9]")
            .replace('"intensity" [12]', '"intensity" [30]'))
suite.run("render", "edited.rib", "-o", "edited.exr", "-q")
suite.expect_run("edits of surface and light", ["shade", "direct.dfb", "--irradiance", "direct.icf", "--edit", "edit.rib", "-o",
                                                "edit.exr", "--stats", "edit.json"], 0)
expect_same("edits give the bits of an edited scene", "edited.exr", "edit.exr")
suite.expect(rays("edit.json") == 0, "edits that move nothing trace no ray")
foggy = 'Imager "background" "background" [0.1 0.2 0.3]\n' + DIRECT.replace("WorldBegin\n", 'WorldBegin\nAtmosphere "fog" "distance" [20] "background" [0.5 0.6 0.9]\n')
suite.write("foggy.rib", foggy)
suite.write("foggier.rib", foggy.replace("[20]", "[7]"))
suite.write("fog.rib", 'Atmosphere "fog" "distance" [7]\nImager "background"\n')
suite.run("hide", "foggy.rib", "-o", "foggy.dfb", "-q")
suite.run("render", "foggier.rib", "-o", "foggier.exr", "-q")
suite.expect_run("edits of air", ["shade", "foggy.dfb", "--edit", "fog.rib", "-o", "fog.exr"], 0)
expect_same("air and imager keep the parameters that are not given", "foggier.exr", "fog.exr")
suite.write("move.rib", 'LightSource "pointlight" "key" "from" [-2 3 -3]\n')
suite.write("moved.rib", DIRECT.replace("[2 3 -3]", "[-2 3 -3]"))
suite.run("render", "moved.rib", "-o", "moved.exr", "-q")
suite.expect_run("a light that has moved", ["shade", "direct.dfb", "--irradiance", "direct.icf", "--edit", "move.rib", "-o", "move.exr"], 0)
expect_same("shadows of a light that has moved are traced anew", "moved.exr", "move.exr")
suite.write("bad.rib", 'Attribute "identifier" "name" ["nobody"]\nLightSource "pointlight" "none"\nSphere 1 -1 1 360\n')
suite.expect_run("edits that fit nothing are named", ["shade", "-o", "bad.exr", "--edit", "bad.rib", "direct.dfb"], 0,
                 'no object is named "nobody"', 'no light has the handle "none"', "Sphere changes more than shading")

# Geometry that is gone is missed only where rays are needed.
(suite.folder / "gone.rib").write_text('Option "bucket" "string order" ["spiral"]\n' + DIRECT)
suite.run("render", "gone.rib", "-o", "spiral.exr", "-q")
expect_same("buckets in a spiral give the same bits", "direct.exr", "spiral.exr")
suite.run("hide", "gone.rib", "-o", "gone.dfb", "-q")
(suite.folder / "gone.rib").unlink()
suite.expect_run("without its RIB a shot that needs rays says so", ["shade", "gone.dfb", "-o", "gone.exr"], 3, "is gone or has changed")

# Shaders and pictures that lie beside the scene are found from any folder.
home = suite.folder
for folder in ("scene/looks", "elsewhere"):
    (home / folder).mkdir(parents=True)
suite.write("scene/plain.sl", "surface plain() { Ci = Cs; }\n")
suite.write("scene/looks/shown.sl", 'surface shown(string map = "";) { Ci = texture(map); }\n')
suite.write("map.rib", 'Display "scene/looks/map.exr" "file" "rgb"\nFormat 8 8 1\nWorldBegin\nColor [0.2 0.7 0.3]\nSurface "constant"\nDisk 1 9 360\nWorldEnd\n')
suite.run("map.rib", "-q")
suite.write("scene/moved.rib", 'Format 16 12 1\nOption "searchpath" "shader" ["looks:&"] "texture" ["looks"]\nTranslate 0 0 4\nWorldBegin\nColor [1 0.5 0]\n'
            'Surface "plain"\nSphere 1 -1 1 360\nSurface "shown" "map" ["map.exr"]\nDisk 0.5 9 360\nWorldEnd\n')
suite.expect_run("a scene with looks of its own", ["scene/moved.rib", "-o", "moved.exr"], 0)
suite.run("hide", "scene/moved.rib", "-o", "moved.dfb", "-q")
suite.folder = home / "elsewhere"
suite.expect_run("which are found from another folder", ["shade", "../moved.dfb", "-o", "../moved_elsewhere.exr"], 0)
suite.folder = home
expect_same("so that the picture stays the same", "moved.exr", "moved_elsewhere.exr")

# Information.
for file, kind in (("direct.dfb", "dfb"), ("indirect.icf", "icf")):
    info = json.loads(suite.run("info", file, "--json").stdout)
    suite.expect(info["kind"] == kind, f"info knows {file}")
    suite.expect_run(f"info {file} as text", ["info", file], 0, f"kind: {kind}")
suite.expect_run("the records as a picture", ["view", "indirect.icf", "-o", "records.png"], 0)
suite.expect_run("and as a cloud", ["convert", "indirect.icf", "records.ptc"], 0)
records = sum(c["records"] for c in json.loads(suite.run("info", "indirect.icf", "--json").stdout)["caches"])
points = json.loads(suite.run("info", "records.ptc", "--json").stdout)["points"]
suite.expect(points == records, f"with a point for each record ({points} of {records})")
suite.expect_run("an .icf that is none", ["view", "indirect.dfb.icf", "-o", "records.png"], 2, "indirect.dfb.icf")
suite.expect(json.loads(suite.run("info", "indirect.icf", "--json").stdout)["caches"][0]["records"] > 10, "info counts records")

# Damage.
whole = (suite.folder / "direct.dfb").read_bytes()
for what, data, says in (("truncated", whole[:-100], "truncated"), ("empty", b"", "no file of this kind"),
                         ("foreign", b"TomalDFB" + whole[8:16] + bytes(16) + whole[32:], "header is damaged"),
                         ("another kind", (suite.folder / "direct.icf").read_bytes(), "no file of this kind")):
    suite.write("damaged.dfb", data)
    suite.expect_run(f"a {what} file is refused", ["shade", "damaged.dfb", "-o", "damaged.exr"], 2, says)
middle = bytearray(whole)
middle[len(whole) // 2] ^= 255
suite.write("damaged.dfb", bytes(middle))
suite.expect_run("a damaged bucket is named and the others are shaded", ["shade", "damaged.dfb", "-o", "damaged.exr"], 2, "bucket")
suite.expect((suite.folder / "damaged.exr").exists(), "a picture of the sound buckets is written")
middle = bytearray((suite.folder / "indirect.icf").read_bytes())
for at in (3, 9, 40, 200, len(middle) // 2, len(middle) - 500, len(middle) - 5):
    middle[at] ^= 1
    suite.write("damaged.icf", bytes(middle))
    result = suite.run("shade", "indirect.dfb", "--irradiance", "damaged.icf", "-o", "damaged.exr", "-q")
    middle[at] ^= 1
    if result.returncode != 2:
        suite.expect(False, f"a flip at {at} of an .icf: exit {result.returncode}")
    if suite.run("info", "damaged.icf").returncode != 2:
        suite.expect(False, f"a flip at {at} of an .icf: info calls it sound")

# A disk fills up. A limit on file size stands in for it.
def limited(*arguments):
    def limit():
        signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
        resource.setrlimit(resource.RLIMIT_FSIZE, (60000, 60000))
    return subprocess.run([suite.program, *arguments], cwd=suite.folder, capture_output=True, text=True, preexec_fn=limit, timeout=60)


full = limited("hide", "direct.rib", "-o", "full.dfb")
suite.expect(full.returncode == 4 and "could not be written" in full.stderr and "--resume" in full.stderr, "a full disk: " + full.stderr[-300:])
suite.expect(not (suite.folder / "full.dfb").exists() and (suite.folder / "full.dfb.part").exists(), "finished buckets are kept")
suite.expect_run("and used when there is room", ["hide", "direct.rib", "-o", "full.dfb", "--resume", "-v"], 0)
suite.run("shade", "full.dfb", "-o", "full.exr", "-q")
expect_same("a resumed shot gives the same bits", "direct.exr", "full.exr")
suite.expect_run("no such folder", ["hide", "direct.rib", "-o", "nowhere/x.dfb"], 4, "folder is missing")

# The program is killed at any moment.
random.seed(1)
for attempt in range(3):
    killed = subprocess.Popen([suite.program, "hide", "direct.rib", "-o", "killed.dfb", "--resume", "-q", "-t", "2"], cwd=suite.folder)
    time.sleep(random.uniform(0.0, 0.25))
    killed.kill()
    killed.wait()
suite.expect_run("a run after kill -9", ["hide", "direct.rib", "-o", "killed.dfb", "--resume"], 0)
suite.run("shade", "killed.dfb", "-o", "killed.exr", "-q")
expect_same("gives the same bits", "direct.exr", "killed.exr")
for attempt in range(3):
    killed = subprocess.Popen([suite.program, "render", "indirect.rib", "-o", "resumed.exr", "--resume", "-q", "-t", "2"], cwd=suite.folder)
    time.sleep(random.uniform(0.0, 0.3))
    killed.kill()
    killed.wait()
suite.expect_run("a render after kill -9", ["render", "indirect.rib", "-o", "resumed.exr", "--resume"], 0)
expect_same("gives the same bits too", "indirect.exr", "resumed.exr")
suite.expect(not list(suite.folder.glob("resumed.exr.dfb*")), "and leaves no buckets behind")

# With less memory, and with records from a file, the bits are the same.
suite.expect_run("a memory limit is obeyed and said so", ["render", "direct.rib", "-o", "small.exr", "--memory-limit", "1K", "-v"], 0, "row by row")
expect_same("a frame that is shaded bucket by bucket has the same bits", "direct.exr", "small.exr")
suite.run("render", "indirect.rib", "-o", "given.exr", "--irradiance", "indirect.icf", "--stats", "given.json", "-q")
expect_same("a render with records from a file has the same bits", "indirect.exr", "given.exr")
# Records keep the bounced light of an edited light.
suite.write("dim.rib", 'LightSource "pointlight" "key" "intensity" [3]\n')
suite.write("exposure.rib", "Exposure 2 1\n")
suite.expect_run("a dimmed light with records of the old one", ["shade", "indirect.dfb", "--irradiance", "indirect.icf", "--edit", "dim.rib", "-o", "dim.exr"], 0,
                 "keeps the bounced light of light", "light-stale")
quiet = suite.expect_run("an edit that bounces no light", ["shade", "indirect.dfb", "--irradiance", "indirect.icf", "--edit", "exposure.rib", "-o", "dim.exr"], 0)
suite.expect("light-stale" not in quiet.stderr, "is not told")

# One region is gathered again after an edit, and the rest of the picture stays as it is.
suite.write("region.rib", 'Attribute "identifier" "name" ["floor"] Color [0.9 0.1 0.1]')
suite.run("gather", "indirect.dfb", "-o", "region.icf", "--irradiance", "indirect.icf", "--crop", "0,0.4,0,1", "--edit", "region.rib", "--stats", "region.json", "-q")
for name in ("indirect", "region"):
    suite.run("shade", "indirect.dfb", "--irradiance", f"{name}.icf", "-o", f"{name}.part.exr", "--indirect-only", "-q", "--stats", f"{name}.part.json")
before, after = (pixels(suite.folder / f"{name}.part.exr") for name in ("indirect", "region"))
inside, outside = (sum(before[xy] != after[xy] for xy in before if (xy[0] < 24) == left) for left in (True, False))
gathered = json.loads((suite.folder / "region.json").read_text())["irradiance_cache"]["samples"]
suite.expect(gathered > 0 and inside > 200 and outside < 100, f"a region is gathered anew ({gathered} records, {inside} pixels, {outside} elsewhere)")
suite.expect(json.loads((suite.folder / "region.part.json").read_text())["rays"]["gather"] == 0, "and needs no rays to be shaded")
for name in ("indirect", "region"):
    suite.run("gather", "indirect.dfb", "-o", "again.icf", "--irradiance", f"{name}.icf", "--stats", "again.json", "-q")
    suite.run("shade", "indirect.dfb", "--irradiance", "again.icf", "-o", f"{name}.again.exr", "--indirect-only", "-q")
    suite.expect(json.loads((suite.folder / "again.json").read_text())["irradiance_cache"]["samples"] == 0, f"{name}.icf gets no record when its frame is gathered again")
    expect_same(f"and {name}.icf has the same bits", f"{name}.part.exr", f"{name}.again.exr")
suite.run("render", "indirect.rib", "-o", "given.exr", "--irradiance", "indirect.icf", "--irradiance-append", "--stats", "given.json", "-q")
suite.expect(json.loads((suite.folder / "given.json").read_text())["irradiance_cache"]["samples"] == 0, "nothing is appended where all is covered")
suite.run("gather", "indirect.dfb", "-o", "dark.icf", "--gi", "none", "-q")
suite.expect_run("light that was not gathered is gathered while shading, and said so", ["shade", "indirect.dfb", "--irradiance", "dark.icf", "-o", "lit.exr"], 0, "icf-without-light")
suite.expect_run("by a render too", ["render", "indirect.rib", "--irradiance", "dark.icf", "-o", "lit.exr"], 0, "icf-without-light")
suite.expect("icf-without-light" not in suite.run("shade", "indirect.dfb", "--irradiance", "dark.icf", "--gi", "none", "-o", "dark.exr").stderr, "or left out again, and nothing is said")
suite.expect_run("a frame beyond memory is refused", ["render", "direct.rib", "-o", "huge.exr", "--format", "65536x65536", "--bucket-size", "16"], 4, "--crop")
suite.finish()
