"""Draws the measurements of brick maps: error against filter size, for each number of photons and maxerror.

    tests/stability/brickmap/chart.py build/release/brickmap_lab CHART.svg [--photons 10000 100000 1000000]
"""
import argparse
import math
import pathlib
import subprocess

COLORS = ("#b04030", "#308050", "#3070b0")          # There is a colour for each number of photons.
DASHES = {"0.03": "", "0.1": ' stroke-dasharray="6 3"', "0.3": ' stroke-dasharray="2 3"'}   # There is a dash pattern for each maxerror.
PANEL, MARGIN, SPACE, LEAST, MOST = 200, 46, 34, 0.005, 0.08


def tables(lab, photons):
    """Returns (scene, nearest photon's error, {maxerror: [(filter, error)]}, {maxerror: (bytes, left out)}) of one run."""
    lines = subprocess.run([lab, "--photons", str(photons)], check=True, capture_output=True, text=True).stdout.splitlines()
    for line in lines:
        cells = [c.strip() for c in line.strip("|").split("|")]
        if line.startswith("## "):
            scene, filters, errors, files = line[3:].split(",")[0], [], {}, {}
        elif line.startswith("| maxerror"):
            filters = [float(c.split()[-1]) for c in cells[4:]]
        elif line.startswith("| nearest"):
            nearest = float(cells[4].split(",")[0])
        elif line.startswith("| 0"):
            errors[cells[0]] = list(zip(filters, (float(c.split(",")[0]) for c in cells[4:])))
            files[cells[0]] = (int(cells[3]), cells[2])
            if len(errors) == 4:
                yield scene, nearest, errors, files


def scale(value, least, most, length):
    return length * math.log(min(max(value, least), most) / least) / math.log(most / least)


def panel(x0, title, curves):
    """Draws a panel. `curves` has (color, nearest, errors) for each number of photons."""
    out = [f'<g transform="translate({x0},{MARGIN})"><rect x="0" y="0" width="{PANEL}" height="{PANEL}" fill="none" stroke="#999"/>'
           f'<text x="{PANEL / 2}" y="-8">{title}</text>']
    for error in (0.005, 0.01, 0.02, 0.04, 0.08):
        y = PANEL - scale(error, LEAST, MOST, PANEL)
        out.append(f'<line x1="0" x2="{PANEL}" y1="{y:.1f}" y2="{y:.1f}" stroke="#ddd"/><text x="-16" y="{y + 4:.1f}">{100 * error:g} %</text>')
    for color, nearest, errors in curves:
        y = PANEL - scale(nearest, LEAST, MOST, PANEL)
        out.append(f'<polygon points="0,{y - 4:.1f} 8,{y:.1f} 0,{y + 4:.1f}" fill="{color}"/>')
        for maxerror, dash in DASHES.items():
            line = " ".join(f"{scale(f, 0.002, 0.1, PANEL):.1f},{PANEL - scale(e, LEAST, MOST, PANEL):.1f}" for f, e in errors[maxerror])
            out.append(f'<polyline points="{line}" fill="none" stroke="{color}" stroke-width="1.5"{dash}/>')
    for f in (0.002, 0.01, 0.05):
        out.append(f'<text x="{scale(f, 0.002, 0.1, PANEL):.1f}" y="{PANEL + 14}">{f}</text>')
    return "".join(out) + "</g>"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("lab")
    parser.add_argument("chart", type=pathlib.Path)
    parser.add_argument("--photons", type=int, nargs="+", default=[10000, 100000, 1000000])
    a = parser.parse_args()
    scenes = {}
    for photons, color in zip(a.photons, COLORS):
        for scene, nearest, errors, files in tables(a.lab, photons):
            scenes.setdefault(scene, []).append((color, nearest, errors))
            print(scene, photons, *(f"maxerror {m}: {size} bytes, {left} left out;" for m, (size, left) in files.items()))
    width, height = MARGIN + len(scenes) * (PANEL + SPACE), PANEL + MARGIN + 60
    panels = "".join(panel(MARGIN + i * (PANEL + SPACE), scene, curves) for i, (scene, curves) in enumerate(scenes.items()))
    legend = "".join(f'<text x="{width / 2 + 200 * i - 200}" y="{height - 6}" fill="{color}">{photons:,} photons</text>'
                     for i, (photons, color) in enumerate(zip(a.photons, COLORS)))
    a.chart.write_text(
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" font-family="sans-serif" font-size="11" text-anchor="middle">'
        f'<rect width="{width}" height="{height}" fill="white"/><text x="{width / 2}" y="16">mean error of lookups against their half width, rooms 1 wide</text>{legend}'
        f'{panels}<text x="{width / 2}" y="{height - 22}">maxerror 0.03: lines, 0.1: dashes, 0.3: dots; triangles: the nearest photon, as before brick maps</text></svg>\n')


main()
