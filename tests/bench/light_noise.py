"""Prints a table of the noise of direct light at equal samples, and of its cost.

    tests/bench/light_noise.py build/release/tomales [another tomales ...]

The error is the mean absolute relative error of one picture without a filter, against 1024 samples by the first program.
"""
import json
import pathlib
import resource
import subprocess
import sys
import tempfile

HEAD = """
Format 192 192 1
PixelSamples 1 1
PixelFilter "box" 1 1
ShadingRate 1
Projection "perspective" "fov" [{fov}]
Clipping 0.1 100
Display "x.exr" "openexr" "rgb"
{camera}
WorldBegin
"""
BALL = "CropWindow 0.3 0.7 0.08 0.3\n"


def area(samples, shape, intensity, extra=""):
    return f"""AttributeBegin
AreaLightSource "arealight" "lamp" "float intensity" [{intensity}] "float samples" [{samples}] {extra}
Surface "matte"
{shape}
AttributeEnd
Illuminate "lamp" 1
"""


def rectangle(x, y, z, half):
    return f'Patch "bilinear" "P" [{x - half} {y} {z - half} {x + half} {y} {z - half} {x - half} {y} {z + half} {x + half} {y} {z + half}]'


FLOOR = 'Patch "bilinear" "P" [-9 -1 -9  -9 -1 9  9 -1 -9  9 -1 9]\n'


def cornell_lamp(n, extra=""):
    """Returns a scene of a ball close below the lamp of a Cornell box, and the wall behind it."""
    return (BALL + HEAD.format(fov=38, camera="Translate 0 0 2.6") + area(n, rectangle(0, 0.98, 0, 0.3), 16, extra) + """Surface "matte"
Polygon "P" [-1 1 -1  1 1 -1  1 1 1  -1 1 1]
Polygon "P" [-1 -1 1  -1 1 1  1 1 1  1 -1 1]
Polygon "P" [-1 -1 -1  -1 -1 1  1 -1 1  1 -1 -1]
TransformBegin
Translate 0 0.6 0
Sphere 0.3 -0.3 0.3 360
TransformEnd
WorldEnd
""")


def lamp_shape(shape):
    def scene(n, extra=""):
        return (HEAD.format(fov=45, camera="Translate 0 0 4") + area(n, shape, 4, extra) + 'Surface "matte"\n' + FLOOR +
                'TransformBegin\nTranslate -0.6 -0.6 0\nSphere 0.4 -0.4 0.4 360\nTransformEnd\nWorldEnd\n')
    return scene


def sky(n, extra=""):
    return (HEAD.format(fov=45, camera="Translate 0 0 4\nRotate -20 1 0 0\nRotate -90 1 0 0") +
            f'LightSource "environmentlight" "sky" "string map" ["sky.exr"] "float samples" [{n}] {extra}\nSurface "matte"\n' +
            'Patch "bilinear" "P" [-9 -9 -1  9 -9 -1  -9 9 -1  9 9 -1]\nTranslate 0 0 -0.4\nSphere 0.6 -0.6 0.6 360\nWorldEnd\n')


def octahedron(x, y, z, r):
    corners = [(x + r, y, z), (x - r, y, z), (x, y + r, z), (x, y - r, z), (x, y, z + r), (x, y, z - r)]
    faces = [(a, c, b) if (a + b + c) % 2 else (a, b, c) for a in (0, 1) for b in (2, 3) for c in (4, 5)]
    flat = lambda rows: " ".join(f"{v}" for row in rows for v in row)
    return f'PointsPolygons [{"3 " * len(faces)}] [{flat(faces)}] "P" [{flat(corners)}]'


def glossy(half, roughness, shape=rectangle):
    def scene(n, extra=""):
        return (HEAD.format(fov=45, camera="Rotate -20 1 0 0\nTranslate 0 0 4") + area(n, shape(0, 1.5, 2, half), 4 / half ** 2, extra) +
                f'Surface "plastic" "float Kd" [0] "float Ks" [1] "float roughness" [{roughness}]\n' + FLOOR + "WorldEnd\n")
    return scene


SCENES = {
    "Cornell, a ball close to the lamp": (cornell_lamp, 16),
    "sphere lamp, near": (lamp_shape('Translate 0.5 0 0\nSphere 0.4 -0.4 0.4 360'), 16),
    "disk lamp, near": (lamp_shape('Translate 0.3 0.3 0\nRotate 90 1 0 0\nDisk 0 0.6 360'), 16),
    "sun and sky map": (sky, 64),
    "glossy floor, lamp of 0.1, roughness 0.1": (glossy(0.05, 0.1), 16),
    "glossy floor, lamp of 2, roughness 0.1": (glossy(1, 0.1), 16),
    "glossy floor, lamp of 2, roughness 0.005": (glossy(1, 0.005), 16),
    "glossy floor, octahedron of 2, roughness 0.005": (glossy(1, 0.005, octahedron), 16),
}


def render(program, folder, text, out):
    (folder / "scene.rib").write_text(text)
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    subprocess.run([program, "render", "scene.rib", "--gi", "none", "-t", "1", "-o", out, "-q", "--stats", "s.json"], cwd=folder, check=True)
    stats = json.loads((folder / "s.json").read_text())
    return resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before, stats["rays"]["transmission"]


def error(program, folder, picture):
    out = subprocess.run([program, "compare", "--json", picture, "truth.exr"], cwd=folder, capture_output=True, text=True).stdout
    return json.loads(out)["mean_absolute_relative_error"]


def main():
    programs = [str(pathlib.Path(p).resolve()) for p in sys.argv[1:]]
    folder = pathlib.Path(tempfile.mkdtemp())
    # The sky has a radiance of about 1, and a sun of half a degree brings three times the light of the sky.
    subprocess.run(["oiiotool", "--pattern", "fill:top=0.5,0.8,1.5:bottom=0.4,0.4,0.3", "2048x1024", "3",
                    "--fill:color=130000,110000,80000", "3x3+700+300", "-o", folder / "sky.exr"], check=True)
    for name, (scene, samples) in SCENES.items():
        render(programs[0], folder, scene(1024), "truth.exr")
        row = [name, f"{samples} samples"]
        for program in programs:
            seconds, rays = render(program, folder, scene(samples), "x.exr")
            row.append(f"{100 * error(program, folder, 'x.exr'):.2f} % ({seconds:.2f} s, {rays / 1e6:.2f} M shadow rays)")
        print(" | ".join(row), flush=True)


if __name__ == "__main__":
    main()
