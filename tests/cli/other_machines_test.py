"""Tests files of a scene that are not where their names say: beside it, in a user's folders, on another machine, or under another ending."""
import json
import os
import subprocess

from program import GOOD, Suite

t = Suite()


def picture(name, colour):
    (t.folder / name).parent.mkdir(parents=True, exist_ok=True)
    subprocess.run(["oiiotool", "--pattern", f"constant:color={colour}", "8x8", "3", "-o", t.folder / name], check=True)


def scene(name, surface='Surface "matte"', ball="Sphere 1 -1 1 360", options="", folder="job"):
    text = GOOD.replace("good.exr", name + ".exr").replace('Surface "matte"', surface).replace("Sphere 1 -1 1 360", ball)
    return t.write(f"{folder}/{name}.rib", options + text)


def textured(name, texture, **rest):
    return scene(name, f'Surface "paintedplastic" "texturename" "{texture}"', **rest)


def same(a, b):
    return json.loads(t.run("compare", a + ".exr", b + ".exr", "--json").stdout)["max_error"] < 1e-5


picture("job/green.tif", "0,1,0")
t.write("job/ball.rib", "Sphere 1 -1 1 360\n")

# The files lie beside the scene. Some names lead out of its folder.
result = t.expect_run("a picture beside the scene, from another folder", [textured("beside", "green.tif")], 0)
t.expect(not result.stderr, "is where it is meant to be")
(t.folder / "job/scenes").mkdir()
t.expect_run("a name that begins with ..", [textured("upwards", "../green.tif", folder="job/scenes")], 0)
t.expect(same("upwards", "beside"), "is seen from the folder of the scene")

# The names are those of another machine.
for name, where in (("unix", "/usr/local/prman/textures/green.tif"), ("windows", "C:\\\\art\\\\green.tif"), ("relative", "textures/green.tif")):
    result = t.expect_run(f"a picture of another machine: {name}", [textured(name, where)], 0, "which has its name")
    t.expect(result.stderr.count("texture-elsewhere") == 1, "is said once")
    t.expect(same(name, "beside"), "is the one beside the scene")
t.expect_run("a picture that is nowhere", [textured("nowhere", "/usr/none.tif")], 3, "magenta")
t.expect_run("the ball itself", [scene("ball_itself")], 0)
t.expect_run("an archive of another machine", [scene("archive", ball='ReadArchive "/net/job7/ball.rib"')], 0, "which has its name")
t.expect(same("archive", "ball_itself"), "is read")
t.expect_run("an archive that is nowhere", [scene("no_archive", ball='ReadArchive "/net/job7/none.rib"')], 3, "none.rib")

# A folder above has the file: the name is as seen from there, or its folders have the same names.
picture("project/maps/green.tif", "0,1,0")
for folder in ("parts", "scenes", "shaders"):
    (t.folder / "project" / folder).mkdir()
t.write("project/parts/ball.rib", "Sphere 1 -1 1 360\n")
for name, where in (("from_above", "maps/green.tif"), ("project", "/home/ann/project/maps/green.tif")):
    t.expect_run(f"a picture beside the scene's folder: {name}", [textured(name, where, folder="project/scenes")], 0, "texture-elsewhere")
    t.expect(same(name, "beside"), "is found")
here = subprocess.run([t.program, "from_above.rib", "-o", t.folder / "here.exr"], cwd=t.folder / "project/scenes", capture_output=True, text=True)
t.expect(here.returncode == 0 and "texture-elsewhere" in here.stderr and same("here", "beside"), f"also where the working folder is that of the scene: {here.stderr}")
t.write("job/leaf.sl", "surface leaf() { Ci = color(0, 1, 0); Oi = 1; }\n")
t.expect_run("a shader of another project", [scene("leaf", 'Surface "other/project/leaf"')], 0, "shader-elsewhere", "which has its name")
t.expect_run("an archive as seen from a folder above", [scene("parts", ball='ReadArchive "parts/ball.rib"', folder="project/scenes")], 0, "rib-elsewhere")
t.expect(same("parts", "ball_itself"), "is found")

t.write("project/shaders/leaf.sl", "surface leaf() { Oi = 1; Ci = color (0, 1, 0); }")
t.expect_run("a shader in a folder that is not here", [scene("leaf", 'Surface "untitled/shaders/leaf"', folder="project/scenes"), "--shaders", t.folder / "project/shaders"], 0)

# A file has another ending: the texture of another renderer is missing or cannot be read, and its picture lies beside it.
t.expect_run("a texture that is missing", [textured("missing_tx", "green.tx")], 0, "green.tif is taken")
t.write("job/old.tx", b"\xce\xfa" + bytes(range(256)) * 8)  # An old texture of PRMan's begins like this.
picture("job/old.tif", "0,1,0")
t.expect_run("a texture of another renderer", [textured("old_tx", "old.tx")], 0, "cannot be read", "old.tif is taken")
t.expect_run("on another machine", [textured("old_unix", "/net/maps/old.tx")], 0, "old.tif is taken")
picture("job/double.tif", "0,1,0")
t.expect_run("a name with two endings", [textured("two_endings", "double.tif.tx")], 0, "double.tif is taken")
for name in ("missing_tx", "old_tx", "old_unix", "two_endings"):
    t.expect(same(name, "beside"), f"{name}: its picture is used")
t.write("job/alone.tx", b"\xce\xfa" + bytes(range(256)) * 8)
t.expect_run("a texture of another renderer alone", [textured("alone", "alone.tx")], 3, "alone.tx", "magenta")
t.expect_run("info finds what rendering takes", ["info", "job/missing_tx.rib"], 0, "job/green.tif", "missing: 0")
t.expect("missing: 1" in t.run("info", "job/nowhere.rib").stdout, "and nothing else")

# An empty name is no picture.
t.write("job/looks.sl", 'surface looks(string map = "";) { Oi = 1; Ci = color texture(map) + color environment(map, N) + shadow(map, P); }')
result = t.expect_run("an empty name", [scene("empty", 'Surface "looks"')], 0)
t.expect(not result.stderr, "is no matter")
t.expect_run("black", [scene("black", 'Surface "constant" Color 0 0 0')], 0)
t.expect(same("empty", "black"), "and brings nothing")

# The files lie in folders of the user.
picture("mine/blue.tif", "0,0,1")
picture("theirs/blue.tif", "1,0,0")
t.write("mine/bead.rib", "Sphere 1 -1 1 360\n")
t.write("mine/tinted.sl", "surface tinted() { Oi = 1; Ci = color(0, 0, 1); }")
picture("job/blue_here.tif", "0,0,1")
t.expect_run("the picture of that colour", [textured("blue_here", "blue_here.tif")], 0)
picture_scene, archive_scene, shader_scene = textured("blue", "blue.tif"), scene("beaded", ball='ReadArchive "bead.rib"'), scene("tinted", 'Surface "tinted"')
for one in (picture_scene, archive_scene, shader_scene):
    t.expect_run("is not found by itself", [one], 3)
t.expect_run("--searchpath", [picture_scene, "--searchpath", "texture=/nowhere:mine"], 0)
t.expect(same("blue", "blue_here"), "names folders of textures")
t.expect_run("twice", [picture_scene, "--searchpath", "texture=mine", "--searchpath", "texture=theirs"], 0)
t.expect(not same("blue", "blue_here"), "the last comes first")
t.expect_run("of archives", [archive_scene, "--searchpath", "archive=mine"], 0)
t.expect(same("beaded", "ball_itself"), "which are read")
t.expect_run("of shaders", [shader_scene, "--searchpath", "shader=mine"], 0)
t.expect_run("the scene's own path comes first", [textured("own_path", "blue.tif", options='Option "searchpath" "texture" ["theirs:@"]\n'), "--searchpath", "texture=mine"], 0)
t.expect(not same("own_path", "blue_here"), "whatever the user has")
t.expect_run("& is the path before", [textured("before", "blue.tif", options='Option "searchpath" "texture" ["mine"]\nOption "searchpath" "texture" ["&:theirs"]\n')], 0)
t.expect(same("before", "blue_here"), "which comes first")
for wrong in ("texture", "pictures=mine"):
    t.expect_run(f"--searchpath {wrong}", [picture_scene, "--searchpath", wrong], 1, "shader|texture|archive=FOLDERS")


def with_environment(variable, folder, one):
    os.environ[variable] = str(folder)
    t.expect_run(f"${variable}", [one], 0)
    del os.environ[variable]


with_environment("TOMALES_TEXTURES", "mine", picture_scene)
with_environment("TOMALES_ARCHIVES", "mine", archive_scene)
with_environment("TOMALES_SHADERS", "mine", shader_scene)
for kind in ("textures", "archives", "shaders"):
    (t.folder / "config2/tomales").mkdir(parents=True, exist_ok=True)
    (t.folder / "config2/tomales" / kind).symlink_to(t.folder / "mine")
for one in (picture_scene, archive_scene, shader_scene):
    with_environment("XDG_CONFIG_HOME", t.folder / "config2", one)

# Files in the working folder come first, because maps that an earlier frame has written are there.
picture("green.tif", "1,0,0")
t.expect_run("a picture in the working folder", [textured("working", "green.tif")], 0)
t.expect(not same("working", "beside"), "comes before the one beside the scene")

t.finish()
