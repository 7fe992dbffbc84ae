"""Tests messages for new users: each cause once, what helps, what a scene needs, what is built in, and which options exist."""
import json
import re

from program import GOOD, Suite

t = Suite()


def lines_with(result, *texts):
    return [line for line in result.stderr.splitlines() if all(text in line for text in texts)]


def scene(world):
    return 'Display "x.exr" "file" "rgba" Format 16 16 1 Translate 0 0 4 WorldBegin LightSource "distantlight" 1 ' + world + " WorldEnd\n"


# Each shader gets one message, however the file is broken into lines.
seven = scene(" ".join(f'Surface "rock{n}" Sphere 1 -1 1 360' for n in range(7)))
t.write("line.rib", seven)
t.run("catrib", "--binary", "line.rib", "-o", "binary.rib")
for file in ("line.rib", "binary.rib"):
    told = t.expect_run(f"seven shaders that are not there, {file}", [file], 3)
    t.expect(len(lines_with(told, "[shader-missing]")) == 7, "are seven messages: " + told.stderr)
    t.expect(all(lines_with(told, f'"rock{n}"') for n in range(7)), "which name them")

# One shader gets one message, however often it is requested.
t.write("many.rib", scene("\n".join('Surface "rock" "Kd" [%g] Sphere 1 -1 1 360' % (0.01 * n) for n in range(93))))
told = t.expect_run("one shader that 93 lines ask for", ["many.rib"], 3)
missing = lines_with(told, "[shader-missing]")
t.expect(len(missing) == 2 and "is unknown" in missing[0] and missing[0].startswith("many.rib:1:"), "is one message: " + told.stderr)
t.expect(missing[-1].startswith("tomales: 93 times:") and "many.rib:1, many.rib:2, many.rib:3, many.rib:4, ..." in missing[-1], "with its count and first places at the end: " + missing[-1])

# Parts of one name that are displaced too far by different distances give one message.
t.write("parts.rib", scene('Attribute "identifier" "name" ["deer"] Attribute "displacementbound" "sphere" [0.01] Displacement "noisybump" "Km" [0.5]\n'
                           + "Sphere .3 -.3 .3 360\nTranslate .5 0 0\n" * 3))
told = t.expect_run("parts that exceed their bound", ["parts.rib"], 0)
t.expect(len(lines_with(told, "[displacement-bound]")) == 2 and lines_with(told, "tomales: 3 times:", '"deer"'), "are one message and its count: " + told.stderr)

# Several frames write one picture.
t.write("frames.rib", "\n".join(f"FrameBegin {n}\n{GOOD}FrameEnd" for n in range(1, 21)))
told = t.expect_run("twenty frames over one picture", ["frames.rib", "--format", "4x4"], 0)
t.expect(len(lines_with(told, "written over")) == 2 and lines_with(told, "tomales: 19 times:", "written over"), "are one message and its count: " + told.stderr)

# The message names the folders that were searched for a missing file, and similar files nearby.
(t.folder / "shaders").mkdir()
t.write("shaders/rock.sl", "surface rock() { Ci = Cs; Oi = 1; }")
t.write("near.rib", scene('Surface "rock" Sphere 1 -1 1 360 Surface "Plastik" Sphere 1 -1 1 360 Surface "fog" Sphere 1 -1 1 360 Surface "rock" Sphere 1 -1 1 360'))
told = t.expect_run("shaders that are not found", ["near.rib"], 3, '"shaders/rock.sl" is there, in a folder that is not searched', 'did you mean "plastic"?',
                    "the shader of that name is a volume", "looked for as NAME.sl in", "--shaders FOLDER")
t.expect(len(lines_with(told, "[shader-folders]")) == 1, "are told where they were looked for once: " + told.stderr)
t.expect_run("and are found there, when the folder is named", ["near.rib", "--shaders", "shaders"], 3)
t.write("part.rib", "Sphere 1 -1 1 360\n")
t.write("wood.tif", "no picture")
t.write("files.rib", scene('ReadArchive "Part.rib" ReadArchive "nowhere.rib" Surface "paintedplastic" "string texturename" ["wood.tx"] Sphere 1 -1 1 360'))
told = t.expect_run("an archive and a picture that are not found", ["files.rib"], 3, 'there is "part.rib"', 'there is "wood.tif"', "looked for in .", "not found in .")

# The program lists what a scene needs.
needs = t.expect_run("info of a scene", ["info", "near.rib"], 3, "missing: 3 of 4")
t.expect(any(line.split()[:3] == ["missing", "surface", "rock"] and "near.rib:1" in line for line in needs.stdout.splitlines()), "says what is missing and where it is named: " + needs.stdout)
t.expect(any(line.split() == ["found", "light", "distantlight", "built-in"] for line in needs.stdout.splitlines()), "and what is built in")
t.write("delayed.rib", 'Surface "rock" Sphere 1 -1 1 360 ReadArchive "deep.rib"\n')
t.write("all.rib", scene('ReadArchive "part.rib" Procedural "DelayedReadArchive" ["delayed.rib"] [-1 1 -1 1 -1 1] Procedural "RunProgram" ["ls" "x"] [-1 1 -1 1 -1 1] Surface "plastic" Sphere 1 -1 1 360'))
told = json.loads(t.expect_run("info --json of a scene", ["info", "all.rib", "--json", "--shaders", "shaders"], 3).stdout)
found = {(n["kind"], n["name"]): n["found"] for n in told["needs"]}
t.expect(found == {("archive", "part.rib"): True, ("archive", "delayed.rib"): True, ("archive", "deep.rib"): False, ("program", "ls"): False,
                   ("light", "distantlight"): True, ("surface", "plastic"): True, ("surface", "rock"): True} and told["missing"] == 2, f"knows archives, programs and shaders: {told['needs']}")
t.expect(next(n["from"] for n in told["needs"] if n["name"] == "rock") == "shaders/rock.sl", "and where they are")
t.write("maps.rib", 'FrameBegin 1\n' + scene("Sphere 1 -1 1 360").replace("x.exr", "made.exr") + 'FrameEnd MakeTexture "made.exr" "made.tex" "black" "black" "box" 1 1 FrameBegin 2\n'
        + scene('Surface "paintedplastic" "string texturename" ["made.tex"] Sphere 1 -1 1 360 Surface "paintedplastic" "string texturename" ["other.tex"] Sphere 1 -1 1 360') + "FrameEnd\n")
told = json.loads(t.expect_run("info of a scene that makes its maps", ["info", "maps.rib", "--json"], 3).stdout)
t.expect({n["name"]: n["found"] for n in told["needs"] if n["kind"] == "texture"} == {"made.tex": True, "other.tex": False}, f"knows which: {told['needs']}")

# A plugin lies in a folder that no option names.
(t.folder / "compiled").mkdir()
t.write("compiled/knit.so", "no plugin")
t.write("knit.rib", scene('Surface "knit" Sphere 1 -1 1 360'))
t.expect_run("a plugin in another folder", ["knit.rib"], 3, '"compiled/knit.so" is there, in a folder that is not searched', "--shaders FOLDER")

# A shader's text names other files, and another text does not compile.
t.write("worn.sl", 'surface worn() { Oi = 1; Ci = texture("wood.tif") + environment("far.tex", N) * match("x.tif$", "y"); string n = format("page%d.tif", 1); printf("no use.tif"); }\n')
t.write("turned.sl", 'surface turned(string map = "") { Oi = 1; Ci = texture(map); }\n')
t.write("worn.rib", scene('Surface "worn" Sphere 1 -1 1 360 Surface "turned" "string map" ["two words.tex"] Sphere 1 -1 1 360'))
told = json.loads(t.expect_run("info of a shader that names pictures", ["info", "worn.rib", "--json"], 3).stdout)
t.expect({n["name"]: n["found"] for n in told["needs"] if n["kind"] == "texture"} == {"wood.tif": True, "far.tex": False, "two words.tex": False}, f"knows them: {told['needs']}")
t.write("several.sl", "surface oak() { Ci = nothing; }\n")
t.write("oak.rib", scene('Surface "oak" Sphere 1 -1 1 360'))
for arguments in (["oak.rib"], ["info", "oak.rib"]):
    told = t.expect_run(f"a shader whose text has errors: {arguments[0]}", arguments, 3, "several.sl:1:", 'its text "./several.sl" has errors')
    t.expect(told.stderr.count("several.sl: missing") <= 1 and "missing: ./several.sl" not in told.stderr, "is named once: " + told.stderr)
t.expect_run("info of a scene that has everything", ["info", "frames.rib"], 0, "missing: 0 of 2")

# The program lists what is built in.
told = t.expect_run("info of a built-in shader", ["info", "plastic"], 0, "roughness", "specularcolor", "default")
t.expect_run("info of a shader's text by its name", ["info", "rock", "--shaders", "shaders"], 0, "shaders/rock.sl")
t.expect_run("info of a shader that there is not", ["info", "plastik"], 2, 'did you mean "plastic"?', "tomales list shaders")
for kind, name in {"shaders": "plastic", "surfaces": "disney", "lights": "indirectlight", "displacements": "bumpy", "volumes": "fog", "imagers": "background", "displays": "openexr", "filters": "mitchell"}.items():
    t.expect_run("list " + kind, ["list", kind], 0, name)
lights = json.loads(t.expect_run("list --json", ["list", "lights", "--json"], 0).stdout)
spot = next(light for light in lights if light["name"] == "spotlight")
cone = next(p for p in spot["parameters"] if p["name"] == "coneangle")
t.expect(cone["type"] == "float" and len(cone["default"]) == 1 and cone["doc"], f"has types, defaults and words: {cone}")
t.expect(all(light["doc"] and all(p["doc"] for p in light["parameters"]) for light in lights), "of every light and parameter")
t.expect_run("list of shaders, which is what most want", ["list"], 0, "surface plastic", "= 0.8 ")
t.expect_run("list of what there is not", ["list", "gremlins"], 1, "shaders", "filters")

# The file is no scene.
for file, says in {"rock.sl": "tomales compile", "rock.slo": ".sl", "house.obj": "tomales import house.obj", "house.usda": "OpenUSD", "house.blend": "export the scene as RIB",
                   "x.exr": "tomales info x.exr", "shot.dfb": "tomales shade shot.dfb", "house.PY": "python3"}.items():
    t.expect_run(file + " is no scene", [file], 2, "no RIB", says)
    t.expect_run(file + " is none to hide", ["hide", file, "-o", "house.dfb"], 2, "no RIB")

# The help fits a screen, and --help-all has everything.
brief, whole = t.run("render", "--help").stdout, t.run("render", "--help-all").stdout
t.expect(len(brief.splitlines()) <= 60 and "--samples" in brief and "--brick-cache" not in brief and "--help-all" in brief, f"render --help fits a screen: {len(brief.splitlines())} lines")
t.expect("--brick-cache" in whole and "--samples" in whole, "and --help-all has the rest")
t.expect(brief.index("Picture:") < brief.index("--format") < brief.index("Light:") < brief.index("--gi") < brief.index("Run:") < brief.index("--progress"), "in groups")
commands = [line.split()[0] for line in t.run("--help").stdout.split("Subcommands:")[1].splitlines() if line.startswith("  ") and not line.startswith("   ")]
commands = [c for c in commands if c.isalpha()]
t.expect({"render", "list", "view"} <= set(commands), f"the commands are listed: {commands}")
for command in commands:
    example = rf"Examples:\n  tomales {'' if command == 'render' else command}\b"
    t.expect(re.search(example, t.run(command, "--help").stdout), f"{command} has an example")
t.finish()
