"""Tests that every scene of the gallery (docs/gallery.md) renders without a message and shows something.

    gallery_test.py tomales repository
"""
import os
import pathlib
import re
import subprocess
import sys
import tempfile

from gallery import FINISHED, make_brick_map, store_photons, text_of
from pictures import pixels

tomales, root = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()
failures = []


def run(*arguments, cwd):
    return subprocess.run([tomales, *map(str, arguments)], cwd=cwd, capture_output=True, text=True)


with tempfile.TemporaryDirectory() as temporary:
    folder = pathlib.Path(temporary)
    os.environ["TOMALES_TEXTURE_CACHE"] = str(folder / "textures")
    make_brick_map(tomales, root, folder)
    scenes = [scene for group in ("primitives", "motion", *FINISHED) for scene in root.glob(f"scenes/{group}/*.rib")]
    for scene in sorted({*scenes, *(root / f"scenes/{name}/{name}.rib" for name in FINISHED)}):
        name = f"{scene.parent.name}/{scene.stem}"
        text = text_of(scene).replace("../../docs", str(root / "docs"))
        text = re.sub(r"Format (\d+) (\d+)", lambda m: f"Format {int(m[1]) // 8} {int(m[2]) // 8}", text)  # This shrinks shadow maps, because --format is for pictures.
        (folder / scene.name).write_text(text)
        if "photons/" in text:
            store_photons(tomales, folder / scene.name, scene.parent)
        done = run("render", scene.name, "-o", "out.exr", "--format", "96x72", "--pixel-samples", "2x2", "--shaders", scene.parent, cwd=folder)
        # These messages are expected: four samples per pixel are fewer than most scenes ask for, and balls of a few
        # pixels are polyhedra.
        said = [line for line in done.stderr.splitlines() if "[pixel-noise]" not in line and "[dice-turned]" not in line]
        if done.returncode or done.stdout or said:
            failures.append(f"{name}: exit code {done.returncode}: {done.stdout}{done.stderr}")
            continue
        seen = sum(max(p[:3]) > 0.01 for p in pixels(folder / "out.exr").values())
        if seen < 0.02 * 96 * 72:
            failures.append(f"{name}: only {seen} pixels show something")

print("\n".join(failures))
sys.exit(bool(failures))
