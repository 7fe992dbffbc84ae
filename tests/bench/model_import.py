"""Measures the CPU seconds that `tomales import` and the frame after it take for a glTF file of a million triangles with normals
and texture coordinates: model_import.py TOMALES. The least of three imports counts."""
import array
import math
import os
import pathlib
import resource
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "cli"))
from models import Gltf  # noqa: E402

SIDE = 708  # This is the number of vertices along each side of a sphere with bumps.


def model():
    points, normals, places, corners = array.array("f"), array.array("f"), array.array("f"), array.array("I")
    for j in range(SIDE):
        v = j / (SIDE - 1) * math.pi
        for i in range(SIDE):
            u = i / (SIDE - 1) * 2 * math.pi
            n = (math.cos(u) * math.sin(v), math.cos(v), math.sin(u) * math.sin(v))
            r = 1 + 0.05 * math.sin(20 * u) * math.sin(20 * v)
            points.extend(r * c for c in n), normals.extend(n), places.extend((u / (2 * math.pi), v / math.pi))
    for j in range(SIDE - 1):
        for i in range(SIDE - 1):
            q = j * SIDE + i
            corners.extend((q, q + 1, q + SIDE + 1, q, q + SIDE + 1, q + SIDE))
    scene = Gltf()
    accessor = lambda data, kind, component, count, **more: scene.add(  # noqa: E731
        "accessors", {"bufferView": scene.view(data.tobytes()), "type": kind, "componentType": component, "count": count, **more})
    attributes = {"POSITION": accessor(points, "VEC3", 5126, SIDE * SIDE, min=[-2] * 3, max=[2] * 3),
                  "NORMAL": accessor(normals, "VEC3", 5126, SIDE * SIDE), "TEXCOORD_0": accessor(places, "VEC2", 5126, SIDE * SIDE)}
    scene.add("meshes", {"primitives": [{"attributes": attributes, "indices": accessor(corners, "SCALAR", 5125, len(corners))}]})
    scene.node(mesh=0)
    return scene.glb(), len(corners) // 3


def cpu_s(*command):
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run(command, check=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


with tempfile.TemporaryDirectory() as folder:
    data, triangles = model()
    pathlib.Path(folder, "model.glb").write_bytes(data)
    tomales, scene = os.path.abspath(sys.argv[1]), os.path.join(folder, "model.rib")
    least = min(cpu_s(tomales, "import", os.path.join(folder, "model.glb"), "-o", scene) for _ in range(3))
    frame = cpu_s(tomales, scene, "-o", os.path.join(folder, "model.png"), "--format", "640x480")
print(f"{triangles} triangles, {len(data) / 1e6:.0f} MB: imported in {least:.1f} CPU s, rendered in {frame:.1f}")
