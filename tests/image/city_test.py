"""Runs the whole chain of the irradiance atlas over 47 photon maps, on scenes/city at scale 0.01, and checks its results."""
import json
import pathlib
import subprocess
import sys
import tempfile

from pictures import pixels

program, source = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2])
failures = 0


def expect(condition, message):
    global failures
    print(("ok      " if condition else "FAILED  ") + message)
    failures += not condition


with tempfile.TemporaryDirectory() as name:
    folder = pathlib.Path(name)
    subprocess.run([sys.executable, source / "scenes/city/make_city.py", folder, "0.01"], check=True, stdout=subprocess.DEVNULL)

    def render(out, *arguments):
        subprocess.run([program, "render", "city.rib", "-q", "--format", "160x86", "--pixel-samples", "2x2", "-o", out, "--stats", "stats.json", *arguments],
                       cwd=folder, check=True, timeout=500)
        return pixels(folder / out), json.loads((folder / "stats.json").read_text())

    def mean(picture):
        return sum(sum(c[:3]) for c in picture.values()) / len(picture) / 3

    atlas = ("--gi", "atlas", "--atlas", "maps", "--photons", "200000", "--samples", "32")
    direct, _ = render("direct.exr", "--gi", "none")
    final, first = render("final.exr", *atlas)
    again, second = render("again.exr", *atlas, "--brick-cache", "1000000")
    expect(first["photons"]["groups"] == 47, "47 photon maps")
    expect(second["photons"]["emitted"] == 0 and second["photons"]["groups_kept"] == 47, "are used again")
    expect(final == again, "and a cache of 1 MB changes no pixel")
    expect(first["bricks"]["hit_rate"] > 0.99, f"cache hits: {100 * first['bricks']['hit_rate']:.2f} %")
    dark = [xy for xy, c in direct.items() if max(c[:3]) < 1e-4 and xy[1] > 43]
    lit = sum(max(final[xy][:3]) > 1e-3 for xy in dark) / len(dark)
    expect(lit > 0.7, f"light reaches what the sun does not: {100 * lit:.1f} % of {len(dark)} pixels")
    expect(mean(direct) < mean(final) < 2 * mean(direct) + 0.2, f"and not too much: mean {mean(direct):.3f} -> {mean(final):.3f}")
    expect(max(max(c[:3]) for xy, c in final.items() if xy in set(dark)) < 2, "no pixel in the shade shines")
sys.exit(bool(failures))
