"""Tests tomales denoise: two noisy pictures become one that is nearer to the truth and keeps everything else in the first one."""
import json
import re
import subprocess

from program import Suite

t = Suite()
SCENE = """Format 96 72 1
PixelSamples 2 2
Display "out.exr" "openexr" "Ci,a,z,albedo,normal,s" %s
Projection "perspective" "fov" [40]
Translate 0 0 5
WorldBegin
LightSource "environmentlight" 1 "samples" [%d]
Surface "matte"
Color [0.8 0.5 0.3]
Polygon "P" [-4 -1 -4 -4 -1 4 4 -1 4 4 -1 -4]
Color [0.3 0.5 0.8]
Sphere 1 -1 1 360
WorldEnd
"""
t.write("scene.rib", SCENE % ("", 4))
t.write("truth.rib", SCENE % ("", 1024))
t.write("parts.rib", SCENE % ('"multipart" [1]', 4))
for seed in "12":
    t.run("scene.rib", "--light-seed", seed, "-o", f"{seed}.exr", "-q")
    t.run("parts.rib", "--light-seed", seed, "-o", f"p{seed}.exr", "-q")
t.run("truth.rib", "-o", "truth.exr", "-q")


def figures(picture):
    return json.loads(t.run("compare", picture, "truth.exr", "--json").stdout)


def channels(picture):
    return {c["name"]: c for c in json.loads(t.run("info", "--json", picture).stdout)["channels"]}


said = t.expect_run("two halves", ["denoise", "1.exr", "2.exr", "-o", "clean.exr"], 0, "root mean square error").stdout
after, before = (float(v) for v in re.search(r"error ([\d.]+) % of the mean, ([\d.]+) % before", said).groups())
noisy, clean = figures("1.exr")["rmse"], figures("clean.exr")["rmse"]
t.expect(clean < 0.5 * noisy, f"are nearer to the truth: {noisy:.4f}, {clean:.4f}")
t.expect(after < 0.6 * before, f"and state it: {said}")
old, new = channels("1.exr"), channels("clean.exr")
t.expect(list(old) == list(new), "every channel stays")
t.expect(all(old[c] == new[c] for c in old if c not in "RGB") and old["R"] != new["R"], "and all but the colours stay as they are")
header = subprocess.run(["oiiotool", "--info", "-v", "clean.exr"], cwd=t.folder, capture_output=True, text=True).stdout
t.expect("tomales:denoised" in header and "tomales:contents" not in header and "worldToCamera" in header, "so does the header, which says what was done")
t.expect_run("the same again", ["denoise", "1.exr", "2.exr", "-o", "again.exr"], 0)
t.expect((t.folder / "again.exr").read_bytes() == (t.folder / "clean.exr").read_bytes(), "has the same bits")
t.expect_run("pictures in parts", ["denoise", "p1.exr", "p2.exr", "-o", "parts.exr"], 0)
t.expect_run("give the same", ["compare", "parts.exr", "clean.exr"], 0, "different_pixels               0")

t.expect_run("a picture with itself", ["denoise", "1.exr", "1.exr", "-o", "x.exr"], 2, "--light-seed", "[denoise]")
t.expect_run("its own output", ["denoise", "clean.exr", "2.exr", "-o", "x.exr"], 2, "denoised already")
t.expect_run("in place", ["denoise", "1.exr", "2.exr", "-o", "1.exr"], 4, "not written over", "[output-input]")
t.run("scene.rib", "--light-seed", "2", "--format", "48x36", "-o", "small.exr", "-q")
t.expect_run("pictures of other sizes", ["denoise", "1.exr", "small.exr", "-o", "x.exr"], 2, "96x72", "48x36")
t.write("plain.rib", SCENE.replace(",albedo,normal,s", "") % ("", 4))
t.run("plain.rib", "-o", "plain.exr", "-q")
t.expect_run("a picture without guides", ["denoise", "plain.exr", "2.exr", "-o", "x.exr"], 2, "plain.exr", '"albedo"', "Ci,a,z,albedo,normal")
t.expect_run("no picture", ["denoise", "scene.rib", "2.exr", "-o", "x.exr"], 2, "scene.rib")
t.expect_run("a missing picture", ["denoise", "none.exr", "2.exr", "-o", "x.exr"], 2, "none.exr")
t.expect_run("nowhere to write", ["denoise", "1.exr", "2.exr", "-o", "no/x.exr"], 4, "no/x.exr")
whole = (t.folder / "1.exr").read_bytes()
t.write("cut.exr", whole[:len(whole) // 2])
t.expect_run("a damaged picture", ["denoise", "cut.exr", "2.exr", "-o", "x.exr"], 2, "cut.exr")
t.expect(not (t.folder / "x.exr").exists() and not [p.name for p in t.folder.iterdir() if ".part" in p.name], "leave nothing behind")
t.finish()
