"""Tests that output that cannot be written gives exit code 4, in every command and for every kind of output. Words instead of
numbers are wrong usage."""
import json
import shutil
import subprocess

from program import GOOD, Suite

t = Suite()
t.write("good.rib", GOOD)
LIT = GOOD.replace("WorldBegin", 'WorldBegin\nLightSource "indirectlight" 2 "float samples" [16]').replace("Sphere", 'Polygon "P" [-3 -1 -3 -3 -1 3 3 -1 3 3 -1 -3]\nSphere', 1)
t.write("lit.rib", LIT)
t.run("good.rib")
t.run("hide", "lit.rib", "-o", "good.dfb", "-q")
t.run("gather", "good.dfb", "-o", "good.icf", "-q")
t.run("photons", "lit.rib", "-o", "photons", "--photons", "2000", "-q")
points = next((t.folder / "photons").glob("*.ptc")).relative_to(t.folder).as_posix()
t.run("irradiance", points, "-o", "irradiance")
lit_points = "irradiance/" + points.split("/")[1]
t.run("convert", points, "points.ply")
t.run("good.rib", "-o", "good.tif")
t.write("map.rib", 'Display "map.z" "zfile" "z"\n' + GOOD.split("\n", 1)[1])
t.run("map.rib")
t.write("a_file", "in the way of folders")
for folder in ("is.exr", "is.dfb", "is.icf", "is.json", "is.html", "is.rib", "is.bkm", "is.ptc", "is.ply", "is.png", "is.tex", "is.z"):
    (t.folder / folder / "inside").mkdir(parents=True)

commands = {
    "a picture": ["good.rib", "-o", "{}.exr"],
    "a deep frame buffer": ["hide", "good.rib", "-o", "{}.dfb"],
    "a cache": ["gather", "good.dfb", "-o", "{}.icf"],
    "a shaded picture": ["shade", "good.dfb", "-o", "{}.exr"],
    "statistics": ["good.rib", "--stats", "{}.json"],
    "statistics of shade": ["shade", "good.dfb", "-o", "shaded.exr", "--stats", "{}.json"],
    "a difference": ["compare", "good.exr", "good.exr", "--diff", "{}.exr"],
    "a picture of a shader": ["shadetest", "matte", "--grid", "4x4", "-o", "{}.png"],
    "a scene": ["catrib", "good.rib", "-o", "{}.rib"],
    "a brick map": ["brickmake", lit_points, "-o", "{}.bkm"],
    "a brick map of two clouds": ["brickmake", lit_points, lit_points, "-o", "{}.bkm"],
    "a view": ["view", points, "-o", "{}.png"],
    "points of records": ["convert", "good.icf", "{}.ptc"],
    "points of PLY": ["convert", "points.ply", "{}.ptc"],
    "PLY": ["convert", points, "{}.ply"],
    "a chart": ["chart", "good.rib", "-o", "{}.html", "--cache", "lab", "--budget", "1s"],
}
for what, arguments in commands.items():
    for where, place in (("in a folder that is missing", "/nowhere/x"), ("in a file", "a_file/x"), ("over a folder", "is")):
        if what == "a chart" and place == "is":
            continue  # This is known only at the end.
        t.expect_run(f"{what} {where}", [a.format(place) for a in arguments], 4)
for what, arguments in {
    "photon maps": ["photons", "lit.rib", "--photons", "100", "-o", "a_file"],
    "irradiance": ["irradiance", points, "-o", "a_file"],
    "brick maps": ["brickmake", lit_points, "-o", "a_file"],
    "an atlas": ["lit.rib", "--gi", "atlas", "--photons", "100", "--atlas", "a_file"],
    "radiosity bricks": ["lit.rib", "--gi", "radiosity", "--atlas", "a_file"],
    "radiosity maps": ["lit.rib", "--gi", "radiosity", "--radiosity-maps", "a_file"],
    "baked light": ["lit.rib", "--baked", "a_file"],
    "the laboratory of a chart": ["chart", "good.rib", "-o", "a.html", "--cache", "a_file"],
}.items():
    t.expect_run(f"{what} where a file stands", arguments, 4)
for what, request in {
    "MakeTexture": 'MakeTexture "good.tif" "{}.tex" "black" "black" "box" 1 1',
    "MakeLatLongEnvironment": 'MakeLatLongEnvironment "good.tif" "{}.tex" "box" 1 1',
    "MakeCubeFaceEnvironment": "MakeCubeFaceEnvironment " + '"good.tif" ' * 6 + '"{}.tex" 90 "box" 1 1',
    "MakeShadow": 'MakeShadow "map.z" "{}.z"',
    "MakeBrickMap": f'MakeBrickMap ["{lit_points}"] "{{}}.bkm"',
}.items():
    for place in ("/nowhere/x", "a_file/x", "is"):
        t.write("make.rib", request.format(place) + "\n" + GOOD)
        t.expect_run(f"{what} to {place}", ["make.rib"], 4, "make.rib:1")
for what, command in {"info": '"$0" info good.rib', "compare": '"$0" compare good.exr good.exr', "catrib": '"$0" catrib good.rib', "shadetest": '"$0" shadetest matte --grid 4x4',
                      "brickmake": f'"$0" brickmake {lit_points} -o o.bkm', "--help": '"$0" --help'}.items():
    result = subprocess.run(["bash", "-c", command + " > /dev/full", t.program], cwd=t.folder, capture_output=True, text=True, timeout=60)
    t.expect(result.returncode == 4 and "standard output" in result.stderr, f"{what} to a standard output that is full (exit {result.returncode}) {result.stderr[-200:]}")
# A frame does not begin if it is known beforehand that one of its Displays cannot be written.
(t.folder / "alone").mkdir()
shutil.copy(t.program, t.folder / "alone/tomales")  # The module that writes TIFF is not beside the program.
for what, display, program, *says in (
        ("depth in a PNG", '"+z.png" "file" "z"', t.program, "PNG holds no depth"),
        ("Cryptomatte in a TIFF", '"+id.tif" "tiff" "cryptoobject"', t.program, "Cryptomatte needs OpenEXR"),
        ("a picture in the place of a folder", '"+is.png" "file" "rgb"', t.program, "directory"),
        ("a TIFF whose module is missing", '"+a.tif" "tiff" "rgba"', t.folder / "alone/tomales", "libtomales_tiff.so")):
    t.write("two.rib", f'Display "first.exr" "file" "rgba"\nDisplay {display}\n' + LIT.split("\n", 1)[1])
    result = subprocess.run([program, "two.rib"], cwd=t.folder, capture_output=True, text=True, timeout=60)
    t.expect(result.returncode == 4 and all(s in result.stderr for s in (*says, "two.rib:2", "the frame was not rendered")), f"{what} is told {result.stderr[-300:]}")
    t.expect(not (t.folder / "first.exr").exists(), "before the frame begins")
t.write("wide.rib", 'Display "wide.png" "file" "rgb" "float quantize[4]" [0 0 0 0]\n' + GOOD.split("\n", 1)[1])
t.expect_run("a Display with a warning", ["wide.rib", "--stats", "wide.json"], 0, "holds no floating point numbers")
warned = [m["count"] for m in json.loads((t.folder / "wide.json").read_text())["warnings"] if m["code"] == "display-quantize"]
t.expect(warned == [1], f"is reported once ({warned})")
t.write("self.rib", GOOD.replace('"good.exr" "file"', '"./self.rib" "openexr"'))
scene = (t.folder / "self.rib").read_bytes()
t.expect_run("a picture in the place of the scene", ["self.rib"], 4, "self.rib:1", "would replace the scene")
t.expect((t.folder / "self.rib").read_bytes() == scene, "leaves the scene")
left = [p.name for p in t.folder.rglob("*.part") if ".dfb" not in p.name and ".icf" not in p.name]
t.expect(not left, f"nothing is left behind but buckets, which --resume uses: {left}")
t.write("kept.rib", GOOD)
t.expect_run("catrib of what is missing", ["catrib", "absent.rib", "-o", "kept.rib"], 2)
t.expect((t.folder / "kept.rib").read_text() == GOOD, "leaves the file that was there")
t.expect_run("catrib onto its input", ["catrib", "kept.rib", "-o", "kept.rib"], 0)
t.expect_run("which is still a scene", ["kept.rib"], 0)

# These are no numbers.
for text in ("nan", "-nan", "NaN", "inf", "-inf", "1e999"):
    for arguments in (["good.rib", "--shading-rate"], ["good.rib", "--max-error"], ["good.rib", "--radiosity-texels"], ["good.rib", "--brick-maxerror"],
                      ["good.rib", "--samples"], ["good.rib", "--seed"], ["good.rib", "--light-seed"], ["good.rib", "--memory-limit"],
                      ["good.rib", "--brick-cache"], ["good.rib", "-t"],
                      ["brickmake", points, "-o", "x.bkm", "--maxerror"], ["brickmake", points, "-o", "x.bkm", "--radiusscale"],
                      ["brickmake", points, "-o", "x.bkm", "--coarseness"], ["view", points, "-o", "x.png", "--gain"], ["view", points, "-o", "x.png", "--level"],
                      ["convert", "points.ply", "x.ptc", "--radius"], ["chart", "good.rib", "-o", "x.html", "--budget"]):
        t.expect_run(f"usage: {' '.join(arguments[:1] + arguments[-1:])} {text}", arguments[:-1] + [f"{arguments[-1]}={text}" if arguments[-1].startswith("--") else arguments[-1] + text], 1)
    t.expect_run(f"usage: --crop with {text}", ["good.rib", "--crop", f"0,{text},0,1"], 1)
t.finish()
