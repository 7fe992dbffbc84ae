"""Writes seeds for the fuzzer of models: small models of each format, behind the byte that names the format (tests/fuzz/model_fuzz.cpp)."""
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "cli"))
from models import Gltf, collada, cube, fbx, obj, ply, png, stl, triangles  # noqa: E402

ENDINGS = ("obj", "ply", "stl", "gltf", "glb", "fbx", "dae")

positions, normals, uvs, colors, quads = cube()
scene = Gltf()
paint = scene.image(png(2, lambda x, y: (255 * x, 255 * y, 0, 128)))
look = {"alphaMode": "MASK", "normalTexture": {"index": paint, "texCoord": 1}, "pbrMetallicRoughness": {"baseColorTexture": {"index": paint}, "metallicRoughnessTexture": {"index": paint}}}
scene.node(mesh=scene.mesh(positions, triangles(quads), material=scene.add("materials", look), NORMAL=normals, TEXCOORD_0=uvs, TEXCOORD_1=uvs, COLOR_0=[(*c, 1) for c in colors]))
scene.add("cameras", {"type": "perspective", "perspective": {"yfov": 0.7, "znear": 0.1, "aspectRatio": 1.5}})
scene.node(camera=0, translation=[0, 0, 4])
for kind in ("point", "directional", "spot"):
    scene.node(extensions=scene.light(type=kind, intensity=10.0, **({"spot": {"outerConeAngle": 0.4}} if kind == "spot" else {})), translation=[1, 2, 3])
SEEDS = {
    "obj": [obj(positions, quads, uvs, normals, colors), obj(positions, quads)],
    "ply": [ply(positions, quads, colors), ply(positions, triangles(quads), colors, binary=True)],
    "stl": [stl(positions, triangles(quads))],
    "gltf": [scene.gltf()],
    "glb": [scene.glb()],
    "fbx": [fbx(positions, quads, normals)],
    "dae": [collada(positions, quads)],
}
folder = pathlib.Path(sys.argv[1])
folder.mkdir(exist_ok=True)
for kind, models in SEEDS.items():
    for number, model in enumerate(models):
        data = model if isinstance(model, bytes) else model.encode()
        (folder / f"{kind}{number}").write_bytes(bytes([ENDINGS.index(kind)]) + data)
