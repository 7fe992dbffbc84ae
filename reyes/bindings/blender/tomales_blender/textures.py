"""Images of Blender as files that the renderer reads: linear, since it takes colours as they are in the file."""
from __future__ import annotations

import hashlib
from collections.abc import Callable
from pathlib import Path

import bpy
import numpy

from . import exr


class Textures:
    """Writes each image once into a folder. Names tell contents, so that frames and scenes share files."""

    def __init__(self, folder: Path, warn: Callable[[str], None]) -> None:
        self._folder = folder
        self._warn = warn
        self._files: dict[tuple[str, bool], Path | None] = {}

    def file(self, image: bpy.types.Image, is_data: bool = False) -> Path | None:
        """None if the image has no pixels, with a message. `is_data`: numbers, which are never linearised."""
        key = (image.name_full, is_data)
        if key not in self._files:
            self._files[key] = self._write(image, is_data)
        return self._files[key]

    def _write(self, image: bpy.types.Image, is_data: bool) -> Path | None:
        width, height = image.size
        if width * height == 0:
            self._warn(f"the image {image.name} is missing: {image.filepath}")
            return None
        pixels = numpy.empty(width * height * image.channels, "f4")
        image.pixels.foreach_get(pixels)
        pixels = pixels.reshape(height, width, image.channels)[::-1]
        if not is_data and not image.is_float and image.colorspace_settings.name == "sRGB":
            pixels = pixels.copy()
            pixels[..., :3] = linear(pixels[..., :3])
        name = hashlib.sha256(pixels.tobytes()).hexdigest()[:20]
        path = self._folder / f"{name}.exr"
        if not path.exists():
            self._folder.mkdir(parents=True, exist_ok=True)
            exr.write(path, pixels if image.channels > 2 else pixels[..., :1])
        return path


def linear(srgb: numpy.ndarray) -> numpy.ndarray:
    """IEC 61966-2-1."""
    return numpy.where(srgb <= 0.04045, srgb / 12.92, ((srgb + 0.055) / 1.055) ** 2.4)
