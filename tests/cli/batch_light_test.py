"""Tests that a batch makes once, and in parts, what its frames share: photons and brick maps, radiosity, and the files of Make requests. The pictures
must have the bits of one run."""
import json
import os
import pathlib
import subprocess

from program import Suite

t = Suite()
HEAD = 'Format 32 24 1\nProjection "perspective" "fov" [60]\nPixelSamples 2 2\n'
ROOM = """FrameBegin {frame}
Translate {camera} 0 3
WorldBegin
LightSource "indirectlight" 1 "samples" [16] {radiance}
Attribute "light" "shadows" ["on"]
LightSource "pointlight" 2 "from" [0 0.5 0] "intensity" [{light}]
Attribute "photon" "globalmap" ["room"]
Color 0.5 0.5 0.5
Sides 2
Surface "matte"
Sphere 2 -2 2 360
Attribute "photon" "globalmap" ["ball"]
Translate 0 -1 0
Sphere 0.5 -0.5 0.5 360
WorldEnd
FrameEnd
"""


def rooms(name, lights=(2, 2, 2), radiance=""):
    return t.write(name, HEAD + "".join(ROOM.format(frame=i + 1, camera=0.05 * i, light=light, radiance=radiance) for i, light in enumerate(lights)))


def plan_of(folder):
    return json.loads((t.folder / folder / "plan.json").read_text())["tasks"]


def stages(folder):
    out = {}
    for task in plan_of(folder):
        out[task["stage"]] = out.get(task["stage"], 0) + 1
    return out


def same(prefix, other="one", frames=range(1, 4)):
    return all(json.loads(t.run("compare", f"{prefix}.{f}.exr", f"{other}.{f}.exr", "--json").stdout or "{}").get("different_pixels") == 0 for f in frames)


def files(folder):
    return {str(f.relative_to(t.folder / folder)): f.read_bytes() for f in (t.folder / folder).rglob("*") if f.is_file() and "parts" not in f.parts}


rooms("rooms.rib")
GI = ("--gi", "atlas", "--photons", "30000")
t.run("rooms.rib", *GI, "--atlas", "maps", "-o", "one.#.exr", "-q")
for name, parts, tiles in (("whole", (), ()), ("parts", ("--photon-parts", "3"), ()), ("tiled", ("--photon-parts", "2"), ("--tiles", "2x1"))):
    t.expect_run(f"photons, {name}", ["batch", "rooms.rib", *GI, *parts, *tiles, "--atlas", f"{name} maps", "-o", f"{name}.#.exr", "--plan", name, "-j", "2"], 0, "finished 3 of 3")
    t.expect(same(name), "have the bits of one run")
    t.expect(files(f"{name} maps") == files("maps"), "and its maps, byte by byte")
t.expect(stages("whole") == {"lightmaps": 1, "render": 3}, f"frames of one world share their maps: {stages('whole')}")
t.expect(stages("parts") == {"photons": 3, "joinphotons": 1, "lightmaps": 2, "render": 3}, f"which are made in parts: {stages('parts')}")
t.expect(not list((t.folder / "parts maps/parts").iterdir()), "which nobody needs any more")
log = t.run("batch", "log", "parts", "2").stdout + t.run("batch", "log", "parts", "3").stdout
t.expect("tracing photons" not in log, "and no frame traces photons")
(t.folder / "parts.2.exr").unlink()
(t.folder / "parts maps/ball.bkm").unlink()
t.expect_run("a map that is gone", ["batch", "parts", "-j", "1"], 0, "finished 3 of 3")
t.expect(same("parts") and files("parts maps") == files("maps"), "is made again")

# Worlds that differ have maps of their own. Without a folder, every frame makes its own maps.
rooms("dim.rib", (2, 2, 1))
t.run("dim.rib", *GI, "-o", "alone.#.exr", "-q")
t.expect_run("frames without a folder of maps", ["batch", "dim.rib", *GI, "-o", "own.#.exr", "--plan", "own", "-j", "2"], 0)
t.expect(stages("own") == {"render": 3} and same("own", "alone"), "make their own")
t.expect_run("or in parts", ["batch", "dim.rib", *GI, "--photon-parts", "2", "-o", "cut.#.exr", "--plan", "cut", "-j", "2"], 0)
t.expect(same("cut", "alone") and not [f for f in (t.folder / "cut/work").rglob("*") if f.is_file()], "which they leave behind nowhere")
t.run("dim.rib", *GI, "--atlas", "serial", "-o", "two.#.exr", "-q")
t.expect_run("two worlds and one folder", ["batch", "dim.rib", *GI, "--atlas", "worlds", "-o", "worlds.#.exr", "--plan", "worlds", "-j", "2"], 0)
t.expect(same("worlds", "two") and sorted(p.name for p in (t.folder / "worlds").glob("0*")) == ["0001", "0003"], "have a folder for each world")

# The scene names a folder for radiosity.
rooms("radiosity.rib", radiance='"string radiance" ["radiosity"] "string atlas" ["rads"]')
t.run("radiosity.rib", "-o", "r1.#.exr", "-q")
once = files("rads")
for f in (t.folder / "rads").rglob("*.*"):
    f.unlink()
t.expect_run("radiosity", ["batch", "radiosity.rib", "-o", "r2.#.exr", "-j", "2"], 0)
t.expect(stages("radiosity.batch") == {"lightmaps": 1, "render": 3} and same("r2", "r1") and files("rads") == once, "is made once")

# A light asks for such maps by the default of its shader, under another name.
t.trust_shaders(".")
t.write("radiant.cpp", """#include <reyes/shader.h>
rsl::StringParam how("how", "radiosity", "", TM_ROLE_HIT_RADIANCE), where("where", "", "", TM_ROLE_ATLAS);
void shade(const TmGrid*) {}
const rsl::Shader radiant(TM_LIGHT, "radiant", "", TM_LIGHT_INDIRECT, shade, {&how, &where});
TM_SHADER_LIBRARY(radiant)
""")
source = pathlib.Path(__file__).resolve().parent.parent.parent
subprocess.run([os.environ["CXX"], "-std=c++17", "-shared", "-fPIC", "-I", source, t.folder / "radiant.cpp", "-o", t.folder / "radiant.so"], check=True)
for name, light in (("asks", '"radiant" 1 "string where" ["radiant maps"]'), ("doesnot", '"radiant" 1 "string how" ["shader"] "string where" ["none"]')):
    t.write(f"{name}.rib", HEAD + "".join(ROOM.format(frame=i, camera=0, light=2, radiance="").replace('"indirectlight" 1', light) for i in (1, 2)))
    t.expect_run(f"a light that {name}", ["batch", f"{name}.rib", "-o", f"{name}.#.exr", "--plan-only"], 0)
t.expect(stages("asks.batch") == {"lightmaps": 1, "render": 2} and stages("doesnot.batch") == {"render": 2}, f"is asked itself, not by the name of its parameter: {stages('asks.batch')}")

# Frames that need a failed task are reported with its name.
(t.folder / "closed").write_text("a file where a folder must be")
t.expect_run("maps that cannot be made", ["batch", "rooms.rib", *GI, "--atlas", "closed/maps", "-o", "b.#.exr", "--plan", "blocked", "-j", "2", "--html", "page.html"], 4,
             "finished 0 of 3", "failed 1: 1", "blocked 2: 2-3", "task 0001.lightmaps failed, and frames 2-3 wait for it", "and 2 wait for them")
told = json.loads(t.run("batch", "status", "blocked", "--json").stdout)
t.expect((told["failed"], told["blocked"], told["waiting"], told["left_s"]) == (1, 2, 0, None), f"so does the status: {told}")
t.expect([f["state"] for f in told["by_frame"]] == ["failed", "blocked", "blocked"] and told["failures"][0]["blocks"] == [2, 3], "of each frame")
t.expect('<tr class="blocked"><td>3' in (t.folder / "page.html").read_text(), "and the page")
(t.folder / "closed").unlink()
(t.folder / "closed").mkdir()
t.expect_run("and when it can be made", ["batch", "retry", "blocked", "-j", "2"], 0, "finished 3 of 3")

# Make requests are performed once, after the frames that they read and before the frames that read them.
t.write("make.rib", 'Format 16 16 1\n' + "".join(f"""FrameBegin {i}
Display "{'z.tif' if i == 1 else f'look{i}.exr'}" "{'zfile' if i == 1 else 'file'}" "{'z' if i == 1 else 'rgba'}"
Projection "perspective" "fov" [40]
Translate 0 0 4
WorldBegin
LightSource "shadowspot" 1 "from" [0 0 -4] "to" [0 0 0] "intensity" [20] "string shadowname" ["{'' if i == 1 else 'z.shd'}"]
Surface "matte"
Sphere 1 -1 1 360
WorldEnd
{'MakeShadow "z.tif" "z.shd"' if i == 1 else ''}
FrameEnd
""" for i in (1, 2, 3)))
t.run("make.rib", "-q")
first = [(t.folder / f"look{i}.exr").read_bytes() for i in (2, 3)]
for name in ("z.tif", "z.shd", "look2.exr", "look3.exr"):
    (t.folder / name).unlink()
t.expect_run("Make requests", ["batch", "make.rib", "-j", "3"], 0, "finished 3 of 3")
t.expect([x["name"] for x in plan_of("make.batch")] == ["0001.maps", "make000", "0002.render", "0003.render"], "are tasks of their own")
t.expect(all(json.loads(t.run("info", "--json", f"look{i}.exr").stdout)["channels"][0]["mean"] > 0 for i in (2, 3)), "and frames find what they make")

# The command prepare works by itself.
t.expect_run("prepare of a scene that needs no maps", ["prepare", "make.rib", "--frames", "2", "--makes", "none"], 0, "prepare-unused")
t.expect_run("prepare without a folder", ["prepare", "rooms.rib", *GI, "--frames", "1"], 2, "prepare-folder")
t.expect_run("a part that is none", ["prepare", "rooms.rib", *GI, "--pass", "photons", "--part", "4/3", "--atlas", "x"], 1, "--part")
t.expect_run("maps without photons", ["prepare", "rooms.rib", *GI, "--pass", "maps", "--atlas", "x", "--frames", "1"], 2, "has no photons")
t.expect_run("joining what is not there", ["prepare", "rooms.rib", *GI, "--pass", "join", "--part", "2/2", "--atlas", "x", "--frames", "1"], 2, "0001of0002.ptc")
t.run("prepare", "rooms.rib", *GI, "--pass", "photons", "--part", "1/2", "--atlas", "x", "--frames", "1", "-q")
t.run("prepare", "rooms.rib", *GI, "--pass", "photons", "--part", "2/2", "--atlas", "x", "--frames", "1", "-q", "--seed", "5")
t.expect_run("parts of different runs", ["prepare", "rooms.rib", *GI, "--pass", "join", "--part", "2/2", "--atlas", "x", "--frames", "1"], 2, "is not part 2 of 2")
half = (t.folder / "x/parts/0001of0002.ptc").read_bytes()
(t.folder / "x/parts/0001of0002.ptc").write_bytes(half[:len(half) // 2])
t.expect_run("half a part", ["prepare", "rooms.rib", *GI, "--pass", "join", "--part", "2/2", "--atlas", "x", "--frames", "1"], 2, "0001of0002.ptc")
t.expect(not list((t.folder / "x/photons").glob("*.ptc")), "makes no photon map")
t.finish()
