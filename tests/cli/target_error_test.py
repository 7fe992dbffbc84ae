"""Tests that --target-error chooses settings that reach an error, reports them, and makes the picture that these settings give on
the command line."""
import json
import pathlib
import re
import sys

from lit_room import ROOM
from program import Suite

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "image"))
import exr  # noqa: E402
from pictures import pixels  # noqa: E402

t = Suite()
t.write("room.rib", ROOM.replace("Format 20 16", "Format 40 32"))
t.write("lamp.rib", ROOM.replace("Format 20 16", "Format 40 32").replace('LightSource "indirectlight"', '# '))


def reach(out, target, *arguments, command=("room.rib",)):
    """Returns the chosen options, what the audit says of the picture, and the result."""
    result = t.run(*command, "-o", out, "--target-error", target, "--stats", "stats.json", *arguments)
    chosen = re.search(r"chose (.*) for a mean error of .* \[target-error\]", result.stderr)
    return chosen and chosen[1].split(), json.loads((t.folder / "stats.json").read_text()).get("audit"), result


def last_of(picture):
    """Returns the settings in the header."""
    return exr.texts(t.folder / picture)["tomales:chosen"].split()


def setting(options, name):
    return float(options[options.index(name) + 1])


coarse, coarse_audit, result = reach("coarse.exr", "8%", "-t", "1")
t.expect(result.returncode == 0 and coarse_audit["picture"]["mean"] < 0.088, f"8 % is reached: {coarse_audit['picture']['mean']:.4f}, {coarse}")
fine, fine_audit, result = reach("fine.exr", "2%")
t.expect(fine_audit["picture"]["mean"] < 0.022 and "target-missed" not in result.stderr, f"2 % is reached: {fine_audit['picture']['mean']:.4f}, {fine}")
t.expect(setting(fine, "--light-samples") > setting(coarse, "--light-samples"), "with more samples of the lamp")
t.expect(setting(fine, "--samples") / setting(fine, "--max-error") > setting(coarse, "--samples") / setting(coarse, "--max-error"),
         "and with more rays, or narrower records")
last = last_of("fine.exr")
t.run("room.rib", "-o", "byhand.exr", *last)
t.expect(pixels(t.folder / "byhand.exr") == pixels(t.folder / "fine.exr"), f"the header says what gives the same picture: {last}")
reach("threads.exr", "2%", "-t", "3")
t.expect(pixels(t.folder / "threads.exr") == pixels(t.folder / "fine.exr"), "three threads find the same picture")

t.run("hide", "room.rib", "-o", "room.dfb")
shot, _, _ = reach("shot.exr", "2%", command=("shade", "room.dfb"))
t.expect(shot == fine and pixels(t.folder / "shot.exr") == pixels(t.folder / "fine.exr"), "and so does a shot that is shaded")

lamp, audit, _ = reach("lamp.exr", "1%", command=("lamp.rib",))
t.expect(lamp[0] == "--light-samples" and len(lamp) == 2 and audit["picture"]["mean"] < 0.011, f"without indirect light the lamp alone is chosen for: {lamp}")
_, audit, result = reach("beyond.exr", "0.0001%", "--audit=20", command=("lamp.rib",))
t.expect("[target-beyond]" in result.stderr and re.search(r"beyond what .* can reach here: [0-9.e-]+ % .* or [0-9.]+ (s|min) here and now", result.stderr),
         f"an error that no settings reach is told at once, with what they reach and the time: {result.stderr[:400]}")
t.expect("[target-missed]" in result.stderr and setting(last_of("beyond.exr"), "--light-samples") == 1024, "the best settings are tried")
_, audit, result = reach("paths.exr", "10%", "--gi", "reference", "--ray-geometry", "scene")
t.expect(result.returncode == 0 and audit["picture"]["mean"] < 0.11, f"paths of the reference are chosen: {audit['picture']['mean']:.4f}")
_, audit, result = reach("progressive.exr", "5%", "--gi", "progressive", "--photons", "20000")
t.expect("[target-unused]" in result.stderr and "indirect" in audit, "light of photons is audited alone, which is said")

for bad in ("0%", "0", "-2%", "100%", "nan", "much", "2"):
    t.expect_run(f"--target-error {bad} is refused, with the range that is allowed", ["room.rib", f"--target-error={bad}"], 1, "--target-error", "more than 0% and less than 100%")
t.expect_run("so is --target-smudges 0%", ["room.rib", "--target-error=2%", "--target-smudges=0%"], 1, "--target-smudges", "more than 0% and less than 100%")
def within(seconds):
    result = t.run("room.rib", "-o", "budget.exr", "--time-budget", seconds, "--stats", "stats.json")
    chosen = re.search(r"chose (.*) for .* s: .* \[time-budget\]", result.stderr)
    t.expect(result.returncode == 0 and chosen and (t.folder / "budget.exr").exists(), f"a budget of {seconds} gives a picture: {result.stderr[-300:]}")
    return chosen[1].split(), result


long, result = within("6s")
held = t.run("room.rib", "-o", "byhand.exr", *last_of("budget.exr"))
t.expect(pixels(t.folder / "byhand.exr") == pixels(t.folder / "budget.exr"), "the settings of a budget give the same picture by hand")
t.expect("[time-over]" not in result.stderr, "6 s are enough for trials")
short, result = within("0.01")
t.expect("[time-over]" in result.stderr, "a hundredth of a second is not, which is said")
t.expect(setting(long, "--samples") / setting(long, "--max-error") > setting(short, "--samples") / setting(short, "--max-error"),
         f"more time brings finer settings: {long} against {short}")
for bad in ("0", "-3", "soon"):
    t.expect_run(f"--time-budget {bad} is refused", ["room.rib", f"--time-budget={bad}"], 1, "--time-budget", "more than 0 s")
t.expect_run("an error and a time exclude each other", ["room.rib", "--target-error", "2%", "--time-budget", "5"], 1, "--time-budget")
t.expect_run("a setting that is chosen cannot be given", ["room.rib", "--target-error", "2%", "--samples", "100"], 1, "--samples")
t.finish()
