"""Tests files that the program keeps for itself: damaged ones must be reported, made again and never used.
(frames_of_textures_test.py tests the folder of converted pictures.)"""
from program import Suite

t = Suite()
t.write("room.rib", """Format 24 24 1
Projection "perspective" "fov" [60]
Translate 0 0 1
WorldBegin
LightSource "indirectlight" 1 "samples" [16]
LightSource "pointlight" 2 "from" [0 0 0] "intensity" [2]
Sides 2
Surface "matte"
Color [0.7 0.7 0.7]
Sphere 2 -2 2 360
WorldEnd
""")
DAMAGES = {
    "cut off": lambda d: d[:len(d) // 2],
    "empty": lambda d: b"",
    "of another kind": lambda d: b"no map" + bytes(400),
    "rotten in its first part": lambda d: d[:40] + bytes([d[40] ^ 255, d[41] ^ 255]) + d[42:],
    "rotten in its middle": lambda d: d[:len(d) // 2] + bytes([d[len(d) // 2] ^ 255]) + d[len(d) // 2 + 1:],
}


def bits(name):
    return (t.folder / name).read_bytes()


def expect_made_anew(kind, folder, arguments):
    """Damages each file of the folder in each way."""
    t.expect_run(f"{kind} are made", arguments + ["-o", "first.exr"], 0)
    for file in sorted(p for p in (t.folder / folder).rglob("*") if p.is_file()):
        for what, damage in DAMAGES.items():
            whole = file.read_bytes()
            file.write_bytes(damage(whole))
            result = t.run(*arguments, "-o", "again.exr")
            t.expect(result.returncode == 0 and bits("again.exr") == bits("first.exr"), f"{kind}, {file.name} {what}: the same picture (exit {result.returncode})")
            # If a map is whole, the files from which it is made are read only when it has to be made again.
            told = "made anew" in result.stderr and file.name in result.stderr
            t.expect(told or file.suffix == ".ptc" and file.read_bytes() == damage(whole), f"and it is told: {result.stderr[-300:]}")
            file.write_bytes(whole)


expect_made_anew("maps of an atlas", "maps", ["room.rib", "--gi", "atlas", "--atlas", "maps", "--photons", "5000"])
expect_made_anew("maps of radiosity", "bricks", ["room.rib", "--gi", "radiosity", "--atlas", "bricks"])

# Files are damaged from which a map has to be made again.
atlas = ["room.rib", "--gi", "atlas", "--atlas", "maps", "--photons", "5000"]
t.run(*atlas, "-o", "first.exr")
for folder in ("photons", "irradiance"):
    (t.folder / "maps" / "scene0.bkm").unlink()
    file = t.folder / "maps" / folder / "scene0.ptc"
    if folder == "photons":
        (t.folder / "maps" / "irradiance" / "scene0.ptc").unlink()
    file.write_bytes(DAMAGES["rotten in its first part"](file.read_bytes()))
    t.expect_run(f"rotten {folder} of which maps are to be made", atlas + ["-o", "again.exr"], 0, "made anew", f"{folder}/scene0.ptc")
    t.expect(bits("again.exr") == bits("first.exr"), "are made anew too")

# Light was baked for earlier cameras.
baked = ["room.rib", "--gi", "gather", "--baked", "light", "-o", "baked.exr"]
t.expect_run("light is baked", baked, 0)
points = t.folder / "light" / "points" / "scene0.ptc"
points.write_bytes(DAMAGES["rotten in its first part"](points.read_bytes()))
t.expect_run("rotten points of it are told", baked, 0, "made anew", "points/scene0.ptc")
t.expect_run("and gathered anew", ["room.rib", "--gi", "baked", "--baked", "light", "-o", "baked.exr"], 0)

# Charts have kept their measurements.
chart = ["chart", "room.rib", "-o", "c.html", "--sweep", "samples", "--cache", "lab", "--budget", "60s", "--batches", "2", "--format", "8x8"]
t.expect_run("a chart is measured", chart, 0)
# How many batches the reference takes depends on the machine's speed, so only the measured points are damaged. These have thumbnails.
figures = sorted(p for p in (t.folder / "lab").glob("*.json") if p.with_suffix(".exr.thumb.png").exists())
pictures = [p.with_suffix(".exr") for p in figures]
for file, damage in ((figures[0], lambda d: d[:len(d) // 2]), (figures[1], lambda d: b'{"cpu_s": "much", "wall_s": []}'), (pictures[2], lambda d: d[:len(d) // 2]),
                     (pictures[3], lambda d: b"")):
    whole = file.read_bytes()
    file.write_bytes(damage(whole))
    t.expect_run(f"a damaged {file.suffix} of it is measured anew", chart, 0, "measured anew", file.stem)
    t.expect(file.read_bytes() != damage(whole), "and is whole after that")
t.finish()
