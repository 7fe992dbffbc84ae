"""Converts images of Blender to linear arrays, and arrays to files. The renderer takes the colours of these files as
linear."""
from __future__ import annotations

import hashlib
from collections.abc import Callable
from pathlib import Path

import bpy
import numpy

from . import exr
from .values import Value, is_gray

FOLDER = "textures"
_MOST = 65504  #: The largest value that a half float holds.


class Textures:
    """Writes each picture once, into FOLDER below a folder. File names are hashes of the contents, so frames and
    scenes share files."""

    def __init__(self, folder: Path, warn: Callable[[str], None]) -> None:
        self._folder = folder
        self._warn = warn
        self._images: dict[str, numpy.ndarray | None] = {}

    def pixels(self, image: bpy.types.Image) -> numpy.ndarray | None:
        """Returns linear pixels of shape (height, width, 4) with the top row first. If there are none, it reports
        this and returns None."""
        if image.name_full not in self._images:
            self._images[image.name_full] = self._read(image)
        return self._images[image.name_full]

    def _read(self, image: bpy.types.Image) -> numpy.ndarray | None:
        width, height = image.size
        if width * height == 0:
            self._warn(f"the image {image.name} is missing: {image.filepath}")
            return None
        pixels = numpy.empty(width * height * image.channels, "f4")
        image.pixels.foreach_get(pixels)
        pixels = pixels.reshape(height, width, image.channels)[::-1]
        out = numpy.ones((height, width, 4), "f4")
        out[..., :3] = pixels[..., :3] if image.channels > 2 else pixels[..., :1]
        if image.channels == 4:
            out[..., 3] = pixels[..., 3]
        if not image.is_float and image.colorspace_settings.name == "sRGB":
            out[..., :3] = linear(out[..., :3])
        return out

    def file(self, picture: Value) -> str:
        """Returns the file of a picture, relative to the folder."""
        pixels = numpy.ascontiguousarray((picture[..., :1] if is_gray(picture) else picture).clip(max=_MOST), "f2")
        name = f"{FOLDER}/{hashlib.sha256(pixels.tobytes()).hexdigest()[:20]}.exr"
        path = self._folder / name
        if not path.exists():
            path.parent.mkdir(parents=True, exist_ok=True)
            exr.write_texture(path, pixels)
        return name


def linear(srgb: numpy.ndarray) -> numpy.ndarray:
    """Converts sRGB to linear values (IEC 61966-2-1)."""
    return numpy.where(srgb <= 0.04045, srgb / 12.92, ((srgb + 0.055) / 1.055) ** 2.4)
