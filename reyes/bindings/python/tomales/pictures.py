"""Reads pictures as numpy arrays, through OpenImageIO's own module (Debian: python3-openimageio)."""
from __future__ import annotations

import os
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import numpy


@dataclass(frozen=True)
class Picture:
    """One part of a picture file."""

    pixels: numpy.ndarray  #: float32 of shape (height, width, channels), with the top row first. EXR files are linear.
    channels: tuple[str, ...]  #: The channels' names, such as R, G, B, A, z, albedo.R.
    attributes: dict[str, Any]  #: The attributes of the file's header.

    def __getitem__(self, name: str) -> numpy.ndarray:
        """Returns a channel of shape (height, width), or of shape (height, width, n) all channels whose names begin
        with "name.".

        "rgb" is R, G and B. Raises KeyError.
        """
        if name in self.channels:
            return self.pixels[..., self.channels.index(name)]
        if name == "rgb":
            return self.pixels[..., [self.channels.index(c) for c in "RGB"]]
        layer = [i for i, channel in enumerate(self.channels) if channel.startswith(name + ".")]
        if not layer:
            raise KeyError(f"no channel {name} among {', '.join(self.channels)}")
        return self.pixels[..., layer]


def read(path: str | os.PathLike[str], part: int = 0) -> Picture:
    """Reads a file. Raises ImportError without OpenImageIO, and OSError if the file cannot be read."""
    try:
        import OpenImageIO as oiio
    except ImportError:
        raise ImportError("pictures are read by OpenImageIO's Python module (Debian: python3-openimageio)") from None
    file = oiio.ImageInput.open(os.fspath(path))
    if not file:
        raise OSError(f"{os.fspath(path)}: {oiio.geterror()}")
    try:
        if not file.seek_subimage(part, 0):
            raise OSError(f"{os.fspath(path)}: there is no part {part}")
        spec = file.spec()
        pixels = file.read_image(part, 0, 0, spec.nchannels, "float")
        if pixels is None:
            raise OSError(f"{os.fspath(path)}: {file.geterror()}")
        return Picture(pixels, tuple(spec.channelnames), {a.name: a.value for a in spec.extra_attribs})
    finally:
        file.close()
