"""Tests that the picture has the same bits for any thread count, bucket size and crop, and in every run."""
import pathlib
import subprocess
import sys
import tempfile

from pictures import pixels

tomales, root = sys.argv[1], pathlib.Path(sys.argv[2])
failures = []


def render(scene, *options):
    with tempfile.TemporaryDirectory() as folder:
        out = pathlib.Path(folder) / "out.exr"
        subprocess.run([tomales, "render", str(root / "scenes" / scene), "-o", str(out), "-q", *options], check=True)
        return pixels(out)


def expect_same(a, b, what, window=lambda x, y: True):
    inside = [key for key in b if window(*key)]
    differing = sum(1 for key in inside if a[key] != b[key])
    same = differing == 0 and len(inside) > 0
    print(("ok      " if same else "FAILED  ") + f"{what}: {differing} of {len(inside)} pixels differ")
    if not same:
        failures.append(what)


small = ["--format", "96x96", "--samples", "32"]
whole = render("cornell/cornell.rib", *small, "-t", "1")
expect_same(whole, render("cornell/cornell.rib", *small, "-t", "2"), "two threads against one, with GI")
for size in ("8", "64"):
    expect_same(whole, render("cornell/cornell.rib", *small, "--bucket-size", size), f"buckets of {size} against 16, with GI")
channels = render("displays/channels.rib")
if len(next(iter(channels.values()))) < 30:
    failures.append("channels")
    print("FAILED  channels are missing")
expect_same(channels, render("displays/channels.rib", "--bucket-size", "40", "-t", "1"), "one thread and large buckets, all channels")
expect_same(channels, render("displays/channels.rib", "--crop", "0.25,0.75,0.5,1"), "a crop window, all channels",
            lambda x, y: 80 <= x < 240 and y >= 120)
direct = render("cornell/cornell.rib", *small, "--gi", "none")
crop = render("cornell/cornell.rib", *small, "--gi", "none", "--crop", "0.25,0.75,0.5,1")
expect_same(direct, crop, "a crop window against the whole frame", lambda x, y: 24 <= x < 72 and y >= 48)
if not any(any(c > 0.05 for c in p[:3]) for p in whole.values()):
    failures.append("black")
    print("FAILED  the picture is black")
sys.exit(bool(failures))
