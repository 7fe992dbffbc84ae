"""Tests that --audit states the error of a picture and does not change it, whatever the threads, the buckets and the commands that make it."""
import json
import pathlib
import sys

from lit_room import ROOM
from program import Suite

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "image"))
import exr  # noqa: E402
from pictures import pixels  # noqa: E402

t = Suite()
t.write("room.rib", ROOM)
t.write("dark.rib", ROOM.replace('"intensity" [4]', '"intensity" [0]').replace('"intensity" [2]', '"intensity" [0]').replace('Surface "constant"', 'Surface "matte"'))


def render(out, *arguments, command=("room.rib",)):
    """Returns what the audit says in the message, in the header and in the statistics."""
    result = t.run(*command, "-o", out, "--stats", "stats.json", *arguments)
    said = [line for line in result.stderr.splitlines() if line.endswith("[audit]")]
    return result, said, exr.texts(t.folder / out), json.loads((t.folder / "stats.json").read_text()).get("audit")


result, said, header, nothing = render("plain.exr")
t.expect(not said and nothing is None and "tomales:audit" not in header, "without --audit nothing is said")
plain = pixels(t.folder / "plain.exr")

result, said, header, figures = render("audited.exr", "--audit=30", "-t", "1")
t.expect(result.returncode == 0 and len(said) == 1, "one line says the error, and the exit code is 0")
sentence = said[0].split("note: ")[1].removesuffix(" [audit]")
t.expect(header["tomales:audit"] == sentence, "the header of the picture has it too")
t.expect("indirect light" in sentence and "direct light" in sentence and "30 pixels" in sentence, f"it names its sources: {sentence}")
t.expect(pixels(t.folder / "audited.exr") == plain, "the picture is the same bit for bit")
t.expect(all(0 < figures[k]["low"] <= figures[k]["mean"] <= figures[k]["high"] < 1 for k in ("picture", "indirect", "direct")),
         f"the statistics have figures with intervals: {figures}")
for what, arguments in {"four threads": ("-t", "4"), "other buckets": ("--bucket-size", "7"), "little memory": ("--memory-limit", "1M")}.items():
    t.expect(render("again.exr", "--audit=30", *arguments)[1] == said, f"{what}: the same line")
t.expect(render("seed.exr", "--audit=30", "--light-seed", "9")[1] != said, "another seed looks at other pixels")

t.run("hide", "room.rib", "-o", "room.dfb")
t.run("gather", "room.dfb", "-o", "room.icf")
t.expect(render("shot.exr", "--audit=30", command=("shade", "room.dfb"))[1] == said, "a shot that is shaded has the same line")
t.expect(render("shot.exr", "--audit=30", "--irradiance", "room.icf", command=("shade", "room.dfb"))[1] == said,
         "and with the records of a file")
t.expect(pixels(t.folder / "shot.exr") == plain, "which has the same picture, audited or not")

rough = render("rough.exr", "--audit=100", "--samples", "4", "--max-error", "5", "--light-samples", "1")[3]
fine = render("fine.exr", "--audit=30", "--samples", "600", "--max-error", "0.2", "--light-samples", "64")[3]
for light in ("indirect", "direct", "picture"):
    t.expect(rough[light]["low"] > fine[light]["high"], f"{light}: few rays err by {rough[light]['mean']:.3f}, many by {fine[light]['mean']:.3f}")
traced = render("traced.exr", "--audit=100", "--gi", "reference", "--samples", "256", "--ray-geometry", "scene")[3]
t.expect(traced["indirect"]["high"] < rough["indirect"]["low"] / 3, f"path tracing errs little: {traced['indirect']['mean']:.4f}")

for method in ("radiosity", "atlas", "progressive"):
    figures = render("method.exr", "--audit=30", "--gi", method, "--photons", "20000", "--bounces", "1")[3]
    t.expect(0 < figures["indirect"]["mean"] < 0.3, f"--gi {method} is audited: {figures['indirect']['mean']:.3f}")
t.run("room.rib", "--baked", "light", "-o", "bake.exr")
figures = render("baked.exr", "--audit=30", "--gi", "baked", "--baked", "light")[3]
t.expect(0 < figures["indirect"]["mean"] < 0.3, f"so is baked light: {figures['indirect']['mean']:.3f}")
t.run("room.rib", "--gi", "none", "-o", "other.exr")
_, said, _, figures = render("none.exr", "--audit", "--gi", "none")
t.expect("there is no indirect light to audit" in said[0] and "indirect" not in figures, "--gi none has no indirect light to audit")
t.expect(pixels(t.folder / "none.exr") == pixels(t.folder / "other.exr"), "a frame that would leave in rows has the same picture")
_, said, header, _ = render("dark.exr", "--audit", command=("dark.rib",))
t.expect("nothing to audit" in said[0], "a dark picture has nothing to audit")

# The floor shows what lies in the mirrored direction, which a hemisphere's mean direction does not tell.
GLOSSY = '''Display "glossy.exr" "openexr" "rgb" Format 24 16 1 PixelSamples 2 2 PixelFilter "box" 1 1
Projection "perspective" "fov" [50] Translate 0 -0.5 3 Rotate -15 1 0 0
WorldBegin
LightSource "indirectlight" 1 "float samples" [256] "float maxerror" [0.5]
Attribute "visibility" "int diffuse" [1] "int specular" [1]
Surface "constant" Polygon "P" [-2 0 2  -0.5 0 2  -0.5 1.5 2  -2 1.5 2]
Surface "{}" "float Ka" [0] "float roughness" [0.1] Polygon "P" [-2 0 -1  2 0 -1  2 0 2  -2 0 2]
WorldEnd
'''
for surface in ("metal", "matte"):
    t.write(f"{surface}.rib", GLOSSY.format(surface))
t.write("small.rib", GLOSSY.format("metal").replace("-0.5 0 2  -0.5 1.5 2  -2 1.5 2", "-1.4 0 2  -1.4 0.6 2  -2 0.6 2").replace('"constant"', '"constant" Color [9 9 9]'))
for name in ("metal", "small"):
    _, said, _, figures = render(f"{name}.exr", "--audit=384", command=(f"{name}.rib",))
    t.run(f"{name}.rib", "-o", "truth.exr", "--gi", "reference", "--samples", "1024", "--light-samples", "1024")
    picture, truth = pixels(t.folder / f"{name}.exr"), pixels(t.folder / "truth.exr")
    errors = [sum(abs(x - y) / (y + 0.01) for x, y in zip(picture[p][:3], truth[p][:3])) / 3 for p in picture if max(*truth[p][:3], *picture[p][:3]) > 0]
    true = sum(errors) / len(errors)
    t.expect(true > 0.05 and figures["picture"]["low"] < true < figures["picture"]["high"],
             f"{name}: highlights of indirect light are in the error: {true:.3f}, {figures['picture']}")
    t.expect("its highlights" in said[0] and abs(figures["highlights"]["mean"] / true - 1) < 0.35, f"and most of it: {said[0]}")
figures = render("matte.exr", "--audit=100", command=("matte.rib",))[3]
t.expect("highlights" not in figures and figures["indirect"]["mean"] < 0.03, f"a matte floor has none: {figures}")

for bad in ("--audit=0", "--audit=-3", "--audit=some", "--audit=1e9"):
    t.expect_run(f"{bad} is refused", ["room.rib", bad], 1, "--audit")
t.finish()
