"""Uncompressed OpenEXR files of one part as numpy arrays. This writes textures in tiles, and reads render passes in
rows.

The format is that of "OpenEXR File Layout" (openexr.com). Not every version of Blender has a module for this format.
"""
from __future__ import annotations

import os
import struct
from collections.abc import Iterator

import numpy

_MAGIC, _VERSION = 20000630, 2
_NONE = 0
_TYPES = {0: numpy.dtype("<u4"), 1: numpy.dtype("<f2"), 2: numpy.dtype("<f4")}


_TILE = 64
_MIPMAP_LEVELS, _TILED = 1, 0x200  # The number of levels is rounded down.


def write_texture(path: str | os.PathLike[str], pixels: numpy.ndarray) -> None:
    """Writes a float16 array of shape (height, width, channels) with the top row first. The channels are R, G, B, A,
    or the first of these.

    The file has tiles of all levels down to one pixel, and it repeats: the renderer reads such a file as it is.
    """
    height, width, count = pixels.shape
    names = sorted("RGBA"[:count])
    box = struct.pack("<4i", 0, 0, width - 1, height - 1)
    attributes = [
        ("channels", "chlist", b"".join(n.encode() + b"\0" + struct.pack("<iB3xii", 1, 0, 1, 1) for n in names) + b"\0"),
        ("compression", "compression", bytes([_NONE])),
        ("dataWindow", "box2i", box),
        ("displayWindow", "box2i", box),
        ("lineOrder", "lineOrder", b"\0"),
        ("pixelAspectRatio", "float", struct.pack("<f", 1)),
        ("screenWindowCenter", "v2f", struct.pack("<2f", 0, 0)),
        ("screenWindowWidth", "float", struct.pack("<f", 1)),
        ("tiles", "tiledesc", struct.pack("<IIB", _TILE, _TILE, _MIPMAP_LEVELS)),
        ("wrapmodes", "string", b"periodic,periodic"),  # The texture repeats, as Blender's Image Texture does.
    ]
    header = struct.pack("<ii", _MAGIC, _VERSION | _TILED)
    for name, kind, value in attributes:
        header += name.encode() + b"\0" + kind.encode() + b"\0" + struct.pack("<i", len(value)) + value
    planes = pixels[:, :, ["RGBA".index(name) for name in names]].astype("f4")
    tiles = [tile for level, picture in enumerate(_levels(planes)) for tile in _tiles(level, picture)]
    header += b"\0"
    ends = numpy.cumsum([len(header) + 8 * len(tiles), *map(len, tiles)])
    with open(path, "wb") as file:
        file.write(header + ends[:-1].astype("<u8").tobytes() + b"".join(tiles))


def _levels(picture: numpy.ndarray) -> Iterator[numpy.ndarray]:
    """Yields levels that each have half the width and height of the one before. A pixel is the mean of two by two
    pixels. A last odd row or column is left out."""
    yield picture
    while max(picture.shape[:2]) > 1:
        for axis in (0, 1):
            size = picture.shape[axis] // 2
            if size:
                first, second = (picture.take(numpy.arange(size) * 2 + i, axis) for i in (0, 1))
                picture = (first + second) / 2
        yield picture


def _tiles(level: int, picture: numpy.ndarray) -> Iterator[bytes]:
    """Yields the tiles of a level. Tiles at the right and at the bottom are smaller if less is left for them."""
    for y in range(0, picture.shape[0], _TILE):
        for x in range(0, picture.shape[1], _TILE):
            data = numpy.ascontiguousarray(picture[y : y + _TILE, x : x + _TILE].transpose(0, 2, 1), "<f2").tobytes()
            yield struct.pack("<5i", x // _TILE, y // _TILE, level, level, len(data)) + data


def read(path: str | os.PathLike[str]) -> dict[str, numpy.ndarray]:
    """Returns the channels of the data window as float32 arrays of shape (height, width), with the top row first.

    Raises OSError for files of another kind.
    """
    with open(path, "rb") as file:
        data = file.read()
    try:
        return _read(data)
    except (ValueError, KeyError, IndexError, struct.error) as problem:
        raise OSError(f"{os.fspath(path)} is no uncompressed EXR file of one part: {problem}") from None


def texts(path: str | os.PathLike[str]) -> dict[str, str]:
    """Returns the attributes of a file that are strings. Raises OSError for the files that read() refuses."""
    with open(path, "rb") as file:
        data = file.read()
    try:
        return {name: value.decode() for name, (kind, value) in _header(data)[0].items() if kind == "string"}
    except (ValueError, IndexError, struct.error) as problem:
        raise OSError(f"{os.fspath(path)} is no EXR file of one part: {problem}") from None


def _header(data: bytes) -> tuple[dict[str, tuple[str, bytes]], int]:
    """Returns the types and values of the attributes, and the offset where they end."""
    magic, version = struct.unpack_from("<ii", data)
    if magic != _MAGIC or version & ~0x400 != _VERSION:
        raise ValueError(f"magic {magic}, version {version}")
    at, attributes = 8, {}
    while data[at]:
        name, at = _text(data, at)
        kind, at = _text(data, at)
        (size,) = struct.unpack_from("<i", data, at)
        attributes[name] = kind, data[at + 4 : at + 4 + size]
        at += 4 + size
    return attributes, at


def _read(data: bytes) -> dict[str, numpy.ndarray]:
    typed, at = _header(data)
    attributes = {name: value for name, (_, value) in typed.items()}
    if attributes["compression"][0] != _NONE:
        raise ValueError("it is compressed")
    x0, y0, x1, y1 = struct.unpack("<4i", attributes["dataWindow"])
    width, height = x1 - x0 + 1, y1 - y0 + 1
    channels = _channels(attributes["channels"])
    row_bytes = 8 + sum(kind.itemsize for _, kind in channels) * width
    offsets = numpy.frombuffer(data, "<u8", height, at + 1).astype("i8")
    rows = numpy.frombuffer(data, "u1")[offsets[:, None] + numpy.arange(row_bytes)]
    out, begin = {}, 8
    for name, kind in channels:
        end = begin + kind.itemsize * width
        out[name] = numpy.ascontiguousarray(rows[:, begin:end]).view(kind).astype("f4")
        begin = end
    return out


def _channels(data: bytes) -> list[tuple[str, numpy.dtype]]:
    out, at = [], 0
    while data[at]:
        name, at = _text(data, at)
        out.append((name, _TYPES[struct.unpack_from("<i", data, at)[0]]))
        at += 16
    return out


def _text(data: bytes, at: int) -> tuple[str, int]:
    end = data.index(b"\0", at)
    return data[at:end].decode(), end + 1
