"""Compares ambient occlusion with closed forms (docs/measured/rays.md), on a floor beside a sphere that stands on it, and beside an
endless wall.
    occlusion.py TOMALES
The points are a row of pixels. The floor is white and only occlusionlight shines, so a pixel is the open part of the hemisphere."""
import math
import pathlib
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "image"))
from pictures import pixels  # noqa: E402

tomales = sys.argv[1]
LEFT, RIGHT, COLUMNS = 0.6, 4.6, 40
HEAD = f"""Format {COLUMNS} 1 1
PixelSamples 8 8
PixelFilter "box" 1 1
ShadingRate 0.1
Projection "orthographic"
ScreenWindow {LEFT} {RIGHT} -0.05 0.05
Translate 0 0 50
Rotate -90 1 0 0
WorldBegin
LightSource "occlusionlight" 1 "float samples" [4096]
Surface "matte" "Kd" [1]
Attribute "trace" "float tessellation" [{{tessellation}}]
Polygon "P" [-2000 0 -2000  2000 0 -2000  2000 0 2000  -2000 0 2000]
"""
SCENES = {
    # This is the form factor of a sphere that touches the horizon: (r / D)^2 cos.
    "sphere of radius 1": (8, "Translate 0 1 0\nRotate 90 1 0 0\nSphere 1 -1 1 360\n", lambda x: (1 + x * x) ** -1.5),
    # For an endless wall of height 2 it is (1 - cos e) / 2, where e is the elevation of the top of the wall.
    "wall of height 2": (1, 'Polygon "P" [0 0 -2000  0 0 2000  0 2 2000  0 2 -2000]\n', lambda x: 0.5 * (1 - x / math.hypot(x, 2))),
}

worst = 0
with tempfile.TemporaryDirectory() as name:
    folder = pathlib.Path(name)
    for scene, (tessellation, body, covered) in SCENES.items():
        (folder / "scene.rib").write_text(HEAD.replace("{tessellation}", str(tessellation)) + body + "WorldEnd\n")
        subprocess.run([tomales, "render", folder / "scene.rib", "-o", folder / "out.exr", "-q"], check=True)
        row = pixels(folder / "out.exr")
        for i in range(COLUMNS):
            places = [LEFT + (RIGHT - LEFT) * (i + (k + 0.5) / 16) / COLUMNS for k in range(16)]
            if scene.startswith("sphere") and places[0] < 1:
                continue  # The camera sees the sphere here.
            expected = 1 - sum(covered(x) for x in places) / 16
            off = row[i, 0][0] / expected - 1
            worst = max(worst, abs(off))
            if i % 5 == 0:
                print(f"{scene}, floor at {places[8]:.2f}: open {row[i, 0][0]:.5f}, closed form {expected:.5f}, {100 * off:+.3f} %")
print(f"at most {100 * worst:.3f} % off")
sys.exit(worst > 0.005)
