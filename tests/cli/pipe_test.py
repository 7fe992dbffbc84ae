"""Puts a named pipe, a device or a folder in the place of every file that is read. A message must say what it is, and the program must not wait. Only
the RIB of a command line may come through a pipe."""
import os
import subprocess

from program import GOOD, Suite

t = Suite()
t.write("good.rib", GOOD)
t.write("lit.rib", GOOD.replace("WorldBegin", 'WorldBegin\nLightSource "indirectlight" 2 "float samples" [4]\nLightSource "shadowdistant" 3 "string shadowname" ["raytrace"]'))


def pipe(name):
    os.mkfifo(t.folder / name)
    return name


def inside(requests):
    return GOOD.replace('Surface "matte"\n', 'Surface "matte"\n' + requests + "\n", 1)


def expect_told(what, arguments, code, *says):
    """Tests the message. If the program waited for a writer of the pipe, the time limit of Suite.run() would end it."""
    try:
        t.expect_run(what, arguments, code, *says)
    except subprocess.TimeoutExpired:
        t.expect(False, what + " (it waits)")


for name in ("p.exr", "p.tif", "p.png", "p.tx", "p.ptc", "p.bkm", "p.ply", "p.dfb", "p.icf", "p.so", "p.rib", "p.z"):
    pipe(name)
PIPE = "it is a pipe"

# Scenes name files.
scenes = {
    "a texture": (inside('Surface "paintedplastic" "texturename" ["p.tx"]'), 3, PIPE),
    "a texture that is a picture": (inside('Surface "paintedplastic" "texturename" ["p.png"]'), 3, PIPE),
    "an environment": (inside('Surface "shinymetal" "texturename" ["p.exr"]'), 3, PIPE),
    "a sky": (inside('LightSource "environmentlight" 2 "string map" ["p.exr"]'), 3, PIPE),
    "a shadow map": (inside('LightSource "shadowspot" 2 "string shadowname" ["p.z"]'), 3, PIPE),
    "a brick map": (inside('Geometry "brickmap" "filename" ["p.bkm"]'), 3, PIPE),
    "a Blobby's plane of depth": (inside('Blobby 2 [1001 0 1003 0 16 0 2 0 1] [1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1 0 1 0.5 0.5] ["p.z"]'), 3, PIPE),
    "an archive": (inside('ReadArchive "p.rib"'), 3, "p.rib"),
    "a procedural archive": (inside('Procedural "DelayedReadArchive" ["p.rib"] [-1 1 -1 1 -1 1]'), 3, "p.rib"),
    "MakeTexture": ('MakeTexture "p.png" "out.tex" "black" "black" "box" 1 1\n' + GOOD, 3, PIPE),
    "MakeLatLongEnvironment": ('MakeLatLongEnvironment "p.exr" "out.env" "box" 1 1\n' + GOOD, 3, PIPE),
    "MakeCubeFaceEnvironment": ("MakeCubeFaceEnvironment " + '"p.exr" ' * 6 + '"out.env" 90 "box" 1 1\n' + GOOD, 3, PIPE),
    "MakeShadow": ('MakeShadow "p.z" "out.z"\n' + GOOD, 3, PIPE),
    "MakeBrickMap": ('MakeBrickMap ["p.ptc"] "out.bkm"\n' + GOOD, 3, PIPE),
}
for what, (text, code, says) in scenes.items():
    t.write("scene.rib", text)
    expect_told(f"{what} that is a pipe", ["scene.rib"], code, says)
t.write("scene.rib", inside('Surface "p"'))
expect_told("a shader that is a pipe", ["scene.rib"], 3)

# Commands name files.
t.run("hide", "good.rib", "-o", "good.dfb", "-q")
for what, arguments in {
    "shade": ["shade", "p.dfb", "-o", "a.exr"],
    "shade --irradiance": ["shade", "good.dfb", "--irradiance", "p.icf", "-o", "a.exr"],
    "gather": ["gather", "p.dfb", "-o", "a.icf"],
    "gather --irradiance": ["gather", "good.dfb", "--irradiance", "p.icf", "-o", "a.icf"],
    "render --irradiance": ["lit.rib", "--irradiance", "p.icf", "-o", "a.exr"],
    "info of a deep frame buffer": ["info", "p.dfb"],
    "info of a cache": ["info", "p.icf"],
    "info of a picture": ["info", "p.exr"],
    "info of points": ["info", "p.ptc"],
    "info of bricks": ["info", "p.bkm"],
    "compare": ["compare", "p.exr", "good.exr"],
    "compare with a pipe": ["compare", "p.png", "p.tif"],
    "irradiance": ["irradiance", "p.ptc", "-o", "folder"],
    "brickmake": ["brickmake", "p.ptc", "-o", "a.bkm"],
    "view of points": ["view", "p.ptc", "-o", "a.png"],
    "view of bricks": ["view", "p.bkm", "-o", "a.png"],
    "view of records": ["view", "p.icf", "-o", "a.png"],
    "convert from PLY": ["convert", "p.ply", "a.ptc"],
    "convert to PLY": ["convert", "p.ptc", "a.ply"],
    "convert of records": ["convert", "p.icf", "a.ptc"],
    "chart --stability": ["chart", "--stability", "p.rib", "-o", "a.html", "--cache", "lab"],
}.items():
    expect_told(f"{what} of a pipe", arguments, 2, PIPE)
expect_told("chart of a pipe", ["chart", "p.rib", "-o", "a.html", "--cache", "lab"], 1, PIPE)
expect_told("info of a plugin that is a pipe", ["info", "p.so"], 2, PIPE)
expect_told("shadetest of a plugin that is a pipe", ["shadetest", "./p.so"], 3, PIPE)
expect_told("a device", ["compare", "/dev/zero", "/dev/zero"], 2, "it is a device")
expect_told("a folder", ["compare", ".", "."], 2, "it is a folder")

# Streams are allowed here.
t.expect_run("a scene on standard input", ["-", "-o", "in.exr"], 0, stdin=GOOD)
t.expect_run("a scene on /dev/stdin", ["/dev/stdin", "-o", "in.exr"], 0, stdin=GOOD)


def piped(what, command, code=0, *says):
    result = subprocess.run(["bash", "-c", command], cwd=t.folder, capture_output=True, text=True, timeout=60, env={**os.environ, "P": str(t.program)})
    t.expect(result.returncode == code and all(s in result.stderr + result.stdout for s in says), f"{what} (exit {result.returncode}) {result.stderr[-300:]}")


piped("a scene by process substitution", '"$P" <(cat good.rib) -o sub.exr')
piped("a scene through a named pipe", 'cat good.rib > p.rib & "$P" p.rib -o named.exr')
piped("hide of one, which is not read a second time", '"$P" hide <(cat good.rib) -o sub.dfb')
piped("hide of a named pipe", 'cat lit.rib > p.rib & "$P" hide p.rib -o sub.dfb')
piped("shade of that, whose rays have nothing to meet", '"$P" shade sub.dfb -o shaded.exr', 3, "standard input or a pipe")
piped("render --resume of one", '"$P" <(cat good.rib) -o sub.exr --resume')
piped("info of one", '"$P" info <(cat good.rib) --json')
piped("catrib of one", '"$P" catrib <(cat good.rib) -o cat.rib')
piped("shade --edit of one", '"$P" hide good.rib -o e.dfb && "$P" shade e.dfb --edit <(echo "") -o e.exr || test $? = 2')
for name in ("sub.exr", "named.exr"):
    t.expect_run(f"{name} is a picture", ["compare", "in.exr", name], 0)
t.finish()
