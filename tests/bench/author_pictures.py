"""Compares our pictures of other people's scenes with the pictures that their authors rendered.

    tests/bench/author_pictures.py build/release/tomales FOLDER ... --keep SHEETS [--seconds 60] [--only PART] [-- -t 1 ...]

Debian's packages: python3-numpy python3-openimageio. A RIB file has its author's picture beside it if a picture in its folder, or
in a folder of pictures below it, has the file's name or that of one of its Displays. The scene is rendered from where it lies, at
the size of that picture, as public_scenes.py does it. Old pictures hold 8 bits without gamma unless the scene's Exposure says
otherwise, and ours are converted in the same way. The rms difference is taken over blocks of 4 x 4 pixels, in units of white, so
that noise and filters at outlines count little. SHEETS gets a picture of each pair: ours, theirs, and the difference times four.
"""
import os
import pathlib
import re
import shutil
import tempfile

import numpy
import OpenImageIO

import public_scenes

KINDS = (".tiff", ".tif", ".png", ".gif", ".jpg", ".jpeg", ".bmp")  # If there are several, the first one is taken.
PICTURE_FOLDERS = ("", "images", "pics", "pictures", "pix")
DISPLAY = re.compile(rb'Display\s+"\+?([^"]+)"')


def pixels(path):
    """Returns pixels of shape height x width x 3 in units of white. Pictures with alpha lie over black."""
    image = OpenImageIO.ImageInput.open(str(path))
    data = image.read_image(OpenImageIO.FLOAT) if image else None
    if data is None:
        return None
    if data.shape[2] < 3:
        data = numpy.repeat(data[..., :1], 3, axis=2)
    return numpy.clip(data[..., :3], 0.0, 1.0)


def author_picture(scene):
    """Returns the path of the picture that the author of the scene rendered, or None."""
    names = [scene.name[:scene.name.lower().index(".rib")]]
    names += [pathlib.PurePath(m.decode("latin-1")).stem for m in DISPLAY.findall(public_scenes.text_of(scene))]
    for name in names:
        for kind in KINDS:
            for folder in PICTURE_FOLDERS:
                for file in (scene.parent / folder).glob("*") if (scene.parent / folder).is_dir() else ():
                    if file.name.lower() == (name + kind).lower():
                        return file
    return None


def blocks(data, edge=4):
    height, width = data.shape[0] // edge * edge, data.shape[1] // edge * edge
    return data[:height, :width].reshape(height // edge, edge, width // edge, edge, 3).mean(axis=(1, 3))


def write(path, data):
    path.parent.mkdir(parents=True, exist_ok=True)
    out = OpenImageIO.ImageOutput.create(str(path))
    out.open(str(path), OpenImageIO.ImageSpec(data.shape[1], data.shape[0], 3, OpenImageIO.UINT8))
    out.write_image(numpy.ascontiguousarray(data, numpy.float32))
    out.close()


def compared(ours, theirs, sheet):
    """Returns the rms difference, and the means of ours and theirs."""
    write(sheet, numpy.concatenate([ours, theirs, numpy.clip(4 * numpy.abs(ours - theirs), 0, 1)], axis=1))
    return float(numpy.sqrt(((blocks(ours) - blocks(theirs)) ** 2).mean())), float(ours.mean()), float(theirs.mean())


def main():
    given, rest = public_scenes.command_line(__doc__, 60, ("--keep", {"type": pathlib.Path, "required": True}), ("--only", {"default": ""}))
    print("| scene | rms | mean of ours | of theirs | ends | messages |\n|---|---|---|---|---|---|")
    for folder in given.folders:
        with tempfile.TemporaryDirectory() as temporary:
            copy = pathlib.Path(temporary) / folder.name
            shutil.copytree(folder, copy, symlinks=True, ignore=shutil.ignore_patterns(".git"))
            environment = {"TOMALES_SHADERS": ":".join(sorted({str(file.parent) for file in copy.rglob("*.sl")})), **os.environ}
            for scene in public_scenes.scenes_of(copy):
                name = str(scene.relative_to(copy))
                picture = author_picture(scene)
                theirs = pixels(picture) if picture and given.only in name else None
                if theirs is None:
                    continue
                public_scenes.SIZE = f"{theirs.shape[1]}x{theirs.shape[0]}"
                result = public_scenes.render(given.program.resolve(), scene, rest, given.seconds, pathlib.Path(temporary), environment)
                ours = pixels(pathlib.Path(temporary) / "picture.exr") if (pathlib.Path(temporary) / "picture.exr").exists() else None
                told = " ".join(dict.fromkeys(result["codes"]))
                if ours is None or ours.shape != theirs.shape:
                    print(f"| {name} | | | | {result['code']} | {told} |", flush=True)
                    continue
                rms, mean, their_mean = compared(ours, theirs, given.keep / (name.replace("/", "_") + ".png"))
                print(f"| {name} | {rms:.3f} | {mean:.3f} | {their_mean:.3f} | {result['code']} | {told} |", flush=True)


if __name__ == "__main__":
    main()
