"""Tests how a model's colours, pictures and texture coordinates are imported, by the numbers in the RIB."""
import math
import pathlib
import re
import struct
import sys

from models import Gltf, obj, ply, png
from program import Suite

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "image"))
from pictures import pixels  # noqa: E402

t = Suite()
SQUARE = [(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)]
UV = [(0, 0), (1, 0), (1, 1), (0, 1)]  # v runs up.
FACES = [(0, 1, 2), (0, 2, 3)]
DOWN = [(u, 1 - v) for u, v in UV]  # glTF and RIB have this order.
white = png(2, lambda *_: (255, 255, 255))


def imported(name, model, code=0, *says):
    """Imports a model. Returns the text of the RIB, and the messages."""
    t.write(name, model)
    made = t.expect_run(f"{name} comes in", ["import", name, "-o", "out.rib"], code, *says)
    t.expect(says or not made.stderr, f"{name}: without a word {made.stderr}")
    return (t.folder / "out.rib").read_text()


def numbers(rib, name):
    """Returns the numbers of a variable, or else of a parameter of the first material."""
    first, *_, last = re.split("ArchiveBegin|ArchiveEnd", rib)[1:]
    found = [re.search(rf'"[^"]* {name}" \[([^\]]*)\]', text) for text in (last, first)]
    return next(([float(x) for x in f[1].split()] for f in found if f), [])


def near(what, seen, expected, tolerance=1e-5):
    flat = [c for row in expected for c in (row if isinstance(row, tuple) else (row,))]
    t.expect(len(seen) == len(flat) and all(abs(a - b) <= tolerance for a, b in zip(seen, flat)), f"{what}: {seen}, expected {flat}")


def scene_of(look, **attributes):
    """Returns a square with a material of glTF. `look` makes the material from the scene."""
    scene = Gltf()
    scene.node(mesh=scene.mesh(SQUARE, FACES, NORMAL=[(0, 0, 1)] * 4, material=scene.add("materials", look(scene)), **{"TEXCOORD_0": UV, **attributes}))
    return scene


def using(scene, *names):
    scene.document.setdefault("extensionsUsed", []).extend(names)
    return scene


def transformed(coordinates, offset=(0, 0), rotation=0, scale=(1, 1)):
    """KHR_texture_transform by its definition: scaled, turned counterclockwise as seen with v downwards, moved."""
    c, s = math.cos(rotation), math.sin(rotation)
    return [(offset[0] + c * scale[0] * u + s * scale[1] * v, offset[1] - s * scale[0] * u + c * scale[1] * v) for u, v in coordinates]


def textured(scene, **transform):
    return {"index": scene.image(white), **({"extensions": {"KHR_texture_transform": transform}} if transform else {})}


CASES = ({"scale": [2, 2]}, {"scale": [0.5, 3]}, {"offset": [0.25, 2.75]}, {"rotation": 0.3}, {"rotation": -2.5}, {"scale": [-1, 1.5], "rotation": 4, "offset": [-3, 0.5]})
for k, case in enumerate(CASES):
    scene = using(scene_of(lambda s: {"pbrMetallicRoughness": {"baseColorTexture": textured(s, **case)}}), "KHR_texture_transform")
    near(f"texture coordinates of {case}", numbers(imported(f"transform{k}.glb", scene.glb()), "st"), transformed(DOWN, **case))
both = using(scene_of(lambda s: {"pbrMetallicRoughness": {"baseColorTexture": textured(s)}, "emissiveTexture": textured(s, scale=[2, 2], offset=[0.5, 0])}), "KHR_texture_transform")
rib = imported("both.glb", both.glb())
other = transformed(DOWN, scale=(2, 2), offset=(0.5, 0))
near("the first picture's coordinates are st", numbers(rib, "st"), DOWN)
near("another's are s1 and t1", numbers(rib, "s1") + numbers(rib, "t1"), [u for u, _ in other] + [v for _, v in other])
t.expect('secondset" [ "emissionmap"]' in rib, "as secondset says")

# The picture of a surface that nothing lights has the colours themselves.
rainbow = [(0.5, 0.25, 0.125), (0.25, 0.5, 0.75), (1, 0.5, 0), (0.125, 1, 1)]
unlit = using(scene_of(lambda s: {"pbrMetallicRoughness": {"baseColorFactor": [1, 0.5, 1, 1]}, "extensions": {"KHR_materials_unlit": {}}}, COLOR_0=[(*c, 1) for c in rainbow]), "KHR_materials_unlit")
near("colours of unlit vertices glow", numbers(imported("unlit.glb", unlit.glb()), "emission"), [(r, g / 2, b) for r, g, b in rainbow])
t.expect_run("and are seen", ["out.rib", "-o", "unlit.exr", "--format", "64x64"], 0)
seen = [p[:3] for p in pixels(t.folder / "unlit.exr").values() if p[2] > 0.2]
t.expect(len(seen) > 100 and min(p[1] for p in seen) < 0.25 and min(p[0] for p in seen) < 0.25 and max(p[0] for p in seen) > 0.5, "as they are between the vertices")


def glossy(name, picture=None, blend="OPAQUE", **extension):
    """Returns the RIB of a material of specular colour and glossiness."""
    def look(scene):
        extension.update({"diffuseTexture": {"index": scene.image(picture)}} if picture else {})
        return {"alphaMode": blend, "extensions": {"KHR_materials_pbrSpecularGlossiness": extension}}
    return imported(name, using(scene_of(look), "KHR_materials_pbrSpecularGlossiness").glb())


def color(rib, material="1 "):
    return [float(x) for x in re.search(rf'ArchiveBegin "material {material}"\nColor \[([^\]]*)\]', rib)[1].split()]


rib = glossy("chalk.glb", diffuseFactor=[0.5, 0.25, 0.125, 1], specularFactor=[0, 0, 0], glossinessFactor=0)
near("a diffuse colour without highlights", color(rib) + numbers(rib, "specular") + numbers(rib, "roughness") + numbers(rib, "metallic"), [0.5, 0.25, 0.125, 0, 1])
rib = glossy("paint.glb", diffuseFactor=[0.5, 0.25, 0.125, 1], specularFactor=[0.04] * 3, glossinessFactor=0.75)
near("a varnished one", color(rib) + numbers(rib, "specular") + numbers(rib, "roughness") + numbers(rib, "metallic"), [0.48, 0.24, 0.12, 0.5, 0.25])
near("glossiness beyond 1", numbers(glossy("wet.glb", diffuseFactor=[0.5, 0.5, 0.5, 1], glossinessFactor=3), "roughness"), [0])
rib = glossy("gold.glb", diffuseFactor=[0, 0, 0, 1], specularFactor=[1, 0.75, 0.25], glossinessFactor=0.5)
near("a metal", color(rib) + numbers(rib, "metallic"), [1, 0.75, 0.25, 1])
rib = glossy("glass.glb", white, "BLEND", diffuseFactor=[1, 1, 1, 0.5], specularFactor=[0, 0, 0])
t.expect("Opacity [ 0.5 0.5 0.5 ]" in rib and "texturename" in rib and "opacitymap" in rib, "the diffuse colour's alpha counts")

# Vertices may be stored as integers. Each kind of file keeps its numbers in another place.
def with_integers(**rows):
    """Returns the square with attributes of (rows, kind, stride, normalized)."""
    scene = scene_of(lambda s: {"pbrMetallicRoughness": {"metallicFactor": 0}})
    attributes = scene.document["meshes"][0]["primitives"][0]["attributes"]
    for name, (values, kind, stride, normalized) in rows.items():
        attributes[name] = scene.integers(values, kind, stride, normalized=normalized)
    return scene


def in_forms(scene):
    """Returns the file in each of its forms, by name."""
    t.write("apart.bin", scene.data)
    return {"one.glb": scene.glb(), "one.gltf": scene.gltf(), "apart.gltf": scene.apart("apart.bin")}


THIRDS = [(0.2, 0.8), (1, 0.4), (0, 0.6), (0.6, 1)]
for kind, most, stride in (("B", 255, 4), ("B", 255, 0), ("H", 65535, 0), ("H", 65535, 12)):
    scene = with_integers(TEXCOORD_0=([tuple(round(c * most) for c in uv) for uv in THIRDS], kind, stride, True))
    for name, model in in_forms(scene).items():
        near(f"{name}: integers up to {most}, {stride} apart", numbers(imported(name, model), "st"), THIRDS)
PLACES = [(-127, -100, 0), (127, -100, 0), (127, 100, 50), (-128, 100, 50)]
few = using(with_integers(POSITION=(PLACES, "b", 4, False), NORMAL=([(0, -127, 127)] * 4, "b", 4, True), TEXCOORD_0=([(0, 3), (5, 3), (5, 0), (0, 0)], "H", 0, False)), "KHR_mesh_quantization")
few.document["extensionsRequired"] = ["KHR_mesh_quantization"]
rib = imported("few.glb", few.glb())
near("quantized places", numbers(rib, "P"), PLACES)
near("and normals", numbers(rib, "N"), [(0, -1, 1)] * 4)
near("and coordinates", numbers(rib, "st"), [(0, 3), (5, 3), (5, 0), (0, 0)])
near("normalized places", numbers(imported("ones.glb", with_integers(POSITION=(PLACES, "b", 4, True)).glb()), "P"), [tuple(max(c / 127, -1) for c in p) for p in PLACES])
bare = scene_of(lambda s: {"alphaMode": "BLEND"}, COLOR_0=rainbow)
rib = imported("bare.glb", bare.glb())
near("colours without alpha", numbers(rib, "Cs"), rainbow)
t.expect('Os"' not in rib, "are opaque")

bright = scene_of(lambda s: {"emissiveFactor": [1, 0.5, 0], "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 3}}})
near("emission has its strength", numbers(imported("bright.glb", using(bright, "KHR_materials_emissive_strength").glb()), "emission"), [3, 1.5, 0])
bright.add("materials", {"emissiveFactor": "x", "extensions": {"KHR_materials_emissive_strength": {}}})
near("beside a malformed one too", numbers(imported("bright.glb", bright.glb()), "emission"), [3, 1.5, 0])
shared = scene_of(lambda s: {}, POSITION=[(x, y, 0.5) for x, y in UV])
attributes = shared.document["meshes"][0]["primitives"][0]["attributes"]
attributes["COLOR_0"] = attributes["POSITION"]
rib = imported("shared.glb", shared.glb())
near("places that are colours too", numbers(rib, "P") + numbers(rib, "Cs"), [(x, y, 0.5) for x, y in UV] * 2)
second = scene_of(lambda s: {"pbrMetallicRoughness": {"baseColorTexture": textured(s, texCoord=1, scale=[2, 2])}}, TEXCOORD_1=[(u / 2, v) for u, v in UV])
near("a transformation names its coordinates", numbers(imported("named.glb", using(second, "KHR_texture_transform").glb()), "st"), transformed([(u / 2, v) for u, v in DOWN], scale=(2, 2)))
odd = using(scene_of(lambda s: {}), "KHR_materials_iridescence", "KHR_materials_unlit", "EXT_odd")
odd.document["extensionsRequired"] = ["EXT_odd"]
imported("odd.glb", odd.glb(), 0, "left out: KHR_materials_iridescence, EXT_odd; the file asks not to be read without EXT_odd [import-extension]")
odd.document.update(extensionsUsed=["\x1b[2J", "A" * 65] + [f"EXT_{k}" for k in range(20)], extensionsRequired=["a b"])
imported("odd.glb", odd.glb(), 0, "left out: EXT_0, EXT_1, EXT_2, EXT_3, EXT_4, EXT_5, EXT_6, EXT_7 and 14 more; the file asks not to be read without 1 with odd names [import-extension]")

# Materials of .obj place their pictures. Colours that they do not give are left out.
t.write("white.png", white)


def of_mtl(lines, colors=()):
    t.write("paint.mtl", "newmtl other\nnewmtl a paint \n" + lines)
    return imported("painted.obj", obj(SQUARE, [(0, 1, 2, 3)], UV, [(0, 0, 1)] * 4, colors, before="mtllib paint.mtl", material="a paint"))


def painted(rib):
    return color(rib, r"\d a paint")


for options, (sx, sy), (x, y) in (("-s 2 3 1", (2, 3), (0, 0)), ("-o .25 -.5", (1, 1), (0.25, -0.5)), ("-clamp on -s 2 -mm 0 1 -o 0 1 0 -t .5", (2, 1), (0, 1))):
    rib = of_mtl(f"Kd .5 .5 .5\nmap_Kd {options} white.png\nKe 0 0 0\n")
    near(f"map_Kd {options}", numbers(rib, "st"), [(sx * u + x, 1 - (sy * v + y)) for u, v in UV])
    near("with its colour", painted(rib), [0.5] * 3)
    t.expect("texturename" in rib, "and its picture")
near("a later line places its picture anew", numbers(of_mtl("map_Kd -s 2 2 2 white.png\nmap_Kd white.png\n"), "st"), DOWN)
near("scales that are no numbers are left out", numbers(of_mtl("map_Kd -s nan 2 1 -o 1e39 0 white.png\n"), "st"), [(u, 1 - 2 * v) for u, v in UV])
near("a picture without a colour is seen as it is", painted(of_mtl("map_Kd white.png\n")), [1] * 3)
near("so are colours of vertices", numbers(of_mtl("Ns 10\n", rainbow), "Cs"), rainbow)
near("which multiply a colour that is given", numbers(of_mtl("Kd .5 .5 .5\n", rainbow), "Cs"), [tuple(c / 2 for c in row) for row in rainbow])
near("and are alone without materials", numbers(imported("bare.obj", obj(SQUARE, [(0, 1, 2, 3)], colors=rainbow)), "Cs"), rainbow)


def off(head, rows):
    """Returns .off with these columns after the places of the square."""
    return f"{head}\n# a comment\n4 1 0\n" + "".join(f"{x} {y} {z} {row}\n" for (x, y, z), row in zip(SQUARE, rows)) + "4 0 1 2 3\n"


BYTES = [(255, 0, 51), (0, 255, 0), (102, 204, 0), (0, 0, 0)]
shares = [tuple(c / 255 for c in row) for row in BYTES]
for what, head, rows in (("bytes", "COFF", [f"{r} {g} {b} 255" for r, g, b in BYTES]), ("bytes without alpha", "COFF", [f"{r} {g} {b}  # colour" for r, g, b in BYTES]),
                         ("shares", "COFF", [f"{r} {g} {b} 1" for r, g, b in shares]), ("bytes behind normals", "CNOFF", [f"0 0 1 {r} {g} {b} 255" for r, g, b in BYTES])):
    near(f".off with {what}", numbers(imported("colours.off", off(head, rows)), "Cs"), shares)
t.expect("Cs" not in imported("plain.off", off("OFF", [""] * 4)), ".off without colours")

# Invisible materials are reported.
t.write("paint.mtl", "newmtl a paint\nKd 1 1 1\nd 0\n")
imported("clear.obj", obj(SQUARE, [(0, 1, 2, 3)], before="mtllib paint.mtl", material="a paint"), 0, 'material "a paint" has the opacity 0', "import-invisible")

# Faces of .ply may have colours.
LIST = "property list uchar int vertex_indices\n"
SHADES = "property uchar red\nproperty uchar green\nproperty uchar blue\n"
of_faces = ply(SQUARE, FACES).replace(LIST, LIST + SHADES).replace("3 0 1 2", "3 0 1 2 255 0 51").replace("3 0 2 3", "3 0 2 3 0 102 0")
near("colours of faces in text", numbers(imported("faces.ply", of_faces), "Cs"), [(1, 0, 0.2), (0, 0.4, 0)])
quality = of_faces.replace("float z\n", "float z\nproperty float quality\n").replace("-1 -1 0\n", "-1 -1 0 nan\n").replace("1 -1 0\n", "1 -1 0 -inf\n").replace("1 1 0\n", "1 1 0 1e99\n")
near("behind what is no number", numbers(imported("faces.ply", quality), "Cs"), [(1, 0, 0.2), (0, 0.4, 0)])
wild = of_faces.replace("uchar red", "double red").replace("uchar green", "float green").replace("255 0 51", "1e300 -5 51").replace("0 102 0", "nan 0.5 0")
near("beyond 0 and 1", numbers(imported("faces.ply", wild), "Cs"), [(1, 0, 0.2), (0, 0.5, 0)])
for order, sign in (("little", "<"), ("big", ">")):
    head = ply(SQUARE, FACES).split("end_header\n")[0].replace("ascii", f"binary_{order}_endian").replace(LIST, SHADES + LIST) + "end_header\n"
    body = b"".join(struct.pack(sign + "3f", *p) for p in SQUARE) + b"".join(struct.pack(sign + "3BB3i", *c, 3, *f) for c, f in zip(((255, 0, 51), (0, 102, 0)), FACES))
    near(f"and in binary, {order} end first", numbers(imported("faces.ply", head.encode() + body), "Cs"), [(1, 0, 0.2), (0, 0.4, 0)])

t.finish()
