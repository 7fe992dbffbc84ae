"""Compares air between transparent layers with the law of Beer and Lambert. Sheets stand before one another in fog, and each pixel
sees some of them."""
import math
import pathlib
import subprocess
import sys
import tempfile

from pictures import pixels

tomales = sys.argv[1]
failures = []
FOG, DISTANCE = (0.2, 0.4, 0.8), 5.0
# The sheets have one width, and each is further to the right than the one before. A row has the depth, the colour, the opacity and the
# first of eight columns.
SHEETS = [(2, (1, 0, 0), 0.25, 0), (3, (0, 1, 0), 0.5, 1), (4.5, (0.5, 0.5, 1), 0.75, 2), (7, (1, 1, 0), 0.9, 3), (12, (1, 1, 1), 1, 4)]


def expect(condition, message):
    print(("ok      " if condition else "FAILED  ") + message)
    if not condition:
        failures.append(message)


def scene(sheets, interpolation):
    text = f"""Display "out.exr" "file" "rgba"
Display "+deep.exr" "deepexr" "rgba"
Format 64 8 1
PixelSamples 2 2
PixelFilter "box" 1 1
Projection "orthographic"
ScreenWindow 0 8 0 1
WorldBegin
ShadingInterpolation "{interpolation}"
Surface "constant"
Atmosphere "fog" "distance" [{DISTANCE}] "background" [{FOG[0]} {FOG[1]} {FOG[2]}]
"""
    for z, color, opacity, first in sheets:
        text += "Color [%g %g %g] Opacity [%g %g %g]\n" % (*color, opacity, opacity, opacity)
        text += f'Polygon "P" [{first} 0 {z} {first + 4} 0 {z} {first + 4} 1 {z} {first} 1 {z}]\n'
    return text + "WorldEnd\n"


def beer_lambert(layers):
    """Returns colour and alpha. The air ends at the last layer."""
    color, clear, before = [0.0, 0.0, 0.0], 1.0, 0.0
    for z, own, opacity, _ in layers:
        passes = math.exp(-(z - before) / DISTANCE)
        for k in range(3):
            color[k] += clear * ((1 - passes) * FOG[k] + passes * opacity * own[k])
        clear *= passes * (1 - opacity)
        before = z
    return (*color, 1 - clear)


with tempfile.TemporaryDirectory() as name:
    folder = pathlib.Path(name)
    for interpolation in ("constant", "smooth"):
        for order in (SHEETS, SHEETS[::-1]):
            (folder / "air.rib").write_text(scene(order, interpolation))
            subprocess.run([tomales, "air.rib", "-q"], cwd=folder, check=True)
            picture = pixels(folder / "out.exr")
            subprocess.run(["oiiotool", "-q", "deep.exr", "--flatten", "-o", "flat.exr"], cwd=folder, check=True)
            flat = pixels(folder / "flat.exr")
            apart = max(abs(a - b) for at in picture for a, b in zip(picture[at], flat[at][:4]))
            expect(apart < 2e-3, f"{interpolation}, first {order[0][0]}: deep pixels, flattened, are apart by at most {apart:.1e}")
            worst = 0.0
            for column in range(8):
                truth = beer_lambert([s for s in SHEETS if s[3] <= column < s[3] + 4])
                seen = picture[8 * column + 4, 4]
                worst = max(worst, *(abs(a - b) for a, b in zip(seen, truth)))
            expect(worst < 2e-4, f"{interpolation}, first {order[0][0]}: differs from Beer and Lambert by at most {worst:.1e}")

sys.exit(bool(failures))
