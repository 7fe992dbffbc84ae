"""Tests blobbies that merge while the shutter is open: the picture must be the mean of still pictures, and have no holes at any size.

    merging_test.py tomales
"""
import pathlib
import statistics
import subprocess
import sys
import tempfile

from pictures import pixels

tomales = pathlib.Path(sys.argv[1]).resolve()
SCENE = """Format 96 64 1
PixelSamples 8 8
PixelFilter "box" 1 1
Shutter 0 1
Projection "orthographic"
ScreenWindow -0.6 0.6 -0.4 0.4
Translate 0 0 3
WorldBegin
Surface "constant"
{keys}
WorldEnd
"""
failures = []


def blobby(share):
    """Returns two balls that do not yet meet at share 0, and have merged to a thick neck at 1."""
    balls = ((-0.72 + 0.22 * share, 1), (0.6, 1 + 0.2 * share))
    floats = " ".join(f"{size} 0 0 0 0 {size} 0 0 0 0 {size} 0 {x} 0 0 1" for x, size in balls)
    return f'Blobby 2 [1001 0 1001 16 0 2 0 1] [{floats}] [""]'


def points(share):
    """Returns the same balls as Points."""
    return f'Points "P" [{-0.72 + 0.22 * share} 0 0  0.6 0 0] "varying float width" [1 {1 + 0.2 * share}] "uniform string type" ["blobby"]'


def render(folder, keys, *options):
    (folder / "a.rib").write_text(SCENE.format(keys=keys))
    done = subprocess.run([tomales, "render", "a.rib", "-o", "a.exr", *options], cwd=folder, capture_output=True, text=True)
    if done.returncode or done.stderr:
        failures.append(f"{options}: exit code {done.returncode}: {done.stderr[:500]}")
    return {at: value[3] for at, value in pixels(folder / "a.exr").items()}


with tempfile.TemporaryDirectory() as name:
    folder = pathlib.Path(name)
    moments = 24
    stills = [render(folder, blobby((k + 0.5) / moments)) for k in range(moments)]
    expected = {at: statistics.fmean(still[at] for still in stills) for at in stills[0]}
    for shape in (blobby, points):
        moving = f"MotionBegin [0 1]\n{shape(0)}\n{shape(1)}\nMotionEnd"
        seen = render(folder, moving)
        worst, mean = (of(abs(seen[at] - expected[at]) for at in expected) for of in (max, statistics.fmean))
        print(f"{shape.__name__}: differs from stills by at most {worst:.3f}, {mean:.4f} in the mean")
        if worst > 0.12 or mean > 0.007:
            failures.append(f"{shape.__name__} differs from the mean of still ones by at most {worst:.3f}, {mean:.4f} in the mean")
        render(folder, moving, "--format", "480x320", "--pixel-samples", "4x4")
print("\n".join(failures))
sys.exit(bool(failures))
