"""Prints as JSON how time grows with micropolygons, with depth complexity and with threads.

    tests/bench/scaling.py build/release/tomales [--largest 1e7]

hide_user_s has the user seconds of the process minus those of the same scene without geometry.
"""
import argparse
import json
import os
import pathlib
import resource
import subprocess
import tempfile
import time

from reyes_set import frame


def sheets(count):
    """Returns rippled bicubic sheets that each fill the frame, nearest first."""
    out = 'Surface "matte"\n'
    for k in range(count):
        z = 5 + 0.5 * k
        points = []
        for j in range(4):
            for i in range(4):
                ripple = 0.3 * ((i * 7 + j * 3 + k) % 3 - 1)
                points += [z * (i - 1.5) * 0.4, z * (j - 1.5) * 0.3, z + ripple]
        out += f'Patch "bicubic" "P" [{" ".join(f"{p:.4f}" for p in points)}]\n'
    return out


def measure(tomales, folder, text, *options):
    scene = folder / "scene.rib"
    scene.write_text(text)
    before, start = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime, time.monotonic()
    subprocess.run([tomales, "render", scene, "-o", folder / "x.exr", "-q", "--stats", folder / "s.json", *options], check=True)
    user = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before
    stats = json.loads((folder / "s.json").read_text())
    return {"user_s": user, "wall_s": time.monotonic() - start, "hide_wall_s": stats["time_s"]["hide"],
            "micropolygons": stats["geometry"]["micropolygons_diced"], "pieces": stats["geometry"]["subpatches"]}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("tomales")
    parser.add_argument("--largest", type=float, default=1e7, help="micropolygons")
    options = parser.parse_args()
    tomales = os.path.abspath(options.tomales)
    result = {"micropolygons": [], "depth": {}, "threads": {}}
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)

        def run(layers, rate, *more, width=640, height=480):
            return measure(tomales, folder, frame(sheets(layers), samples=4, rate=rate, width=width, height=height), *more)

        empty = run(0, 1, "-t", "1")["user_s"]
        wanted = 1e5
        while wanted <= options.largest:
            # The rate changes how much there is to hide, but not the picture.
            r = run(1, 640 * 480 / wanted, "-t", "1")
            r["hide_user_s"] = r["user_s"] - empty
            r["user_ns_per_micropolygon"] = round(r["hide_user_s"] / r["micropolygons"] * 1e9)
            result["micropolygons"].append(r)
            wanted *= 10
        for layers in (1, 20):
            r = run(layers, 1, "-t", "1")
            r["hide_user_s"] = r["user_s"] - empty
            result["depth"][layers] = r
        for threads in (1, 2):
            result["threads"][threads] = run(4, 0.25, "-t", str(threads), width=1280, height=960)
    print(json.dumps(result, indent=1))


if __name__ == "__main__":
    main()
