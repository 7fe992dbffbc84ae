"""Models of other programs as scenes: what is where in the picture, and what is told of what cannot be brought in."""
import math
import subprocess

from models import Gltf, cube, fbx, obj, ply, stl, triangles
from program import Suite

t = Suite()
positions, normals, uvs, colors, quads = cube()
opaque = [(*c, 1) for c in colors]


def picture(name, *options):
    """Of a scene: its exit code is 0, and the pixels are rows of triples of bytes."""
    t.expect_run(f"{name} renders", [name + ".rib", "-o", name + ".png", *options], 0)
    subprocess.run(["oiiotool", name + ".png", "-d", "uint8", "-o", name + ".pnm"], cwd=t.folder, check=True)
    head, size, _, data = (t.folder / (name + ".pnm")).read_bytes().split(b"\n", 3)
    width, height = map(int, size.split())
    return [[tuple(data[3 * (y * width + x) : 3 * (y * width + x) + 3]) for x in range(width)] for y in range(height)]


def imported(name, model, *options):
    """Writes a model and brings it in; returns the picture."""
    t.write(name, model)
    stem = name.replace(".", "_")
    made = t.expect_run(f"{name} comes in", ["import", name, "-o", stem + ".rib", *options], 0)
    t.expect(not made.stderr, f"{name}: without a word {made.stderr}")
    return picture(stem, "--format", "160x120")


def strongest(pixel):
    """Letters of the channels above half of the greatest."""
    return "".join(c for c, value in zip("rgb", pixel) if value > 0.5 * max(pixel) and max(pixel) > 10)


# The camera that is added looks from above the front right corner: +z is on the left, +x on the right, +y on top.
plain = Gltf()
plain.node(mesh=plain.mesh(positions, triangles(quads), NORMAL=normals, TEXCOORD_0=uvs, COLOR_0=opaque))
for name, model in (("cube.obj", obj(positions, quads, uvs, normals, colors)), ("cube.ply", ply(positions, triangles(quads), colors)),
                    ("binary.ply", ply(positions, triangles(quads), colors, binary=True)), ("cube.gltf", plain.gltf()), ("cube.glb", plain.glb())):
    seen = imported(name, model)
    sides = [strongest(seen[y][x]) for x, y in ((63, 73), (108, 66), (77, 28))]
    t.expect(sides == ["b", "r", "g"], f"{name}: blue, red and green are where z, x and y point to: {sides}")
    t.expect(seen[5][5] == (0, 0, 0), f"{name}: the picture's corner is empty")
# A model that is not of the same size along all axes, and stands on one of them.
tall = [(x / 4, y / 4, z) for x, y, z in positions]


def extent(seen):
    rows = [y for y, row in enumerate(seen) if any(max(p) > 10 for p in row)]
    columns = [x for x in range(len(seen[0])) if any(max(row[x]) > 10 for row in seen)]
    return columns[0], columns[-1], rows[0], rows[-1]


def is_upright(seen):
    left, right, top, bottom = extent(seen)
    return bottom - top > 1.5 * (right - left)


t.expect(is_upright(imported("tall.stl", stl(tall, triangles(quads)))), "the z axis of .stl points up")
t.expect(is_upright(imported("tall.obj", obj(tall, quads), "--up", "z")), "--up z turns another model")
t.expect(not is_upright(imported("lying.stl", stl(tall, triangles(quads)), "--up", "y")), "--up y leaves .stl")
t.expect(strongest(imported("red.fbx", fbx(positions, quads, normals))[73][63]) == "r", "an .fbx has the colour of its material")

# Its own camera: a cube of width 1 whose front is 4 from the eye, in the middle of an angle of 40 degrees.
fov = math.radians(40)
own = Gltf()
cube_mesh = own.mesh(positions, triangles(quads), NORMAL=normals, COLOR_0=opaque)
own.node(mesh=cube_mesh)
own.add("cameras", {"type": "perspective", "perspective": {"yfov": fov, "znear": 0.1, "aspectRatio": 4 / 3}})
own.node(camera=0, name="eye", translation=[0.25, 0, 4.5])
left, right, top, bottom = extent(imported("camera.glb", own.glb()))
scale = 60 / math.tan(fov / 2) / 4  # pixels of a unit
expected = [80 - 0.75 * scale, 80 + 0.25 * scale - 1, 60 - 0.5 * scale, 60 + 0.5 * scale - 1]
t.expect(all(abs(a - b) <= 1.5 for a, b in zip((left, right, top, bottom), expected)),
         f"the model's camera is looked through: {left, right, top, bottom}, expected {expected}")
t.expect_run("a camera that is not there", ["import", "camera.glb", "-o", "other.rib", "--camera", "nobody"], 3, 'no camera "nobody"', '"eye"')

# One mesh for several nodes, of which one mirrors: red towards +x is then on the other side.
twice = Gltf()
twin = twice.mesh(positions, triangles(quads), NORMAL=normals, COLOR_0=opaque)
twice.node(mesh=twin, translation=[-1, 0, 0], name="left")
twice.node(mesh=twin, translation=[1, 0, 0], scale=[-1, 1, 1], name="right")
twice.add("cameras", {"type": "perspective", "perspective": {"yfov": 0.6, "znear": 0.1, "aspectRatio": 4 / 3}})
twice.node(camera=0, translation=[0, 0, 6])
seen = imported("twice.glb", twice.glb())
text = (t.folder / "twice_glb.rib").read_text()
t.expect(text.count("ObjectBegin") == 1 and text.count("ObjectInstance") == 2 and text.count("PointsPolygons") == 1, "instances share a mesh")
middle = [strongest(seen[60][x]) for x in range(60, 101)]
t.expect("r" in middle and "rg" not in middle and "gb" not in middle, "both show the red side to the middle: " + " ".join(middle))

# Lights: the same light from a point of four times the intensity at twice the distance; a sun is as strong everywhere.


def lit(name, *options, **light):
    scene = Gltf()
    scene.node(mesh=scene.mesh(positions, triangles(quads), NORMAL=normals, material=scene.add("materials", {"pbrMetallicRoughness": {"metallicFactor": 0}})))
    scene.add("cameras", {"type": "perspective", "perspective": {"yfov": 0.3, "znear": 0.1, "aspectRatio": 1}})
    scene.node(camera=0, translation=[0, 0, 6])
    place = light.pop("translation")
    scene.node(extensions=scene.light(**light), translation=place)
    return imported(name, scene.glb(), "--light-scale", "1", *options)[60][80][0]


near, far = (lit(f"point{k}.glb", type="point", intensity=k * k * 2.0, translation=[0, 0, 0.5 + 1.5 * k]) for k in (1, 2))
t.expect(abs(near - far) <= 1 and near > 50, f"points follow the inverse square: {near}, {far}")
sun = lit("sun.glb", type="directional", intensity=2.0, translation=[9, 9, 9])
same = lit("candela.glb", type="point", intensity=2.0 * 100, translation=[0, 0, 10.5])
t.expect(abs(sun - same) <= 1 and sun > 50, f"lux of a sun are candela of a point over the squared distance: {sun}, {same}")
spot = lit("spot.glb", type="spot", intensity=2.0 * 100, translation=[0, 0, 10.5], spot={"innerConeAngle": 0.2, "outerConeAngle": 0.3})
t.expect(abs(spot - same) <= 1, f"a spot is a point within its cone: {spot}, {same}")
dim = Gltf()
dim.node(mesh=dim.mesh(positions, triangles(quads), NORMAL=normals))
dim.node(extensions=dim.light(type="directional", intensity=1e5))
t.write("flood.glb", dim.glb())
t.expect_run("light that would flood the picture", ["import", "flood.glb", "-o", "flood.rib"], 0, "--light-scale 1")
t.expect(max(map(max, picture("flood", "--format", "80x60")[30])) < 255, "is scaled down")

# Larger meshes are archives in a folder beside the scene, wherever one stands.
n = 24
grid = [(math.cos(6.283 * i / n) * math.sin(3.1416 * j / n), math.cos(3.1416 * j / n), math.sin(6.283 * i / n) * math.sin(3.1416 * j / n)) for j in range(n + 1) for i in range(n)]
ball = [(j * n + i, j * n + (i + 1) % n, (j + 1) * n + (i + 1) % n, (j + 1) * n + i) for j in range(n) for i in range(n)]
smooth = imported("ball.obj", obj(grid, ball))
parts = sorted(p.name for p in (t.folder / "ball_obj_parts").iterdir())
t.expect(len(parts) == 1 and parts[0].endswith(".rib"), f"a large mesh is an archive: {parts}")
edges = imported("flat.obj", obj(grid, ball), "--smooth", "0")
step = [max(abs(seen[60][x + 1][0] - seen[60][x][0]) for x in range(60, 100)) for seen in (smooth, edges)]
t.expect(2 * step[0] < step[1], f"a model without normals looks smooth, and faceted with --smooth 0: {step}")
imported("cage.obj", obj(positions, quads), "--subdivide")
t.expect("SubdivisionMesh" in (t.folder / "cage_obj.rib").read_text(), "--subdivide makes subdivision surfaces")

# What cannot be brought in.
t.expect_run("a file that is not there", ["import", "none.obj", "-o", "none.rib"], 2, "cannot be read")
t.write("empty.obj", "# nothing\n")
t.expect_run("a file without geometry", ["import", "empty.obj", "-o", "none.rib"], 2, "[import-")
t.write("broken.glb", b"glTF" + bytes(40))
t.expect_run("a damaged file", ["import", "broken.glb", "-o", "none.rib"], 2, "cannot be read")
t.write("cube.xyz", "1 2 3")
t.expect_run("a kind that Assimp does not know", ["import", "cube.xyz", "-o", "none.rib"], 2, "cannot be read")
t.expect_run("a folder that is not there", ["import", "cube.obj", "-o", "nowhere/none.rib"], 4, "nowhere")
t.expect_run("a name that is no RIB's", ["import", "cube.obj", "-o", "none.txt"], 1)
t.expect(not list(t.folder.glob("*none*")) and not list(t.folder.glob(".tomales*")), "none of these leaves a file")
t.expect_run("a model where a scene is wanted", ["cube.obj"], 2, "tomales import cube.obj -o FILE.rib")

t.finish()
