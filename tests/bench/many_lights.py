"""Prints a table of error and time of direct light by the number of lamps, with all of them and with those that Option "trace" "lightcut" chooses.

    tests/bench/many_lights.py build/release/tomales [--kinds point area unshadowed ...] [--lamps 10 100 ...] [--lights 0 32 ...]
                               [--out FOLDER]

The scene is a town square at night with lamps between its houses. The error is the mean absolute relative error of the picture
against the picture with all lamps. Seconds are CPU seconds of the process.
"""
import argparse
import json
import pathlib
import random
import resource
import subprocess
import tempfile

HEAD = """
Format {size} {size} 1
PixelSamples 3 3
Projection "perspective" "fov" [60]
Display "{out}" "openexr" "rgb"
Option "trace" "int lightcut" [{lights}]
Rotate -24 1 0 0
Translate 0 -9 26
WorldBegin
"""
BLOCK = "0 0 0 1 0 0 1 0 1 0 0 1 0 1 0 1 1 0 1 1 1 0 1 1"
FACES = "0 1 5 4 1 2 6 5 2 3 7 6 3 0 4 7 4 5 6 7"


def houses(rng):
    out = []
    for gx in range(-4, 5):
        for gz in range(-3, 6):
            if gx == 0 or rng.random() < 0.3:
                continue
            out.append((gx * 9 + rng.uniform(-2, 0), gz * 9 + rng.uniform(-2, 0), rng.uniform(3, 6), rng.uniform(3, 6), rng.uniform(2, 7)))
    return out


def inside(x, z, blocks):
    return any(bx - 0.3 < x < bx + w + 0.3 and bz - 0.3 < z < bz + d + 0.3 for bx, bz, w, d, _ in blocks)


def lamps(kind, count, blocks, rng):
    out = []
    while len(out) < count:
        x, z, y = rng.uniform(-40, 40), rng.uniform(-30, 50), rng.uniform(1.5, 5)
        if inside(x, z, blocks):
            continue
        power = 400 / count * rng.uniform(0.3, 1.7)
        colour = f"{rng.uniform(0.7, 1):.3f} {rng.uniform(0.5, 0.9):.3f} {rng.uniform(0.2, 0.8):.3f}"
        if kind != "area":
            out.append(f'LightSource "pointlight" {len(out)} "float intensity" [{power:.4f}] "color lightcolor" [{colour}] "point from" [{x:.3f} {y:.3f} {z:.3f}]')
        else:
            h = 0.1
            out.append(f'AttributeBegin\nAreaLightSource "arealight" {len(out)} "float intensity" [{power * 3.14159 / (4 * h * h):.4f}] "color lightcolor" [{colour}] "float samples" [4]\n'
                       f'Patch "bilinear" "P" [{x - h} {y} {z - h} {x + h} {y} {z - h} {x - h} {y} {z + h} {x + h} {y} {z + h}]\n'
                       f'AttributeEnd\nIlluminate {len(out)} 1')
    return out


def scene(kind, count, lights, out, size, indirect):
    rng = random.Random(7)
    blocks = houses(rng)
    text = [HEAD.format(out=out, lights=lights, size=size), f'Attribute "light" "shadows" "{"off" if kind == "unshadowed" else "on"}"']
    text += lamps(kind, count, blocks, rng)
    if indirect:
        text.append('LightSource "indirectlight" "bounce" "float samples" [256]')
    text.append('Surface "matte"\nPatch "bilinear" "P" [-60 0 -60 60 0 -60 -60 0 60 60 0 60]')
    for x, z, w, d, h in blocks:
        text.append(f'TransformBegin\nTranslate {x:.3f} 0 {z:.3f}\nScale {w:.3f} {h:.3f} {d:.3f}\nColor [{rng.uniform(0.4, 0.9):.2f} {rng.uniform(0.4, 0.9):.2f} {rng.uniform(0.4, 0.9):.2f}]\n'
                    f'PointsPolygons [4 4 4 4 4] [{FACES}] "P" [{BLOCK}]\nTransformEnd')
    text.append("Color [0.8 0.8 0.8]")
    for _ in range(40):
        x, z, r = rng.uniform(-12, 12), rng.uniform(-10, 30), rng.uniform(0.3, 1)
        if not inside(x, z, blocks):
            text.append(f"TransformBegin\nTranslate {x:.3f} {r:.3f} {z:.3f}\nSphere {r:.3f} -{r:.3f} {r:.3f} 360\nTransformEnd")
    return "\n".join(text + ["WorldEnd", ""])


def render(program, folder, name, text, gi):
    (folder / f"{name}.rib").write_text(text)
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run([program, "render", f"{name}.rib", "--gi", gi, "-q", "--stats", "s.json"], cwd=folder, check=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    rays = json.loads((folder / "s.json").read_text())["rays"]["transmission"]
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, rays


def error(program, folder, picture, truth):
    out = subprocess.run([program, "compare", "--json", picture, truth], cwd=folder, capture_output=True, text=True).stdout
    return json.loads(out)["mean_absolute_relative_error"]


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("--kinds", nargs="+", default=["point", "area"])
    parser.add_argument("--lamps", nargs="+", type=int, default=[10, 100, 1000, 10000])
    parser.add_argument("--lights", nargs="+", type=int, default=[0, 32])
    parser.add_argument("--size", type=int, default=128)
    parser.add_argument("--indirect", action="store_true")
    parser.add_argument("--out")
    arguments = parser.parse_args()
    program = str(pathlib.Path(arguments.program).resolve())
    folder = pathlib.Path(arguments.out or tempfile.mkdtemp()).resolve()
    folder.mkdir(exist_ok=True)
    gi = "gather" if arguments.indirect else "none"
    for kind in arguments.kinds:
        for count in arguments.lamps:
            row = [f"{count} {kind} lamps"]
            for lights in arguments.lights:
                name = f"{kind}_{count}_{lights}"
                seconds, rays = render(program, folder, name, scene(kind, count, lights, f"{name}.exr", arguments.size, arguments.indirect), gi)
                truth = folder / f"{kind}_{count}_0.exr"
                off = f"{100 * error(program, folder, f'{name}.exr', truth.name):.2f} %, " if lights and truth.exists() else ""
                row.append(f"{lights or 'all'}: {off}{seconds:.2f} s, {rays / 1e6:.2f} M shadow rays")
            print(" | ".join(row), flush=True)


if __name__ == "__main__":
    main()
