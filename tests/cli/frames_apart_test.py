"""Tests that unwanted frames are skipped without being read (--frames-apart), with the same bits as if they were read. A batch
does so if nothing in a frame outlives it. Make requests are chosen by their places (--makes)."""
import json

from moving_ball import frame, head
from program import Suite

t = Suite()
HEAD = head(64, 48)
FRAMES = [frame(i, 32, 0.2).replace("WorldBegin\n", "WorldBegin\nAttribute \"light\" \"shadows\" [\"on\"]\n") for i in range(1, 5)]
t.write("shot.rib", HEAD + "".join(FRAMES))
t.run("catrib", "shot.rib", "-o", "binary.rib", "--binary")
t.run("shot.rib", "-o", "one.#.exr", "-q")


def same(a, b):
    return json.loads(t.run("compare", a, b, "--json").stdout or "{}").get("different_pixels") == 0


def tasks(folder):
    return json.loads((t.folder / folder / "plan.json").read_text())["tasks"]


for name in ("shot.rib", "binary.rib"):
    t.expect_run(f"a frame of {name}", [name, "-o", "apart.#.exr", "--frames", "3", "--frames-apart"], 0)
    t.expect(same("apart.3.exr", "one.3.exr"), "has the bits of reading all")
t.expect_run("hide", ["hide", "shot.rib", "-o", "s.#.dfb", "--frames", "3", "--frames-apart"], 0)
for flag in ((), ("--frames-apart",)):
    t.expect_run("gather finds the world of the frame again", ["gather", "s.3.dfb", "-o", "s.icf", *flag], 0)
    t.expect_run("and so does shade", ["shade", "s.3.dfb", "--irradiance", "s.icf", "-o", "shot.exr", *flag], 0)
    t.expect(same("shot.exr", "one.3.exr"), "with the same bits")

# Errors in skipped frames are not found.
broken = FRAMES[0].replace("WorldBegin", 'WorldBegin\nReadArchive "nowhere.rib"\nNonsense 1 2 "WorldBegin" [ \n')
t.write("broken.rib", HEAD + broken + "FrameBegin 7\nWorldBegin\nSphere 1 -1 1 360\n" + FRAMES[2] + broken)
said = t.run("broken.rib", "-o", "x.#.exr", "--frames", "3").stderr
t.expect("nowhere.rib" in said and "Nonsense" in said, "a frame that is not wanted is read")
t.expect_run("or is not", ["broken.rib", "-o", "x.#.exr", "--frames", "3", "--frames-apart"], 0)
t.expect("broken.rib" not in t.run("broken.rib", "-o", "x.#.exr", "--frames", "3", "--frames-apart").stderr and same("x.3.exr", "one.3.exr"), "and nothing is said of it, even where it does not end")
t.expect_run("a frame that is not there", ["shot.rib", "-o", "x.#.exr", "--frames", "9", "--frames-apart"], 2, "no-frame")
# A plan skips frames unless something outlives them.
for what, text, apart in (("plain frames", HEAD + "".join(FRAMES), True),
                          ("a declaration in a frame", HEAD + FRAMES[0].replace("WorldBegin", 'Declare "shine" "uniform float"\nWorldBegin') + FRAMES[1], False),
                          ("an archive in a frame", HEAD + FRAMES[0].replace("WorldBegin", 'ArchiveBegin "a"\nArchiveEnd\nWorldBegin') + FRAMES[1], False),
                          ("a declaration before them", 'Declare "shine" "uniform float"\n' + HEAD + "".join(FRAMES), True)):
    t.write("plan.rib", text)
    t.run("batch", "plan.rib", "-o", "p.#.exr", "--plan-only", "--plan", what)
    t.expect(all(("--frames-apart" in task["arguments"]) == apart for task in tasks(what)), f"{what}: {'not all' if apart else 'all'} frames are read")
t.write("world.rib", "WorldBegin\nSurface \"matte\"\nSphere 1 -1 1 360\nWorldEnd\n")
t.write("plan.rib", HEAD + "".join(f'FrameBegin {i}\nReadArchive "world.rib"\nFrameEnd\n' for i in (1, 2)))
t.run("batch", "plan.rib", "-o", "w.#.exr", "--plan-only", "--plan", "worlds")
t.expect("--frames-apart" not in tasks("worlds")[0]["arguments"], "worlds in archives could not be counted")

# Make requests are chosen by their places.
t.run("shot.rib", "-o", "pic.#.tif", "--frames", "1-2", "-q")
t.write("makes.rib", "".join(f'MakeTexture "pic.{1 + i % 2}.tif" "t{i}.tx" "periodic" "periodic" "box" 1 1\n' for i in range(4)) + HEAD + FRAMES[0])
t.expect_run("some Make requests alone", ["makes.rib", "--frames", "none", "--makes", "1-2"], 0)
t.expect(sorted(p.name for p in t.folder.glob("*.tx")) == ["t1.tx", "t2.tx"], "make what they name")
t.expect_run("none of them", ["makes.rib", "-o", "m.#.exr", "--makes", "none"], 0)
t.expect(sorted(p.name for p in t.folder.glob("*.tx")) == ["t1.tx", "t2.tx"] and same("m.1.exr", "one.1.exr"), "makes none")
t.expect_run("places that are none", ["makes.rib", "--makes", "x"], 1, "--makes")
t.finish()
