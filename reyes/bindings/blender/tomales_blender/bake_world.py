"""Renders a world's panorama: blender -b --factory-startup -P bake_world.py -- LIBRARY WORLD FRAME WIDTH FOLDER

FOLDER/whole.exr gets all that the world's nodes show, in the layout of an Environment Texture. Where the nodes show the
disk of a sun, FOLDER/sunless.exr gets the same without it. Cycles makes the pictures, so every kind of node works.
"""
import math
import os
import sys

import bpy


def suns(world):
    """Returns the Sky Textures that show the disk of a sun."""
    return [node for node in world.node_tree.nodes if node.type == "TEX_SKY" and node.sky_type not in ("PREETHAM", "HOSEK_WILKIE") and node.sun_disc]


def panorama(scene, width):
    for obj in list(bpy.data.objects):
        bpy.data.objects.remove(obj)
    data = bpy.data.cameras.new("panorama")
    data.type = "PANO"
    (data if hasattr(data, "panorama_type") else data.cycles).panorama_type = "EQUIRECTANGULAR"
    scene.camera = bpy.data.objects.new("panorama", data)
    scene.collection.objects.link(scene.camera)
    scene.camera.rotation_euler = (math.pi / 2, 0, -math.pi / 2)
    scene.render.engine, scene.cycles.device, scene.cycles.samples = "CYCLES", "CPU", 16
    scene.cycles.use_denoising = scene.cycles.use_adaptive_sampling = False
    scene.render.resolution_x, scene.render.resolution_y, scene.render.resolution_percentage = width, width // 2, 100
    settings = scene.render.image_settings
    settings.file_format, settings.color_depth, settings.exr_codec = "OPEN_EXR", "32", "NONE"


def main(library, world, frame, width, folder):
    with bpy.data.libraries.load(library) as (_, here):
        here.worlds = [world]
    scene = bpy.context.scene
    scene.world = here.worlds[0]
    panorama(scene, int(width))
    scene.frame_set(int(frame))
    shown = suns(scene.world)
    for name in ("whole", "sunless") if shown else ("whole",):
        for node in shown:
            node.sun_disc = name == "whole"
        scene.render.filepath = os.path.join(folder, f"{name}.exr")
        bpy.ops.render.render(write_still=True)


main(*sys.argv[sys.argv.index("--") + 1 :])
