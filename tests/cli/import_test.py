"""Tests models of other programs as scenes: where things are in the picture, and the messages about what cannot be imported."""
import math
import os
import pathlib
import sys

from models import Gltf, collada, cube, fbx, obj, ply, png, stl, triangles
from program import Suite

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "image"))
from pictures import pixels  # noqa: E402

t = Suite()
positions, normals, uvs, colors, quads = cube()
opaque = [(*c, 1) for c in colors]


def picture(name, *options):
    """Renders a scene with exit code 0. Returns rows of pixels of three bytes, about as a screen shows them."""
    t.expect_run(f"{name} renders", [name + ".rib", "-o", name + ".exr", *options], 0)
    seen = pixels(t.folder / (name + ".exr"))
    width, height = (max(place[k] for place in seen) + 1 for k in (0, 1))
    return [[tuple(round(255 * min(max(c, 0), 1) ** (1 / 2.2)) for c in seen[x, y][:3]) for x in range(width)] for y in range(height)]


def imported(name, model, *options):
    """Writes a model and imports it. Returns the picture."""
    t.write(name, model)
    stem = name.replace(".", "_")
    made = t.expect_run(f"{name} comes in", ["import", name, "-o", stem + ".rib", *options], 0)
    t.expect(not made.stderr, f"{name}: without a word {made.stderr}")
    return picture(stem, "--format", "160x120")


def strongest(pixel):
    """Returns the letters of the channels above half of the greatest."""
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
# The model has different sizes along its axes, and stands on one of them.
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

# The model has its own camera: a cube of width 1 whose front is 4 from the eye, in the middle of an angle of 40 degrees.
fov = math.radians(40)
own = Gltf()
cube_mesh = own.mesh(positions, triangles(quads), NORMAL=normals, COLOR_0=opaque)
own.node(mesh=cube_mesh)
own.add("cameras", {"type": "perspective", "perspective": {"yfov": fov, "znear": 0.1, "aspectRatio": 4 / 3}})
own.node(camera=0, name="eye", translation=[0.25, 0, 4.5])
left, right, top, bottom = extent(imported("camera.glb", own.glb()))
scale = 60 / math.tan(fov / 2) / 4  # This is the number of pixels of a unit.
expected = [80 - 0.75 * scale, 80 + 0.25 * scale - 1, 60 - 0.5 * scale, 60 + 0.5 * scale - 1]
t.expect(all(abs(a - b) <= 1.5 for a, b in zip((left, right, top, bottom), expected)),
         f"the model's camera is looked through: {left, right, top, bottom}, expected {expected}")
t.expect_run("a camera that is not there", ["import", "camera.glb", "-o", "other.rib", "--camera", "nobody"], 3, 'no camera "nobody"', '"eye"')
away = Gltf()
away.node(mesh=away.mesh(positions, triangles(quads), NORMAL=normals, COLOR_0=opaque))
away.add("cameras", {"type": "perspective", "perspective": {"yfov": fov, "znear": 0.1, "aspectRatio": 4 / 3}})
away.node(camera=0, name="eye", translation=[0, 0, -4.5])
t.write("away.glb", away.glb())
t.expect_run("a camera that looks away", ["import", "away.glb", "-o", "away.rib"], 0, 'camera "eye" looks away')
t.expect(max(picture("away", "--format", "160x120")[60][80]) > 10, "another one sees the model")

# Several nodes show one mesh, and one of them mirrors it: its red towards +x is then on the other side.
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

# Assimp returns neither the kind nor the size of the area lights of .fbx. They shine only in front of themselves.
for name, height, top in (("above.fbx", 4, "r"), ("below.fbx", -4, "")):
    t.write(name, fbx(positions, quads, normals, area=(0, height, 0)))
    t.expect_run(f"an area light: {name}", ["import", name, "-o", name + ".rib"], 0, "1 lights are taken as small areas")
    seen = picture(name, "--format", "160x120")
    t.expect((strongest(seen[28][77]), strongest(seen[73][63])) == (top, ""), f"{name}: the light falls down: {seen[28][77]}, {seen[73][63]}")
# A point light of four times the intensity at twice the distance gives the same light, and a sun is as strong everywhere.


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

# Each quarter of a picture has one colour.
QUARTERS = ((255, 0, 0), (0, 255, 0), (0, 0, 255), (255, 255, 255))  # These go from the left, with the upper row first.
quarters = png(64, lambda x, y: QUARTERS[(x >= 32) + 2 * (y >= 32)])
square = [(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)]


def facing(name, look, uv=uvs[:4], files=(), **attributes):
    """A square of a glTF material faces the camera. `look` makes the material, with pictures of its own."""
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
veiled = png(8, lambda x, y: (128, 255 if y >= 4 else 51))  # This is grey with alpha, as the last of two channels.
shades = [[seen[y][80] for y in (30, 90)] for seen in (facing(f"veil{m}.glb", paint(veiled, alphaMode=m)) for m in ("OPAQUE", "MASK", "BLEND"))]
t.expect(all(max(abs(c - grey) for c in p) <= 3 for p in (*shades[0], shades[1][1], shades[2][1])), f"grey with alpha is grey: {shades}, {grey}")
t.expect(max(shades[1][0]) == 0 and 0 < max(shades[2][0]) < grey, f"where its alpha says so: {shades}")
ways = facing("metal.glb", lambda scene: {"pbrMetallicRoughness": {"metallicRoughnessTexture": {"index": scene.image(png(8, lambda x, y: (0, 255, 255 * (x >= 4))))}}})
t.expect(ways[60][50][0] > 1.5 * ways[60][110][0], "the blue channel makes the right half a metal, which scatters nothing")
cut = facing("cut.glb", paint(png(8, lambda x, y: (255, 255, 255, 255 * (y >= 4))), alphaMode="BLEND"))
t.expect(max(cut[30][80]) == 0 and min(cut[90][80]) > 50, "alpha of a picture cuts away where the material blends")
ramp = png(64, lambda x, y: (255, 255, 255, 255 * (64 - y) // 64))  # Alpha is 1 on top and 0 at the bottom.


def rows(name, **mode):
    """Returns the brightness above and below the middle of a square whose alpha falls downwards."""
    seen = facing(name, paint(ramp, **mode))
    return [seen[y][80][0] for y in (40, 56, 64, 80)]


masked, third, blended = rows("masked.glb", alphaMode="MASK"), rows("third.glb", alphaMode="MASK", alphaCutoff=0.4), rows("blended.glb", alphaMode="BLEND")
t.expect(masked[0] == masked[1] > 50 and masked[2] == masked[3] == 0, f"MASK is whole where alpha is at least 0.5, and nothing elsewhere: {masked}")
t.expect(third[2] == third[0] and third[3] == 0, f"or at least what the material says: {third}")
t.expect(all(a > b + 5 for a, b in zip(blended, blended[1:])) and blended[3] > 50, f"BLEND shows less and less: {blended}")
alpha = lambda a, **mode: lambda scene: {"pbrMetallicRoughness": {"metallicFactor": 0, "baseColorFactor": [1, 1, 1, a]}, **mode}
factors = [facing(f"factor{k}.glb", alpha(*look[:1], alphaMode=look[1]))[60][80][0] for k, look in enumerate(((0.4, "OPAQUE"), (0.4, "MASK"), (0.6, "MASK"), (1, "OPAQUE")))]
t.expect(factors[1] == 0 and factors[0] == factors[2] == factors[3] > 50, f"a material's own alpha counts in the same way: {factors}")
corners = [facing(f"corner{m}.glb", alpha(1, alphaMode=m), COLOR_0=[(1, 1, 1, a) for a in (0, 0, 1, 1)]) for m in ("OPAQUE", "MASK")]
t.expect(corners[0][80][80] == corners[0][40][80] == corners[1][40][80] > (50, 50, 50) and corners[1][80][80] == (0, 0, 0), "so do alphas of vertices")
whole = facing("whole.glb", paint(png(8, lambda x, y: (255, 255, 255, 255 if y >= 4 else 51))))
t.expect(abs(whole[30][80][0] - whole[90][80][0]) <= 2, "and nowhere else, nor does it darken")
glow = facing("glow.glb", lambda scene: {"emissiveFactor": [1, 1, 1], "emissiveTexture": {"index": scene.image(quarters)}, "pbrMetallicRoughness": {"baseColorFactor": [0, 0, 0, 1]}})
t.expect([strongest(glow[y][x]) for x, y in CENTERS] == ["r", "g", "b", "rgb"], "a picture of what glows is seen")


# Each picture may have texture coordinates of its own.
def of_two(scene):
    """Looks up the colour by the first set and the opacity by the second, so that the square shows only the left half of the
    picture."""
    halves = scene.image(png(64, lambda x, y: (255, 255, 255, 255 * (x < 16))))
    return {"alphaMode": "MASK", "pbrMetallicRoughness": {"metallicFactor": 0, "baseColorFactor": [0, 0, 0, 1], "baseColorTexture": {"index": halves}},
            "emissiveFactor": [1, 1, 1], "emissiveTexture": {"index": scene.image(quarters), "texCoord": 1}}


left_half = facing("two.glb", of_two, uv=[(u / 2, v) for u, v in uvs[:4]], TEXCOORD_1=uvs[:4])
t.expect([strongest(left_half[y][x]) for x, y in CENTERS] == ["r", "", "b", ""], "two pictures have two sets of coordinates")
only = facing("second.glb", lambda scene: {"pbrMetallicRoughness": {"metallicFactor": 0, "baseColorTexture": {"index": scene.image(quarters), "texCoord": 1}}},
              uv=[(0.1, 0.1)] * 4, TEXCOORD_1=uvs[:4])
t.expect([strongest(only[y][x]) for x, y in CENTERS] == ["r", "g", "b", "rgb"], "or all have the second")


def wrapped(name, **sampler):
    """Returns the colours at the middles of nine squares, row by row, of the four-coloured picture between -1 and 2."""
    def look(scene):
        index = scene.image(quarters)
        if sampler:
            scene.document["textures"][index]["sampler"] = scene.add("samplers", sampler)
        return {"emissiveFactor": [1, 1, 1], "emissiveTexture": {"index": index}, "pbrMetallicRoughness": {"baseColorFactor": [0, 0, 0, 1]}}
    seen = facing(name, look, uv=[(3 * u - 1, 3 * v - 1) for u, v in uvs[:4]])
    return [strongest(seen[y][x]) for y in (10, 50, 90) for x in (30, 70, 110)]


t.expect(wrapped("wraps.glb") == ["r"] * 9, f"pictures repeat where the file says nothing: {wrapped('wraps.glb')}")
clamped = wrapped("clamps.glb", wrapS=33071, wrapT=33071)
t.expect(clamped == ["r", "r", "g", "r", "r", "g", "b", "b", "rgb"], f"their edges go on where it says so: {clamped}")
mirrored = wrapped("mirrors.glb", wrapS=33648, wrapT=10497)
t.expect(mirrored == ["g", "r", "g"] * 3, f"or they are mirrored: {mirrored}")


def tilted(x, y):
    return lambda scene: {"pbrMetallicRoughness": {"metallicFactor": 0, "roughnessFactor": 1}, "normalTexture": {"index": scene.image(png(8, lambda *_: (128 + x, 128 + y, 218)))}}


def lit_from(name, direction, look, **more):
    """Returns the brightness of a square under a sun that shines along -z of a node with this rotation."""
    scene = Gltf()
    scene.node(mesh=scene.mesh(square, [(0, 1, 2), (0, 2, 3)], NORMAL=[(0, 0, 1)] * 4, TEXCOORD_0=uvs[:4], material=scene.add("materials", look(scene))))
    scene.node(extensions=scene.light(type="directional", intensity=2.0), rotation=direction)
    return imported(name, scene.glb(), "--light-scale", "1")[60][80][0]


s = math.sin(math.pi / 8), math.cos(math.pi / 8)
from_right, from_top = [0, s[0], 0, s[1]], [-s[0], 0, 0, s[1]]
bumps = [[lit_from(f"tilt{a}{b}.glb", sun, tilted(*by)) for b, sun in enumerate((from_right, from_top))] for a, by in enumerate(((90, 0), (-90, 0), (0, 90)))]
t.expect(bumps[0][0] > bumps[1][0] + 40, f"red of a normal map turns to the right: {bumps}")
t.expect(bumps[2][1] > bumps[2][0] + 20 and bumps[0][0] > bumps[0][1] + 20, f"green turns up, where red lets light from there alone: {bumps}")

# Lights of other formats store the whole angles of their cones. A white square that faces them sends their light back.
WHITE_SQUARE = [(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)]


def shone_on(name, light):
    seen = imported(name, collada(WHITE_SQUARE, [(0, 1, 2, 3)], light, "<perspective><xfov>40</xfov><aspect_ratio>1.333</aspect_ratio><znear>1</znear></perspective>"), "--light-scale", "1")
    return [seen[60][x][0] for x in (80, 110)]


sun = shone_on("sun.dae", "<directional><color>.5 .5 .5</color></directional>")
near = shone_on("point.dae", "<point><color>8 8 8</color><quadratic_attenuation>1</quadratic_attenuation><constant_attenuation>0</constant_attenuation></point>")
even = shone_on("even.dae", "<point><color>.5 .5 .5</color></point>")
cone = shone_on("spot.dae", "<spot><color>.5 .5 .5</color><falloff_angle>12</falloff_angle><outer_cone>14</outer_cone></spot>")
t.expect(sun[0] > 50 and max(abs(other[0] - sun[0]) for other in (near, even, cone)) <= 1, f"they are as strong as the file says: {sun, near, even, cone}")
t.expect(abs(sun[1] - sun[0]) <= 4 and cone[1] == 0, f"and a spot lights its cone alone: {sun, cone}")

t.write("nameless.dae", collada(WHITE_SQUARE, [(0, 1, 2, 3)], "", "<perspective><xfov>40</xfov></perspective>").replace('name="camera"', ""))
t.expect_run("a camera that Assimp does not read is told of", ["import", "nameless.dae", "-o", "nameless.rib"], 0, "import-camera", "does not tell its angle")

# Motion is reported.
moving = Gltf()
bound = moving.mesh(positions, triangles(quads), NORMAL=normals)
moving.document["meshes"][bound]["primitives"][0]["attributes"].update(
    JOINTS_0=moving.add("accessors", {"bufferView": moving.view(bytes(4 * 24)), "componentType": 5121, "count": 24, "type": "VEC4"}),
    WEIGHTS_0=moving.floats([(1, 0, 0, 0)] * 24))
joint = moving.node(name="bone")
moving.node(mesh=bound, skin=moving.add("skins", {"joints": [joint], "inverseBindMatrices": moving.floats([(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1)])}))
morphing = moving.mesh(positions, triangles(quads), NORMAL=normals)
moving.document["meshes"][morphing]["primitives"][0]["targets"] = [{"POSITION": moving.floats(positions)}]
moving.node(mesh=morphing, translation=[2, 0, 0])
times, turns = moving.floats([(0,), (1,)]), moving.floats([(0, 0, 0), (1, 0, 0)])
moving.add("animations", {"channels": [{"sampler": 0, "target": {"node": joint, "path": "translation"}}], "samplers": [{"input": times, "output": turns}]})
t.write("moving.glb", moving.glb())
t.expect_run("animations, bones and other shapes are told of", ["import", "moving.glb", "-o", "moving.rib"], 0, "import-animation", "import-skin", "import-morph")

# Pictures lie beside the model, but the model has names from other machines.
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

t.write("plain.obj", obj(positions, quads, uvs, normals, before="mtllib gone.mtl", material="paint"))
t.expect_run("a file of materials that is missing", ["import", "plain.obj", "-o", "gone.rib"], 3, '"gone.mtl" is not there; its materials are grey')
t.write("plain.mtl", "newmtl paint\nKd 1 0 0\n")
t.expect_run("the file of materials of the model's own name", ["import", "plain.obj", "-o", "gone.rib"], 3, '"gone.mtl" is not there; "plain.mtl" is read instead')
t.write("huge.ply", "ply\nformat ascii 1.0\nelement vertex 4000000000\nproperty float x\nproperty float y\nproperty float z\n"
        "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n")
enough = os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE") > 48e9  # then the file ends too early
t.expect_run("a count beyond the memory", ["import", "huge.ply", "-o", "gone.rib"], 2, "cannot be read" if enough else "there is not enough memory for what it says that it holds")

# Larger meshes become archives in a folder beside the scene.
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

# Some models cannot be imported.
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

# Names must not become paths.
escaping = 'name with "quotes" ../../../escaped\n'
large = Gltf()
large.node(mesh=large.mesh(grid, [f for a, b, c, d in ball for f in ((a, b, c), (a, c, d))], name=escaping))
t.write("a name.glb", large.glb())
t.expect_run("names with blanks", ["import", "a name.glb", "-o", "a scene.rib"], 0)
t.expect_run("are found again", ["a scene.rib", "-o", "odd.png", "--format", "32x24"], 0)
t.expect(len(list((t.folder / "a scene_parts").iterdir())) == 1 and not list(t.folder.parent.glob("*escaped*")), "and lead nowhere else")

t.expect_run("a folder that is missing is named, and no file that nobody asked for", ["import", sorted(p.name for p in t.folder.glob("*.obj"))[0], "-o", "none/a.rib"], 4,
             "none/a.rib cannot be written: its folder is missing")
t.finish()
