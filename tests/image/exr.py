"""Reads the OpenEXR files that most tests look at: one part of scanlines, uncompressed or compressed by ZIP. Starting oiiotool
would take several times as long as a small render. "OpenEXR File Layout" (openexr.com) describes the layout."""
import itertools
import pathlib
import struct
import zlib

SCANLINES = {0: 1, 2: 1, 3: 16}  # This is the number of rows of a chunk, by compression: none, ZIPS, ZIP.
MAGIC = b"\x76\x2f\x31\x01"
PARTS = 0x1000                   # This flag of the version means several parts.
NOT_SCANLINES = 0xa00 | PARTS    # These mean tiles and deep pixels.
NUMBERS = {0: "I", 1: "e", 2: "f"}


def _text(data, at):
    end = data.index(0, at)
    return data[at:end].decode(), end + 1


def _header(data):
    """Returns {attribute: (its type, its bytes)} of the first part, and the offset where they end."""
    out, at = {}, 8
    while data[at]:
        name, at = _text(data, at)
        kind, at = _text(data, at)
        size = struct.unpack_from("<i", data, at)[0]
        out[name], at = (kind, data[at + 4:at + 4 + size]), at + 4 + size
    return out, at + 1


def _channels(attribute):
    """Returns the name and the struct format of each channel, in the order of the file."""
    out, at = [], 0
    while attribute[at]:
        name, at = _text(attribute, at)
        assert struct.unpack_from("<ii", attribute, at + 8) == (1, 1), f"{name} has not all pixels"
        out.append((name, NUMBERS[struct.unpack_from("<i", attribute, at)[0]]))
        at += 16
    return out


def _unzipped(packed, size):
    """Unpacks a chunk. A chunk that compression would make larger is stored as it is."""
    if len(packed) == size:
        return packed
    sums = bytes(itertools.accumulate(zlib.decompress(packed), lambda before, step: (before + step - 128) & 255))
    out, half = bytearray(size), (size + 1) // 2
    out[0::2], out[1::2] = sums[:half], sums[half:]
    return out


def _order(name):
    """Orders channels as oiiotool does: by layer, and red, green, blue and alpha first in each."""
    layer, _, part = name.rpartition(".")
    return layer, {"R": 0, "G": 1, "B": 2, "A": 3}.get(part.upper(), 4), part


def _only_header(path):
    """Returns the header of a file of one part."""
    data = pathlib.Path(path).read_bytes()
    assert data[:4] == MAGIC and not struct.unpack_from("<I", data, 4)[0] & PARTS, path
    return _header(data)[0]


def texts(path):
    """Returns {attribute: text} of the attributes that are strings."""
    return {name: value.decode() for name, (kind, value) in _only_header(path).items() if kind == "string"}


def window(path):
    """Returns x, y, width and height of the data window."""
    x0, y0, x1, y1 = struct.unpack("<4i", _only_header(path)["dataWindow"][1])
    return x0, y0, x1 - x0 + 1, y1 - y0 + 1


def read(path, wanted=None):
    """Returns the display window's size and {(x, y) within it: numbers} of the data window, with the channels in the order of `wanted`, or of
    oiiotool; all of `wanted` must be there. Returns None if the file is of a layout that is not read here."""
    data = pathlib.Path(path).read_bytes()
    if data[:4] != MAGIC or struct.unpack_from("<I", data, 4)[0] & NOT_SCANLINES:
        return None
    header, at = _header(data)
    channels = _channels(header["channels"][1])
    lines = SCANLINES.get(header["compression"][1][0])
    if lines is None:
        return None
    x0, y0, x1, y1 = struct.unpack("<4i", header["displayWindow"][1])
    left, top, right, bottom = struct.unpack("<4i", header["dataWindow"][1])
    width = right - left + 1
    line = sum(width * struct.calcsize(code) for _, code in channels)
    order = wanted or sorted((name for name, _ in channels), key=_order)
    out = {}
    for start in struct.unpack_from(f"<{-(-(bottom - top + 1) // lines)}Q", data, at):
        y, size = struct.unpack_from("<ii", data, start)
        count = min(lines, bottom + 1 - y)
        chunk = _unzipped(data[start + 8:start + 8 + size], count * line)
        for row in range(count):
            numbers, place = {}, row * line
            for name, code in channels:
                numbers[name] = struct.unpack_from(f"<{width}{code}", chunk, place)
                place += width * struct.calcsize(code)
            out.update(zip(((x - x0, y + row - y0) for x in range(left, right + 1)), zip(*(numbers[name] for name in order))))
    return (x1 - x0 + 1, y1 - y0 + 1), out
