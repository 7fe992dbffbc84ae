"""Tests that three ways to a caustic agree: photon maps (Attribute "photon" "causticmap"), --gi progressive and --gi reference."""
import pathlib
import statistics
import sys

from caustic_scenes import SCENES, text
from program import Suite

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "image"))
from pictures import pixels  # noqa: E402

t = Suite()
# The caustic of this ring is its highlights, because its shader reflects no rays: photons and highlights would bring the same light to the floor twice.
SCENES["shining ring"] = (SCENES["ring"][0], SCENES["ring"][1].replace('"mirror" "color specularcolor" [0.95 0.78 0.45]', '"shinymetal" "Ks" [1] "Ka" [0] "roughness" [0.3]'))
METHODS = {"reference": ("--samples", "16", "--photons", "300000"), "progressive": ("--photons", "400000"), "atlas": ("--photons", "150000")}
SEEDS = 3
# A share of the mean is allowed, because each method blurs: over a micropolygon, over seven and fewer, or over 50 photons, where the ring's light is a
# thin line.
BLUR = 0.02


def means(name, method):
    """Returns means of red over the pictures of some seeds, for each quarter and for the whole."""
    out = []
    for seed in range(SEEDS):
        t.run(f"{name}.rib", "--gi", method, *METHODS[method], "--bounces", "1", "--indirect-only", "--ray-geometry", "full", "--light-seed", str(seed), "-q")
        picture = pixels(t.folder / f"{name}.exr")
        quarters = [[p[0] for (x, y), p in picture.items() if (x < 12, y < 12) == q] for q in ((True, True), (True, False), (False, True), (False, False))]
        out.append([sum(q) / len(q) for q in quarters])
        out[-1].append(sum(out[-1]) / 4)
    return list(zip(*out))


for name in SCENES:
    t.write(name + ".rib", text(name))
    found = {method: means(name, method) for method in METHODS if method != "progressive" or name != "shining ring"}
    truth = [statistics.mean(m) for m in found["reference"]]
    for method in sorted(set(found) - {"reference"}):
        for place, mine, theirs in zip(("left above", "left below", "right above", "right below", "all"), found[method], found["reference"]):
            # The noise is four standard errors of both means. It is estimated from the seeds at all places.
            noise = 4 * max(statistics.stdev(m) for m in (mine, theirs)) * (2 / SEEDS) ** 0.5
            off = statistics.mean(mine) - statistics.mean(theirs)
            t.expect(abs(off) <= noise + BLUR * truth[-1] and truth[-1] > 0.05,
                     f"{name}, {place}: {method} is {100 * off / truth[-1]:+.1f} % of the mean from the reference, of which noise is {100 * noise / truth[-1]:.1f} %")
t.finish()
