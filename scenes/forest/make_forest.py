#!/usr/bin/env python3
"""Writes forest.rib: a beech wood in October, with the sun low behind it, and a stag in its clearing.

    make_forest.py > forest.rib

Units are metres. x points to the right, y up and z away from the eye.
"""
import math
import pathlib
import random
import sys

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1]))
from parts import flat, head, numbers, part

random.seed(11)
SUN = (-0.21, 0.315, 0.926)            # This direction to the sun stands in forest.h too.
CLEARING = (-2.8, 16.5, 5.5)           # The clearing has this x, z and radius.
STAG = (-2.1, 13.4)


def path(z):
    """Returns the x of the middle of the path."""
    return 0.55 - 0.9 * math.sin(0.17 * z) - 0.05 * z


def ground(x, z):
    away = abs(x - path(z))
    bank = 1 - math.exp(-(max(0, away - 0.7) / 3.2) ** 2)
    return bank * (0.55 + 0.25 * math.sin(0.31 * x + 1.3) * math.sin(0.23 * z + 0.4)) + 0.06 * math.sin(0.9 * x + 0.7 * z) * math.sin(0.8 * z) + 0.010 * z


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def unit(a):
    return tuple(c / math.hypot(*a) for c in a)


def limb(points, radii, side=(0, 0, 1), around=8, flare=lambda k, a: 1):
    """Returns a tube through points. A ring is a circle of one radius, or an ellipse of two (across `side` and along it), and
    flare(ring, angle) scales it."""
    rings = []
    for k, (point, radius) in enumerate(zip(points, radii)):
        before, after = points[max(k - 1, 0)], points[min(k + 1, len(points) - 1)]
        along = unit([b - a for a, b in zip(before, after)])
        across = unit(cross(side, along))
        other = cross(along, across)
        wide, deep = radius if isinstance(radius, tuple) else (radius, radius)
        angles = [2 * math.pi * n / around for n in range(around)]
        rings.append([tuple(p + flare(k, a) * (wide * math.cos(a) * u + deep * math.sin(a) * v) for p, u, v in zip(point, across, other)) for a in angles])
    rings = [rings[0]] * 2 + rings + [rings[-1]] * 2
    return f'Basis "b-spline" 1 "b-spline" 1 PatchMesh "bicubic" {around} "periodic" {len(rings)} "nonperiodic" "P" [{numbers(flat(flat(rings)))}]'


# A leaf is two quadrangles with a fold between them. The shader cuts them to the shape of a leaf.
def leaf(base, along, up, size):
    """Returns six points: left, middle and right at the stalk, and the same at the tip."""
    side = cross(unit(up), along)
    return [tuple(b + size * (t * a + w * s + (0.10 * abs(w) - droop) * u) for b, a, s, u in zip(base, along, side, up))
            for t, droop in ((0, 0), (1, 0.06)) for w in (-0.36, 0, 0.36)]


def leaves(all_leaves):
    """Returns one mesh of leaves. The variable "which" differs from leaf to leaf. st is (0, 0) left of the stalk and (1, 1) right of the
    tip."""
    count = len(all_leaves)
    faces = " ".join(f"{6 * k} {6 * k + 1} {6 * k + 4} {6 * k + 3} {6 * k + 1} {6 * k + 2} {6 * k + 5} {6 * k + 4}" for k in range(count))
    which = " ".join(f"{random.random():.2f}" for _ in range(count) for _ in (0, 1))
    return (f'PointsPolygons [{"4 4 " * count}] [{faces}] "P" [{numbers(flat(flat(all_leaves)), ".3f")}] "varying float[2] st" [{"0 0 .5 0 1 0 0 1 .5 1 1 1 " * count}] '
            f'"uniform float which" [{which}]')


def spray(origin, heading, length, size, gap, droop=0.25):
    """Returns leaves on both sides of a twig and of its side twigs, nearly in one plane, and the twigs."""
    out, twigs = [], []

    def twig(start, angle, reach, depth):
        position, points, side = start, [start], 1
        steps = max(2, round(reach / gap))
        for k in range(steps):
            angle += random.uniform(-0.12, 0.12)
            fall = droop * (k / steps + 0.6 * depth) * gap
            position = (position[0] + gap * math.cos(angle), position[1] - fall + random.uniform(-0.01, 0.01), position[2] + gap * math.sin(angle))
            points.append(position)
            side = -side
            turn = angle + side * random.uniform(0.7, 1.1)
            if depth < 1 and 0 < k < steps - 1:
                twig(position, turn, reach * 0.55 * (1 - 0.7 * k / steps), depth + 1)
            up = unit((random.uniform(-0.35, 0.35), 1, random.uniform(-0.35, 0.35)))
            flatwise = (math.cos(turn), random.uniform(-0.35, 0.1), math.sin(turn))
            out.append(leaf(position, unit(flatwise), up, size * random.uniform(0.75, 1.15)))
        out.append(leaf(position, (math.cos(angle), -0.2, math.sin(angle)), (0, 1, 0), size))
        twigs.append(points)

    twig(origin, heading, length, 0)
    return out, twigs


def sticks(twigs, thick, thin):
    points, widths = [], []
    for twig in twigs:
        points += twig
        widths += [thick + (thin - thick) * k / (len(twig) - 1) for k in range(len(twig))]
    return f'Curves "linear" [{numbers(map(len, twigs))}] "nonperiodic" "P" [{numbers(flat(points), ".3f")}] "varying float width" [{numbers(widths)}]'


def thing(name, surface, *requests):
    """Prints an object that instances repeat."""
    print(f'ObjectBegin "{name}"\n  Surface {surface}')
    for request in requests:
        print("  " + request)
    print("ObjectEnd")


def trunk(name, tall, radius):
    heights = [-0.4, 0, 0.2, 0.5, 1.1, 2.2, 4, 7, 10, 14, 18, tall]
    bend, phase, roots = random.uniform(0.1, 0.5), random.uniform(0, 6), random.randint(4, 6)
    points = [(bend * math.sin(0.23 * y + phase) * min(1, y / 4) + 0.05 * math.sin(0.9 * y + phase), y, bend * math.cos(0.2 * y + 2 * phase) * min(1, max(y, 0) / 5)) for y in heights]
    radii = [radius * (1 - 0.8 * max(y, 0) / tall) * (1 + 0.55 * math.exp(-max(y, 0) / 0.45)) for y in heights]
    thing(name, '"bark"', limb(points, radii, around=14, flare=lambda k, a: 1 + 0.30 * math.exp(-max(heights[k], 0) / 0.6) * math.sin(roots * a + phase) + 0.04 * math.sin(2 * a + heights[k])))


def crown(name, low, high, sprays, size, gap):
    """Prints sprays in tiers around a trunk and the branches that bear them. The crown is wide below and narrow above."""
    foliage, branches = [], []
    for k in range(sprays):
        h = (k + random.random()) / sprays
        y, angle = low + h * (high - low), 2.4 * k + random.uniform(-0.4, 0.4)
        reach = (1.0 + 2.9 * math.sin(math.pi * (0.25 + 0.7 * h))) * random.uniform(0.55, 1.1)
        inner = reach * 0.45
        start = (inner * math.cos(angle), y + 0.35 * inner, inner * math.sin(angle))
        out, twigs = spray(start, angle, reach * 0.75, size, gap)
        foliage += out
        branches.append([(0, y - 0.35 * inner, 0), (0.5 * start[0], y + 0.1 * inner, 0.5 * start[2]), start])
        branches += twigs[-1:]
    thing(name + " wood", '"bark" "float old" [0]', sticks(branches, 0.16 * size if size > 0.1 else 0.012, 0.006))
    thing(name, '"beech"', leaves(foliage))


def litter(name, count, wide):
    """Prints fallen leaves, which lie at random angles."""
    fallen = []
    for _ in range(count):
        x, z, angle = random.uniform(-wide, wide), random.uniform(-wide, wide), random.uniform(0, 2 * math.pi)
        along = unit((math.cos(angle), random.uniform(-0.1, 0.35), math.sin(angle)))
        fallen.append(leaf((x, random.uniform(0.004, 0.03), z), along, unit((random.uniform(-0.5, 0.5), 1, random.uniform(-0.5, 0.5))), random.uniform(0.055, 0.085)))
    thing(name, '"beech" "float fallen" [1]', leaves(fallen))


def fern(name, fronds, size):
    """Prints arching fronds in the shape of a shuttlecock. The shader cuts their pinnae (leaflets) out of strips."""
    strips = []
    for k in range(fronds):
        angle, steep = 2.4 * k + random.uniform(-0.3, 0.3), random.uniform(0.6, 1.15)
        length, rows = size * random.uniform(0.75, 1.1), 9
        x, y, lean, points = 0.03, 0, steep + 0.35, []
        for row in range(rows + 1):
            tilt = 0.16 * length * (1 - 0.5 * row / rows)
            for w, drop in ((-1, 0.25), (0, 0), (1, 0.25)):
                a, b, c = x + tilt * drop * math.sin(lean), y - tilt * drop * math.cos(lean), w * tilt
                points.append((a * math.cos(angle) - c * math.sin(angle), b, a * math.sin(angle) + c * math.cos(angle)))
            lean -= (steep + 0.55) / rows * (0.5 + row / rows)
            x, y = x + length / rows * math.cos(lean), y + length / rows * math.sin(lean)
        strips.append(f'PatchMesh "bilinear" 3 "nonperiodic" {rows + 1} "nonperiodic" "P" [{numbers(flat(points), ".3f")}]')
    thing(name, '"fern"', *strips)


def stag():
    """Returns the parts of a stag that looks along +x. The eye sees its right side."""
    spine = [(-0.66, 1.02), (-0.64, 1.06), (-0.52, 1.06), (-0.25, 1.03), (0.05, 1.0), (0.3, 1.02), (0.47, 1.12), (0.58, 1.30), (0.66, 1.47), (0.72, 1.58)]
    girth = [(0.03, 0.03), (0.11, 0.09), (0.21, 0.16), (0.235, 0.19), (0.23, 0.19), (0.25, 0.175), (0.2, 0.14), (0.135, 0.1), (0.1, 0.075), (0.075, 0.06)]
    parts = [limb([(x, y, 0) for x, y in spine], girth),
             limb([(0.64, 1.66, 0), (0.68, 1.665, 0), (0.78, 1.63, 0), (0.9, 1.57, 0), (0.98, 1.53, 0), (1.0, 1.52, 0)], [(0.03, 0.03), (0.085, 0.075), (0.085, 0.07), (0.055, 0.045), (0.04, 0.035), (0.02, 0.02)]),
             limb([(-0.66, 1.1, 0), (-0.72, 1.03, 0), (-0.735, 0.92, 0)], [0.04, 0.045, 0.012])]
    for z, fore, back in ((0.09, 0.06, 0.05), (-0.09, -0.07, -0.10)):
        parts.append(limb([(0.33, 0.98, 0.7 * z), (0.36, 0.72, z), (0.37 + fore, 0.47, z), (0.36 + fore, 0.25, z), (0.35 + fore, 0.08, z), (0.38 + fore, 0.0, z)], [0.11, 0.075, 0.038, 0.026, 0.03, 0.035]))
        parts.append(limb([(-0.46, 1.0, 0.7 * z), (-0.43 + 0.5 * back, 0.75, z), (-0.55 + back, 0.5, z), (-0.52 + back, 0.26, z), (-0.5 + back, 0.08, z), (-0.47 + back, 0.0, z)], [0.17, 0.12, 0.045, 0.028, 0.03, 0.035]))
        ear = 1 if z > 0 else -1
        parts.append(limb([(0.66, 1.7, 0.05 * ear), (0.62, 1.75, 0.12 * ear), (0.58, 1.8, 0.2 * ear)], [(0.02, 0.02), (0.045, 0.02), (0.006, 0.006)], side=(1, 0, 0)))
        beam = [(0.70, 1.71, 0.03 * ear), (0.58, 1.86, 0.12 * ear), (0.53, 2.05, 0.24 * ear), (0.60, 2.25, 0.3 * ear), (0.70, 2.38, 0.26 * ear)]
        parts.append(limb(beam, [0.024, 0.022, 0.02, 0.016, 0.005], side=(1, 0, 0)))
        for start, tip in ((beam[0], (0.9, 1.84, 0.1 * ear)), (beam[1], (0.82, 2.0, 0.2 * ear)), (beam[2], (0.76, 2.17, 0.33 * ear)), (beam[3], (0.5, 2.42, 0.36 * ear))):
            bent = (start[0] + 0.6 * (tip[0] - start[0]), start[1] + 0.35 * (tip[1] - start[1]), start[2] + 0.6 * (tip[2] - start[2]))
            parts.append(limb([start, bent, tip], [0.016, 0.014, 0.004], side=(1, 0, 0)))
    return parts


def instance(name, x, z, scale=1.0, turn=None, lift=0.0, tilt=""):
    turn = random.uniform(0, 360) if turn is None else turn
    return f'TransformBegin Translate {x:.2f} {ground(x, z) + lift:.3f} {z:.2f} {tilt} Rotate {turn:.0f} 0 1 0 Scale {scale:.2f} {scale:.2f} {scale:.2f} ObjectInstance "{name}" TransformEnd'


def places(x0, x1, z0, z1, apart, tries):
    """Returns random places that keep the distance `apart` from each other."""
    kept = []
    for _ in range(tries):
        x, z = random.uniform(x0, x1), random.uniform(z0, z1)
        if all((x - a) ** 2 + (z - b) ** 2 > apart ** 2 for a, b in kept):
            kept.append((x, z))
    return kept


def is_free(x, z, margin):
    """Returns whether a place lies off the path, outside the clearing, and not between the eye and the stag."""
    cx, cz, radius = CLEARING
    return abs(x - path(z)) > margin and math.hypot(x - cx, z - cz) > radius and not (z < STAG[1] and abs(x - z * STAG[0] / STAG[1]) < 0.8 + 0.06 * z)


def shades(x, z):
    """Returns whether a tree may stand at a place. Sunlight comes in through the gaps between such places."""
    across = x - z * SUN[0] / SUN[2]
    return z < 11 or math.sin(1.25 * across + 1.4) + 0.5 * math.sin(0.61 * across) < 0.45


def sun_view(wide, tall):
    """Returns the camera of the shadow map, which looks along the sunlight at the part of the wood that the map covers."""
    w = tuple(-c for c in unit(SUN))
    u = unit(cross((0, 1, 0), w))
    v = cross(w, u)
    centre = (0, 3, 26)
    move = [-sum(a * b for a, b in zip(axis, centre)) for axis in (u, v, w)]
    rows = [c for k in range(3) for c in (u[k], v[k], w[k], 0)] + [move[0], move[1], move[2] + 120, 1]
    return f'Projection "orthographic"\nScreenWindow {-wide} {wide} {-tall} {tall}\nConcatTransform [{numbers(rows, ".6g")}]'


def world():
    part("ground", 'Surface "floor"', f'PatchMesh "bilinear" 61 "nonperiodic" 66 "nonperiodic" "P" [{numbers(c for n in range(66) for k in range(61) for z in [0.3 + 0.22 * n + 0.013 * n * n] for x in [(k - 30) * (0.22 + 0.035 * n)] for c in (x, ground(x, z), z))}]')
    trees = [(-2.75, 6.4), (3.15, 7.6), (4.6, 12.4)]
    trees += [(x, z) for x, z in places(-34, 34, 8.5, 72, 3.0, 2600) if is_free(x, z, 1.9) and shades(x, z) and abs(x) < 5 + 0.72 * z and (math.hypot(x - 1, z - 7) > 4.5)]
    near, far = [t for t in trees if t[1] < 34], [t for t in trees if t[1] >= 34]
    part("trees", *(line for k, (x, z) in enumerate(near) for turn, scale in [(random.uniform(0, 360), random.uniform(0.8, 1.15))]
                    for line in (instance(f"trunk{k % 4}", x, z, scale, turn), instance(f"crown{k % 3}", x, z, scale, turn), instance(f"crown{k % 3} wood", x, z, scale, turn))))
    part("far trees", *(line for k, (x, z) in enumerate(far) for turn, scale in [(random.uniform(0, 360), random.uniform(0.8, 1.2))]
                        for line in (instance(f"trunk{k % 4}", x, z, scale, turn), instance("far crown", x, z, scale, turn), instance("far crown wood", x, z, scale, turn))))
    young = [(x, z) for x, z in places(-16, 14, 9, 32, 2.4, 200) if is_free(x, z, 1.6) and abs(x) < 3 + 0.6 * z]
    part("saplings", *(line for k, (x, z) in enumerate(young) for turn, scale in [(random.uniform(0, 360), random.uniform(0.6, 1.2))]
                       for line in (instance(f"sapling{k % 2}", x, z, scale, turn), instance(f"sapling{k % 2} wood", x, z, scale, turn))))
    ferns = [(x, z) for x, z in places(-12, 12, 2.4, 26, 0.62, 2500) if abs(x - path(z)) > 0.95 + 0.25 * math.sin(1.3 * z) and math.sin(0.55 * x + 1) + math.sin(0.5 * z + 0.3 * x) > -0.25 and abs(x) < 1.5 + 0.75 * z]
    part("ferns", *(instance(f"fern{k % 3}", x, z, random.uniform(0.55, 1.1)) for k, (x, z) in enumerate(ferns)))
    fallen = [(x, z) for x, z in places(-9, 9, 1.8, 17, 0.45, 4000) if abs(x) < 1.2 + 0.75 * z]
    part("fallen leaves", *(instance(f"litter{k % 3}", x, z) for k, (x, z) in enumerate(fallen)))
    sx, sz = STAG
    part("stag", 'Surface "coat"', f"Translate {sx} {ground(sx, sz) - 0.02:.3f} {sz} Rotate -24 0 1 0", *stag())


head("forest", "A beech wood in October", 34, "Clipping 0.3 400", size=(1600, 900))
for k in range(4):
    trunk(f"trunk{k}", 24, (0.19, 0.26, 0.31, 0.23)[k])
for k in range(3):
    crown(f"crown{k}", 4.2 + 0.8 * k, 21, 60, 0.125, 0.16)
crown("far crown", 5.5, 21, 46, 0.30, 0.36)
for k in range(2):
    crown(f"sapling{k}", 0.7, 4.2, 15, 0.085, 0.085)
for k in range(3):
    litter(f"litter{k}", 60, 0.42)
    fern(f"fern{k}", 9 + 2 * k, 0.9)
print('ArchiveBegin "wood"')
world()
print(f'''ArchiveEnd
FrameBegin 1  # what the sun sees
  Format 4096 3072 1
  PixelSamples 2 2
  PixelFilter "box" 1 1
  ShadingRate 4
  Hider "hidden" "string depthfilter" "midpoint"
  Display "sun.z" "zfile" "z"
  {sun_view(38, 28.5)}
  WorldBegin
  CoordinateSystem "forest"
  ReadArchive "wood"
  WorldEnd
FrameEnd
MakeShadow "sun.z" "sun.shd"
FrameBegin 2
  Rotate 5 1 0 0
  Translate 0 -1.55 0
  WorldBegin
  CoordinateSystem "forest"
  LightSource "shadowdistant" "sun" "from" [{numbers(SUN)}] "to" [0 0 0] "intensity" [5] "lightcolor" [1 0.74 0.42] "string shadowname" ["sun.shd"]
    "float samples" [4] "float shadowbias" [0.06] "string __category" ["sun"]
  Atmosphere "mist"
  AttributeBegin
    Attribute "identifier" "string name" ["sky"]
    Surface "morning"
    Rotate -90 1 0 0
    Sphere 300 -20 300 360
  AttributeEnd
  ReadArchive "wood"
  WorldEnd
FrameEnd''')
