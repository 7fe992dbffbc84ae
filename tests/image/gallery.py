"""Lists the gallery's scenes as pictures of one world each, and makes the files that they name: plugins, brick maps, and maps
that earlier frames render."""
import dataclasses
import os
import pathlib
import re
import subprocess
import sys

# The files' comments and READMEs name these arguments, but with more photons.
OPTIONS = {"shading/milk.rib": ("--gi", "atlas", "--atlas", "maps", "--photons", "100000", "--bounces", "20")}
FINISHED = ("pool", "coast", "still_life", "teapots", "nave", "evening", "watch", "forest", "noon", "dandelion", "dragon")  # These are the finished pictures of docs/gallery.md.
# The source of each file whose source has another name.
PLUGINS = {"stonesurface": "stone"}


@dataclasses.dataclass
class Picture:
    name: str
    text: str    # The RIB of one world.
    maps: str    # The frames before, which have to be rendered first. It is "" for most pictures.
    options: tuple

    @property
    def has_photons(self):
        return "--photons" in self.options


def text_of(path):
    """Returns the text of a scene's file, or what the script beside it prints if the scene is too large to be kept."""
    if path.exists():
        return path.read_text(errors="replace")
    return subprocess.run([sys.executable, path.parent / f"make_{path.stem}.py"], capture_output=True, text=True, check=True).stdout


def pictures_of(path, root):
    """Yields the pictures of a file. Frames that only make maps are no pictures."""
    name = str(path.relative_to(root / "scenes"))
    text = text_of(path).replace("../../docs", str(root / "docs"))
    text = re.sub(r"^Transform \[", "ConcatTransform [", text, flags=re.M)  # Both forms mean the same before the world, unless a test puts something before them.
    head, *frames = re.split(r"^(?=FrameBegin)", text, flags=re.M)
    if not frames:
        return [Picture(name, text, "", OPTIONS.get(name, ()))]
    alone = [head + re.sub(r"^Frame(Begin.*|End[^$]*)", "", frame, flags=re.M) for frame in frames]
    return [Picture(f"{name}, frame {k + 1}", alone[k], head + "".join(frames[:k]) if k else "", ()) for k, frame in enumerate(frames)
            if re.search(r'^\s*Display .*"rgba?"', frame, flags=re.M)]


def has_to_be_furnished(text):
    return "plugins:" in text or "slide.png" in text or ".vdb" in text or ".bkm" in text or "photons/" in text


def furnish(tomales, root, text, folder):
    """Makes the files that RIB names and that other commands make."""
    if "plugins:" in text:
        os.environ["TOMALES_SHADERS"] = "plugins"  # Every render of the picture needs this.
        (folder / "plugins").mkdir()
        for plugin in sorted(set(re.findall(r'"(\w+)"', text))):
            source = root / "docs/rsl_plugins" / f"{PLUGINS.get(plugin, plugin)}.cpp"
            if source.exists():
                subprocess.run([os.environ.get("CXX", "c++"), "-O1", "-std=c++17", "-shared", "-fPIC", "-I", root, source, "-o", folder / f"plugins/{plugin}.so"], check=True)
    if "slide.png" in text:
        (folder / "slide.png").symlink_to(root / "docs/images/displaced.png")
    if "smoke.vdb" in text:
        subprocess.run([sys.executable, root / "scenes/smoke/make_smoke.py", "16", folder / "smoke.vdb"], check=True)
    if "cornell.bkm" in text:
        make_brick_map(tomales, root, folder)
    if "photons/" in text:
        (folder / "photons.rib").write_text(text)
        store_photons(tomales, folder / "photons.rib", folder)


def store_photons(tomales, scene, shaders):
    """Stores photons as scenes/pool/README.md says, but fewer of them."""
    subprocess.run([tomales, "photons", scene.name, "-o", "photons", "--photons", "20000", "--bounces", "3", "--shaders", shaders],
                   cwd=scene.parent, check=True, capture_output=True)


def make_brick_map(tomales, root, folder):
    """Makes a brick map as scenes/primitives/brickmap.rib says."""
    for step in (("photons", root / "scenes/cornell/cornell.rib", "-o", "photons", "--photons", "20000"), ("irradiance", "photons", "-o", "irradiance"),
                 ("brickmake", "irradiance", "-o", "cornell.bkm", "--relative", "--maxerror", "0.1")):
        subprocess.run([tomales, *map(str, step)], cwd=folder, check=True, capture_output=True)
