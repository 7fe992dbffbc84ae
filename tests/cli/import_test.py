"""Models of other programs as scenes: what is where in the picture, and what is told of what cannot be brought in."""
import math
import subprocess

from models import Gltf, cube, fbx, obj, ply, png, stl, triangles
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

# Pictures: a quarter of each is of one colour.
QUARTERS = ((255, 0, 0), (0, 255, 0), (0, 0, 255), (255, 255, 255))  # from the left, the upper row first
quarters = png(64, lambda x, y: QUARTERS[(x >= 32) + 2 * (y >= 32)])
square = [(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)]


def facing(name, look, uv=uvs[:4], files=(), **attributes):
    """A square that the camera looks at, of a material of glTF; `look` makes it, with pictures of its own."""
    scene = Gltf()
    material = scene.add("materials", look(scene))
    scene.node(mesh=scene.mesh(square, [(0, 1, 2), (0, 2, 3)], NORMAL=[(0, 0, 1)] * 4, TEXCOORD_0=uv, material=material, **attributes))
    scene.add("cameras", {"type": "perspective", "perspective": {"yfov": 2 * math.atan(1 / 4), "znear": 0.1, "aspectRatio": 4 / 3}})
    scene.node(camera=0, translation=[0, 0, 4])
    scene.node(extensions=scene.light(type="directional", intensity=3.0))
    return imported(name, scene.glb())


def paint(picture, **more):
    return lambda scene: {"pbrMetallicRoughness": {"metallicFactor": 0, "baseColorTexture": {"index": scene.image(picture)}}, **more}


CENTERS = ((50, 30), (110, 30), (50, 90), (110, 90))
painted = facing("painted.glb", paint(quarters))
colours = [strongest(painted[y][x]) for x, y in CENTERS]
t.expect(colours == ["r", "g", "b", "rgb"], f"a picture within a .glb is the right way up: {colours}")
turned = facing("repeated.glb", paint(quarters), uv=[(u + 2, v - 3) for u, v in uvs[:4]])
t.expect(all(max(abs(a - b) for a, b in zip(turned[y][x], painted[y][x])) <= 3 for x, y in CENTERS), "pictures repeat beyond their edges")
grey = facing("grey.glb", paint(png(8, lambda x, y: (128, 128, 128))))[60][80][0]
half = facing("half.glb", lambda scene: {"pbrMetallicRoughness": {"metallicFactor": 0, "baseColorFactor": [0.2159, 0.2159, 0.2159, 1]}})[60][80][0]
t.expect(abs(grey - half) <= 1, f"base colours are made linear: {grey}, {half}")
ways = facing("metal.glb", lambda scene: {"pbrMetallicRoughness": {"metallicRoughnessTexture": {"index": scene.image(png(8, lambda x, y: (0, 255, 255 * (x >= 4))))}}})
t.expect(ways[60][50][0] > 1.5 * ways[60][110][0], "the blue channel makes the right half a metal, which scatters nothing")
cut = facing("cut.glb", paint(png(8, lambda x, y: (255, 255, 255, 255 * (y >= 4))), alphaMode="BLEND"))
t.expect(max(cut[30][80]) == 0 and min(cut[90][80]) > 50, "alpha of a picture cuts away where the material blends")
whole = facing("whole.glb", paint(png(8, lambda x, y: (255, 255, 255, 255 if y >= 4 else 51))))
t.expect(abs(whole[30][80][0] - whole[90][80][0]) <= 2, "and nowhere else, nor does it darken")
glow = facing("glow.glb", lambda scene: {"emissiveFactor": [1, 1, 1], "emissiveTexture": {"index": scene.image(quarters)}, "pbrMetallicRoughness": {"baseColorFactor": [0, 0, 0, 1]}})
t.expect([strongest(glow[y][x]) for x, y in CENTERS] == ["r", "g", "b", "rgb"], "a picture of what glows is seen")


def tilted(x, y):
    return lambda scene: {"pbrMetallicRoughness": {"metallicFactor": 0, "roughnessFactor": 1}, "normalTexture": {"index": scene.image(png(8, lambda *_: (128 + x, 128 + y, 218)))}}


def lit_from(name, direction, look, **more):
    """Brightness of a square under a sun that shines along -z of a node which is turned so."""
    scene = Gltf()
    scene.node(mesh=scene.mesh(square, [(0, 1, 2), (0, 2, 3)], NORMAL=[(0, 0, 1)] * 4, TEXCOORD_0=uvs[:4], material=scene.add("materials", look(scene))))
    scene.node(extensions=scene.light(type="directional", intensity=2.0), rotation=direction)
    return imported(name, scene.glb(), "--light-scale", "1")[60][80][0]


s = math.sin(math.pi / 8), math.cos(math.pi / 8)
from_right, from_top = [0, s[0], 0, s[1]], [-s[0], 0, 0, s[1]]
bumps = [[lit_from(f"tilt{a}{b}.glb", sun, tilted(*by)) for b, sun in enumerate((from_right, from_top))] for a, by in enumerate(((90, 0), (-90, 0), (0, 90)))]
t.expect(bumps[0][0] > bumps[1][0] + 40, f"red of a normal map turns to the right: {bumps}")
t.expect(bumps[2][1] > bumps[2][0] + 20 and bumps[0][0] > bumps[0][1] + 20, f"green turns up, where red lets light from there alone: {bumps}")

# Pictures beside the model, under the names that people's machines give them.
(t.folder / "textures").mkdir(exist_ok=True)
t.write("textures/a picture.png", quarters)
t.write("wood.png", quarters)
for name in ("wood.png", "C:\\\\work\\\\wood.png", "/nowhere/wood.png", "..\\\\old\\\\a picture.png", "a picture.png"):
    t.write("paint.mtl", f"newmtl paint\nKd 1 1 1\nmap_Kd {name}\n")
    seen = imported("named.obj", obj(positions, quads, uvs, normals, before="mtllib paint.mtl", material="paint"))
    t.expect(strongest(seen[50][40]) == "r", f"{name} is found: {seen[50][40]}")
t.write("paint.mtl", "newmtl paint\nKd 1 1 1\nmap_Kd ../../gone.png\nmap_bump wood.png\n")
t.expect_run("a texture that is missing", ["import", "named.obj", "-o", "gone.rib"], 3, 'texture "../../gone.png" is neither', 'material "paint"', "bump map")
t.write("wood.png", b"no picture")
t.write("paint.mtl", "newmtl paint\nmap_Kd wood.png\n")
t.expect_run("a texture that is no picture", ["import", "named.obj", "-o", "gone.rib"], 3, "cannot be read")

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

# Odd corners: a scene that renders, or a message.


def odd(change, mode=4, faces=((0, 1, 2), (0, 2, 3)), corners=square, **node):
    scene = Gltf()
    scene.node(mesh=scene.mesh(corners, faces, mode=mode), **node)
    change(scene)
    return scene.glb()


def cycle(scene):
    scene.document["nodes"][0]["children"] = [0]


def deep(scene):
    for k in range(3000):
        scene.document["nodes"][k]["children"] = [scene.node(root=False)]


def far_index(scene):
    scene.document["accessors"][0]["count"] = 2


nothing = lambda scene: None
nan, inf = float("nan"), float("inf")
escaping = 'name with "quotes" ../../../escaped\n'
ODD = {
    "cyclic nodes": (odd(cycle), {2}),
    "a chain of nodes": (odd(deep), {0, 2}),
    "corners that are not there": (odd(far_index), {0, 2}),
    "a corner that is no number": (odd(nothing, corners=square[:3] + [(nan, 0, 0)]), {0}),
    "no corner that is a number": (odd(nothing, corners=[(nan, inf, 0)] * 4), {2}),
    "huge coordinates": (odd(nothing, corners=[(x * 1e30, y * 1e30, z) for x, y, z in square]), {0}),
    "tiny coordinates": (odd(nothing, corners=[(x * 1e-30, y * 1e-30, z) for x, y, z in square]), {0}),
    "one place for all corners": (odd(nothing, corners=[(1, 2, 3)] * 4), {0}),
    "a scale of 0": (odd(nothing, scale=[0, 1, 1]), {2}),
    "negative scales": (odd(nothing, scale=[-2, -1, -1]), {0}),
    "three faces at an edge": (odd(nothing, faces=((0, 1, 2), (0, 1, 3), (0, 1, 2), (1, 0, 3))), {0}),
    "points": (odd(nothing, mode=0, faces=((0, 1), (2, 3))), {0}),
    "lines": (odd(nothing, mode=1, faces=((0, 1), (2, 3))), {0}),
    "names that are paths": (odd(nothing, name=escaping), {0}),
    "no meshes": (odd(lambda scene: scene.document["nodes"][0].pop("mesh")), {2}),
}
for what, (model, codes) in ODD.items():
    t.write("odd.glb", model)
    for options in ([], ["--subdivide"]):
        made = t.run("import", "odd.glb", "-o", "odd.rib", *options)
        t.expect(made.returncode in codes and bool(made.stderr) >= (made.returncode > 0), f"{what} {options}: {made.returncode} {made.stderr}")
        if made.returncode == 0:
            drawn = t.run("odd.rib", "-o", "odd.png", "--format", "32x24")
            t.expect(drawn.returncode in (0, 3), f"{what} {options}: renders: {drawn.returncode} {drawn.stderr}")
        (t.folder / "odd.rib").unlink(missing_ok=True)
large = Gltf()
large.node(mesh=large.mesh(grid, [f for a, b, c, d in ball for f in ((a, b, c), (a, c, d))], name=escaping))
t.write("a name.glb", large.glb())
t.expect_run("names with blanks", ["import", "a name.glb", "-o", "a scene.rib"], 0)
t.expect_run("are found again", ["a scene.rib", "-o", "odd.png", "--format", "32x24"], 0)
t.expect(len(list((t.folder / "a scene_parts").iterdir())) == 1 and not list(t.folder.parent.glob("*escaped*")), "and lead nowhere else")

t.finish()
