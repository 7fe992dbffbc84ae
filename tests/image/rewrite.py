"""Rewrites RIB so that it says the same in another way: objects in another order, polygons as one mesh, or primitives in halves. A function returns
the text unchanged if it finds nothing to rewrite. It looks for requests at the beginning of lines, where the gallery writes them.
"""
import re

NUMBERS = r"[-+.\deE \t]+"
POLYGON = re.compile(rf'^[ \t]*Polygon "P" \[({NUMBERS})\][ \t]*$', re.M)
BILINEAR = re.compile(rf'^[ \t]*Patch "bilinear" "P" \[({NUMBERS})\][ \t]*$', re.M)
SWEPT = re.compile(rf"\b((?:Sphere|Cone|Cylinder|Paraboloid|Disk|Torus|Hyperboloid) {NUMBERS}) 360[ \t]*$", re.M)
SHAPE = re.compile(r"[ \t]*(?:Polygon|Patch|Sphere|Cone|Cylinder|Paraboloid|Disk|Torus|Hyperboloid) .*\n")
OPENS, CLOSES = re.compile(r"\b(?:Attribute|Transform|Solid|Object|Archive|Motion|If|Frame)Begin\b"), re.compile(r"\b(?:Attribute|Transform|Solid|Object|Archive|Motion|If|Frame)End\b")
STAYS = re.compile(r"LightSource|Illuminate")


def pieces(text):
    """Returns the lines of the world in pieces. An attribute block stays in one piece."""
    out, depth = [], 0
    for line in text.splitlines(keepends=True):
        if depth > 0:
            out[-1] += line
        else:
            out.append(line)
        depth += len(OPENS.findall(line)) - len(CLOSES.findall(line))
    return out


def movable(piece):
    if piece.lstrip().startswith("AttributeBegin"):
        return not STAYS.search(piece)
    return SHAPE.fullmatch(piece)


def reordered(text):
    """Reverses the order of neighbours that may change places."""
    head, world, rest = text.partition("WorldBegin")
    out, run = [], []
    for piece in [*pieces(rest), ""]:
        if movable(piece):
            run.append(piece)
            continue
        out += [*reversed(run), piece]
        run = []
    return head + world + "".join(out)


def points(numbers):
    values = [float(n) for n in numbers.split()]
    return [values[i:i + 3] for i in range(0, len(values), 3)]


def written(corners):
    return "  ".join(" ".join(f"{v:.9g}" for v in p) for p in corners)


def middle(a, b):
    return [(x + y) / 2 for x, y in zip(a, b)]


def merged(text):
    """Makes one mesh of neighbouring polygons."""
    def mesh(match):
        polygons = [points(p[1]) for p in POLYGON.finditer(match[0])]
        corners = [p for polygon in polygons for p in polygon]
        counts = " ".join(str(len(p)) for p in polygons)
        return f'PointsPolygons [{counts}] [{" ".join(map(str, range(len(corners))))}] "P" [{written(corners)}]'
    return re.sub(rf"(?:{POLYGON.pattern}\n){{2,}}", lambda m: mesh(m) + "\n", text, flags=re.M)


def halves(match):
    corners = points(match[1])
    if len(corners) != 4:
        return match[0]
    a, b, c, d = corners
    near, far = middle(a, b), middle(c, d)
    return f'Polygon "P" [{written([a, near, far, d])}]\nPolygon "P" [{written([near, b, c, far])}]'


def half_patches(match):
    a, b, c, d = points(match[1])
    near, far = middle(a, b), middle(c, d)
    return f'Patch "bilinear" "P" [{written([a, near, c, far])}]\nPatch "bilinear" "P" [{written([near, b, far, d])}]'


def split(text):
    """Cuts quadrilaterals and full sweeps in halves, unless they move, belong to solids or are lamps."""
    out = []
    for piece in pieces(text):
        if not re.search(r"(?:Motion|Solid)Begin|AreaLightSource", piece):
            piece = POLYGON.sub(halves, piece)
            piece = BILINEAR.sub(half_patches, piece)
            piece = SWEPT.sub(r"\1 180\nRotate 180 0 0 1\n\1 180\nRotate -180 0 0 1", piece)
        out.append(piece)
    return "".join(out)
