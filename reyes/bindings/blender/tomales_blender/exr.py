"""Uncompressed OpenEXR files of one part as numpy arrays: textures out, render passes in.

The format is that of "OpenEXR File Layout" (openexr.com). Blender has no module of its own for it in all versions.
"""
from __future__ import annotations

import os
import struct

import numpy

_MAGIC, _VERSION = 20000630, 2
_NONE = 0
_TYPES = {0: numpy.dtype("<u4"), 1: numpy.dtype("<f2"), 2: numpy.dtype("<f4")}


def write(path: str | os.PathLike[str], pixels: numpy.ndarray) -> None:
    """float16 of shape (height, width, channels), the top row first; channels are R, G, B, A, or fewer of these."""
    height, width, count = pixels.shape
    names = sorted("RGBA"[:count])
    order = ["RGBA".index(name) for name in names]
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
    ]
    header = struct.pack("<ii", _MAGIC, _VERSION)
    for name, kind, value in attributes:
        header += name.encode() + b"\0" + kind.encode() + b"\0" + struct.pack("<i", len(value)) + value
    header += b"\0"
    row_bytes = 8 + width * count * 2
    rows = numpy.empty((height, row_bytes), "u1")
    rows[:, :8] = numpy.column_stack([numpy.arange(height), numpy.full(height, row_bytes - 8)]).astype("<i4").view("u1").reshape(height, 8)
    planes = pixels[:, :, order].transpose(0, 2, 1).astype("<f2")
    rows[:, 8:] = numpy.ascontiguousarray(planes).view("u1").reshape(height, -1)
    first = len(header) + 8 * height
    with open(path, "wb") as file:
        file.write(header + (first + row_bytes * numpy.arange(height)).astype("<u8").tobytes() + rows.tobytes())


def read(path: str | os.PathLike[str]) -> dict[str, numpy.ndarray]:
    """Channels of shape (height, width), float32, the top row first: those of the data window.

    Raises OSError for files of another kind.
    """
    with open(path, "rb") as file:
        data = file.read()
    try:
        return _read(data)
    except (ValueError, KeyError, IndexError, struct.error) as problem:
        raise OSError(f"{os.fspath(path)} is no uncompressed EXR file of one part: {problem}") from None


def _read(data: bytes) -> dict[str, numpy.ndarray]:
    magic, version = struct.unpack_from("<ii", data)
    if magic != _MAGIC or version & ~0x400 != _VERSION:
        raise ValueError(f"magic {magic}, version {version}")
    at, attributes = 8, {}
    while data[at]:
        name, at = _text(data, at)
        _, at = _text(data, at)
        (size,) = struct.unpack_from("<i", data, at)
        attributes[name] = data[at + 4 : at + 4 + size]
        at += 4 + size
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
