"""Tests models that no modeller should write, in every format that allows them: each must give a picture or a message."""
import json
import math
import pathlib
import resource
import sys

from models import Gltf, collada, fbx, obj, ply, png, stl
from program import Suite

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "image"))
import exr  # noqa: E402

t = Suite()
square = [(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)]
nan, inf = float("nan"), float("inf")


def judge(what, name, model, expected, *options):
    """Imports and renders a model. `expected` is "picture" (something is visible), "message" (exit code 2), or "either", which
    may be an empty picture too. None of these models crashes Assimp 5.2, so that a crash is one of ours."""
    t.write(name, model)
    made = t.run("import", name, "-o", "odd.rib", *options, cpu_s=3)  # Assimp does not end on some files.
    codes = {"picture": (0,), "message": (2,), "either": (0, 2, 3)}[expected]
    good = made.returncode in codes and (made.stderr != "" or made.returncode == 0) and "ends while" not in made.stderr and "ends without" not in made.stderr
    told = f"{what}, {name} {' '.join(options)}: {made.returncode} {made.stderr[:300]}"
    if good and made.returncode != 2:
        drawn = t.run("odd.rib", "-o", "odd.exr", "--format", "32x24")
        seen = max(map(max, exr.read(t.folder / "odd.exr")[1].values())) if drawn.returncode in (0, 3) else 0
        good = drawn.returncode in (0, 3) and (seen > 0 or expected != "picture" or drawn.stderr != "")
        told += f" then {drawn.returncode}, brightest {seen} {drawn.stderr[:300]}"
    t.expect(good, told)
    (t.folder / "odd.rib").unlink(missing_ok=True)


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
escaping = 'name with "quotes" ../../../escaped\n'

def without(scene, *path):
    """Takes an entry out of a document."""
    at = scene.document
    for step in path[:-1]:
        at = at[step]
    del at[path[-1]]


def painted(data, mime="image/png", **entries):
    """Paints a square with a picture that is kept within the file. `entries` of it are changed."""
    def change(scene):
        index = scene.image(data)
        scene.document["images"][0].update(mimeType=mime, **entries)
        scene.add("materials", {"pbrMetallicRoughness": {"baseColorTexture": {"index": index}}})
        scene.document["meshes"][0]["primitives"][0]["material"] = 0
    return change


def set_in(kind, **entries):
    return lambda scene: scene.document[kind][0].update(entries)


pixel = png(1, lambda *_: (255, 255, 255))
GLTF = {
    "cyclic nodes": (odd(cycle), "message"),
    "a chain of nodes": (odd(deep), "either"),
    "corners that are not there": (odd(far_index), "either"),
    "a scale of 0": (odd(nothing, scale=[0, 1, 1]), "message"),
    "negative scales": (odd(nothing, scale=[-2, -1, -1]), "picture"),
    "a left-handed matrix": (odd(nothing, matrix=[1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1]), "picture"),
    "a matrix that is no number": (odd(nothing, matrix=[1e39] * 16), "either"),
    "a matrix of a perspective": (odd(nothing, matrix=[1, 0, 0, 0.1, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]), "either"),
    "far from the origin": (odd(nothing, translation=[1e7, 0, 0]), "picture"),
    "points": (odd(nothing, mode=0, faces=((0, 1), (2, 3))), "picture"),
    "lines": (odd(nothing, mode=1, faces=((0, 1), (2, 3))), "picture"),
    "a strip": (odd(nothing, mode=5, faces=((0, 1, 3, 2),)), "picture"),
    "a fan": (odd(nothing, mode=6, faces=((0, 1, 2, 3),)), "picture"),
    "a mode that there is not": (odd(nothing, mode=77), "either"),
    "names that are paths": (odd(nothing, name='"../../escaped\n'), "picture"),
    "no meshes": (odd(lambda scene: without(scene, "nodes", 0, "mesh")), "message"),
    "a mesh that is not there": (odd(set_in("nodes", mesh=7)), "either"),
    "a mesh without primitives": (odd(set_in("meshes", primitives=[])), "either"),
    "a buffer that is too short": (odd(set_in("bufferViews", byteLength=1 << 30)), "either"),
    "a count beyond all memory": (odd(set_in("accessors", count=1 << 40)), "either"),
    "integers beyond the buffer": (odd(set_in("accessors", componentType=5122, count=1 << 40)), "either"),
    "integers too far apart": (odd(lambda scene: (set_in("accessors", componentType=5121)(scene), set_in("bufferViews", byteStride=1 << 62)(scene))), "either"),
    "numbers for names": (odd(lambda scene: scene.document.update(extensionsUsed=[1, {}], materials=7)), "either"),
    "a negative count": (odd(set_in("accessors", count=-4)), "either"),
    "no scene": (odd(lambda scene: without(scene, "scenes")), "either"),
    "no version": (odd(lambda scene: without(scene, "asset")), "either"),
    "a material that is not there": (odd(lambda scene: scene.document["meshes"][0]["primitives"][0].update(material=9)), "either"),
    "a picture of one texel": (odd(painted(pixel)), "picture"),
    "a picture that is cut off": (odd(painted(pixel[:40])), "either"),
    "a picture of another kind": (odd(painted(pixel, mime="image/jpeg")), "either"),
    "a picture that is no picture": (odd(painted(b"nothing of the kind")), "either"),
    "a picture of a path": (odd(painted(pixel, uri="../../../etc/passwd")), "either"),
    "an address for a picture": (odd(painted(pixel, uri="https://example.org/a.png")), "either"),
    "half a file": (odd(nothing)[:600], "message"),
    "a light without end": (odd(lambda scene: scene.node(extensions=scene.light(type="point", intensity=1e38))), "picture"),
    "a camera without an angle": (odd(lambda scene: scene.node(camera=scene.add("cameras", {"type": "perspective", "perspective": {"yfov": 0, "znear": 0}}))), "either"),
}
for what, (model, expected) in GLTF.items():
    for options in ([], ["--subdivide"]):
        judge(what, "odd.glb", model, expected, *options)

# The same shapes come in each format: points, faces, and what is expected of them.
SHAPES = {
    "nothing": ([], [], "message"),
    "points without faces": (square, [], "either"),
    "a corner that is no number": (square[:3] + [(nan, 0, 0)], [(0, 1, 2), (0, 2, 3)], "either"),
    "no corner that is a number": ([(nan, inf, -inf)] * 4, [(0, 1, 2), (0, 2, 3)], "either"),
    "huge coordinates": ([(x * 1e30, y * 1e30, z) for x, y, z in square], [(0, 1, 2), (0, 2, 3)], "picture"),
    "tiny coordinates": ([(x * 1e-30, y * 1e-30, z) for x, y, z in square], [(0, 1, 2), (0, 2, 3)], "picture"),
    "one place for all corners": ([(1, 2, 3)] * 4, [(0, 1, 2), (0, 2, 3)], "either"),
    "a face that names its corner twice": (square, [(0, 1, 1), (0, 2, 3)], "picture"),
    "many faces at an edge, both ways round": (square, [(0, 1, 2), (0, 1, 3), (0, 1, 2), (1, 0, 3)], "picture"),
    "a corner beyond the points": (square, [(0, 1, 2), (0, 2, 30)], "either"),
    "two corners for a face": (square, [(0, 1), (0, 2, 3)], "either"),
    "a star of many corners": ([((1 + k % 2) * math.cos(k), (1 + k % 2) * math.sin(k), 0) for k in range(97)], [tuple(range(97))], "either"),
}
ones = lambda points: [(0, 0, 1)] * len(points)
FORMATS = {
    "odd.obj": lambda points, faces: obj(points, faces),
    "odd.ply": lambda points, faces: ply(points, faces),
    "binary.ply": lambda points, faces: ply(points, faces, binary=True),
    "odd.stl": lambda points, faces: stl([*points, (5, 5, 5)], [tuple(min(i, len(points)) for i in (*f, f[0])[:3]) for f in faces]),
    "odd.gltf": lambda points, faces: shaped(points, faces).gltf(),
    "odd.fbx": lambda points, faces: fbx(points, faces, {i: (0, 0, 1) for i in range(100)}),
    "odd.dae": lambda points, faces: collada(points, faces),
}


def shaped(points, faces):
    scene = Gltf()
    scene.node(mesh=scene.mesh(points or [(0, 0, 0)], [(f[0], b, c) for f in faces for b, c in zip(f[1:], f[2:])]))
    return scene


for what, (points, faces, expected) in SHAPES.items():
    for name, model in FORMATS.items():
        judge(what, name, model(points, faces), "either" if not points else expected)
coloured = ply(square, [(0, 1, 2), (0, 2, 3)]).replace("vertex_indices\n", "vertex_indices\nproperty uchar red\n")
judge("elements of nothing", "odd.ply", coloured.replace("element face", f"element nothing {1 << 62}\nelement face"), "either")
judge("faces beyond the file", "odd.ply", coloured.replace("element face 2", f"element face {1 << 62}"), "either")
for name, model in FORMATS.items():
    whole = model(square, [(0, 1, 2), (0, 2, 3)])
    for share in (0.3, 0.6, 0.9):
        judge(f"{share} of a file", name, whole[:int(share * len(whole))], "either")

integers = shaped(square, [(0, 1, 2), (0, 2, 3)])
set_in("accessors", componentType=5121)(integers)
judge("lists within lists", "odd.gltf", integers.gltf().replace('"asset"', f'"extras": {"[" * 100000 + "]" * 100000}, "asset"', 1), "either")

# Small files may ask for a lot of memory. 200 buffers are the same large file, and each of them needs little of it.
BYTES = {"componentType": 5121, "type": "VEC3"}


def of_bytes(name, buffers, views, accessors):
    """Imports a file whose first mesh is a triangle for each accessor. Returns the messages."""
    meshes = [{"primitives": [{"attributes": {"POSITION": k}} for k in range(len(accessors))]}]
    t.write(name, json.dumps({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}], "meshes": meshes,
                              "buffers": buffers, "bufferViews": views, "accessors": [{**BYTES, **a} for a in accessors]}))
    made = t.run("import", name, "-o", "odd.rib", cpu_s=10)
    t.expect(made.returncode == 0, f"{name} comes in: {made.returncode} {made.stderr[:300]}")
    return made.stderr


t.write("large.bin", bytes(range(250)) * 40000)
of_bytes("many.gltf", [{"uri": "large.bin", "byteLength": 1000}] * 200, [{"buffer": k, "byteLength": 1000} for k in range(200)], [{"bufferView": k, "count": 3} for k in range(200)])
large = [{"uri": "large.bin", "byteLength": 1000000}], [{"buffer": 0, "byteLength": 1000000, "byteStride": 4}]
said = of_bytes("same.gltf", *large, [{"bufferView": 0, "count": 240000}] * 30)
t.expect(said == "", f"accessors of the same bytes are one: {said}")
said = of_bytes("shifted.gltf", *large, [{"bufferView": 0, "byteOffset": 4 * k, "count": 240000} for k in range(30)])
t.expect("as floats they would be far larger" in said and "[import-coordinates]" in said, f"floats are bounded: {said}")
peak_mb = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 1024
t.expect(peak_mb < 1500, f"no model takes more than {peak_mb:.0f} MB")
t.finish()
