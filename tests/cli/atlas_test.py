"""Tests the files of the irradiance atlas: what is made again and what is kept, and the messages about damaged, foreign, empty
and truncated files."""
import json
import resource
import shutil
import signal
import subprocess

from program import Suite

t = Suite()
ROOM = """Format 24 24 1
Projection "perspective" "fov" [60]
Translate {camera} 0 3
WorldBegin
LightSource "indirectlight" 1 "samples" [16]
LightSource "pointlight" 2 "from" [0 0 0] "intensity" [{light}]
Attribute "photon" "globalmap" ["room"]
Color {color} 0.5 0.5
Sides 2
Surface "matte"
Sphere 2 -2 2 360
Translate 40 0 0
LightSource "pointlight" 3 "from" [0 0 0] "intensity" [2]
Attribute "photon" "globalmap" ["closet"]
Color 0.5 0.5 0.5
Sphere 2 -2 2 360
WorldEnd
"""


def room(name="room.rib", camera="0", light="2", color="0.5"):
    return t.write(name, ROOM.format(camera=camera, light=light, color=color))


def stages(*arguments):
    """Returns the stages of the atlas that had work to do, and the number of maps that were kept."""
    result = t.run(*arguments, "--gi", "atlas", "--atlas", "maps", "--photons", "20000", "-o", "out.exr", "--stats", "stats.json")
    stats = json.loads((t.folder / "stats.json").read_text())
    work = [s for s in ("photons", "irradiance", "brickmake") if s in stats["time_s"]]
    return result.returncode, " ".join(work), stats["photons"]["groups_kept"]


def limited(size, *arguments):
    """Runs the command with files of no more than `size` bytes, as on a full disk."""
    def limit():
        signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
        resource.setrlimit(resource.RLIMIT_FSIZE, (size, size))
    return subprocess.run([t.program, *arguments], cwd=t.folder, capture_output=True, text=True, preexec_fn=limit, timeout=60)


room()
t.expect(stages("room.rib") == (0, "photons irradiance brickmake", 0), "an atlas is made")
t.expect(stages("room.rib") == (0, "", 2), "and used again")
t.expect(stages("room.rib", "--format", "32x16") == (0, "", 2), "whatever the format")
room("moved.rib", camera="0.3")
t.expect(stages("moved.rib") == (0, "", 2), "and from another camera")
room("red.rib", color="0.7")
t.expect(stages("red.rib") == (0, "photons irradiance brickmake", 1), "a colour that changes leaves the other room its map")
t.expect(stages("red.rib", "--seed", "4")[1] == "photons irradiance brickmake", "other random numbers make other maps")
(t.folder / "maps" / "room.bkm").write_bytes((t.folder / "maps" / "room.bkm").read_bytes()[:-9])
t.expect(stages("red.rib", "--seed", "4") == (0, "brickmake", 1), "a map that is cut off is made again")

# Maps that somebody made by hand are used. Maps of another scene get a message.
t.run("photons", "room.rib", "-o", "byhand_photons", "--photons", "20000")
t.run("irradiance", "byhand_photons", "-o", "byhand_points")
t.run("brickmake", "byhand_points", "-o", "byhand", "--relative", "--maxerror", "0.03")
t.expect_run("maps made by hand", ["room.rib", "--gi", "atlas", "--atlas", "byhand", "-o", "out.exr"], 0)
t.expect_run("and of a scene that has changed since", ["red.rib", "--gi", "atlas", "--atlas", "byhand", "-o", "out.exr"], 0, "was made before the scene was changed")

# The RIB request MakeBrickMap does what brickmake does. A second request names a file that is missing.
t.write("make.rib", 'MakeBrickMap ["byhand_points/room.ptc" "byhand_points/closet.ptc"] "rib.bkm" "maxerror" [0.01] "maxdepth" [2] "speed" [1]')
t.expect_run("MakeBrickMap joins clouds", ["make.rib"], 0, "make.rib:1", '"speed"')
t.run("brickmake", "byhand_points", "-o", "both.bkm", "--maxerror", "0.01", "--maxdepth", "2")
t.expect((t.folder / "rib.bkm").read_bytes() == (t.folder / "both.bkm").read_bytes(), "as brickmake does")
t.write("absent.rib", 'MakeBrickMap ["nowhere.ptc"] "a.bkm"')
t.expect_run("of a cloud that is not there", ["absent.rib"], 3, "absent.rib:1", "nowhere.ptc", "a.bkm")

t.write("nowhere.rib", 'MakeBrickMap ["byhand_points/room.ptc" "byhand_points/closet.ptc"] "nowhere.rib/x.bkm"')
t.expect_run("and one for a folder that cannot be", ["nowhere.rib"], 4, "nowhere.rib:1", "nowhere.rib/x.bkm")

# Bad files are refused.
points = (t.folder / "byhand_points" / "room.ptc").read_bytes()
bricks = (t.folder / "byhand" / "room.bkm").read_bytes()
for end in (0, 5, 40, len(points) // 2, len(points) - 1):
    t.write("cut.ptc", points[:end])
    t.expect_run(f"a .ptc of {end} bytes", ["brickmake", "cut.ptc", "-o", "cut.bkm"], 2, "cut.ptc")
t.expect(not (t.folder / "cut.bkm").exists(), "makes no map")
for end in (0, 5, 40, len(bricks) // 2, len(bricks) - 1):
    t.write("cut.bkm", bricks[:end])
    t.expect_run(f"a .bkm of {end} bytes", ["view", "cut.bkm", "-o", "cut.png"], 2, "cut.bkm")
t.write("newer.ptc", points[:8] + b"\xff" + points[9:])
t.expect_run("a .ptc of another version", ["brickmake", "newer.ptc", "-o", "newer.bkm"], 2, "newer.ptc", "version")
t.write("foreign.ptc", bricks)
t.expect_run("a brick map that calls itself a cloud", ["brickmake", "foreign.ptc", "-o", "foreign.bkm"], 2, "another kind")
t.expect_run("irradiance of what is no photon map", ["irradiance", "byhand_points", "-o", "again"], 2, "no photon map")

# A surface glows by its shader and is no light. The radiance in a closed ball is 1 / (1 - albedo) times the radiance
# that its wall adds.
t.write("glow.sl", "surface glow() { Oi = Os; Ci = Os * (1 + Cs * diffuse(faceforward(normalize(N), I))); }")
t.write("glow.rib", """Format 16 16 1
Projection "perspective" "fov" [90]
Translate 0.3 0 0.5
WorldBegin
LightSource "indirectlight" 1 "samples" [64]
Sides 2
Color 0.8 0.8 0.8
Surface "glow"
Sphere 2 -2 2 360
WorldEnd
""")
result = t.run("glow.rib", "--gi", "atlas", "--photons", "100000", "-o", "glow.exr")
glow = json.loads(t.run("info", "--json", "glow.exr").stdout)["channels"][0]["mean"]
t.expect(result.stderr == "" and abs(glow - 5) < 0.1, f"a closed ball that glows is as bright as the series of its albedo: {glow:.3f}, {result.stderr}")

# Two rooms share floor and ceiling. A wall of 2 cm stands between a bright and a dim lamp.
def rooms(name, dim, wall, *more):
    def sheet(*corners):
        return 'Polygon "P" [' + "  ".join(f"{x} {y} {z}" for x, y, z in corners) + "]\n"
    x, y, z = 3, 2.5, 1.5
    t.write(name, f"""Format 8 8 1
Projection "perspective" "fov" [80]
Translate -2.6 -1.2 1.2
WorldBegin
LightSource "indirectlight" 1 "samples" [16]
Attribute "light" "shadows" ["on"]
LightSource "pointlight" 2 "from" [-1.5 2 0] "intensity" [8]
LightSource "pointlight" 3 "from" [1.5 2 0] "intensity" [{dim}]
Sides 2
Surface "matte"
Color 0.7 0.7 0.7
Attribute "identifier" "name" ["room"]
""" + sheet((-x, 0, -z), (x, 0, -z), (x, 0, z), (-x, 0, z)) + sheet((-x, y, -z), (-x, y, z), (x, y, z), (x, y, -z))
        + sheet((-x, 0, -z), (-x, y, -z), (x, y, -z), (x, 0, -z)) + sheet((-x, 0, z), (x, 0, z), (x, y, z), (-x, y, z))
        + sheet((-x, 0, -z), (-x, 0, z), (-x, y, z), (-x, y, -z)) + sheet((x, 0, -z), (x, y, -z), (x, y, z), (x, 0, z))
        + 'Attribute "identifier" "name" ["thin wall"]\n'
        + "".join(sheet((a, 0, -z), (a, y, -z), (a, y, z), (a, 0, z)) for a in (-0.01, 0.01) if wall) + "WorldEnd\n")
    return t.run(name, "--gi", "atlas", "--photons", "50000", "-o", "rooms.exr", *more).stderr


stored = ("--atlas-direct", "stored")
said = rooms("thin.rib", 0.05, True, *stored)
t.expect("thin.rib:21" in said and '"thin wall"' in said and "[photon-walls]" in said, f"a thin wall before much more light is named: {said}")
t.expect("photon-walls" not in rooms("alike.rib", 8, True, *stored), "one between rooms that are alike is not")
t.expect("photon-walls" not in rooms("open.rib", 0.05, False, *stored), "nor a room without a wall")
said = rooms("thin.rib", 0.05, True, "--samples", "256", "--bounces", "8")
t.run("thin.rib", "--gi", "gather", "--samples", "256", "--bounces", "8", "-o", "gathered.exr")
dim, right = (json.loads(t.run("info", "--json", name).stdout)["channels"][0]["mean"] for name in ("rooms.exr", "gathered.exr"))
t.expect("photon-walls" not in said and abs(dim / right - 1) < 0.2, f"where hits sample lamps the dim room keeps its light: {dim / right:.3f} of what is right")

# Light that was gathered into brick maps shades the view of another camera at the cost of direct light (Christensen and Batali 2004, section 6.3).
def lit(scene, *arguments):
    """Returns the exit code, the number of gather rays, and the messages."""
    result = t.run(scene, *arguments, "--stats", "stats.json", "--samples", "64")
    return result.returncode, json.loads((t.folder / "stats.json").read_text())["rays"]["gather"], result.stderr


def apart(a, b):
    return json.loads(t.run("compare", a, b, "--json").stdout)["mean_absolute_relative_error"]


def kept(folder):
    return sum(f.stat().st_size for f in (t.folder / folder / "points").iterdir())


code, rays, _ = lit("room.rib", "--gi", "gather", "--baked", "light", "-o", "first.exr")
t.expect(code == 0 and rays > 0, "light is gathered and kept")
before = kept("light")
code, rays, said = lit("room.rib", "--gi", "baked", "--baked", "light", "-o", "again.exr")
t.expect((code, rays, said) == (0, 0, ""), f"and used without a ray ({code}, {rays}, {said})")
t.expect(apart("again.exr", "first.exr") < 0.01, "for the same picture but for 1 %")
lit("moved.rib", "--gi", "gather", "-o", "own.exr")
code, rays, said = lit("moved.rib", "--gi", "baked", "--baked", "light", "-o", "other.exr")
t.expect((code, rays, said) == (0, 0, "") and apart("other.exr", "own.exr") < 0.02, f"from another camera, within 2 % of what that would gather ({said})")
t.expect(kept("light") == before, "shading adds nothing to it")
t.expect_run("a shot of it", ["hide", "moved.rib", "-o", "moved.dfb"], 0)
t.expect_run("has no baked light, and says so", ["shade", "moved.dfb", "--gi", "baked", "-o", "shot.exr"], 3, "is for tomales render")
lit("moved.rib", "--gi", "gather", "--baked", "light", "-o", "own.exr")
t.expect(kept("light") > before, "but another camera may")
t.expect("was made before the scene was changed" in lit("red.rib", "--gi", "baked", "--baked", "light", "-o", "out.exr")[2], "of a scene that has changed it is used with a warning")
lit("red.rib", "--gi", "gather", "--baked", "light", "-o", "out.exr")
t.expect(lit("red.rib", "--gi", "baked", "--baked", "light", "-o", "out.exr")[2] == "", "and what such a scene gathers takes its place")
t.expect_run("baked light without a folder", ["room.rib", "--gi", "baked", "-o", "out.exr"], 3, "needs --baked FOLDER")
t.expect_run("a folder for what is not gathered", ["room.rib", "--gi", "reference", "--samples", "1", "--baked", "light", "-o", "out.exr"], 0, "nothing is gathered")
t.expect_run("baked light that is not there", ["room.rib", "--gi", "baked", "--baked", "nowhere", "-o", "out.exr"], 3, "is missing")
(t.folder / "light" / "room.bkm").write_bytes(b"TMBRICKS" + bytes(40))
t.expect(lit("red.rib", "--gi", "baked", "--baked", "light", "-o", "out.exr")[0] == 3, "a damaged map is said")

# Direct light is in the maps, or comes from samples where gather rays hit.
sampled = ("--gi", "atlas", "--atlas", "sampled", "--photons", "20000", "--samples", "400", "-q", "-o")
t.run("render", "room.rib", *sampled, "sampled.exr")
t.run("render", "room.rib", "--gi", "atlas", "--atlas", "byhand", "--samples", "400", "-q", "-o", "stored.exr")
t.expect(apart("sampled.exr", "stored.exr") < 0.03, f"lights that gather rays sample bring as much as photons of theirs: {apart('sampled.exr', 'stored.exr')}")
shutil.rmtree(t.folder / "sampled" / "photons")
t.run("render", "room.rib", *sampled, "again.exr", "--atlas-direct", "stored")
t.expect(apart("again.exr", "sampled.exr") == 0, "and maps say themselves which of both they need")

# Point clouds take the place of brick maps.
t.run("render", "room.rib", "--gi", "atlas", "--atlas", "byhand", "-o", "bricks.exr", "-q")
t.expect_run("gather rays look up points", ["room.rib", "--gi", "points", "--atlas", "byhand_points", "-o", "points.exr", "-q"], 0)
t.expect(apart("points.exr", "bricks.exr") < 0.001, "as they do brick maps of them")
t.expect_run("points without a folder", ["room.rib", "--gi", "points", "-o", "out.exr"], 3, "needs --atlas FOLDER of point clouds")
t.expect_run("points that are not there", ["room.rib", "--gi", "points", "--atlas", "nowhere", "-o", "out.exr"], 3, "there are no points")
t.expect_run("photons are no irradiance", ["room.rib", "--gi", "points", "--atlas", "byhand_photons", "-o", "out.exr"], 3, 'has no channel "irradiance"')

# A lamp turns its back on the floor and faces a mirror. Gather rays see the lamp in the mirror, and photons come from there to a map of caustics, but
# the light must count once.
MIRROR = """Format 24 24 1
Projection "perspective" "fov" [40]
Rotate -90 1 0 0
Translate 0 -3 0
WorldBegin
LightSource "indirectlight" 1 "samples" [400]
AttributeBegin
AreaLightSource "arealight" 2 "intensity" [10]
Color 0 0 0
Patch "bilinear" "P" [1.5 0.3 -0.3  1.5 0.3 0.3  1.5 0.9 -0.3  1.5 0.9 0.3]
AttributeEnd
Illuminate 2 1
AttributeBegin
Surface "mirror"
Attribute "photon" "shadingmodel" ["chrome"]
Polygon "P" [-1.5 0 -2  -1.5 2 -2  -1.5 2 2  -1.5 0 2]
AttributeEnd
Surface "matte"
Attribute "photon" "causticmap" ["{map}"]
Polygon "P" [-1.2 0 -1  -1.2 0 1  1.2 0 1  1.2 0 -1]
WorldEnd
"""
for name, of in (("seen", ""), ("landed", "floor")):
    t.write(name + ".rib", MIRROR.format(map=of))
    t.run("render", name + ".rib", "--gi", "atlas", "--photons", "200000", "--indirect-only", "-o", name + ".exr", "-q")
t.expect(apart("landed.exr", "seen.exr") < 0.25, f"light from mirrors counts once, as photons or as rays: {apart('landed.exr', 'seen.exr')}")

# A scene has no light, an object gets no photon, and a disk is full.
t.write("dark.rib", ROOM.format(camera="0", light="2", color="0.5").replace('LightSource "pointlight"', '# LightSource "pointlight"'))
t.expect_run("a scene without light", ["dark.rib", "--gi", "atlas", "-o", "dark.exr"], 0, "emits photons")
t.write("lonely.rib", ROOM.format(camera="0", light="2", color="0.5").replace("LightSource \"pointlight\" 3", "# LightSource \"pointlight\" 3"))
t.expect_run("a group that no photon reaches", ["lonely.rib", "--gi", "atlas", "--atlas-direct", "stored", "-o", "lonely.exr"], 0, 'no photon came to the objects of photon map "closet"')
said = t.run("lonely.rib", "--gi", "atlas", "-o", "lonely.exr").stderr
t.expect("no photon came" not in said, f"which is no fault where gather rays sample lights ({said})")
full = limited(20000, "room.rib", "--gi", "atlas", "--atlas", "full", "--photons", "50000", "-o", "full.exr")
t.expect(full.returncode == 4 and "room.ptc" in full.stderr and "cannot be written" in full.stderr, f"a disk too full for photons (exit {full.returncode})")
t.expect(not [f for f in (t.folder / "full").rglob("*") if f.is_file() and "room" in f.name], "leaves nothing half-written")
t.finish()
