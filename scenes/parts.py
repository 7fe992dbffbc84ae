"""What the scripts of finished pictures share: the head of their RIB, objects with names, and a few shapes.

A script that lies in a folder beside this file finds it by
    sys.path.append(str(pathlib.Path(__file__).resolve().parents[1]))
Requests go to standard output.
"""
import math


def numbers(values, form=".4g"):
    return " ".join(format(v, form) for v in values)


def flat(points):
    """The coordinates of points, one after the other."""
    return [c for point in points for c in point]


def head(name, about, fov, *requests, size=(1600, 900), samples=4, rate=1, imager="print"):
    """A picture as linear EXR and as PNG to look at; requests are further options and the camera."""
    print(f'''##RenderMan RIB-Structure 1.1
# {about}. make_{name}.py has written this file; README.md tells about it.
version 3.04
Format {size[0]} {size[1]} 1
PixelSamples {samples} {samples}
PixelFilter "mitchell" 4 4
ShadingRate {rate}
Projection "perspective" "fov" [{fov}]
Imager "{imager}"
Display "{name}.exr" "openexr" "rgba"
Display "+{name}.png" "png" "rgb" "string transfer" ["sRGB"]''')
    for request in requests:
        print(request)


def part(name, *requests):
    """An object with a name; requests are its attributes and geometry."""
    print(f'  AttributeBegin\n    Attribute "identifier" "string name" ["{name}"]')
    for request in requests:
        print("    " + request)
    print("  AttributeEnd")


FACES = "0 1 3 2  4 6 7 5  0 4 5 1  2 3 7 6  0 2 6 4  1 5 7 3"


def corners(x0, x1, y0, y1, z0, z1):
    return [(x, y, z) for x in (x0, x1) for y in (y0, y1) for z in (z0, z1)]


def box(*sides):
    return f'PointsPolygons [4 4 4 4 4 4] [{FACES}] "P" [{numbers(flat(corners(*sides)))}]'


def soft(*sides, hard=2.0):
    """A box with rounded edges; the less hard, the fuller."""
    rings = "0 1 3 2 0  4 6 7 5 4  0 4  1 5  3 7  2 6"
    return (f'SubdivisionMesh "catmull-clark" [4 4 4 4 4 4] [{FACES}] ["crease" "crease" "crease" "crease" "crease" "crease"] '
            f'[5 1 5 1 2 1 2 1 2 1 2 1] [{rings}] [{numbers([hard] * 6)}] "P" [{numbers(flat(corners(*sides)))}]')


def rounded(profile, steps=6):
    """The profile as a Catmull-Rom curve through its points."""
    points = [profile[0], *profile, profile[-1]]
    curve = []
    for a, b, c, d in zip(points, points[1:], points[2:], points[3:]):
        for k in range(steps):
            t = k / steps
            curve.append(tuple(0.5 * (2 * q + (r - p) * t + (2 * p - 5 * q + 4 * r - s) * t * t + (3 * q - p - 3 * r + s) * t ** 3)
                               for p, q, r, s in zip(a, b, c, d)))
    return curve + [profile[-1]]


def lathe(profile, around=12):
    """A bicubic B-spline through rings of control points; profile is (radius, height) from below to above. The first and the last point
    count three times, so that the surface ends there. Corners are points that stand twice. The radii of control points are a
    little larger than those of the curve that they bend."""
    rings = [profile[0]] * 2 + list(profile) + [profile[-1]] * 2
    swell = 3 / (2 + math.cos(2 * math.pi / around))
    points = [c for r, y in rings for k in range(around)
              for c in (swell * r * math.cos(2 * math.pi * k / around), y, -swell * r * math.sin(2 * math.pi * k / around))]
    return f'Basis "b-spline" 1 "b-spline" 1 PatchMesh "bicubic" {around} "periodic" {len(rings)} "nonperiodic" "P" [{numbers(points)}]'
