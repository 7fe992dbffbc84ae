"""Holds what the scripts of finished pictures share: the head of their RIB, objects with names, and a few shapes.

A script that lies in a folder beside this file finds it with
    sys.path.append(str(pathlib.Path(__file__).resolve().parents[1]))
The functions that make a head or a part print requests. The others return them.
"""
import math


def numbers(values, form=".4g"):
    return " ".join(format(v, form) for v in values)


def flat(points):
    """Returns the coordinates of points, one after the other."""
    return [c for point in points for c in point]


def head(name, about, fov, *requests, size=(1600, 900), samples=4, rate=1, imager="print"):
    """Prints the options of a picture, which becomes a linear EXR and a PNG. The requests are further options and the camera."""
    print(f'''##RenderMan RIB-Structure 1.1
# {about}. make_{name}.py has written this file; README.md describes it.
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
    """Prints an object with a name. The requests are its attributes and geometry."""
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
    """Returns a box with rounded edges. A smaller `hard` makes them rounder."""
    rings = "0 1 3 2 0  4 6 7 5 4  0 4  1 5  3 7  2 6"
    return (f'SubdivisionMesh "catmull-clark" [4 4 4 4 4 4] [{FACES}] ["crease" "crease" "crease" "crease" "crease" "crease"] '
            f'[5 1 5 1 2 1 2 1 2 1 2 1] [{rings}] [{numbers([hard] * 6)}] "P" [{numbers(flat(corners(*sides)))}]')


def rounded(profile, steps=6):
    """Returns the points of a Catmull-Rom curve through the points of a profile."""
    points = [profile[0], *profile, profile[-1]]
    curve = []
    for a, b, c, d in zip(points, points[1:], points[2:], points[3:]):
        for k in range(steps):
            t = k / steps
            curve.append(tuple(0.5 * (2 * q + (r - p) * t + (2 * p - 5 * q + 4 * r - s) * t * t + (3 * q - p - 3 * r + s) * t ** 3)
                               for p, q, r, s in zip(a, b, c, d)))
    return curve + [profile[-1]]


def lathe(profile, around=12):
    """Returns a surface of revolution as a bicubic B-spline. The profile is a list of (radius, height) from the bottom to the top. Its first
    and its last point count three times, so that the surface ends there. A point that stands twice makes a corner. The control points
    lie a little outside the circle that they bend, so they get larger radii."""
    rings = [profile[0]] * 2 + list(profile) + [profile[-1]] * 2
    swell = 3 / (2 + math.cos(2 * math.pi / around))
    points = [c for r, y in rings for k in range(around)
              for c in (swell * r * math.cos(2 * math.pi * k / around), y, -swell * r * math.sin(2 * math.pi * k / around))]
    return f'Basis "b-spline" 1 "b-spline" 1 PatchMesh "bicubic" {around} "periodic" {len(rings)} "nonperiodic" "P" [{numbers(points)}]'
