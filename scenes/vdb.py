"""Writes a grid of numbers as an OpenVDB file without the OpenVDB library. It writes version 224 of the format, uncompressed.

    write(path, name, side, value, size=0.1, low=(0, 0, 0), kind="float")

The lattice has side x side x side points at a distance of `size`. The first one lies at `low`. value(x, y, z) is called for each
point with its indices, which start at 0. `side` is at most 4096. With kind="double" the grid holds doubles, which some tests
need.
"""
import struct

# Along each axis, a leaf has 8 points, an inner node has 16 leaves, and an outer node has 32 inner nodes.
LEAF, INNER, OUTER = 8, 16, 32
UNCOMPRESSED = b"\x06"  # This byte says that all values follow, active or not.


def text(s):
    return struct.pack("<I", len(s)) + s.encode()


def metadata(entries):
    return struct.pack("<I", len(entries)) + b"".join(text(k) + text("string") + text(v) for k, v in entries.items())


def mask(bits, count):
    return sum(1 << b for b in bits).to_bytes(count // 8, "little")


def inside(point, unit, across):
    """Returns the number of a child in its node. Children are `unit` points wide, `across` of them lie along each axis, and z varies fastest."""
    x, y, z = (c // unit % across for c in point)
    return (x * across + y) * across + z


def write(path, name, side, value, size=0.1, low=(0, 0, 0), kind="float"):
    form = {"float": "f", "double": "d"}[kind]
    leaves = {}  # The key is the origin of the leaf.
    for origin in ((x, y, z) for x in range(0, side, LEAF) for y in range(0, side, LEAF) for z in range(0, side, LEAF)):
        points = [(origin[0] + x, origin[1] + y, origin[2] + z) for x in range(LEAF) for y in range(LEAF) for z in range(LEAF)]
        values = [value(*p) if max(p) < side else 0.0 for p in points]
        if any(values):
            leaves[origin] = (mask([i for i, v in enumerate(values) if v], LEAF ** 3), struct.pack(f"<{LEAF ** 3}{form}", *values))
    node = LEAF * INNER
    nodes = sorted({tuple(c // node * node for c in origin) for origin in leaves}, key=lambda n: inside(n, node, OUTER))
    outer_bits, inner_bits = OUTER ** 3, INNER ** 3
    ordered = {n: sorted((o for o in leaves if tuple(c // node * node for c in o) == n), key=lambda o: inside(o, LEAF, INNER)) for n in nodes}
    tree = struct.pack("<I", 1) + struct.pack(f"<{form}II", 0, 0, 1) + struct.pack("<iii", 0, 0, 0)
    tree += mask([inside(n, node, OUTER) for n in nodes], outer_bits) + mask([], outer_bits) + UNCOMPRESSED + struct.pack(f"<{outer_bits}{form}", *[0] * outer_bits)
    for n in nodes:
        tree += mask([inside(o, LEAF, INNER) for o in ordered[n]], inner_bits) + mask([], inner_bits) + UNCOMPRESSED
        tree += struct.pack(f"<{inner_bits}{form}", *[0] * inner_bits)
        tree += b"".join(leaves[o][0] for o in ordered[n])
    buffers = b"".join(leaves[o][0] + UNCOMPRESSED + leaves[o][1] for n in nodes for o in ordered[n])
    rows = [size, 0, 0, 0, 0, size, 0, 0, 0, 0, size, 0, *low, 1]
    placing = text("AffineMap") + struct.pack("<16d", *rows)
    about = struct.pack("<I", 0) + metadata({"class": "fog volume", "name": name}) + placing
    head = struct.pack("<qIIIB", 0x56444220, 224, 10, 0, 1) + b"00000000-0000-0000-0000-000000000000" + metadata({}) + struct.pack("<I", 1)
    head += text(name) + text(f"Tree_{kind}_5_4_3") + text("")
    begin = len(head) + 24
    blocks = begin + len(about) + len(tree)
    with open(path, "wb") as file:
        file.write(head + struct.pack("<qqq", begin, blocks, blocks + len(buffers)) + about + tree + buffers)
