"""Tests files that are not yet renamed: processes that write the same file, links, inputs that are outputs, and standard files that
are closed."""
import json
import os
import pathlib
import shutil
import subprocess

from program import GOOD, Suite

t = Suite()
ROOM = """Display "room.exr" "file" "rgba"
Format 24 24 1
PixelSamples 1 1
Projection "perspective" "fov" [60]
WorldBegin
LightSource "indirectlight" 1
LightSource "pointlight" 2 "from" [0 0.5 3] "intensity" [4]
Surface "matte"
Attribute "identifier" "name" "back"
Polygon "P" [-2 -2 5  2 -2 5  2 2 5  -2 2 5]
Attribute "identifier" "name" "floor"
Polygon "P" [-2 -1 1  2 -1 1  2 -1 5  -2 -1 5]
WorldEnd
"""
t.write("good.rib", GOOD)
t.write("room.rib", ROOM)


def leftovers(folder=None):
    return [p for p in (folder or t.folder).rglob("*") if ".part" in p.name]


# Containers have processes with equal numbers, and may share a folder.
ALONE = ["unshare", "--pid", "--fork", "--mount-proc"]
separate = ALONE if shutil.which("unshare") and subprocess.run([*ALONE, "true"], capture_output=True).returncode == 0 else []


def together(*lines):
    """Returns the exit codes and messages of programs that run at the same time, with the same process number if that is possible."""
    running = [subprocess.Popen([*separate, t.program, *line], cwd=t.folder, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True,
                                env={**os.environ, "TOMALES_TEXTURE_CACHE": str(t.folder / "textures")}) for line in lines]
    return [(p, p.communicate(timeout=100)[1]) for p in running]


def expect_all_good(what, ended):
    t.expect(all(p.returncode == 0 for p, _ in ended), what)
    for p, messages in ended:
        if p.returncode != 0:
            print(f"        exit {p.returncode}: {messages[:300]}")


t.run("good.rib", "-o", "small.exr", "-q")
t.run("good.rib", "-o", "large.exr", "--format", "300x300", "-q")
for name in ("picture.exr", "picture.tif", "picture.png"):
    for _ in range(3):
        ended = together(*[["good.rib", "-o", name, "--format", size, "-t", "1"] for size in ("300x300", "310x310", "300x300", "310x310")])
        expect_all_good(f"four programs that write {name} end well", ended)
        t.expect(json.loads(t.run("info", name, "--json").stdout)["size"] in ([300, 300], [310, 310]), "and it is one of theirs")
t.run("good.rib", "-o", "again.exr", "--format", "300x300", "-q")
ended = together(*[["good.rib", "-o", "picture.exr", "--format", "300x300", "-t", "1"] for _ in range(4)])
t.expect_run("with the bits that one alone writes", ["compare", "picture.exr", "again.exr"], 0, "different_pixels               0")

t.run("room.rib", "--gi", "atlas", "--photons", "20000", "--atlas", "alone", "-o", "alone.exr", "-q")
ended = together(*[["room.rib", "--gi", "atlas", "--photons", "20000", "--atlas", "shared", "-o", f"shared{i}.exr"] for i in range(4)])
expect_all_good("four programs that make one atlas end well", ended)
for i in range(4):
    t.expect_run("and have all its light", ["compare", f"shared{i}.exr", "alone.exr"], 0, "different_pixels               0")

t.run("hide", "room.rib", "-o", "room.dfb", "-q")
ended = together(*[["gather", "room.dfb", "--gi", "gather", "-o", "room.icf"] for _ in range(3)])
expect_all_good("three programs that write one .icf end well", ended)
t.expect_run("and it is whole", ["info", "room.icf"], 0)
ended = together(*[["hide", "good.rib", "-o", "shared.dfb", "--format", "500x500"] for _ in range(3)])
t.expect(any(p.returncode == 0 for p, _ in ended) and all(p.returncode == 0 or "another program is writing" in said for p, said in ended),
         "of three programs that write one .dfb those that cannot say so")
t.expect_run("and it is whole", ["info", "shared.dfb"], 0)

t.run("photons", "room.rib", "-o", "photons", "--photons", "20000", "-q")
ended = together(*[["irradiance", "photons", "-o", "points"] for _ in range(3)])
expect_all_good("three programs that write the same .ptc end well", ended)
cloud = next((t.folder / "points").glob("*.ptc")).name
ended = together(*[["brickmake", f"points/{cloud}", "-o", "shared.bkm"] for _ in range(3)])
expect_all_good("three programs that write one .bkm end well", ended)
t.expect_run("and it is whole", ["view", "shared.bkm", "-o", "view.png"], 0)

t.run("good.rib", "-o", "paint.tif", "--format", "64x64", "-q")
t.write("textured.rib", GOOD.replace('Surface "matte"', 'Surface "paintedplastic" "string texturename" "paint.tif"'))
ended = together(*[["textured.rib", "-o", f"textured{i}.exr"] for i in range(3)])
expect_all_good("three programs that fill one texture cache end well", ended)
t.expect(len([p for p in (t.folder / "textures").rglob("*") if p.is_file()]) == 1, "and it holds one file")
t.expect(not leftovers(), f"nothing unfinished is left: {leftovers()}")

# Outputs are links.
(t.folder / "elsewhere").mkdir()
os.symlink("elsewhere/picture.exr", t.folder / "latest.exr")
t.expect_run("a picture by the name of a link", ["good.rib", "-o", "latest.exr"], 0)
t.expect((t.folder / "latest.exr").is_symlink() and (t.folder / "elsewhere/picture.exr").is_file(), "goes to where it leads")
t.write("precious", "precious")
os.symlink("precious", t.folder / "s.json.part")
t.run("good.rib", "-o", "a.exr", "--stats", "s.json", "-q")
t.expect((t.folder / "precious").read_text() == "precious", "a link that somebody has put in the way is not followed")
(t.folder / "s.json.part").unlink()

# Outputs are devices and pipes.
t.expect_run("statistics to a device", ["good.rib", "-o", "a.exr", "--stats", "/dev/null"], 0)
t.expect(pathlib.Path("/dev/null").is_char_device(), "which stays one")
said = t.expect_run("statistics to standard output", ["good.rib", "-o", "a.exr", "-q", "--stats", "/dev/stdout"], 0).stdout
t.expect('"micropolygons_visible"' in said, "come there")
os.mkfifo(t.folder / "pipe.exr")
t.expect_run("a picture into a pipe", ["good.rib", "-o", "pipe.exr"], 4, "pipe or a device")

# The scene is the output of catrib, under any name.
plain = t.run("catrib", "good.rib").stdout
t.expect("WorldBegin" in plain, "catrib writes the scene")
os.link(t.folder / "good.rib", t.folder / "hard.rib")
os.symlink("good.rib", t.folder / "soft.rib")
for output in ("good.rib", "./good.rib", "soft.rib"):
    t.expect_run(f"catrib good.rib -o {output}", ["catrib", "good.rib", "-o", output], 0)
    t.expect((t.folder / "good.rib").read_text() == plain, "keeps the scene")
t.expect_run("catrib good.rib -o hard.rib", ["catrib", "good.rib", "-o", "hard.rib"], 0)
t.expect((t.folder / "hard.rib").read_text() == plain == (t.folder / "good.rib").read_text(), "keeps both")
t.write("half.rib", GOOD.replace("Sphere 1 -1 1 360", "Sphere 1 -1 [1"))
before = (t.folder / "half.rib").read_text()
result = t.run("catrib", "half.rib", "-o", "half.rib")
t.expect(result.returncode != 0 and (t.folder / "half.rib").read_text() == before, "what cannot be read whole stays as it was")
original = sorted(p.name for p in (t.folder / "photons").iterdir())
before = {name: (t.folder / "photons" / name).read_bytes() for name in original}
t.expect_run("irradiance of photons over themselves", ["irradiance", "photons", "-o", "photons"], 4, "would replace")
t.expect(all((t.folder / "photons" / name).read_bytes() == before[name] for name in original), "leaves them")
os.symlink(f"photons/{original[0]}", t.folder / "cloud.bkm")
t.expect_run("brickmake over its points", ["brickmake", f"photons/{original[0]}", "-o", "cloud.bkm"], 4, "would replace")
os.symlink(f"photons/{original[0]}", t.folder / "cloud.ply")
t.expect_run("convert over its points", ["convert", f"photons/{original[0]}", "cloud.ply"], 4, "would replace")
t.write("make.rib", 'MakeTexture "paint.tif" "paint.tif" "clamp" "clamp" "box" 1 1\n')
t.expect_run("MakeTexture over its picture", ["make.rib"], 0)
t.expect_run("makes a whole file", ["info", "paint.tif"], 0)
t.run("compare", "small.exr", "small.exr", "--diff", "small.exr")
t.expect_run("compare over its picture makes a whole one", ["info", "small.exr"], 0)

# Standard files are closed.
line = "good.rib -o closed.exr --format 64x64 --progress -t 1"
for closed in ("<&- >&-", "<&- >&- 2>&-", ">&-", "2>&-"):
    code = subprocess.run(["sh", "-c", f'exec "$0" {line} {closed}', t.program], cwd=t.folder, timeout=60).returncode
    t.run("good.rib", "-o", "open.exr", "--format", "64x64", "-q")
    same = t.run("compare", "closed.exr", "open.exr")
    t.expect(code == 0 and "different_pixels               0" in same.stdout, f"with {closed} the picture is what it is")
t.finish()
