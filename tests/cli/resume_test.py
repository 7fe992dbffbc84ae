"""Tests --resume: a frame that was interrupted or killed reuses its records, maps of light and shaded buckets. It must have the bits of
an uninterrupted frame."""
import json
import signal
import subprocess

from program import Suite

t = Suite()
SCENE = """Display "room.exr" "file" "rgba"
Format 40 30 1
PixelSamples 2 2
Projection "perspective" "fov" [60]
WorldBegin
LightSource "indirectlight" 1 "samples" [%d] "bounces" [3]
LightSource "pointlight" 2 "from" [0 0.5 3] "intensity" [%g]
Surface "%s"
Attribute "identifier" "name" "back"
Polygon "P" [-2 -2 5  2 -2 5  2 2 5  -2 2 5]
Color [0.9 0.3 0.2]
Attribute "identifier" "name" "floor"
Polygon "P" [-2 -1 1  2 -1 1  2 -1 5  -2 -1 5]
Translate 0.4 -0.4 3.5
Sphere 0.6 -0.6 0.6 360
WorldEnd
"""
t.write("room.rib", SCENE % (800, 4, "matte"))
t.write("bright.rib", SCENE % (800, 5, "matte"))
t.write("baking.sl", 'surface baking() { bake3d("room.ptc", "", P, normalize(N), "color", Cs); Oi = Os; Ci = Cs * diffuse(normalize(N)); }')
t.write("baking.rib", SCENE % (64, 4, "baking"))


def rays(name):
    return sum(json.loads((t.folder / name).read_text())["rays"].values())


def shaded(name):
    return json.loads((t.folder / name).read_text())["shade"]["vertices_shaded"]


def cut(at, number, *line):
    """Starts a frame and sends it a signal when it has reached this percentage. If the signal comes so late that nothing is left to resume,
    the frame is rendered again."""
    for _ in range(5):
        process = subprocess.Popen([t.program, *line, "--resume", "--progress", "-q", "-t", "2", "--stats", "cut.json"],
                                   cwd=t.folder, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        for said in process.stdout:
            if said.startswith("R90000") and int(said.split()[1].rstrip("%")) >= at:
                break
        process.send_signal(number)
        process.communicate(timeout=200)
        if process.returncode != 0 and list(t.folder.glob("*.kept.part")):
            break
        for name in ("room.exr", "room.icf", "room.ptc"):
            (t.folder / name).unlink(missing_ok=True)
    t.expect(process.returncode in (-number, 128 + number), f"{' '.join(line)}: ended by signal {int(number)} at {at} %")


def resumed(*line):
    """Resumes the frame, which must have the bits of a whole frame. Returns the share of all rays that the resumed run traces."""
    t.expect_run("    goes on", [*line, "--resume", "--stats", "rest.json", "-t", "2"], 0)
    t.run(*line, "-o", "whole.exr", "--stats", "whole.json", "-q")
    t.expect((t.folder / "room.exr").read_bytes() == (t.folder / "whole.exr").read_bytes(), "    and has the same bits")
    t.expect(not [p.name for p in t.folder.iterdir() if ".part" in p.name or ".kept" in p.name], "    and leaves nothing else")
    (t.folder / "room.exr").unlink()
    return rays("rest.json") / rays("whole.json")


for at, number in ((40, signal.SIGKILL), (60, signal.SIGTERM), (85, signal.SIGKILL)):
    cut(at, number, "room.rib")
    share = resumed("room.rib")
    t.expect(share < {40: 0.95, 60: 0.6, 85: 0.1}[at], f"    with {share:.3f} of its rays")
    points = shaded("rest.json") / shaded("whole.json")
    t.expect(points < {40: 0.95, 60: 0.6, 85: 0.002}[at], f"    and {points:.4f} of its points, which are those of hits, too")
    if number == signal.SIGTERM:
        redone = (rays("cut.json") + rays("rest.json") - rays("whole.json")) / rays("cut.json")
        t.expect(redone < 0.1, f"    of which {redone:.3f} had been traced before")

for option, value in (("--seed", "3"), ("--crop", "0,0.5,0,1")):
    cut(60, signal.SIGKILL, "room.rib")
    t.run("room.rib", "-o", "whole.exr", option, value, "-q")
    t.run("room.rib", "--resume", option, value, "-q")
    t.expect((t.folder / "room.exr").read_bytes() == (t.folder / "whole.exr").read_bytes(), f"another {option[2:]} takes nothing over")
    (t.folder / "room.exr").unlink()
cut(60, signal.SIGKILL, "bright.rib")
t.expect(resumed("room.rib") > 0.99, "nor does another light")

cut(60, signal.SIGKILL, "room.rib")
kept = t.folder / "room.exr.kept.part"
whole = bytearray(kept.read_bytes())
whole[len(whole) // 2] ^= 0x40
kept.write_bytes(whole)
share = resumed("room.rib")
t.expect(0.1 < share < 1, f"what follows damage is made again ({share:.3f})")

for method in ("radiosity", "atlas"):
    cut(60, signal.SIGKILL, "room.rib", "--gi", method, "--photons", "50000")
    share = resumed("room.rib", "--gi", method, "--photons", "50000")
    t.expect(share < 0.6, f"{method}: {share:.3f} of its rays")

counted = ("--gi", "progressive", "--photons", "2000000")
cut(60, signal.SIGKILL, "room.rib", *counted)
share = resumed("room.rib", *counted)
t.expect(share < 0.6, f"progressive: {share:.3f} of its photons")

t.run("hide", "room.rib", "-o", "room.dfb", "-q")
t.run("gather", "room.dfb", "-o", "whole.icf", "--stats", "whole.json", "-q")
for at, number in ((20, signal.SIGKILL), (60, signal.SIGTERM)):
    cut(at, number, "gather", "room.dfb", "-o", "room.icf")
    t.expect_run("    goes on", ["gather", "room.dfb", "-o", "room.icf", "--resume", "--stats", "rest.json", "-t", "2"], 0)
    t.expect((t.folder / "room.icf").read_bytes() == (t.folder / "whole.icf").read_bytes(), "    and has the same bits")
    share = rays("rest.json") / rays("whole.json")
    t.expect(share < {20: 0.95, 60: 0.6}[at], f"    with {share:.3f} of its rays")
    t.expect(not list(t.folder.glob("room.icf.*")), "    and leaves nothing else")
cut(60, signal.SIGKILL, "gather", "room.dfb", "-o", "room.icf")
t.run("gather", "room.dfb", "-o", "room.icf", "--resume", "--light-seed", "3", "--stats", "rest.json", "-q")
t.expect(rays("rest.json") > 0.9 * rays("whole.json"), "another seed takes nothing over")

cut(85, signal.SIGKILL, "baking.rib")
resumed("baking.rib")
whole = (t.folder / "room.ptc").read_bytes()
(t.folder / "room.ptc").unlink()
cut(85, signal.SIGKILL, "baking.rib")
t.run("baking.rib", "--resume", "-q")
t.expect((t.folder / "room.ptc").read_bytes() == whole, "points that shaders bake are whole")
t.finish()
