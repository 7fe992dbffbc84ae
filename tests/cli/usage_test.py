"""Tests the command as its documentation describes it: options, defaults, outputs, and exit codes of good and wrong usage."""
import json
import signal
import subprocess
import sys

from program import GOOD, Suite

t = Suite()
t.write("good.rib", GOOD)
t.write("maps_alone.rib", 'Display "only.z" "zfile" "z"\n' + GOOD.split("\n", 1)[1])

# Wrong usage gives exit code 1.
for arguments in ([], ["render"], ["good.rib", "--frobnicate"], ["good.rib", "--memory-limit", "much"],
                  ["good.rib", "--crop", "1,0,0,1"], ["good.rib", "--format", "640"], ["good.rib", "--frames", "9-1"],
                  ["good.rib", "-t", "0"], ["good.rib", "-o", "a.jpg"], ["good.rib", "--gi", "magic"], ["compare", "good.rib"]):
    t.expect_run("usage: " + " ".join(arguments), arguments, 1)
for arguments in (["good.rib", "--stats", "-o", "a.exr"], ["good.rib", "-o", "--progress"], ["chart", "-o", "-t", "1", "good.rib"]):
    t.expect_run("usage: " + " ".join(arguments), arguments, 1, "stands where a value is missing")
for arguments, range_of_values in ((["--frames", "9-1"], "ranges rise"), (["--frames", "1-9999999"], "at most a million"), (["--crop", "0,2,0,1"], "from 0 to 1"),
                                   (["--format", "0x9"], "from 1 to"), (["--pixel-samples", "4x99"], "from 1 to 64"), (["--brick-cache", "-5"], "10M"),
                                   (["--irradiance-append"], "--irradiance")):
    t.expect_run("the refusal of " + " ".join(arguments) + " says what is allowed", ["good.rib", *arguments], 1, range_of_values)
for arguments in (["--photons", "5"], ["--photon-noise", "0.1"], ["--atlas", "maps"], ["--atlas-direct", "stored"], ["--brick-maxerror", "0.1"],
                  ["--radiosity-texels", "2"], ["--radiosity-maps", "maps"], ["--pilot-frames", "1"], ["--animation-settings", "a.json"], ["--audit-every", "3"]):
    t.expect_run(f"{arguments[0]} warns that it has no effect", ["good.rib", *arguments], 0, f"{arguments[0]} has no effect", "[option-unused]")
    t.expect("option-unused" not in t.run("maps_alone.rib", *arguments).stderr, "but not in a frame of maps alone")
t.expect_run("the warning names the methods that read the option", ["good.rib", "--gi", "none", "--photons", "5"], 0,
             "for --gi atlas, progressive and reference, and the light is by --gi none")
for arguments in (["--gi", "atlas", "--photons", "5000"], ["--gi", "progressive", "--photons", "5000", "--photon-noise", "0.5"], ["--gi", "radiosity", "--radiosity-texels", "2"],
                  ["--gi", "atlas", "--photons", "5000", "--atlas", "maps", "--atlas-direct", "stored", "--brick-maxerror", "0.1"],
                  ["--gi", "radiosity", "--radiosity-maps", "texels"], ["--gi", "radiosity", "--atlas", "direct"]):
    t.expect("option-unused" not in t.run("good.rib", *arguments).stderr, " ".join(arguments) + " has an effect")
t.expect_run("--version", ["--version"], 0, sys.argv[2])
t.expect_run("--help", ["--help"], 0, "render", "info", "compare")

# Rendering.
t.expect_run("render is the default command", ["good.rib"], 0)
t.expect((t.folder / "good.exr").exists(), "the Display of the scene is written")
t.expect_run("standard input", ["-", "-o", "stdin.exr"], 0, stdin=GOOD)
figures = json.loads(t.expect_run("compare --json", ["compare", "good.exr", "stdin.exr", "--json"], 0).stdout)
t.expect(figures["max_error"] == 0 and figures["psnr_dB"] is None, "standard input gives the same picture, bit for bit")
t.expect_run("compare --diff", ["compare", "good.exr", "stdin.exr", "--diff", "diff.png"], 0, "rmse")
t.expect((t.folder / "diff.png").exists(), "the difference is written")
t.write("plain.rib", GOOD.split("\n", 1)[1])
t.expect_run("a scene without Display", ["plain.rib"], 0)
t.expect((t.folder / "ri.exr").exists(), "writes ri.exr")

display, rest = GOOD.split("\n", 1)
for aspect in (1, 2):
    t.write("wide.rib", f"Format 32 24 {aspect}\n" + "\n".join(line for line in GOOD.splitlines() if not line.startswith("Format")))
    for extension in ("exr", "tif", "png"):
        t.expect_run(f"pixels {aspect} times as wide as high, {extension}", ["wide.rib", "-o", "wide." + extension], 0)
        said = subprocess.run(["oiiotool", "--info", "-v", "wide." + extension], cwd=t.folder, capture_output=True, text=True).stdout
        shown = [line.split(":")[1].strip() for line in said.splitlines() if "PixelAspectRatio" in line] or ["1"]
        t.expect(shown == [str(aspect)], f"are so in {extension}: {shown}")
t.write("project.rib", 'Display "renderman/images/scene.exr" "it" "rgba" "int[4] quantize" [0 0 0 0] "int asrgba" 1\n' + rest)
made = t.expect_run("folders of a modeller's project", ["project.rib"], 0)
t.expect((t.folder / "renderman/images/scene.exr").exists(), "are made")
t.expect("quantize" not in made.stderr and "asrgba" not in made.stderr, "what RenderMan for Maya says of a Display is understood: " + made.stderr)
t.write("nowhere.rib", 'Display "/nowhere/scene.exr" "openexr" "rgba"\n' + rest)
t.expect_run("absolute ones are not", ["nowhere.rib"], 4, "folder is missing")

# Frames.
frames = "".join(f"FrameBegin {n}\n{GOOD}FrameEnd\n" for n in (1, 2, 3))
t.write("frames.rib", frames)
t.expect_run("--frames with numbered output", ["frames.rib", "--frames", "1-3x2", "-o", "f.###.exr"], 0)
t.expect(sorted(p.name for p in t.folder.glob("f.*.exr")) == ["f.001.exr", "f.003.exr"], "writes those frames and no other")
(t.folder / "take #2").mkdir()
t.expect_run("-o in a folder whose name has a #", ["frames.rib", "--frames", "1", "-o", "take #2/f#.exr"], 0)
t.expect([p.name for p in t.folder.glob("take*")] == ["take #2"] and (t.folder / "take #2/f1.exr").exists(), "writes there, and makes no folder")
t.expect_run("-o in a new folder for each frame", ["frames.rib", "--frames", "2", "-o", "take##/f.exr"], 0)
t.expect((t.folder / "take02/f.exr").exists(), "makes the folder of the frame")
t.expect_run("frames over one name", ["frames.rib", "-o", "one.exr"], 0, "written over")
t.expect_run("frames that are not there", ["frames.rib", "--frames", "8"], 2, "--frames")

# Statistics and progress.
result = t.expect_run("--stats and --progress", ["good.rib", "--stats", "s.json", "--progress", "-t", "1"], 0, "R90000  100%")
stats = json.loads((t.folder / "s.json").read_text())
for key in ("version", "command", "scene", "threads", "time_s", "cpu_s", "memory_bytes", "geometry", "shade", "rays", "warnings"):
    t.expect(key in stats, f"statistics have {key}")
t.expect(stats["threads"] == 1 and stats["geometry"]["micropolygons_visible"] > 0, "and hold plausible figures")
t.expect(all(k in stats["time_s"] for k in ("total", "parse", "hide", "shade", "image")), "and the time of every stage")

t.expect_run("an option that is given twice", ["good.rib", "-t", "1", "-t", "2"], 1, "-t is given more than once\nRun with --help")

# The command info.
info = json.loads(t.expect_run("info of a scene", ["info", "frames.rib", "--json"], 0).stdout)
t.expect([f["frame"] for f in info["frames"]] == [1, 2, 3] and info["frames"][0]["objects"] == 1, "lists frames and objects")
info = json.loads(t.expect_run("info of a picture", ["info", "good.exr", "--json"], 0).stdout)
t.expect(info["size"] == [24, 24] and [c["name"] for c in info["channels"]] == ["R", "G", "B", "A"], "lists size and channels")
for copy in ("map.z", "map", "map.rib", "map.tex", "map.jpg"):
    t.write(copy, (t.folder / "good.exr").read_bytes())
    info = json.loads(t.expect_run(f"info of a picture called {copy}", ["info", copy, "--json"], 0).stdout)
    t.expect(info["kind"] == "image" and info["size"] == [24, 24], "goes by its first bytes")
t.expect_run("a picture is no scene, whatever its name", ["map.rib"], 2, "is a picture by its first bytes", "not-rib")

t.write("glassy.rib", GOOD.replace('"good.exr" "file"', '"deep.exr" "deepexr"').replace("Surface", "Opacity [0.5 0.5 0.5]\nSurface"))
t.run("glassy.rib")
info = json.loads(t.run("info", "deep.exr", "--json").stdout)
depth = {c["name"]: c for c in info["channels"]}["Z"]
t.expect(info["deep_samples"] > 24 * 24 / 4 and 2.9 < depth["min"] < depth["mean"] < depth["max"] < 5.1, f"info of a deep picture is of its samples, whose depths do not add up ({depth})")

# After an interruption, finished buckets are written and the exit code reports it.
for number, code in ((signal.SIGINT, 130), (signal.SIGTERM, 143)):
    out = t.folder / f"cut{code}.exr"
    process = subprocess.Popen([t.program, "good.rib", "-o", out.name, "--format", "2000x2000", "--stats", "cut.json", "--progress",
                                "-t", "1"], cwd=t.folder, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
    process.stdout.readline()  # The first per cent shows that the frame has begun.
    process.send_signal(number)
    t.expect(process.communicate(timeout=200) and process.returncode == code, f"signal {int(number)} ends with {code}")
    t.expect(out.with_suffix(".partial.exr").exists() and not out.exists() and json.loads((t.folder / "cut.json").read_text())["time_s"]["total"] > 0, "with a picture and statistics")
# -o replaces the picture, but not the maps that later frames need.
t.write("maps.rib", 'FrameBegin 1 Display "key.z" "zfile" "z"\n' + GOOD.split("\n", 1)[1] + "FrameEnd\nFrameBegin 2\n" + GOOD + "FrameEnd\n")
t.expect_run("-o with a frame of maps before", ["maps.rib", "-o", "picture.exr"], 0)
t.expect((t.folder / "key.z").exists() and (t.folder / "picture.exr").exists(), "the map and the picture are both there")
t.write("map.rib", 'Display "key.z" "zfile" "z"\n' + GOOD.split("\n", 1)[1])
t.expect_run("-o without a picture to take the place of", ["map.rib", "-o", "other.exr"], 4, "other.exr")
t.finish()
