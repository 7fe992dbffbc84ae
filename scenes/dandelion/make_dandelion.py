#!/usr/bin/env python3
"""Writes dandelion.rib: a dandelion clock against the evening sun, while a gust carries its seeds away.

    make_dandelion.py > dandelion.rib

Units are millimetres. x points to the right, y up and z away from the eye. The head of the flower is at HEAD.
"""
import math
import pathlib
import random
import sys

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1]))
from parts import flat, head, numbers, part

random.seed(5)
HEAD = (-27, 6, 0)
KINDS = 4  # This is the number of shapes of seeds.
SOFT = 3   # Hairs out of focus are wider and less opaque by this factor. They look the same and show less noise.
WIND = (1, 0.12, 0.1)


def curve(counts, points, widths, kind="cubic"):
    return f'Curves "{kind}" [{counts}] "nonperiodic" "P" [{numbers(flat(points), ".3f")}] "varying float width" [{numbers(widths)}]'


def veil(soft):
    """Returns the opacity of hairs that are `soft` times as wide as they should be."""
    return f"Opacity [{numbers([1 / soft] * 3)}]"


def moving(*keys):
    """Returns a motion block. Its requests hold at the opening and at the closing of the shutter."""
    return "MotionBegin [0 1] " + " ".join(keys) + " MotionEnd"


def direction():
    y, a = random.uniform(-1, 1), random.uniform(0, 2 * math.pi)
    r = math.sqrt(1 - y * y)
    return (r * math.cos(a), y, r * math.sin(a))


def seed(name, soft=1):
    """Prints the object of a seed along +y: the fruit, its beak, and a parasol of hairs, which bear finer hairs."""
    hairs, widths, count = [], [], 0
    for k in range(46):
        a, rise, length = 2.39996 * k + random.uniform(-0.1, 0.1), random.uniform(0.15, 0.62), random.uniform(5.6, 7.2)
        x, z, bend = math.cos(a), math.sin(a), random.uniform(-0.10, 0.22)
        path = [(s * length * x * math.cos(rise), 16.3 + s * length * math.sin(rise) + bend * length * s * s, s * length * z * math.cos(rise)) for s in (0, 0.33, 0.67, 1)]
        hairs += path
        widths += [0.034, 0.016]
        count += 1
        for _ in range(4):
            s = random.uniform(0.15, 0.95)
            at = (s * path[3][0], 16.3 + s * (path[3][1] - 16.3) + bend * length * (s * s - s), s * path[3][2])
            d = direction()
            reach = random.uniform(0.3, 0.75)
            hairs += [tuple(c + reach * t * e for c, e in zip(at, d)) for t in (0, 0.33, 0.67, 1)]
            widths += [0.013, 0.008]
            count += 1
    print(f'ObjectBegin "{name}"')
    print(f'  Surface "hair"\n  {veil(soft)}\n  {curve("4 " * count, hairs, [soft * w for w in widths])}')
    beak = [(0.06 * math.sin(0.5 * y), y, 0.05 * math.cos(0.4 * y)) for y in (7.4, 10.5, 13.5, 16.4)]
    print(f'  Surface "hair" "color tint" [0.75 0.62 0.45]\n  {veil(soft)}\n  {curve("4", beak, [0.10 * soft, 0.06 * soft])}\n  {veil(1)}')
    print('  Surface "fruit"\n  Attribute "dice" "int roundcurve" [1]')
    print(f'  Curves "linear" [6] "nonperiodic" "P" [{numbers(flat((0, y, 0) for y in (4.0, 4.6, 5.6, 6.6, 7.1, 7.5)))}] "varying float width" [0.15 0.5 0.85 0.9 0.55 0.12]')
    print("ObjectEnd")


def aim(d):
    """Returns the rotations that turn +y to d."""
    return f"Rotate {math.degrees(math.atan2(d[0], d[2])):.2f} 0 1 0", f"Rotate {math.degrees(math.acos(max(-1, min(1, d[1])))):.2f} 1 0 0"


def clock():
    """Returns seeds all over the head, except where the wind has taken them. The seeds beside the gap are about to leave."""
    out = []
    for k in range(150):
        y = 1 - 2 * (k + 0.5) / 150
        if y < -0.86:
            continue
        r, a = math.sqrt(1 - y * y), 2.39996 * k
        d = (r * math.cos(a), y, r * math.sin(a))
        gone = d[0] * 0.90 + d[1] * 0.36 - d[2] * 0.25
        if gone > 0.62 + random.uniform(-0.12, 0.08):
            continue
        lean = 4 + 13 * max(0, gone) ** 2  # The wind bends seeds by this number of degrees.
        stir = 1.1 + 2.2 * max(0, gone) ** 2
        turns = [f"Rotate {-angle:.2f} 0 0.2 1" for angle in (lean, lean + stir * random.uniform(0.5, 1.3))]
        out.append(f'TransformBegin {moving(*turns)} {" ".join(aim(d))} Rotate {random.uniform(0, 360):.0f} 0 1 0 ObjectInstance "seed{k % KINDS}" TransformEnd')
    return out


def flight(x, y, z, tilt, way, spin, kind="soft"):
    """Returns a seed in the air at (x, y, z), whose parasol leads. It moves by `way` while the shutter is open."""
    places = [f"Translate {x + t * way[0]:.2f} {y + t * way[1]:.2f} {z + t * way[2]:.2f}" for t in (0, 1)]
    turns = [f"Rotate {tilt + t * spin:.1f} 0.25 0.1 -1" for t in (0, 1)]
    return (f'TransformBegin {moving(*places)} {moving(*turns)} Rotate {random.uniform(0, 360):.0f} 0 1 0 Translate 0 -12 0 '
            f'ObjectInstance "{kind}{random.randrange(KINDS)}" TransformEnd')


def blade(x, z, tall, wide, lean, sway, foot=-75):
    """Returns a blade of grass as a ribbon, at the opening and at the closing of the shutter."""
    keys = []
    for t in (0, 1):
        bend = lean + t * sway
        points = [(x + tall * bend * s ** 2.2, foot + tall * (s - 0.28 * abs(bend) * s ** 2.5), z + 0.12 * tall * s * s * math.sin(x)) for s in (0, 0.33, 0.67, 1)]
        keys.append(curve("4", points, [wide, 0.12 * wide]))
    return moving(*keys)


def foxtail(x, z, tall, lean, sway, length, bristles):
    """Returns a foxtail, a flowering grass. Its stalk bends over and has a brush of bristles around its end."""
    stalks, brushes, shape = [], [], random.getstate()
    for t in (0, 1):
        random.setstate(shape)
        bend = lean + t * sway

        def at(s):
            return (x + tall * bend * s ** 2.5, -75 + tall * (s - 0.33 * bend * bend * s ** 3), z)
        stalks.append(curve("17", [at(k / 16) for k in range(17)], [1.3 - 0.75 * k / 16 for k in range(17)], "linear"))
        points, widths = [], []
        for _ in range(bristles):
            s = 1 - length / tall * random.random() ** 0.9
            p, q = at(s), at(s + 0.01)
            along = [(b - a) / math.dist(p, q) for a, b in zip(p, q)]
            out, full = direction(), math.sin(math.pi * min(1, max(0.04, (1 - s) * tall / length * 0.93 + 0.06))) ** 0.5
            reach = random.uniform(3.4, 6.6) * (0.45 + 0.55 * full)
            tip = [0.60 * o * reach + 0.75 * a * reach + 0.12 * w * reach for o, a, w in zip(out, along, WIND)]
            start = [c + 0.9 * full * o for c, o in zip(p, out)]
            points += [tuple(b + e * h + g * 0.35 * reach * h * (1 - h) for b, e, g in zip(start, tip, out)) for h in (0, 0.33, 0.67, 1)]
            widths += [0.075 * SOFT, 0.02 * SOFT]
        brushes.append(curve("4 " * bristles, points, widths))
    return ['Surface "hair" "color tint" [0.62 0.62 0.25]', moving(*stalks), 'Surface "hair" "color tint" [0.95 0.72 0.42] "float bristle" [1]', veil(SOFT), moving(*brushes)]


head("dandelion", "A dandelion clock in a gust", 20.5, "Clipping 20 4000", "Shutter 0 1", "DepthOfField 1 15 230", "Translate 0 0 230", samples=20)
for k in range(KINDS):
    shape = random.getstate()
    seed(f"soft{k}", SOFT)
    random.setstate(shape)
    seed(f"seed{k}")
print('''WorldBegin
  CoordinateSystem "meadow"
  LightSource "distantlight" "sun" "from" [-0.50 0.42 0.76] "to" [0 0 0] "intensity" [3.2] "lightcolor" [1 0.76 0.44]
''')
part("far grass", 'Surface "blade" "float far" [1]', *(blade(x, z, random.uniform(45, 100), random.uniform(2, 4), random.uniform(0.05, 0.6), random.uniform(0.02, 0.07), foot=-75 - 0.12 * z)
                                for z in sorted((random.uniform(90, 420) for _ in range(420)), reverse=True) for x in [random.uniform(-0.42, 0.42) * (230 + z)]))
part("grass", 'Surface "blade"', *(blade(x, z, random.uniform(32, 78), random.uniform(1.6, 3.2), random.uniform(0.08, 0.6), random.uniform(0.015, 0.05))
                                for z in sorted((random.uniform(14, 80) for _ in range(70)), reverse=True) for x in [random.uniform(-0.36, 0.36) * (230 + z)]))
part("near grass", 'Surface "blade"', *(blade(x, z, tall, wide, lean, sway) for x, z, tall, wide, lean, sway in (
    (2, 3, 52, 1.6, 0.30, 0.02), (21, -4, 50, 1.5, 0.42, 0.03), (44, 9, 63, 1.8, 0.25, 0.025), (57, 2, 55, 1.6, 0.5, 0.03), (66, 8, 66, 1.7, 0.2, 0.03), (-52, 5, 56, 1.7, 0.35, 0.02), (-62, -3, 48, 1.5, 0.5, 0.03))))
for k, (x, z, tall, lean, sway, length) in enumerate(((34, 22, 72, 0.33, 0.035, 30), (50, 6, 60, 0.30, 0.03, 27), (14, 46, 62, 0.42, 0.04, 30), (-78, 40, 72, 0.30, 0.03, 30), (-60, 70, 58, 0.4, 0.04, 28))):
    part(f"foxtail {k}", *foxtail(x, z, tall, lean, sway, length, 950))
part("stalk", 'Surface "stalk"', 'Attribute "dice" "int roundcurve" [1]', curve("4", [(HEAD[0] - 9, -80, 6), (HEAD[0] - 8, -52, 4), (HEAD[0] - 3.5, -25, 1), (HEAD[0], HEAD[1] - 3, 0)], [3.6, 3.0]))
part("receptacle", 'Surface "fruit" "float pale" [1]', f"Translate {numbers(HEAD)}", "Scale 1 0.85 1", "Sphere 4.2 -4.2 4.2 360")
part("bracts", 'Surface "stalk"', f"Translate {numbers(HEAD)}", *(curve("4", [(1.6 * math.cos(a), -3, 1.6 * math.sin(a)), (3.2 * math.cos(a), -5, 3.2 * math.sin(a)), (3.9 * math.cos(a), -9, 3.9 * math.sin(a)), ((5.2 - k % 2) * math.cos(a), -13 - k % 3, (5.2 - k % 2) * math.sin(a))], [1.5, 0.12])
                                        for k in range(13) for a in [2 * math.pi * k / 13]))
part("clock", f"Translate {numbers(HEAD)}", *clock())
part("seeds in the air", *(flight(*seed_) for seed_ in (
    (6, 16, -4, 58, (0.3, 0.05, 0), 1.5, "seed"), (21, 24, 2, 40, (0.9, 0.15, 0.1), 4, "seed"), (36, 11, -2, 66, (0.5, 0.1, 0), 2, "seed"), (44, 30, 10, 30, (1.6, 0.1, 0.2), 6),
    (58, 20, 2, 52, (1.2, 0.3, 0), 3), (64, 3, 24, 75, (1.2, -0.1, 0), 5), (26, 38, 40, 45, (2.4, 0.2, 0), 6), (73, 36, 34, 55, (2.8, 0.3, 0), 5),
    (88, 16, 60, 60, (2.6, 0.2, 0), 4), (49, -9, -34, 50, (2.4, 0.3, 0), 5))))
part("blades before the eye", 'Surface "blade" "float far" [-1]', *(blade(x, z, tall, wide, lean, sway, foot=-45) for x, z, tall, wide, lean, sway in (
    (-38, -120, 38, 3.2, 0.5, 0.03), (-20, -110, 26, 2.6, 0.7, 0.03), (24, -125, 30, 2.8, 0.5, 0.03), (33, -115, 42, 3, 0.25, 0.02))))
print("WorldEnd")
