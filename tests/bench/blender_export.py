"""Exports frames of 500 moving objects: blender -b --factory-startup -P tests/bench/blender_export.py -- FOLDER

It prints the frames per second over 24 frames in which only transformations change. As in the tests, TOMALES_SOURCE names the
source tree.
"""
import os
import sys
import time

arguments = sys.argv[sys.argv.index("--") + 1 :]
sys.argv = [*sys.argv[: sys.argv.index("--")], "--", arguments[0], "nothing"]  # With this name scenes.py renders nothing, and only provides its functions.
sys.path.insert(0, os.path.join(os.environ["TOMALES_SOURCE"], "tests/blender"))
import bpy  # noqa: E402
from scenes import camera, empty_scene, light, material  # noqa: E402

scene = empty_scene()
camera(scene, (0, -60, 40))
light(scene, "SUN", (0, 0, 5), angle=0)
bpy.ops.mesh.primitive_monkey_add()
shape = bpy.context.object.data
for i in range(500):
    mesh = shape.copy()  # Each object has a mesh of its own.
    mesh.materials.append(material(f"m{i % 20}", (i / 500, 0.5, 0.5), "ShaderNodeBsdfPrincipled")[0] if i < 20 else bpy.data.materials[f"m{i % 20}"])
    obj = bpy.data.objects.new(f"o{i}", mesh)
    scene.collection.objects.link(obj)
    obj.location = (3 * (i % 25), 3 * (i // 25), 0)
    obj.keyframe_insert("location", frame=1)
    obj.location.z += 2
    obj.keyframe_insert("location", frame=24)
scene.frame_start, scene.frame_end = 1, 24
scene.render.engine = "TOMALES"
scene.tomales.folder, scene.tomales.export_only = arguments[0], True
scene.tomales.export_frames = True
scene.render.filepath = os.path.join(arguments[0], "x")
begin, cpu = time.time(), time.process_time()
bpy.ops.render.render()
print(f"24 frames: {24 / (time.time() - begin):.1f} a second, {24 / (time.process_time() - cpu):.1f} a CPU second")
