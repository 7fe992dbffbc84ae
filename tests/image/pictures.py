"""Reads float pixels of a picture with nothing but the standard library. Files that exr.py does not read are turned by oiiotool
(openimageio-tools, which the install step brings) into uncompressed float TIFF, which is simple to read."""
import pathlib
import struct
import subprocess
import tempfile

import exr


def _tiff_fields(data):
    """Returns {tag: values} of the first directory of a little-endian TIFF."""
    types = {1: "B", 3: "H", 4: "I"}
    at = struct.unpack_from("<I", data, 4)[0]
    fields = {}
    for i in range(struct.unpack_from("<H", data, at)[0]):
        tag, kind, count = struct.unpack_from("<HHI", data, at + 2 + 12 * i)
        if kind not in types:
            continue
        layout = f"<{count}{types[kind]}"
        where = at + 2 + 12 * i + 8
        if struct.calcsize(layout) > 4:
            where = struct.unpack_from("<I", data, where)[0]
        fields[tag] = struct.unpack_from(layout, data, where)
    return fields


def pixels(path):
    """Returns {(x, y): (R, G, B, ...)} of an image file. Pixels outside of the data window of a crop are black."""
    if read := exr.read(path):
        (width, height), seen = read
        black = (0.0,) * len(next(iter(seen.values())))
        return {(x, y): seen.get((x, y), black) for y in range(height) for x in range(width)}
    with tempfile.TemporaryDirectory() as folder:
        tiff = pathlib.Path(folder) / "float.tif"
        subprocess.run(["oiiotool", "-q", str(path), "--croptofull", "-d", "float", "--compression", "none", "--scanline",
                        "--planarconfig", "contig", "-o", str(tiff)], check=True)
        data = tiff.read_bytes()
    fields = _tiff_fields(data)
    width, height, channels = fields[256][0], fields[257][0], fields[277][0]
    raw = b"".join(data[o:o + n] for o, n in zip(fields[273], fields[279]))
    values = struct.unpack(f"<{width * height * channels}f", raw[:4 * width * height * channels])
    return {(i % width, i // width): values[i * channels:(i + 1) * channels]
            for i in range(width * height)}
