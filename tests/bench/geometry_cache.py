"""Measures what a small geometry cache costs (docs/measured/rays.md). Rays see the displacement of a scene at three levels. In
one render the cache has room for all polygons that they ask for, and in another for a thirtieth of the full-rate geometry.
    geometry_cache.py TOMALES [RIB [further arguments of each render]]"""
import json
import pathlib
import subprocess
import sys
import tempfile

root = pathlib.Path(__file__).resolve().parents[2]
tomales = sys.argv[1]
scene = sys.argv[2] if len(sys.argv) > 2 else root / "scenes/film/film.rib"
further = sys.argv[3:] or ["--format", "560x338", "--gi", "none"]

BYTES_OF_POLYGON = 37  # These are position, normal, and Embree's 22 (raytrace/embree_chunks.cpp).
TIMES_SMALLER = 30
ROUNDS = 2


def render(folder, cache):
    rates = folder / "rates.rib"
    rates.write_text('Attribute "trace" "int displacements" [1] "string tessellationmode" ["multiresolution"]\n')
    out, stats = folder / f"{cache}.exr", folder / "stats.json"
    subprocess.run([tomales, "render", rates, scene, *further, "--geometry-cache", str(cache), "-o", out, "--stats", stats, "-q"], check=True)
    return json.loads(stats.read_text())


with tempfile.TemporaryDirectory() as name:
    folder = pathlib.Path(name)
    seconds, figures = {}, {}
    unlimited, small = 1 << 40, None
    for _ in range(ROUNDS):
        for cache in (unlimited, small):
            if cache is None:
                cache = small = figures[unlimited]["geometry_cache"]["fine_polygons"] * BYTES_OF_POLYGON // TIMES_SMALLER
            figures[cache] = render(folder, cache)
            seconds.setdefault(cache, []).append(figures[cache]["cpu_s"])
    for cache, runs in seconds.items():
        c = figures[cache]["geometry_cache"]
        print(f"cache of {cache / 1e6:.1f} MB: {min(runs):.2f} CPU s, {c['lookups']} lookups, {c['misses']} misses, hit rate {c['hit_rate']:.5f}, "
              f"at most {c['bytes'] / 1e6:.1f} MB held")
    same = (folder / f"{unlimited}.exr").read_bytes() == (folder / f"{small}.exr").read_bytes()
    print(f"{min(seconds[small]) / min(seconds[unlimited]):.2f} times the time; {'the same picture' if same else 'ANOTHER PICTURE'}")
