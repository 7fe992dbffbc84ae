"""Tests with each scene of the gallery that a picture does not depend on the world's place, size or handedness, on the order and
the pieces in which it is described, or on how it is rendered.

    symmetry_test.py tomales repository [--all] [--share=K/N] [part of a scene's name]

Threads and buckets must not change the picture, and crops may change only records of indirect light. Worlds that differ only by
rounding (turned, far away, scaled) must agree in almost every pixel. Worlds that draw other random numbers or dice differently
must agree in means of blocks as well as two seeds do. These are worlds that are mirrored, have another seed or twice the
resolution, are described in another order, as one mesh or in halves, or are crops with indirect light; with photons, also worlds
that are turned or far away. Without --all, only scenes that need no other files are tested, and only for equal bits, moving and
scaling.
"""
import itertools
import os
import pathlib
import re
import shutil
import statistics
import subprocess
import sys
import tempfile

from gallery import furnish, has_to_be_furnished, pictures_of
from pictures import pixels
from rewrite import merged, reordered, split

tomales, root = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()
only = next((a for a in sys.argv[3:] if not a.startswith("--")), "")
every_check = "--all" in sys.argv
# Each process takes every Nth scene, from the Kth on. One process for all of them would be the last of ctest's to end.
share, shares = map(int, next((a.split("=")[1] for a in sys.argv if a.startswith("--share=")), "0/1").split("/"))
WIDTH, HEIGHT, BLOCK = (96, 72, 8) if every_check else (64, 48, 8)
failures = []

# The reasons why some scenes are left out of some checks.
FALLS_OFF = re.compile(r'"(pointlight|spotlight|shadowspot|sl_shadowspot|slidespot)"')  # I / d^2 depends on the unit of length.
IN_UNITS = re.compile(r"DepthOfField|[Dd]isplace|fog|Atmosphere|Interior|filterlight")  # So do lengths that are parameters,
ON_SCREEN = re.compile(r"ScreenWindow|orthographic")                                      # and windows on the screen.
BY_PIXELS = re.compile(r"motionfactor|DetailRange")                                       # The picture is coarser, or has another shape, by this number of pixels.
KNOWS_WORLD = re.compile(r'"smoke"')                                                     # Its parameters are heights in the world.
BY_PARAMETERS = re.compile(r"[Tt]exture|[Dd]isplace|primvar|vertex|varying|wood|grid")  # The halves have other u, v and bounds.
SLOW = ("furnace", "interior", "rectlight", "ris")
MOVES = {"turned": ("Rotate 37 1 2 3", "Rotate -37 1 2 3"), "far from the origin": ("Translate 300 -200 500", "Translate -300 200 -500")}


class Scene:
    """One picture of the gallery in a folder of its own, in which the renderer runs."""

    def __init__(self, picture, folder):
        self.name, self.maps, self.options, self.has_photons, self.folder = picture.name, picture.maps, picture.options, picture.has_photons, folder
        self.text = re.sub(r"^PixelFilter.*$", "", picture.text, flags=re.M).replace("WorldBegin", 'PixelFilter "box" 1 1\nWorldBegin', 1)

    def render(self, text, *options, size=(WIDTH, HEIGHT)):
        (self.folder / "scene.rib").write_text(text)
        shutil.rmtree(self.folder / "maps", ignore_errors=True)  # Photon maps would be used as they are.
        out = self.folder / "out.exr"
        out.unlink(missing_ok=True)
        done = subprocess.run([tomales, "render", "scene.rib", "-o", "out.exr", "-q", "--format", f"{size[0]}x{size[1]}", *self.options, *options],
                              capture_output=True, text=True)
        if not out.exists() or re.search(r"\[(shader|texture)-missing", done.stderr):
            sys.exit(f"{self.name}: not the picture that is meant: {done.stderr[-500:]}")
        return {key: value[:3] for key, value in pixels(out).items()}

    def render_moved(self, there, back):
        """Renders the moved world with its own maps, because maps hold positions in the world."""
        picture = self.make_maps(there, back).render(moved(self.text, there, back))
        self.make_maps()
        return picture

    def make_maps(self, there="", back=""):
        if self.maps:
            (self.folder / "maps.rib").write_text(moved(self.maps, there, back))
            subprocess.run([tomales, "render", "maps.rib", "-q"], check=True, capture_output=True)
        return self

    def verdict(self, what, good, figure):
        print(("ok      " if good else "FAILED  ") + f"{self.name}: {what}: {figure}", flush=True)
        if not good:
            failures.append((self.name, what))


def moved(text, there, back):
    return text.replace("WorldBegin", f"{there}\nWorldBegin\n{back}")


def scaled(text, k):
    def clip(match):
        return f"Clipping {float(match[1]) * k} {float(match[2]) * k}"
    text = re.sub(r"Clipping\s+([\d.e+-]+)\s+([\d.e+-]+)", clip, text)
    return re.sub(r"^(\s*Projection.*)$", rf"\1\nScale {k} {k} {k}", text, count=1, flags=re.M)


def finer(text):
    """Keeps the micropolygons as they are at twice the resolution. Outlines of round objects are chords, which lose up to 1 % of
    a picture's light (docs/measured/invariance.md)."""
    return "ShadingRate 0.25\n" + re.sub(r"^(\s*ShadingRate\s+)([\d.e+-]+)", lambda m: f"{m[1]}{float(m[2]) / 4}", text, flags=re.M)


def blocks(picture, width=WIDTH, height=HEIGHT, block=BLOCK, x0=0, y0=0):
    return [[statistics.fmean(picture[x, y][c] for y in range(by, by + block) for x in range(bx, bx + block)) for c in range(3)]
            for by in range(y0, height, block) for bx in range(x0, width, block)]


def differing(a, b):
    """Returns the share of pixels that rounding does not explain."""
    scale = statistics.fmean(sum(p) / 3 for p in a.values()) + 1e-6
    return sum(any(abs(p - q) > 0.02 * (scale + abs(p)) for p, q in zip(a[key], b[key])) for key in a) / len(a)


def distance(a, b):
    """Returns the root mean square difference between means of blocks, and the difference between their sums."""
    squares = [(p - q)**2 for u, v in zip(a, b) for p, q in zip(u, v)]
    return statistics.fmean(squares)**0.5, abs(statistics.fmean(sum(u) - sum(v) for u, v in zip(a, b))) / 3


def has_records(text):
    """Returns whether the scene has records of indirect light or of occlusion. RIS scenes ask for them by their integrator."""
    return any(word in text for word in ("indirectlight", "PxrPathTracer", "maxvariation", '"irradiance" "float maxerror"'))


def check(scene):
    text = scene.text
    base = scene.make_maps().render(text)
    mean = statistics.fmean(sum(p) / 3 for p in base.values())
    scene.verdict("shows something", mean > 0, f"mean {mean:.3g}")
    check_bits(scene, base)
    most = 0.05 if has_records(text) else 0.02  # Rounding decides where irradiance records lie.

    def check_pixels(what, other):
        share = differing(base, other)
        scene.verdict(what, share < most, f"{100 * share:.2f} % of the pixels differ")

    for what, (there, back) in MOVES.items():
        if not scene.has_photons and not KNOWS_WORLD.search(text):
            check_pixels(what, scene.render_moved(there, back))
    if not any(reason.search(text) for reason in (FALLS_OFF, IN_UNITS, ON_SCREEN)):
        for k in (0.01, 1000) if every_check else (1000,):
            check_pixels(f"{k} times as large", scene.render(scaled(text, k)))
    if every_check:
        check_means(scene, mean)


def check_bits(scene, base):
    """Compares bits. A crop has different irradiance records, so scenes with records are not cropped."""
    crop = [] if has_records(scene.text) else ["--crop", "0.25,0.75,0.25,1"]
    other = scene.render(scene.text, "-t", "3", "--bucket-size", "8", *crop)
    seen = [(x, y) for x, y in base if not crop or WIDTH <= 4 * x < 3 * WIDTH and HEIGHT <= 4 * y]
    count = sum(base[key] != other[key] for key in seen)
    scene.verdict("three threads, buckets of 8" + (", cropped" if crop else ""), count == 0, f"{count} of {len(seen)} pixels differ")


def check_means(scene, mean):
    text = scene.text
    # There are four seeds, because means of two may agree by chance, and then a fifth one would seem to differ.
    pictures = [scene.render(text, "--seed", str(n)) for n in (1, 2, 3, 4)]
    seeds = [blocks(p) for p in pictures]
    noise, noise_of_mean = (statistics.fmean(d * d for d in of)**0.5 for of in zip(*(distance(a, b) for a, b in itertools.combinations(seeds, 2))))
    others = {"a fifth seed": blocks(scene.render(text, "--seed", "5"))}
    against = {}
    if scene.has_photons:
        others.update({what: blocks(scene.render_moved(there, back)) for what, (there, back) in MOVES.items()})
    if has_records(text):  # For other scenes check_bits has tested crops.
        window = {"x0": WIDTH // 4, "width": 3 * WIDTH // 4, "y0": HEIGHT // 3}
        others["cropped"] = blocks(scene.render(text, "--seed", "1", "--crop", f"0.25,0.75,{1 / 3},1"), **window)
        against["cropped"] = blocks(pictures[0], **window)
    if not ON_SCREEN.search(text):
        flipped = scene.render(re.sub(r"^(\s*Projection.*)$", r"\1\nScale -1 1 1", text, count=1, flags=re.M))
        others["mirrored"] = blocks({(WIDTH - 1 - x, y): p for (x, y), p in flipped.items()})
    if not BY_PIXELS.search(text):
        others["twice the resolution"] = blocks(scene.render(text, size=(2 * WIDTH, 2 * HEIGHT)), 2 * WIDTH, 2 * HEIGHT, 2 * BLOCK)
        against["twice the resolution"] = blocks(scene.render(finer(text)))
    rewritten = {"told in another order": reordered(text), "polygons as one mesh": merged(text)}
    if not BY_PARAMETERS.search(text):
        rewritten["primitives in halves"] = split(text)
    others.update({what: blocks(scene.render(other)) for what, other in rewritten.items() if other != text})
    for what, other in others.items():
        rms, of_mean = distance(against.get(what, seeds[0]), other)
        good = rms < 2 * noise + 0.01 * mean and of_mean < 4 * noise_of_mean + 0.005 * mean
        scene.verdict(what, good, f"blocks differ by {rms / mean:.4f} of the mean, two seeds by {noise / mean:.4f}; means by {of_mean / mean:.4f}")


for path in sorted((root / "scenes").rglob("*.rib"))[share::shares]:
    if only not in str(path) or not every_check and not only and path.parent.name in SLOW:
        continue
    for picture in pictures_of(path, root):
        if not every_check and (picture.maps or has_to_be_furnished(picture.text)):
            continue
        with tempfile.TemporaryDirectory() as where:
            os.chdir(where)  # Pictures that a scene names stay here.
            shutil.copytree(path.parent, where, dirs_exist_ok=True)  # Links would not do: a header that leads out of its folder is refused.
            furnish(tomales, root, picture.text, pathlib.Path(where))
            check(Scene(picture, pathlib.Path(where)))
            os.chdir(root)
sys.exit(bool(failures))
