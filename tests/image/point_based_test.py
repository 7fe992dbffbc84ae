"""Compares light of baked points (indirectdiffuse() with "pointbased") with paths of one bounce: in a closed box with a ball, and for a ball on a
plane; then with lookups that are coarser or finer than the bake.

    tests/image/point_based_test.py build/release/tomales [SIZE]
"""
import pathlib
import resource
import subprocess
import sys
import tempfile

from pictures import pixels

tomales = str(pathlib.Path(sys.argv[1]).resolve())
SIZE = int(sys.argv[2]) if len(sys.argv) > 2 else 24
failures = []
BAKES = """surface bakes(float front = 0; float ball = 0;) {
  normal n = normalize(N), f = ball > 0 ? n : faceforward(n, I);
  if (front > 0) f = normal "world" (0, 0, 1);
  color c = Cs * diffuse(f);
  bake3d("box.ptc", "", P, f, "_area", area(P), "_radiosity", c);
  Ci = c;
}"""
LOOKS = 'surface looks() { Ci = Cs * indirectdiffuse(P, faceforward(normalize(N), I), 0, "pointbased", 1, "filename", "box.ptc"); }'
HEAD = """Format {size} {size} 1
PixelSamples 2 2
ShadingRate {rate}
Display "{name}.exr" "openexr" "rgb"
Projection "perspective" "fov" [40]
Translate 0 0 4
WorldBegin
Attribute "dice" "rasterorient" [0]
Attribute "cull" "hidden" [0]
AttributeBegin
AreaLightSource "arealight" "lamp" "float intensity" [12] "float samples" [16]
Attribute "visibility" "camera" [0] "diffuse" [0]
Polygon "P" [-.3 .98 -.3  .3 .98 -.3  .3 .98 .3  -.3 .98 .3]
AttributeEnd
Illuminate "lamp" 1
LightSource "indirectlight" "gi"
"""
# The front is seen from behind and culled. It must be baked all the same.
BOX = """{surface}
Color [1 .2 .2] Polygon "P" [-1 -1 -1  -1 -1 1  -1 1 1  -1 1 -1]
Color [.2 1 .2] Polygon "P" [1 -1 -1  1 -1 1  1 1 1  1 1 -1]
Color [.8 .8 .8] Polygon "P" [-1 -1 -1  1 -1 -1  1 -1 1  -1 -1 1]
Polygon "P" [-1 1 -1  1 1 -1  1 1 1  -1 1 1]
Polygon "P" [-1 -1 1  1 -1 1  1 1 1  -1 1 1]
AttributeBegin
Sides 1 Attribute "cull" "backfacing" [0]
ReverseOrientation
{front}
Polygon "P" [-1 -1 -1  -1 1 -1  1 1 -1  1 -1 -1]
AttributeEnd
"""
PLANE = '{surface}\nColor [.8 .5 .3] Polygon "P" [-.9 -1 -.9  .9 -1 -.9  .9 -1 .9  -.9 -1 .9]\n'
BALL = "{ball}\nColor [.8 .8 .8]\nTranslate 0.2 -0.5 0.1\nSphere 0.5 -0.5 0.5 360\nWorldEnd\n"


def expect(condition, message):
    print(("ok      " if condition else "FAILED  ") + message)
    if not condition:
        failures.append(message)


def render(folder, name, world, surface, rate, *options):
    """Returns the program's messages, and its CPU seconds."""
    bakes = surface == "bakes"
    shaders = {"surface": f'Surface "{surface}"', "front": 'Surface "bakes" "front" [1]' if bakes else "", "ball": 'Surface "bakes" "ball" [1]' if bakes else ""}
    (folder / f"{name}.rib").write_text(HEAD.format(size=SIZE, rate=rate, name=name) + (world + BALL).format(**shaders))
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run([tomales, f"{name}.rib", *options], cwd=folder, capture_output=True, text=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    expect(done.returncode == 0, f"{name} {surface} at rate {rate} renders {done.stderr[:300] if done.returncode else ''}")
    return done.stderr, after.ru_utime - before.ru_utime


def off(folder, name, truth, where=lambda x, y: True):
    """Returns the mean absolute relative error in per cent."""
    a, b = pixels(folder / f"{name}.exr"), pixels(folder / f"{truth}.exr")
    lit = [(sum(a[k][:3]), sum(b[k][:3])) for k in b if sum(b[k][:3]) > 0.003 and where(k[0] / SIZE, k[1] / SIZE)]
    return 100 * sum(abs(x - t) / t for x, t in lit) / len(lit)


def on_ball(x, y):
    return (x - 0.59) ** 2 + (y - 0.67) ** 2 < 0.02


with tempfile.TemporaryDirectory() as temporary:
    folder = pathlib.Path(temporary)
    (folder / "bakes.sl").write_text(BAKES)
    (folder / "looks.sl").write_text(LOOKS)
    fine = 1 if SIZE > 48 else 0.25
    for name, world in (("plane", PLANE), ("box", BOX)):
        render(folder, f"{name}_truth", world, "matte", fine, "--gi", "reference", "--bounces", "1", "--indirect-only", "--samples", "1024")
        render(folder, "bake", world, "bakes", fine, "--gi", "none")
        said, seconds = render(folder, name, world, "looks", fine, "--gi", "none")
        error = off(folder, name, f"{name}_truth")
        expect(error < 3, f"{name}: {error:.2f} % off in {seconds:.1f} s (goal: 3 %)")
        expect("point-cloud-coarse" not in said, "points as dense as the lookups are not called coarse")
    for rate in (4, 16):
        render(folder, "larger", BOX, "looks", rate, "--gi", "none")
        error = off(folder, "larger", "box_truth", on_ball)
        expect(error < 15, f"the ball, with lookups of ShadingRate {rate}: {error:.1f} % off")
    render(folder, "bake", BOX, "bakes", 32, "--gi", "none")
    said, _ = render(folder, "smaller", BOX, "looks", 0.25, "--gi", "none")
    expect("point-cloud-coarse" in said, f"large disks beside small micropolygons are told of: {off(folder, 'smaller', 'box_truth'):.1f} % off")
sys.exit(1 if failures else 0)
