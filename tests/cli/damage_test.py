"""Tests disks that fill up, folders that vanish, and truncated files: each gives a clear message and the documented exit code, and finished files are
kept. (The unit tests of Dfb and RecordFiles flip every byte, and shot_test.py kills runs.)"""
import resource
import shutil
import signal
import subprocess

from program import GOOD, Suite

t = Suite()
LIT = GOOD.replace("LightSource", 'LightSource "indirectlight" 2 "float samples" [16]\nLightSource', 1).replace("Sphere", "Sphere 1 -1 1 360\nPolygon \"P\" [-3 -1 -3 -3 -1 3 3 -1 3 3 -1 -3]\nSphere", 1)
t.write("lit.rib", LIT.replace("Format 24 24 1", "Format 120 120 1"))
t.write("good.rib", GOOD)


def limited(size, *arguments):
    """Runs the command with files of no more than `size` bytes, as on a full disk."""
    def limit():
        signal.signal(signal.SIGXFSZ, signal.SIG_DFL)  # The signal acts as under ulimit -f.
        resource.setrlimit(resource.RLIMIT_FSIZE, (size, size))
    return subprocess.run([t.program, *arguments], cwd=t.folder, capture_output=True, text=True, preexec_fn=limit, timeout=60)


def expect_said(result, code, what, *says):
    t.expect(result.returncode == code and all(s in result.stderr for s in says), f"{what} (exit {result.returncode}) {result.stderr[-200:] if result.returncode != code else ''}")


expect_said(limited(3000, "good.rib", "--format", "300x300", "-o", "full.exr"), 4, "a disk too full for the picture", "full.exr", "could not be written")
t.expect(not list(t.folder.glob("*full.exr*")), "leaves nothing half-written")
expect_said(limited(30000, "lit.rib", "-o", "spill.exr", "--memory-limit", "1K"), 4, "a disk too full for the buckets that do not fit into memory",
            "do not fit into memory", "some are left out")
expect_said(limited(30000, "lit.rib", "-o", "resume.exr", "--resume"), 4, "a disk too full for buckets and picture", "resume.exr", "could not be written")
t.expect((t.folder / "resume.exr.dfb.part").exists(), "keeps the buckets that were finished")
t.expect_run("for a run with more room", ["lit.rib", "-o", "resume.exr", "--resume", "-v"], 0, "buckets were finished before")
t.run("hide", "good.rib", "-o", "good.dfb", "-q")
expect_said(limited(100, "gather", "good.dfb", "-o", "good.icf"), 4, "a disk too full for records", "good.icf", "could not be written")

# Memory is too small, for a frame that needs none for rays and then for one that does. (Sanitizers need more memory
# than the test allows.)
t.write("two.rib", "FrameBegin 1\n" + GOOD + "FrameEnd\nFrameBegin 2\n" + LIT.replace("Format 24 24 1", "Format 400 400 1") + "FrameEnd\n")


def starved(megabytes, *arguments):
    limit = (megabytes << 20,) * 2
    return subprocess.run([t.program, *arguments], cwd=t.folder, capture_output=True, text=True, preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, limit), timeout=60)


if starved(300, "--version").returncode == 0:
    codes, kept = set(), False
    stacks = 3 * 64  # Three threads have stacks for deep paths. These take only address space, which the limit counts.
    for megabytes in range(80 + stacks, 200 + stacks, 10):
        (t.folder / "frame1.exr").unlink(missing_ok=True)
        ended = starved(megabytes, "two.rib", "-o", "frame#.exr", "-t", "2", "-q")
        codes.add(ended.returncode)
        told = ended.returncode == 0 or ended.returncode == 4 and ("out of memory" in ended.stderr or "little memory" in ended.stderr or "pthread_create" in ended.stderr)
        t.expect(told, f"{megabytes} MB of memory end with a message (exit {ended.returncode}) {ended.stderr[-200:]}")
        first = (t.folder / "frame1.exr").exists()
        failures = [line for line in ended.stderr.splitlines() if "[frame-failed]" in line]
        t.expect(first or any("two.rib:17" not in line for line in failures), "and the first frame is there, or its own message says that it is not")
        kept = kept or first and bool(failures)
    t.expect(4 in codes, f"some of these were too few: {codes}")
    t.expect(kept, "a first frame stays when the second one needs too much")

# A folder vanishes while the frame is made.
(t.folder / "gone").mkdir()
process = subprocess.Popen([t.program, "good.rib", "-o", "gone/a.exr", "--format", "700x700", "--progress", "-t", "1"], cwd=t.folder,
                           stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
process.stdout.readline()
shutil.rmtree(t.folder / "gone")
_, said = process.communicate(timeout=100)
t.expect(process.returncode == 4 and "gone/a.exr" in said, "a folder that vanishes on the way " + said[-200:])

# Files of our own formats are truncated.
whole = (t.folder / "good.dfb").read_bytes()
for end in (0, 7, 31, 32, 200, len(whole) // 2, len(whole) - 1):
    t.write("cut.dfb", whole[:end])
    t.expect_run(f"a .dfb of {end} bytes", ["shade", "cut.dfb", "-o", "cut.exr"], 2, "cut.dfb")
t.write("newer.dfb", whole[:8] + b"\xff" + whole[9:])
t.expect_run("a .dfb of another version", ["shade", "newer.dfb", "-o", "cut.exr"], 2, "newer.dfb")

# Nobody writes a channel of that name, and no machine holds so large a deep picture.
t.write("aov.rib", 'Display "a.exr" "file" "rgba"\nDisplay "+b.exr" "file" "color nobody"\n' + GOOD.split("\n", 1)[1])
t.expect_run("a channel that no shader writes", ["aov.rib"], 0, "aov.rib:2", "nobody")
t.expect((t.folder / "b.exr").exists(), "is written with its fill")
t.write("late.rib", 'Display "a.exr" "file" "rgba"\nDisplay "+b.exr" "file" "color nobody"\nDisplay "+c.exr" "file" "color diffuse"\nArchiveBegin "ball"\nSphere 1 -1 1 360\nArchiveEnd\n' +
        GOOD.split("\n", 1)[1].replace("Sphere 1 -1 1 360", 'Procedural "DelayedReadArchive" ["ball"] [-1 1 -1 1 -1 1]'))
late = t.expect_run("or none of a procedural", ["late.rib"], 0, "late.rib:2", "nobody")
t.expect("diffuse" not in late.stderr, "while what those of a procedural write is known " + late.stderr)
t.write("deep.rib", 'Display "deep.exr" "deepexr" "rgba"\n' + GOOD.split("\n", 1)[1])
t.expect_run("a deep picture beyond all memory", ["deep.rib", "--format", "65536x65536", "--bucket-size", "16"], 4, "--crop")
t.finish()
