"""Reading float pictures in tests with nothing but the standard library: uncompressed float TIFF, as `tomales -o x.tif` with
Quantize 0 writes it, is more than we need; `oiiotool` (openimageio-tools) dumps pixels of any format as text."""
import re
import subprocess


def pixels(path):
    """{(x, y): (R, G, B, ...)} of an image file, by raster position."""
    text = subprocess.run(["oiiotool", "-q", path, "--dumpdata"], capture_output=True, text=True, check=True).stdout
    found = {}
    for line in text.splitlines():
        if m := re.match(r"\s*Pixel \((\d+), (\d+)\): (.*)", line):
            found[int(m[1]), int(m[2])] = tuple(float(v) for v in m[3].split())
    return found
