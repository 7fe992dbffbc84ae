"""Tests that TextureCoordinates, Orientation, ReverseOrientation, Sides and Matte mean the same to every kind of primitive. A
polygon must have the same texture whichever of its corners comes first.

    kinds_test.py tomales repository
"""
import pathlib
import subprocess
import sys
import tempfile

from pictures import pixels

tomales, root = sys.argv[1], pathlib.Path(sys.argv[2])
failures = []

SQUARE = "-1 -1 0  1 -1 0  1 1 0  -1 1 0"
BALL = "1 0 0 0  0 1 0 0  0 0 1 0  0 0 0 1"
GRID = "  ".join(f"{x} {y} {0.4 * (x * x + y * y):.3f}" for y in (-1, -0.33, 0.33, 1) for x in (-1, -0.33, 0.33, 1))
KINDS = {
    "sphere": "Sphere 1 -0.7 0.8 300", "cone": "Cone 1.5 1 300", "cylinder": "Cylinder 0.8 -0.8 0.8 300", "paraboloid": "Paraboloid 1 0 1.2 300",
    "hyperboloid": "Hyperboloid 1 0 -0.8 0.3 0.6 0.8 300", "disk": "Disk 0 1 300", "torus": "Torus 0.7 0.35 20 330 300",
    "polygon": f'Polygon "P" [{SQUARE}]',
    "general polygon": f'GeneralPolygon [4 3] "P" [{SQUARE}  -0.5 -0.5 0  0.5 -0.5 0  0 0.5 0]',
    "mesh": f'PointsPolygons [3 3] [0 1 2 0 2 3] "P" [{SQUARE}]',
    "bilinear": 'Patch "bilinear" "P" [-1 -1 0  1 -1 0.5  -1 1 0.5  1 1 0]', "bicubic": f'Patch "bicubic" "P" [{GRID}]',
    "rational": 'Patch "bilinear" "Pw" [-1 -1 0 1  2 -2 0 2  -1 1 0 1  1 1 0 1]',
    "nupatch": f'NuPatch 4 4 [0 0 0 0 1 1 1 1] 0 1 4 4 [0 0 0 0 1 1 1 1] 0 1 "P" [{GRID}]',
    "subdivision": f'SubdivisionMesh "catmull-clark" [4] [0 1 2 3] ["interpolateboundary"] [0 0] [] [] "P" [{SQUARE}]',
    "points": 'Points "P" [-0.5 0 0  0.5 0 0] "varying normal N" [0.3 0 1  0 0.2 1]', "spheres": 'Points "P" [-0.5 0 0  0.5 0 0] "constant string type" ["sphere"]',
    "cards": 'Points "P" [-0.5 0 0  0.5 0 0] "constant string type" ["patch"] "varying normal N" [0 0 1  0.2 0 1]',
    "ribbon": 'Curves "linear" [3] "nonperiodic" "P" [-1 -0.5 0  0 0.5 0  1 -0.5 0] "constantwidth" [0.5] "varying normal N" [0 0 1  0 0 1  0 0 1]',
    "tube": 'Attribute "dice" "int roundcurve" [1] Curves "linear" [3] "nonperiodic" "P" [-1 -0.5 0  0 0.5 0  1 -0.5 0] "constantwidth" [0.5]',
    "blobby": f'Blobby 1 [1001 0] [{BALL}] [""]', "teapot": 'Scale 0.3 0.3 0.3 Geometry "teapot"',
}
COLUMNS, CELL = 6, 32  # Each kind of primitive has a cell of the picture, 3.2 units wide.
ROWS = -(-len(KINDS) // COLUMNS)
BACKDROP = 'AttributeBegin Sides 2 Surface "constant" Patch "bilinear" "P" [-9 -9 9  99 -9 9  -9 99 9  99 99 9] AttributeEnd'


def render(folder, attributes, behind="", mode="rgba"):
    shapes = "\n".join(f"AttributeBegin Translate {3.2 * (k % COLUMNS) + 1.6} {3.2 * (k // COLUMNS) + 1.6} 2 Rotate 35 1 0 0 Rotate 20 0 1 0 {shape} AttributeEnd"
                       for k, shape in enumerate(KINDS.values()))
    scene = folder / "a.rib"
    scene.write_text(f"""Format {COLUMNS * CELL} {ROWS * CELL} 1
PixelFilter "box" 1 1
Hider "hidden" "jitter" [0]
Display "a.exr" "openexr" "{mode}" "string exrpixeltype" ["float"]
Projection "orthographic"
ScreenWindow 0 {3.2 * COLUMNS} 0 {3.2 * ROWS}
WorldBegin
LightSource "distantlight" 1 "from" [-0.4 0.3 -1] "to" [0 0 0]
{behind}
{attributes}
{shapes}
WorldEnd
""")
    done = subprocess.run([tomales, "render", str(scene), "-o", str(folder / "a.exr")], capture_output=True, text=True)
    if done.returncode or done.stderr:
        sys.exit(f"{attributes}: {done.stderr}")
    return pixels(folder / "a.exr")


def polygons(folder, what):
    """Writes the same square eight times, beginning at each corner in both directions."""
    corners = [(-0.4, -0.4), (-0.4, 0.4), (0.4, 0.4), (0.4, -0.4)]
    (folder / "map.ppm").write_text("P3 8 8 255 " + " ".join(f"{40 * (x % 4) + 60} {30 * y} {90 * ((x + y) % 2)}" for y in range(8) for x in range(8)))
    squares = "\n".join(
        f'TransformBegin Translate {k % 4 + 0.5} {k // 4 + 0.5} 2 Polygon "P" [' +
        " ".join(f"{x} {y} 0" for x, y in [corners[(k + i * (1 if k < 4 else -1)) % 4] for i in range(4)]) + "] TransformEnd" for k in range(8))
    (folder / "polygons.rib").write_text(f"""Format 128 64 1
PixelFilter "box" 1 1
Hider "hidden" "jitter" [0]
Display "polygons.exr" "openexr" "rgba"
Projection "orthographic"
ScreenWindow 0 4 0 2
WorldBegin
LightSource "ambientlight" 1
{what}
{squares}
WorldEnd
""")
    subprocess.run([pathlib.Path(tomales).absolute(), "render", "polygons.rib", "-q", "--texture-cache", "cache"], cwd=folder, check=True)
    picture = pixels(folder / "polygons.exr")
    return [{(x, y): picture[32 * (k % 4) + x, 32 * (1 - k // 4) + y] for x in range(32) for y in range(32)} for k in range(8)]


def expect(what, good):
    """Reports `what` for each kind of primitive whose pixels are not `good`."""
    for k, kind in enumerate(KINDS):
        x0, y0 = k % COLUMNS * CELL, (ROWS - 1 - k // COLUMNS) * CELL
        if not good([(x, y) for x in range(x0, x0 + CELL) for y in range(y0, y0 + CELL)]):
            failures.append(f"{kind}: {what}")


with tempfile.TemporaryDirectory() as temporary:
    folder = pathlib.Path(temporary)
    lit = 'Surface "plastic" Sides 1 '
    both = render(folder, 'Surface "plastic"')
    outside, inside = render(folder, lit), render(folder, lit + 'Orientation "inside"')
    reversed_, twice = render(folder, lit + "ReverseOrientation"), render(folder, lit + "ReverseOrientation ReverseOrientation")
    held, placed = render(folder, "Matte 1", BACKDROP), render(folder, "TextureCoordinates [.3 .6  .3 .6  .3 .6  .3 .6]", "", "s,t,a")
    expect("nothing is seen", lambda cell: sum(both[p][3] for p in cell) > 20)
    expect("ReverseOrientation is not Orientation inside", lambda cell: all(inside[p] == reversed_[p] for p in cell))
    expect("two ReverseOrientations are not none", lambda cell: all(outside[p] == twice[p] for p in cell))
    expect("its two sides are not all of it", lambda cell: all(max(outside[p][3], inside[p][3]) > both[p][3] - 0.6 for p in cell))
    expect("its two sides cover more than it does", lambda cell: all(max(outside[p][3], inside[p][3]) <= both[p][3] for p in cell))
    expect("Matte does not hold out what it covers", lambda cell: all(abs(held[p][3] + both[p][3] - 1) < 1e-3 for p in cell))
    expect("TextureCoordinates are not its s and t",
           lambda cell: all(abs(placed[p][0] - 0.3) < 1e-4 and abs(placed[p][1] - 0.6) < 1e-4 for p in cell if placed[p][2] == 1))

    squares = polygons(folder, 'Surface "paintedplastic" "string texturename" "map.ppm" "Kd" [0] "Ks" [0]')
    if len({round(p[0], 1) for p in squares[0].values()}) < 3:
        failures.append("the picture is not to be seen on a polygon")
    for k, square in enumerate(squares):
        off = sum(abs(a - b) for p in square for a, b in zip(square[p], squares[0][p])) / len(square)
        if off > 0.01:
            failures.append(f"a polygon that begins at another corner ({k}) is textured otherwise: {off:.3f}")
    misty = render(folder, "Matte 1 Opacity 0.25 0.25 0.25", BACKDROP)  # A kind may cover a pixel with up to eight layers.
    expect("transparent and Matte, it does not hold out as much as it covers",
           lambda cell: all(1 - (1 - 0.75**8) * both[p][3] - 1e-3 <= misty[p][3] <= 1 - 0.25 * both[p][3] + 1e-3 for p in cell))

print("\n".join(failures))
sys.exit(bool(failures))
