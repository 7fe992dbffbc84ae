"""Tests that settings of light that --target-error finds on a few frames hold for all frames of a run, and for frames of other
runs that read them from a file."""
import json
import pathlib
import sys

from lit_room import ROOM
from program import Suite

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "image"))
import exr  # noqa: E402
from pictures import pixels  # noqa: E402

t = Suite()
# Without indirect light there are only samples of the lamp to choose, which takes little time.
head, world = ROOM.replace("Format 20 16", "Format 24 24").replace('LightSource "indirectlight"', "# ").split("WorldBegin")
FRAMES = 5
t.write("shot.rib", head + "".join(f"FrameBegin {f}\nDisplay \"room.{f:04}.exr\" \"file\" \"rgba\"\nTranslate 0 0 {0.15 * f:.2f}\nWorldBegin{world}FrameEnd\n"
                                   for f in range(1, FRAMES + 1)))
t.write("one.rib", head + "WorldBegin" + world)


def render(*arguments, scene="shot.rib"):
    """Returns the result, the settings in each frame's header, and the frames that have an audit."""
    return run(scene, "-t", "1", *arguments)


def run(*arguments):
    for old in t.folder.glob("room.*.exr"):
        old.unlink()
    result = t.run(*arguments)
    chosen, audited = {}, []
    for f in range(1, FRAMES + 1):
        picture = t.folder / f"room.{f:04}.exr"
        if not picture.exists():
            continue
        header = exr.texts(picture)
        chosen[f] = header.get("tomales:chosen", "")
        audited += [f] if "tomales:audit" in header else []
    return result, chosen, audited


result, chosen, audited = render("--target-error", "2%", "--audit-every", "2")
t.expect(result.returncode == 0 and len(chosen) == FRAMES, f"all frames are rendered: {result.stderr[-500:]}")
t.expect(len(set(chosen.values())) == 1 and "--light-samples" in chosen[1], f"with the same settings: {chosen}")
t.expect(audited == [2, 4], f"every second frame is audited: {audited}")
t.expect("found on frames 1, 3, 5" in result.stderr and "[animation-settings]" in result.stderr, "it says which frames they were found on")
held = pixels(t.folder / "room.0004.exr")
t.run("shot.rib", "--frames", "4", *chosen[4].split())
t.expect(pixels(t.folder / "room.0004.exr") == held, "given by hand they make the same picture")

result, shared, audits = run("batch", "shot.rib", "--target-error", "2%", "--audit-every", "2", "-j", "2")
t.expect(result.returncode == 0 and shared == chosen and audits == audited, f"a batch has them for all its frames: {shared} {result.stderr[-500:]}")
t.expect(pixels(t.folder / "room.0004.exr") == held, "and the bits of one run")
stages = [task["stage"] for task in json.loads((t.folder / "shot.batch/plan.json").read_text())["tasks"]]
t.expect(stages == ["settings"] + FRAMES * ["render"], f"which one task finds before them: {stages}")
_, shared, _ = run("batch", "shot.rib", "--target-error", "2%", "--frames", "4", "--plan", "alone")
t.expect(len(shared) == 1 and len(json.loads((t.folder / "alone/plan.json").read_text())["tasks"]) == 1, "one frame finds its own")
t.write("tiny.rib", (t.folder / "shot.rib").read_text().replace("Format 24 24", "Format 6 6").replace("room.", "tiny."))
t.expect_run("a method without settings of light renders all the same", ["batch", "tiny.rib", "--target-error", "5%", "--gi", "progressive", "--photons", "2000",
             "--frames", "1-2", "--plan", "photons", "-j", "2"], 0, "finished 2 of 2")
t.expect_run("tiles are whole frames' light", ["batch", "shot.rib", "--target-error", "2%", "--tiles", "2x2", "-o", "x.#.exr"], 1, "--tiles", "--target-error")

_, each, _ = render("--target-error", "2%", "--frames", "4")
t.expect(len(each) == 1, "a run of one frame finds its own")
result, other, _ = render("--target-error", "2%", "--frames", "4", "--pilot-frames", "1,3,5", "--animation-settings", "shot.json")
t.expect(other.get(4) == chosen[4] and pixels(t.folder / "room.0004.exr") == held, f"unless pilot frames are named, of which it need not be one: {other}")
kept = json.loads((t.folder / "shot.json").read_text())
t.expect(kept["pilots"] == [1, 3, 5] and len(kept["worlds"]) == 1, f"a file keeps what they chose: {kept}")
result, other, _ = render("--target-error", "2%", "--frames", "2", "--animation-settings", "shot.json")
t.expect(other.get(2) == chosen[4] and "[target-error]" not in result.stderr, "from which another run has them, without trials")
result, _, _ = render("--target-error", "1%", "--frames", "2", "--animation-settings", "shot.json")
t.expect(result.returncode != 0 and "[animation-settings]" in result.stderr, "for another target the file is refused")
t.expect(not (t.folder / "room.0002.exr").exists(), "and nothing is rendered")
t.write("damaged.json", "{")
result, _, _ = render("--target-error", "1%", "--frames", "2", "--animation-settings", "damaged.json")
t.expect(result.returncode != 0 and "damaged.json" in result.stderr, "so is one that is damaged")

text = (t.folder / "shot.rib").read_text()
result = t.run("-", "-t", "1", "--target-error", "2%", stdin=text)
chosen = {exr.texts(t.folder / f"room.{f:04}.exr")["tomales:chosen"] for f in range(1, FRAMES + 1)}
t.expect(result.returncode == 0 and len(chosen) == 1, f"of a stream the first frame decides for all: {chosen}")

result = t.run("one.rib", "-o", "one.exr", "--target-error", "2%")
t.expect("[animation-settings]" not in result.stderr and "[target-error]" in result.stderr, "a scene of one frame chooses as ever")
for bad in ("--audit-every=-1", "--pilot-frames=x"):
    t.expect_run(f"{bad} is refused", ["shot.rib", "--target-error", "1%", bad], 1, bad.split("=")[0])
t.finish()
