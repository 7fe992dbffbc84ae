"""Prints peak memory against the size of the picture as JSON, for a plastic sphere before a wall.

    tests/bench/memory.py build/release/tomales [--largest 16384]

For each edge of a square picture in pixels, this gives the peak resident MB of `render`, of `render --memory-limit 100M`, of `hide`
and of `shade`, and the user seconds of `render`.
"""
import argparse
import json
import os
import pathlib
import subprocess
import tempfile

SCENE = """Projection "perspective" "fov" [40]
PixelSamples 2 2
ShadingRate 1
WorldBegin
  LightSource "distantlight" "key" "from" [-1 1 -1] "to" [0 0 0]
  AttributeBegin
    Translate 0 0 6
    Surface "matte"
    Polygon "P" [-6 -6 2  -6 6 2  6 6 2  6 -6 2]
    Surface "plastic"
    Sphere 1.5 -1.5 1.5 360
  AttributeEnd
WorldEnd
"""


def run(tomales, *arguments):
    child = subprocess.Popen([tomales, *map(str, arguments), "-q", "-t", "2"])
    _, status, used = os.wait4(child.pid, 0)
    child.returncode = os.waitstatus_to_exitcode(status)
    if child.returncode != 0:
        raise SystemExit(f"{arguments} ended with {child.returncode}")
    return used.ru_maxrss * 1024 / 1e6, used.ru_utime


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("tomales")
    parser.add_argument("--largest", type=int, default=8192)
    a = parser.parse_args()
    sizes, edge = [], 2048
    while edge <= a.largest:
        sizes.append(edge)
        edge *= 2
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        scene, file, picture = folder / "scene.rib", folder / "scene.dfb", folder / "picture.exr"
        scene.write_text(SCENE)
        for size in sizes:
            format_ = ("--format", f"{size}x{size}", "--bucket-size", "16")
            render, user = run(a.tomales, "render", scene, "-o", picture, *format_)
            limited, _ = run(a.tomales, "render", scene, "-o", picture, "--memory-limit", "100M", *format_)
            hide, _ = run(a.tomales, "hide", scene, "-o", file, *format_)
            shade, _ = run(a.tomales, "shade", file, "-o", picture)
            print(json.dumps({"edge_px": size, "render_MB": round(render), "limited_MB": round(limited),
                              "hide_MB": round(hide), "shade_MB": round(shade), "render_user_s": round(user, 1)}), flush=True)


main()
