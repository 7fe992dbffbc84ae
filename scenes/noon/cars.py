"""Makes the cars of noon.rib. A car is a smooth body through cross-sections, with parts that stand off it."""
from houses import colour
from parts import box, flat, numbers, part, soft

# Each cross-section has a z, half a width, and the heights of sill, belt and middle line. They run from the tail to the nose. The cabin is
# where the middle line lies above the belt.
SEDAN = [(-2.22, .66, .42, .66, .68), (-2.20, .78, .32, .80, .84), (-2.05, .85, .26, .90, .95), (-1.75, .875, .25, .93, .99), (-1.50, .885, .24, .94, 1.01), (-1.40, .885, .24, .94, 1.05),
         (-1.10, .89, .24, .945, 1.24), (-0.82, .89, .24, .945, 1.39), (-0.55, .89, .24, .945, 1.44), (-0.1, .89, .24, .945, 1.46), (0.25, .89, .24, .94, 1.43), (0.42, .89, .24, .94, 1.37),
         (0.72, .885, .24, .94, 1.17), (0.98, .88, .24, .93, 1.01), (1.08, .875, .24, .925, .985), (1.45, .87, .24, .90, .96), (1.85, .845, .25, .84, .895), (2.08, .80, .27, .74, .79), (2.19, .72, .34, .62, .64), (2.21, .60, .42, .56, .58)]
HATCH = [(-1.86, .62, .42, .70, .72), (-1.85, .78, .34, .88, .93), (-1.76, .83, .28, .95, 1.08), (-1.62, .845, .26, .97, 1.26), (-1.42, .85, .25, .97, 1.42), (-1.15, .85, .24, .97, 1.49),
         (-0.5, .855, .24, .965, 1.53), (0.1, .855, .24, .96, 1.52), (0.36, .855, .24, .955, 1.47), (0.66, .85, .24, .95, 1.28), (0.98, .845, .24, .94, 1.06), (1.10, .84, .24, .93, 1.02), (1.40, .83, .24, .90, .97), (1.68, .80, .26, .83, .88),
         (1.85, .74, .30, .72, .75), (1.93, .64, .38, .60, .62), (1.94, .52, .44, .56, .58)]
VAN = [(-2.42, .70, .46, .92, 1.70), (-2.41, .88, .34, 1.06, 2.00), (-2.32, .93, .29, 1.10, 2.10), (-1.9, .95, .28, 1.10, 2.14), (-0.9, .95, .28, 1.10, 2.15), (0.1, .95, .28, 1.10, 2.14), (0.6, .95, .28, 1.10, 2.08), (0.85, .945, .28, 1.10, 1.92),
       (1.25, .94, .28, 1.09, 1.50), (1.55, .93, .28, 1.08, 1.20), (1.66, .925, .28, 1.06, 1.14), (1.95, .90, .28, 1.00, 1.06), (2.20, .86, .30, .90, .95), (2.33, .76, .38, .74, .77), (2.35, .64, .46, .66, .68)]
KINDS = {"sedan": (SEDAN, 'Surface "carbody" "float flake" [FLAKE]', 1.32, -1.28),
         "hatch": (HATCH, 'Surface "carbody" "float flake" [FLAKE] "float belt" [0.96] "float roof" [1.47] "vector front" [0.96 0.34 0] "vector back" [-1.86 -1.52 0] "float middle" [-0.30] "float wheelfront" [1.18] "float wheelback" [-1.20]', 1.18, -1.20),
         "van": (VAN, 'Surface "carbody" "float flake" [FLAKE] "float belt" [1.10] "float roof" [2.02] "vector front" [1.60 0.78 0] "vector back" [-2.6 -2.5 0] "float middle" [0.28] "float panel" [1] "float wheelfront" [1.50] "float wheelback" [-1.48]', 1.50, -1.48)}


def ring(z, w, low, belt, top):
    """Returns a cross-section as a ring of control points. They are the points of one half, from the bottom to the top, and their
    mirror images."""
    cabin = max(0, top - belt - 0.09)
    lean = w * (1 - 0.20 * min(1, cabin / 0.45)) * (1 if cabin else 0.93)
    shoulder = belt + 0.02
    half = [(0, low), (0.5 * w, low), (0.9 * w, low), (0.99 * w, low + 0.05), (1.005 * w, low + 0.22), (1.01 * w, 0.55 * belt + 0.45 * (low + 0.22)), (1.005 * w, belt - 0.10), (0.985 * w, belt - 0.015)]
    if cabin:
        half += [(0.955 * w, shoulder + 0.01), (0.93 * w, shoulder + 0.05), (0.5 * (0.93 * w + lean), 0.5 * (shoulder + top)), (1.02 * lean - 0.03, top - 0.12 * min(1, cabin / 0.3)), (0.96 * lean - 0.06, top - 0.02), (0.6 * lean, top), (0.3 * lean, top + 0.008), (0, top + 0.01)]
    else:
        half += [(0.955 * w, belt + 0.01), (0.90 * w, 0.6 * belt + 0.4 * top), (0.82 * w, 0.35 * belt + 0.65 * top), (0.72 * w, 0.2 * belt + 0.8 * top), (0.58 * w, 0.1 * belt + 0.9 * top), (0.4 * w, top - 0.005), (0.2 * w, top), (0, top)]
    return [(x, y, z) for x, y in half] + [(-x, y, z) for x, y in half[-2:0:-1]]


def car(name, kind, paint, x, z, heading, flake=0.6, taxi=False):
    stations, surface, *axles = KINDS[kind]
    rings = [ring(*s) for s in stations]
    rings = [[(0.02 * px, stations[0][3] * 0.75 + 0.02 * py, pz - 0.004) for px, py, pz in rings[0]]] + rings + [[(0.02 * px, stations[-1][3] * 0.8 + 0.02 * py, pz + 0.004) for px, py, pz in rings[-1]]]
    rings = [rings[0]] * 2 + rings + [rings[-1]] * 2
    body = f'Basis "b-spline" 1 "b-spline" 1 PatchMesh "bicubic" {len(rings[0])} "periodic" {len(rings)} "nonperiodic" "P" [{numbers(flat(flat(rings)))}]'
    tail, nose = stations[1][0], stations[-3][0]
    width, belt = stations[3][1], stations[4][3]
    rows = [f"Translate {x} 0 {z}", f"Rotate {heading} 0 1 0", f"{colour(paint)} {surface.replace('FLAKE', str(flake))}", body]
    for axle in axles:
        for s in (-1, 1):
            out = s * (width - 0.02)
            rows += ["AttributeBegin", f"Translate {out - s * 0.10:.3f} 0.325 {axle}", f"Rotate {90 * s} 0 1 0",
                     'Surface "plain" "float uneven" [0.3]', "Color 0.028 0.028 0.030", "Torus 0.232 0.095 0 360 360", "AttributeEnd",
                     "AttributeBegin", f"Translate {out - s * 0.03:.3f} 0.325 {axle}", 'Surface "wheel"', f"Rotate {90 * s} 0 1 0", "Disk 0 0.215 360", "Hyperboloid 0.215 0 0 0.222 0 0.035 360", "Color 0.5 0.5 0.5", "Sphere 0.045 0 0.045 360", "AttributeEnd"]
    bumper, dark = '"plain" "float gloss" [0.5]', "Color 0.03 0.03 0.032"
    high = 0.70 if kind != "van" else 0.86
    for s in (-1, 1):
        # Head lamps and tail lamps lie half in the body. Mirrors stand off it.
        rows += ["AttributeBegin", 'Surface "chrome" "float glass" [1]', "Color 0.9 0.92 0.95", f"Translate {s * 0.60} {high - 0.02} {nose - 0.035}", f"Rotate {s * 14} 0 1 0", "Scale 0.17 0.085 0.10", "Sphere 1 -1 1 360", "AttributeEnd",
                 "AttributeBegin", 'Surface "chrome" "float glass" [1]', "Color 0.75 0.03 0.02", f"Translate {s * (0.72 if kind != 'van' else 0.86)} {high + (0.07 if kind == 'sedan' else 0.22)} {tail + 0.03}", f"Rotate {s * -12} 0 1 0", f"Scale {0.13 if kind == 'sedan' else 0.07} {0.075 if kind == 'sedan' else 0.17} 0.055", "Sphere 1 -1 1 360", "AttributeEnd",
                 "AttributeBegin", surface.split(' "float flake"')[0].replace("carbody", "plain") + ' "float gloss" [1]', f"Translate {s * (width + 0.10):.3f} {belt + 0.09:.3f} {stations[-8][0] - 0.10:.3f}", soft(-0.11, 0.11, -0.075, 0.075, -0.05, 0.06, hard=0.6), "AttributeEnd",
                 "AttributeBegin", 'Surface "chrome"', "Color 0.8 0.8 0.8", f"Translate {s * (width + 0.005):.3f} {belt - 0.12:.3f} {-0.36}", soft(-0.014, 0.014, -0.014, 0.014, -0.08, 0.08, hard=1), "AttributeEnd"]
    for z0, z1, plate in ((nose + 0.02, nose + 0.10, nose + 0.105), (tail - 0.09, tail + 0.0, tail - 0.094)):
        rows += ["AttributeBegin", f"Surface {bumper}", dark, soft(-0.80 * width / 0.88, 0.80 * width / 0.88, 0.37, 0.48, z0, z1, hard=1.2), "AttributeEnd",
                 "AttributeBegin", 'Surface "plain" "float uneven" [0]', "Color 0.75 0.74 0.68", box(-0.26, 0.26, 0.37, 0.48, plate - 0.004, plate + 0.004), "AttributeEnd"]
    if taxi:
        rows += ["AttributeBegin", 'Surface "plain" "float gloss" [0.6]', "Color 0.85 0.80 0.55", "Translate 0 1.52 -0.25", soft(-0.22, 0.22, -0.05, 0.10, -0.09, 0.09, hard=1), "AttributeEnd"]
    part(name, "Sides 2", 'ShadingInterpolation "smooth"', *rows)
