"""Tests that three ways to a caustic agree: photon maps (Attribute "photon" "causticmap"), --gi progressive and --gi reference."""
import pathlib
import statistics
import sys

from program import Suite

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "image"))
from pictures import pixels  # noqa: E402

t = Suite()
# The eye looks down on a floor, through things that it does not see.
ABOVE = """Display "{name}.exr" "file" "rgb"
Format 24 24 1
PixelSamples 2 2
PixelFilter "box" 1 1
ShadingRate 0.25
Projection "orthographic"
ScreenWindow -1 1 -1 1
Rotate -90 1 0 0
Translate 0 -5 0
WorldBegin
LightSource "indirectlight" "gi" "samples" [16]
Attribute "light" "shadows" ["on"]
Attribute "trace" "maxspeculardepth" [8]
{light}
AttributeBegin
Attribute "photon" "causticmap" ["floor"]
Surface "matte"
Color 0.7 0.7 0.7
Polygon "P" [-2 0 -2  -2 0 2  2 0 2  2 0 -2]
AttributeEnd
Attribute "visibility" "int camera" [0]
Attribute "trace" "float tessellation" [4]
{thing}
WorldEnd
"""
SPOT = 'LightSource "spotlight" "lamp" "from" [{}] "to" [{}] "intensity" [20] "coneangle" [{}] "conedeltaangle" [0.05]'
WAVES = " ".join(f"{-2.4 + 0.6 * i} {0.6 + 0.06 * ((i * i + 2 * j) % 5 - 2)} {-2.4 + 0.6 * j}" for j in range(9) for i in range(9))
SCENES = {
    "pool": ('LightSource "distantlight" "sun" "from" [0.3 1 0.2] "to" [0 0 0]',
             'Attribute "photon" "shadingmodel" ["water"]\nSurface "glass" "eta" [1.33]\nColor 1 1 1\nBasis "b-spline" 1 "b-spline" 1\n'
             f'PatchMesh "bicubic" 9 "nonperiodic" 9 "nonperiodic" "P" [{WAVES}]'),
    "glass": (SPOT.format("-0.8 4 0.3", "0 1.2 0", 0.2),
              'Attribute "photon" "shadingmodel" ["glass"]\nSurface "glass"\nColor 1 1 1\nTranslate 0 1.2 0\nSphere 0.35 -0.35 0.35 360'),
    "ring": (SPOT.format("2.5 2 0", "0 0 0", 0.4),
             'Attribute "photon" "shadingmodel" ["chrome"]\nSurface "mirror" "color specularcolor" [0.95 0.78 0.45]\nColor 0.95 0.78 0.45\n'
             "Translate 0 0.2 0\nRotate -90 1 0 0\nCylinder 0.6 0 0.25 360\nCylinder 0.65 0 0.25 360\nHyperboloid 0.6 0 0.25 0.65 0 0.25 360"),
}
# The caustic of this ring is its highlights, because its shader reflects no rays: photons and highlights would bring the same light to the floor twice.
SCENES["shining ring"] = (SCENES["ring"][0], SCENES["ring"][1].replace('"mirror" "color specularcolor" [0.95 0.78 0.45]', '"shinymetal" "Ks" [1] "Ka" [0] "roughness" [0.3]'))
METHODS = {"reference": ("--samples", "16", "--photons", "300000"), "progressive": ("--photons", "400000"), "atlas": ("--photons", "150000")}
SEEDS = 3
# A share of the mean is allowed, because each method blurs: over a micropolygon, over four and less, or over 50 photons, where the ring's light is a
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


for name, (light, thing) in SCENES.items():
    t.write(name + ".rib", ABOVE.format(name=name, light=light, thing=thing))
    found = {method: means(name, method) for method in METHODS if method != "progressive" or name != "shining ring"}
    truth = [statistics.mean(m) for m in found["reference"]]
    for method in sorted(set(found) - {"reference"}):
        for place, mine, theirs in zip(("left above", "left below", "right above", "right below", "all"), found[method], found["reference"]):
            # The noise is four standard errors of both means. The seeds of all places tell its size.
            noise = 4 * max(statistics.stdev(m) for m in (mine, theirs)) * (2 / SEEDS) ** 0.5
            off = statistics.mean(mine) - statistics.mean(theirs)
            t.expect(abs(off) <= noise + BLUR * truth[-1] and truth[-1] > 0.05,
                     f"{name}, {place}: {method} is {100 * off / truth[-1]:+.1f} % of the mean from the reference, of which noise is {100 * noise / truth[-1]:.1f} %")
t.finish()
