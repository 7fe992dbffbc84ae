"""Tests radiosity maps as files, and objects that have none."""
import json

from program import Suite

t = Suite()
t.write("room.rib", """Format 24 24 1
Projection "perspective" "fov" [60]
Translate 0 0 3
WorldBegin
LightSource "indirectlight" 1 "samples" [16] "string radiance" "radiosity"
LightSource "pointlight" 2 "from" [0 0 0] "intensity" [2]
Surface "matte"
AttributeBegin
Attribute "identifier" "name" ["the room"]
Color 0.5 0.5 0.5
Sides 2
Sphere 2 -2 2 360
AttributeEnd
AttributeBegin
Attribute "identifier" "name" ["glass"]
Opacity 0.5 0.5 0.5
Sphere 0.2 -0.2 0.2 360
AttributeEnd
AttributeBegin
Attribute "identifier" "name" ["plain"]
Sides 1
Attribute "radiosity" "float worldtexels" [0.1]
Translate 0 -1 0
Sphere 0.2 -0.2 0.2 360
AttributeEnd
Sides 1
AttributeBegin
Attribute "identifier" "name" ["the room.back"]
Translate 0 1 0
Sphere 0.2 -0.2 0.2 360
AttributeEnd
AttributeBegin
Attribute "identifier" "name" ["object_5"]
Translate 1 0 0
Sphere 0.2 -0.2 0.2 360
AttributeEnd
AttributeBegin
Translate -1 0 0
Sphere 0.2 -0.2 0.2 360
AttributeEnd
WorldEnd
""")

t.expect_run("what has no map is told", ["room.rib", "--radiosity-maps", "maps", "-o", "out.exr", "--stats", "stats.json", "-v"], 0,
             '"glass" has no radiosity map, because it is not opaque')
stats = json.loads((t.folder / "stats.json").read_text())
t.expect("radiosity" in stats["time_s"], "the time of baking is counted")
names = sorted(p.name for p in (t.folder / "maps").iterdir())
t.expect(names == ["object_5.exr", "object_5_5.exr", "plain.exr", "the_room.back.exr", "the_room.exr", "the_room_back.exr"], f"a map for each side that shows, and nothing else: {names}")
t.expect_run("a map is a picture", ["info", "maps/the_room.exr"], 0)
t.expect_run("by the command line", ["room.rib", "--gi", "radiosity", "--radiosity-texels", "0.5", "-o", "coarse.exr"], 0)

bricks = ["room.rib", "--atlas", "bricks", "--radiosity-texels", "0.5", "--stats", "stats.json"]
t.expect_run("as brick maps", bricks + ["-o", "bricks.exr"], 0)
kept = json.loads((t.folder / "stats.json").read_text())
t.expect("brickmake" in kept["time_s"], "which are made")
t.expect(sorted(p.name for p in (t.folder / "bricks").rglob("*")) == ["radiosity", "scene0.bkm", "scene0.ptc"], "in the folder, with their points")
t.expect_run("and used again", bricks + ["-o", "again.exr"], 0)
again = json.loads((t.folder / "stats.json").read_text())
t.expect("brickmake" not in again["time_s"], "nothing is baked twice")
t.expect((t.folder / "bricks.exr").read_bytes() == (t.folder / "again.exr").read_bytes(), "for the same picture")
(t.folder / "bricks" / "radiosity" / "scene0.bkm").write_bytes(b"no map")
t.expect_run("what is damaged is made anew", bricks + ["-o", "again.exr"], 0)
t.expect((t.folder / "bricks.exr").read_bytes() == (t.folder / "again.exr").read_bytes(), "as before")
t.expect_run("an atlas has room beside them", ["room.rib", "--gi", "atlas", "--atlas", "bricks", "--photons", "10000", "-o", "out.exr"], 0)
t.expect_run("maps that are not written are told", bricks + ["--radiosity-maps", "maps", "-o", "out.exr"], 0, "--radiosity-maps: left out")
scene = (t.folder / "room.rib").read_text()
t.write("unmet.rib", scene.replace("Color 0.5 0.5 0.5", 'Attribute "visibility" "int photon" 0\nColor 0.5 0.5 0.5'))
t.write("repainted.rib", scene.replace("Color 0.5 0.5 0.5", 'Attribute "visibility" "int photon" 0\nColor 0.9 0.1 0.1'))
t.run("render", "unmet.rib", "--atlas", "unmet", "-o", "out.exr")
t.expect(t.run("render", "repainted.rib", "--atlas", "unmet", "-o", "kept.exr").returncode == 0, "what photons do not meet is baked")
t.run("render", "repainted.rib", "--atlas", "new", "-o", "new.exr")
t.expect((t.folder / "kept.exr").read_bytes() == (t.folder / "new.exr").read_bytes(), "and baked anew when it changes")

t.write("file", "")
t.expect_run("bricks in a folder that is none", ["room.rib", "--atlas", "file", "-o", "out.exr"], 4, "hits of gather rays are shaded instead")
t.expect_run("a folder that is none", ["room.rib", "--radiosity-maps", "file", "-o", "out.exr"], 4, "radiosity maps cannot be written")
t.finish()
