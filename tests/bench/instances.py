"""Measures user seconds and peak memory of 10,000 instances of a mesh of 10,000 faces, under an area light with traced shadows, at 320 x 240. The
goal is 300 MB.

    tests/bench/instances.py build/release/tomales [--camera low all cloud] [--gi none gather] [-t 2] [--keep FOLDER]

`low` looks along the field, where near instances hide most others; `all` sees every instance, a few pixels large. `cloud` is
another scene: a million instances of a small sphere in a cube, under a lamp far away. Its goal is 60 s with gather.
"""
import argparse
import itertools
import math
import os
import pathlib
import random
import subprocess
import tempfile

CAMERAS = {"all": "Rotate -35 1 0 0 Translate 0 -40 60", "low": "Rotate -5 1 0 0 Translate 0 -3 5"}


def scene(camera, side=100):
    """Returns a scene of a bumpy ball of side x side quadrilaterals, shown side x side times on a plane."""
    points, faces = [], []
    for j in range(side + 1):
        for i in range(side):
            theta, phi = math.pi * (j + 0.5) / (side + 1), 2 * math.pi * i / side
            r = 0.4 * (1 + 0.1 * math.sin(8 * phi) * math.sin(8 * theta))
            points += [r * math.sin(theta) * math.cos(phi), r * math.cos(theta), r * math.sin(theta) * math.sin(phi)]
    for j in range(side):
        for i in range(side):
            a, b = j * side + i, j * side + (i + 1) % side
            faces += [a, b, b + side, a + side]
    chance = random.Random(1)
    yield f'Format 320 240 1 PixelSamples 3 3 Projection "perspective" "fov" [50] {CAMERAS[camera]} WorldBegin\n'
    yield ('AttributeBegin Translate 0 60 0 Rotate 90 1 0 0 AreaLightSource "arealight" "sun" "float intensity" [3000] "float samples" [4]\n'
           'Disk 0 10 360 AttributeEnd\nAttribute "visibility" "transmission" [1]\n')
    yield (f'ObjectBegin 1 PointsPolygons [{" ".join(["4"] * (side * side))}] [{" ".join(map(str, faces))}] '
           f'"P" [{" ".join("%.5g" % x for x in points)}] ObjectEnd\n')
    yield 'Surface "matte"\nPolygon "P" [-100 -0.5 -20 -100 -0.5 150 100 -0.5 150 100 -0.5 -20]\n'
    for z in range(side):
        for x in range(side):
            yield (f"AttributeBegin Translate {x - side / 2:g} 0 {z:g} Rotate {chance.uniform(0, 360):g} 0 1 0 "
                   f"Color [{chance.random():g} 0.5 0.4] ObjectInstance 1 AttributeEnd\n")
    yield "WorldEnd\n"


def cloud(side=100):
    """Returns a scene of side x side x side small spheres in a cube over a floor."""
    chance = random.Random(1)
    yield ('Format 320 240 1 PixelSamples 2 2 Projection "perspective" "fov" [50] Translate 0 -1 9 Rotate -20 1 0 0 WorldBegin\n'
           'LightSource "distantlight" 1 "from" [1 3 -2] "to" [0 0 0] LightSource "indirectlight" 2 "samples" [256]\n'
           'Attribute "light" "shadows" ["on"] Surface "matte"\nPolygon "P" [-20 -4 -20 -20 -4 20 20 -4 20 20 -4 -20]\n'
           f'ObjectBegin 1 Sphere {3 / side:g} {-3 / side:g} {3 / side:g} 360 ObjectEnd\n')
    for place in itertools.product(range(side), repeat=3):
        at = " ".join(f"{8 * (i / side - 0.5) + chance.uniform(-2, 2) / side:.3f}" for i in place)
        yield f"AttributeBegin Color [{chance.random():.2f} 0.5 0.4] Translate {at} ObjectInstance 1 AttributeEnd\n"
    yield "WorldEnd\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("tomales")
    parser.add_argument("--camera", nargs="+", choices=[*CAMERAS, "cloud"], default=list(CAMERAS))
    parser.add_argument("--gi", nargs="+", default=["none", "gather"])
    parser.add_argument("-t", default="2")
    parser.add_argument("--keep", help="where the scenes and pictures stay")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as temporary:
        folder = pathlib.Path(arguments.keep or temporary)
        for camera in arguments.camera:
            rib = folder / f"{camera}.rib"
            rib.write_text("".join(cloud() if camera == "cloud" else scene(camera)))
            for gi in arguments.gi:
                command = [arguments.tomales, "render", rib, "-o", folder / f"{camera}_{gi}.exr", "--gi", gi, "-t", arguments.t, "-q"]
                process = subprocess.Popen(list(map(str, command)))
                _, status, used = _wait(process)
                print(f"{camera:4} {gi:7} {used.ru_utime:7.1f} user s {used.ru_maxrss / 1024:7.1f} MB, exit {status}", flush=True)


def _wait(process):
    """Waits for this child and returns the resources that it used alone, because RUSAGE_CHILDREN keeps the largest of all children."""
    pid, status, used = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    return pid, process.returncode, used


if __name__ == "__main__":
    main()
