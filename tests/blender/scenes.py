"""Renders scenes of Blender with Tomales and with Cycles: blender -b --factory-startup -P scenes.py -- FOLDER [NAME...]

For each scene FOLDER/NAME.json has the mean colours of a grid of blocks of both pictures, and FOLDER has the pictures.
"""
import json
import math
import os
import sys

import bpy
import numpy
from mathutils import Vector

root = os.environ["TOMALES_SOURCE"]
sys.path[:0] = [os.path.join(root, "reyes/bindings/blender"), os.path.join(root, "reyes/bindings/python")]
sys.dont_write_bytecode = True
import tomales_blender  # noqa: E402

tomales_blender.register()
from tomales_blender import exr  # noqa: E402

WIDTH, HEIGHT, BLOCKS = 96, 72, (6, 8)


def empty_scene():
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    scene.render.resolution_x, scene.render.resolution_y, scene.render.resolution_percentage = WIDTH, HEIGHT, 100
    scene.render.image_settings.file_format = "OPEN_EXR"
    scene.render.image_settings.exr_codec = "NONE"
    scene.render.image_settings.color_depth = "32"
    scene.cycles.device, scene.cycles.samples, scene.cycles.use_denoising = "CPU", 256, False
    scene.cycles.use_adaptive_sampling = False
    scene.cycles.max_bounces = 2
    scene.tomales.bounces = 1
    scene.tomales.light_samples = 64
    world = bpy.data.worlds.new("World")
    world.color = (0, 0, 0)
    scene.world = world
    return scene


def camera(scene, location, target=(0, 0, 0), **settings):
    data = bpy.data.cameras.new("Camera")
    for name, value in settings.items():
        setattr(data, name, value)
    obj = bpy.data.objects.new("Camera", data)
    scene.collection.objects.link(obj)
    obj.location = location
    direction = obj.location - Vector(target)
    obj.rotation_euler = direction.to_track_quat("Z", "Y").to_euler()
    scene.camera = obj
    return obj


def light(scene, kind, location, rotation=(0, 0, 0), **settings):
    data = bpy.data.lights.new(kind, kind)
    for name, value in settings.items():
        setattr(data, name, value)
    obj = bpy.data.objects.new(kind, data)
    obj.location, obj.rotation_euler = location, rotation
    obj.visible_camera = False
    scene.collection.objects.link(obj)
    return obj


def material(name, color, kind="ShaderNodeBsdfDiffuse", **inputs):
    made = bpy.data.materials.new(name)
    made.use_nodes = True
    nodes = made.node_tree.nodes
    nodes.clear()
    shader, output = nodes.new(kind), nodes.new("ShaderNodeOutputMaterial")
    made.node_tree.links.new(shader.outputs[0], output.inputs["Surface"])
    shader.inputs["Base Color" if "Base Color" in shader.inputs else "Color"].default_value = (*color, 1)
    for key, value in inputs.items():
        shader.inputs[key.replace("_", " ")].default_value = value
    return made, shader


def add(make, made=None, **arguments):
    make(**arguments)
    obj = bpy.context.object
    if made:
        obj.data.materials.append(made)
    return obj


def floor(color=(0.6, 0.6, 0.6), size=20):
    return add(bpy.ops.mesh.primitive_plane_add, material("floor", color)[0], size=size)


def area():
    """A square lamp of known power over a floor."""
    scene = empty_scene()
    floor()
    camera(scene, (0, -6, 4))
    light(scene, "AREA", (0.5, 0.5, 2), energy=100, size=1.2)
    return scene


def disk_lamp():
    scene = empty_scene()
    floor()
    camera(scene, (0, -6, 4))
    lamp = light(scene, "AREA", (0.5, 0.5, 2), (0.4, 0.2, 0), energy=100, shape="ELLIPSE", size=1.5, size_y=0.6)
    lamp.scale = (1.5, 1.5, 1.5)
    return scene


def sun():
    scene = empty_scene()
    floor()
    add(bpy.ops.mesh.primitive_cube_add, material("cube", (0.2, 0.5, 0.8))[0], size=1, location=(0.5, 0, 0.5))
    camera(scene, (2, -6, 4))
    light(scene, "SUN", (0, 0, 5), (0.5, 0.3, 0), energy=2, angle=0)
    return scene


def point():
    scene = empty_scene()
    floor()
    camera(scene, (0, -6, 4))
    light(scene, "POINT", (0.5, 0.5, 2), energy=150, shadow_soft_size=0.2, color=(1, 0.6, 0.3))
    return scene


def spot():
    scene = empty_scene()
    floor()
    camera(scene, (0, -6, 4))
    light(scene, "SPOT", (0.5, 0.5, 3), (0.2, 0, 0), energy=300, shadow_soft_size=0, spot_size=1.0, spot_blend=0.4)
    return scene


def soft_spot():
    """A spot lamp has a radius, and a ball between its light and its dark part has a soft shadow."""
    scene = empty_scene()
    floor()
    made, _ = material("ball", (0.8, 0.8, 0.8))
    add(bpy.ops.mesh.primitive_uv_sphere_add, made, radius=0.5, location=(0.2, 0, 1), segments=64, ring_count=32)
    camera(scene, (0, -6, 4))
    light(scene, "SPOT", (0.5, 0.5, 3), (0.2, 0, 0), energy=300, shadow_soft_size=0.3, spot_size=1.0, spot_blend=0.4)
    return scene


def camera_shift():
    """Objects that glow by themselves show where the camera stands, and how it is turned, shifted and cropped."""
    scene = empty_scene()
    for i, (place, color) in enumerate([((-1.5, 0, 0), (1, 0, 0)), ((1, 1, 0.5), (0, 1, 0)), ((0.3, -1, 1.2), (0, 0, 1)), ((0, 3, 0), (1, 1, 0))]):
        glow, _ = material(f"glow{i}", color, "ShaderNodeEmission")
        add(bpy.ops.mesh.primitive_uv_sphere_add, glow, radius=0.6 + 0.1 * i, location=place, segments=64, ring_count=32)
    camera(scene, (2, -7, 3), (0, 0, 0.5), lens=40, shift_x=0.1, shift_y=-0.07).rotation_euler.rotate_axis("Z", 0.3)
    scene.tomales.bounces = 0
    return scene


def orthographic():
    scene = camera_shift()
    scene.camera.data.type, scene.camera.data.ortho_scale = "ORTHO", 7
    scene.render.resolution_x, scene.render.resolution_y = HEIGHT, WIDTH
    return scene


def focus():
    scene = camera_shift()
    scene.camera.data.dof.use_dof = True
    scene.camera.data.dof.focus_distance, scene.camera.data.dof.aperture_fstop = 6, 0.05
    scene.tomales.pixel_samples = 8
    return scene


def motion():
    scene = camera_shift()
    obj = scene.objects["Sphere"]
    for frame, x in ((0, -3), (2, 0)):
        obj.location.x = x
        obj.keyframe_insert("location", index=0, frame=frame)
    for curve in obj.animation_data.action.fcurves:
        for key in curve.keyframe_points:
            key.interpolation = "LINEAR"
    scene.render.use_motion_blur, scene.render.motion_blur_shutter = True, 0.8
    scene.tomales.pixel_samples = 8
    scene.frame_set(1)
    return scene


def picture(name, width, height, color_of, is_float=False):
    image = bpy.data.images.new(name, width, height, float_buffer=is_float)
    v, u = numpy.mgrid[0:height, 0:width]
    pixels = numpy.ones((height, width, 4), "f4")
    pixels[..., :3] = color_of((u + 0.5) / width, (v + 0.5) / height)
    image.pixels.foreach_set(pixels.ravel())
    image.pack()
    return image


def texture():
    """A picture in sRGB, which is not symmetric, lies on a plane."""
    scene = empty_scene()
    made, shader = material("picture", (1, 1, 1), "ShaderNodeBsdfPrincipled", Roughness=1.0, Specular=0.0)
    node = made.node_tree.nodes.new("ShaderNodeTexImage")
    node.image = picture("uv", 64, 64, lambda u, v: numpy.stack([u, v, 0.5 * (u > 0.5)], -1))
    node.interpolation = "Linear"
    made.node_tree.links.new(node.outputs["Color"], shader.inputs["Base Color"])
    add(bpy.ops.mesh.primitive_plane_add, made, size=4)
    camera(scene, (0.5, -1, 6))
    light(scene, "SUN", (0, 0, 5), energy=3, angle=0)
    scene.tomales.bounces = 0
    scene.cycles.max_bounces = 0
    return scene


def pictures_of_all():
    """Pictures that are not symmetric give roughness, metal, alpha and glow, in front of a floor."""
    scene = empty_scene()
    made, shader = material("pictures", (0.8, 0.6, 0.3), "ShaderNodeBsdfPrincipled", **{"Emission Strength": 0.5})
    for socket, of in (("Roughness", lambda u, v: 0.3 + 0.5 * u), ("Metallic", lambda u, v: 1.0 * (v > 0.6)), ("Alpha", lambda u, v: 1.0 * (u + v < 1.4)), ("Emission", lambda u, v: 1.0 * (u < 0.3))):
        node = made.node_tree.nodes.new("ShaderNodeTexImage")
        node.image = picture(socket, 64, 64, lambda u, v, of=of: numpy.stack([of(u, v)] * 3, -1), True)
        made.node_tree.links.new(node.outputs["Color"], shader.inputs[socket])
    add(bpy.ops.mesh.primitive_plane_add, made, size=4, location=(0, 0, 0.5))
    floor()
    camera(scene, (0.5, -1, 6))
    light(scene, "AREA", (-1, -1, 3), energy=200, size=2)
    scene.tomales.bounces = 0
    scene.cycles.max_bounces = 0
    scene.cycles.transparent_max_bounces = 8
    return scene


def panorama():
    """Every direction of the sky has its own colour. The camera sees the sky, and it lights a white ball."""
    scene = empty_scene()
    world = scene.world
    world.use_nodes = True
    node = world.node_tree.nodes.new("ShaderNodeTexEnvironment")
    node.image = picture("sky", 256, 128, lambda u, v: numpy.stack([u, v, 2.0 * (abs(u - 0.3) < 0.1)], -1), True)
    world.node_tree.links.new(node.outputs["Color"], world.node_tree.nodes["Background"].inputs["Color"])
    add(bpy.ops.mesh.primitive_uv_sphere_add, material("white", (0.8, 0.8, 0.8))[0], radius=1, segments=64, ring_count=32)
    bpy.ops.object.shade_smooth()
    camera(scene, (2, -4, 1), lens=24)
    scene.tomales.light_samples = 256
    scene.tomales.bounces = 0
    scene.cycles.max_bounces = 1
    return scene


def instances():
    """Three empties show a collection, one of them mirrored, and faces show a cone each."""
    scene = empty_scene()
    collection = bpy.data.collections.new("shown")
    glow, _ = material("glow", (1, 0.3, 0.1))
    cone = add(bpy.ops.mesh.primitive_cone_add, glow, radius1=0.4, depth=1, rotation=(0, 0.6, 0))
    for owner in list(cone.users_collection):
        owner.objects.unlink(cone)
    collection.objects.link(cone)
    for i, scale in enumerate((1, -1, 0.5)):
        shows = bpy.data.objects.new(f"empty{i}", None)
        shows.instance_type, shows.instance_collection = "COLLECTION", collection
        shows.location, shows.scale = (i * 1.5 - 1.5, 0, 0.5), (scale, abs(scale), abs(scale))
        scene.collection.objects.link(shows)
    floor()
    camera(scene, (0, -6, 3))
    light(scene, "SUN", (0, 0, 5), (0.5, 0.3, 0), energy=3, angle=0)
    return scene


def room():
    """Light bounces in a room, and a mesh glows."""
    scene = empty_scene()
    floor((0.7, 0.7, 0.7), 4)
    add(bpy.ops.mesh.primitive_plane_add, material("wall", (0.8, 0.2, 0.1))[0], size=4, location=(-2, 0, 2), rotation=(0, math.pi / 2, 0))
    lamp, _ = material("lamp", (1, 1, 1), "ShaderNodeEmission", Strength=20.0)
    add(bpy.ops.mesh.primitive_plane_add, lamp, size=1, location=(0, 0, 3.5), rotation=(math.pi, 0, 0))
    camera(scene, (3, -6, 2.5), (0, 0, 1.2))
    return scene


def subdivision():
    scene = empty_scene()
    cube = add(bpy.ops.mesh.primitive_cube_add, material("smooth", (0.5, 0.6, 0.7))[0], size=2)
    modifier = cube.modifiers.new("s", "SUBSURF")
    modifier.render_levels = 5
    bpy.ops.object.shade_smooth()
    camera(scene, (3, -5, 3))
    light(scene, "SUN", (0, 0, 5), (0.5, 0.3, 0), energy=3, angle=0)
    scene.tomales.bounces = 0
    scene.cycles.max_bounces = 0
    return scene


def sky():
    """A Sky Texture has its sun low at one side, and a box stands in it."""
    scene = empty_scene()
    scene.world.use_nodes = True
    tree = scene.world.node_tree
    node = tree.nodes.new("ShaderNodeTexSky")
    node.sky_type, node.sun_elevation, node.sun_rotation, node.sun_intensity = "NISHITA", 0.5, 2.3, 0.5
    background = tree.nodes["Background"]
    background.inputs["Strength"].default_value = 0.1
    tree.links.new(node.outputs["Color"], background.inputs["Color"])
    floor()
    add(bpy.ops.mesh.primitive_cube_add, material("cube", (0.2, 0.5, 0.8))[0], size=1, location=(0.5, 0, 0.5))
    camera(scene, (2, -6, 1), (0, 0, 1), lens=24)
    scene.tomales.bounces, scene.tomales.light_samples = 0, 256
    scene.cycles.max_bounces = 0
    return scene


def woven_sky():
    """Waves over directions are the sky, and a second Background is added to it."""
    scene = empty_scene()
    scene.world.use_nodes = True
    tree = scene.world.node_tree
    waves, both = tree.nodes.new("ShaderNodeTexWave"), tree.nodes.new("ShaderNodeAddShader")
    waves.inputs["Scale"].default_value = 0.5
    more = tree.nodes.new("ShaderNodeBackground")
    more.inputs["Color"].default_value = (0.1, 0.2, 0.5, 1)
    tree.links.new(waves.outputs["Color"], tree.nodes["Background"].inputs["Color"])
    tree.links.new(tree.nodes["Background"].outputs[0], both.inputs[0])
    tree.links.new(more.outputs[0], both.inputs[1])
    tree.links.new(both.outputs[0], tree.nodes["World Output"].inputs["Surface"])
    add(bpy.ops.mesh.primitive_uv_sphere_add, material("white", (0.8, 0.8, 0.8))[0], radius=1, segments=64, ring_count=32)
    bpy.ops.object.shade_smooth()
    camera(scene, (2, -4, 1), lens=24)
    scene.tomales.bounces, scene.tomales.light_samples = 0, 256
    scene.cycles.max_bounces = 1
    return scene


def soft_sun():
    scene = sun()
    scene.objects["SUN"].data.angle = 0.3
    scene.tomales.light_samples = 256
    return scene


def lit_plane(kind="ShaderNodeBsdfDiffuse", **inputs):
    """Makes a plane under a slanting sun, whose nodes the caller adds. Returns scene, node tree and shader."""
    scene = empty_scene()
    made, shader = material("graph", (0.5, 0.5, 0.5), kind, **inputs)
    add(bpy.ops.mesh.primitive_plane_add, made, size=4)
    camera(scene, (0.5, -1, 6))
    light(scene, "SUN", (0, 0, 5), (0.6, 0.4, 0), energy=3, angle=0)
    scene.tomales.bounces = 0
    scene.cycles.max_bounces = 0
    return scene, made.node_tree, shader


def image_node(tree, image, **settings):
    node = tree.nodes.new("ShaderNodeTexImage")
    node.image = image
    for name, value in settings.items():
        setattr(node, name, value)
    return node


def waves(u, v):
    """Returns heights that are not symmetric, and that are periodic like pictures."""
    u, v = 2 * math.pi * u, 2 * math.pi * v
    return numpy.repeat((0.5 + 0.25 * numpy.sin(u + v) + 0.25 * numpy.sin(2 * v - u + 1))[..., None], 3, -1)


def bump():
    scene, tree, shader = lit_plane()
    node = tree.nodes.new("ShaderNodeBump")
    node.inputs["Distance"].default_value, node.inputs["Strength"].default_value = 0.3, 1
    tree.links.new(image_node(tree, picture("waves", 256, 256, waves, True)).outputs["Color"], node.inputs["Height"])
    tree.links.new(node.outputs["Normal"], shader.inputs["Normal"])
    return scene


def normal_map():
    scene, tree, shader = lit_plane()
    node = tree.nodes.new("ShaderNodeNormalMap")
    node.uv_map = "UVMap"
    tilted = picture("tilted", 64, 64, lambda u, v: numpy.stack([0.5 + 0.3 * numpy.sin(6 * u), 0.5 + 0.25 * v, numpy.full_like(u, 0.9)], -1), True)
    tree.links.new(image_node(tree, tilted).outputs["Color"], node.inputs["Color"])
    tree.links.new(node.outputs["Normal"], shader.inputs["Normal"])
    return scene


def second_uv():
    """Colours use one UV map. Metal and bent normals use another one that is turned and stretched."""
    scene, tree, shader = lit_plane("ShaderNodeBsdfPrincipled", Roughness=0.7)
    mesh = scene.objects["Plane"].data
    second = mesh.uv_layers.new(name="Second")
    for item, first in zip(second.data, mesh.uv_layers["UVMap"].data):
        u, v = first.uv
        item.uv = (0.1 + 0.8 * v, 0.9 - 0.5 * u)
    mesh.uv_layers["UVMap"].active_render = True
    coordinates, bend = tree.nodes.new("ShaderNodeUVMap"), tree.nodes.new("ShaderNodeNormalMap")
    coordinates.uv_map = bend.uv_map = "Second"
    color = image_node(tree, picture("ramp", 64, 64, lambda u, v: numpy.stack([u, v, 0.5 + 0 * u], -1), True))
    tilted = image_node(tree, picture("tilted", 64, 64, lambda u, v: numpy.stack([0.5 + 0.3 * numpy.sin(6 * u), 0.5 + 0.25 * v, numpy.full_like(u, 0.9)], -1), True))
    metal = image_node(tree, picture("metal", 64, 64, lambda u, v: numpy.repeat((0.8 * (u < v))[..., None], 3, -1), True))
    for node, output, target in ((color, "Color", shader.inputs["Base Color"]), (tilted, "Color", bend.inputs["Color"]), (metal, "Color", shader.inputs["Metallic"])):
        tree.links.new(node.outputs[output], target)
        if node is not color:
            tree.links.new(coordinates.outputs["UV"], node.inputs["Vector"])
    tree.links.new(bend.outputs["Normal"], shader.inputs["Normal"])
    return scene


def displaced():
    """A displacement moves the surface, which is seen from the side."""
    scene, tree, shader = lit_plane()
    plane = scene.objects["Plane"]
    modifier = plane.modifiers.new("fine", "SUBSURF")
    modifier.subdivision_type, modifier.render_levels = "SIMPLE", 7
    plane.material_slots[0].material.cycles.displacement_method = "DISPLACEMENT"
    node = tree.nodes.new("ShaderNodeDisplacement")
    node.inputs["Scale"].default_value, node.inputs["Midlevel"].default_value = 0.6, 0.3
    tree.links.new(image_node(tree, picture("waves", 256, 256, waves, True)).outputs["Color"], node.inputs["Height"])
    tree.links.new(node.outputs["Displacement"], tree.nodes["Material Output"].inputs["Displacement"])
    camera(scene, (1, -5, 1.5))
    return scene


def graph():
    """A group mixes two pictures, one of them turned and repeated, by a third one, through the nodes that artists use."""
    scene, tree, shader = lit_plane()
    group = bpy.data.node_groups.new("mixed", "ShaderNodeTree")
    group.outputs.new("NodeSocketColor", "Color")
    group.inputs.new("NodeSocketColor", "Tint")
    nodes, link = group.nodes, group.links.new
    outside, inside = nodes.new("NodeGroupInput"), nodes.new("NodeGroupOutput")
    stripes = picture("stripes", 64, 64, lambda u, v: numpy.stack([u, 0.2 + 0 * u, (v > 0.5) * 0.8], -1))
    one, two = image_node(group, stripes), image_node(group, picture("ramp", 32, 32, lambda u, v: numpy.stack([v, u, u * v], -1), True))
    mapping, coordinates = nodes.new("ShaderNodeMapping"), nodes.new("ShaderNodeTexCoord")
    mapping.inputs["Scale"].default_value, mapping.inputs["Rotation"].default_value = (2, 2, 1), (0, 0, math.pi / 2)
    link(coordinates.outputs["UV"], mapping.inputs["Vector"])
    link(mapping.outputs["Vector"], one.inputs["Vector"])
    hue, ramp, mix, power = (nodes.new(f"ShaderNode{kind}") for kind in ("HueSaturation", "ValToRGB", "MixRGB", "Math"))
    hue.inputs["Hue"].default_value, hue.inputs["Saturation"].default_value = 0.6, 0.8
    link(one.outputs["Color"], hue.inputs["Color"])
    power.operation = "POWER"
    power.inputs[1].default_value = 2
    link(two.outputs["Color"], power.inputs[0])
    link(power.outputs["Value"], ramp.inputs["Fac"])
    link(ramp.outputs["Color"], mix.inputs["Fac"])
    link(hue.outputs["Color"], mix.inputs["Color1"])
    link(outside.outputs["Tint"], mix.inputs["Color2"])
    link(mix.outputs["Color"], inside.inputs["Color"])
    node = tree.nodes.new("ShaderNodeGroup")
    node.node_tree = group
    node.inputs["Tint"].default_value = (0.1, 0.7, 0.9, 1)
    tree.links.new(node.outputs["Color"], shader.inputs["Color"])
    return scene


def mixture():
    """A quarter of the surface is invisible, over one that glows a little with colours of the vertices."""
    scene, tree, shader = lit_plane()
    plane = scene.objects["Plane"]
    colors = plane.data.color_attributes.new("Painted", "FLOAT_COLOR", "CORNER")
    for item, loop in zip(colors.data, plane.data.loops):  # The colours are linear over the plane, so that no diagonal shows.
        x, y, _ = plane.data.vertices[loop.vertex_index].co
        item.color = (0.5 + 0.2 * x, 0.5 + 0.2 * y, 0.4 - 0.1 * x, 1)
    painted, clear, mix, glow, both = (
        tree.nodes.new(f"ShaderNode{kind}") for kind in ("VertexColor", "BsdfTransparent", "MixShader", "Emission", "AddShader")
    )
    painted.layer_name = "Painted"
    mix.inputs[0].default_value = 0.25
    glow.inputs["Color"].default_value = (0.1, 0.1, 0.3, 1)
    tree.links.new(painted.outputs["Color"], shader.inputs["Color"])
    tree.links.new(shader.outputs[0], both.inputs[0])
    tree.links.new(glow.outputs[0], both.inputs[1])
    tree.links.new(both.outputs[0], mix.inputs[1])
    tree.links.new(clear.outputs[0], mix.inputs[2])
    tree.links.new(mix.outputs[0], tree.nodes["Material Output"].inputs["Surface"])
    scene.render.film_transparent = True
    return scene


def turned_sky():
    scene = panorama()
    tree = scene.world.node_tree
    mapping, coordinates = tree.nodes.new("ShaderNodeMapping"), tree.nodes.new("ShaderNodeTexCoord")
    mapping.inputs["Rotation"].default_value = (0.3, 0, 1.2)
    tree.links.new(coordinates.outputs["Generated"], mapping.inputs["Vector"])
    tree.links.new(mapping.outputs["Vector"], tree.nodes["Environment Texture"].inputs["Vector"])
    tree.nodes["Background"].inputs["Strength"].default_value = 0.5
    return scene


def creases():
    scene = subdivision()
    cube = scene.objects["Cube"]
    for edge in cube.data.edges[:5]:
        edge.crease = 0.6
    for edge in cube.data.edges[5:8]:
        edge.crease = 1
    return scene


def hair():
    """A particle system has strands on a ball. They glow, because renderers differ in how light falls on a ribbon."""
    scene = empty_scene()
    made, _ = material("hair", (0.7, 0.4, 0.2), "ShaderNodeEmission")
    ball = add(bpy.ops.mesh.primitive_uv_sphere_add, made, radius=1)
    settings = ball.modifiers.new("hair", "PARTICLE_SYSTEM").particle_system.settings
    settings.type, settings.count, settings.hair_length, settings.render_step = "HAIR", 300, 0.8, 3
    settings.root_radius, settings.tip_radius, settings.radius_scale = 3, 3, 0.01
    scene.world.color = (0, 0, 0.2)
    camera(scene, (0, -6, 2))
    scene.tomales.bounces = 0
    return scene


def deformation():
    """A shape key moves a glowing cube within the shutter."""
    scene = empty_scene()
    glow, _ = material("glow", (1, 0.5, 0.2), "ShaderNodeEmission")
    cube = add(bpy.ops.mesh.primitive_cube_add, glow, size=1.5)
    cube.shape_key_add(name="Basis")
    key = cube.shape_key_add(name="aside")
    for point in key.data:
        point.co.x += 1 + point.co.z
    for frame, value in ((0, 0), (2, 2)):
        key.value = value
        key.slider_max = 2
        key.keyframe_insert("value", frame=frame)
    for curve in cube.data.shape_keys.animation_data.action.fcurves:
        for point in curve.keyframe_points:
            point.interpolation = "LINEAR"
    camera(scene, (0, -6, 1))
    scene.render.use_motion_blur, scene.render.motion_blur_shutter = True, 1
    scene.tomales.pixel_samples = 8
    scene.tomales.bounces = 0
    scene.frame_set(1)
    return scene


def metal():
    """Polished metal mirrors a lit floor."""
    scene = empty_scene()
    floor((0.6, 0.3, 0.2))
    made, _ = material("metal", (0.9, 0.9, 0.9), "ShaderNodeBsdfPrincipled", Metallic=1.0, Roughness=0.3)
    add(bpy.ops.mesh.primitive_uv_sphere_add, made, radius=1, location=(0, 0, 1), segments=64, ring_count=32)
    bpy.ops.object.shade_smooth()
    camera(scene, (0, -6, 3))
    light(scene, "AREA", (1, -1, 4), energy=300, size=2)
    scene.tomales.reflection_samples = 32
    return scene


SCENES = [area, disk_lamp, sun, soft_sun, point, spot, soft_spot, camera_shift, orthographic, focus, motion, deformation, texture, pictures_of_all, panorama, turned_sky, sky, woven_sky]
SCENES += [instances, room, subdivision, creases, bump, normal_map, second_uv, displaced, graph, mixture, hair, metal]


def blocks(path):
    channels = exr.read(path)
    rgb = numpy.stack([channels[c] for c in "RGB"], -1)
    rows, columns = BLOCKS if rgb.shape[0] < rgb.shape[1] else BLOCKS[::-1]
    height, width = rgb.shape[0] // rows, rgb.shape[1] // columns
    return rgb[: height * rows, : width * columns].reshape(rows, height, columns, width, 3).mean((1, 3))


def main(folder, names):
    for make in SCENES:
        if names and make.__name__ not in names:
            continue
        out = {}
        for engine in ("CYCLES", "TOMALES"):
            scene = make()
            scene.render.engine = engine
            scene.tomales.folder = os.path.join(folder, make.__name__)
            scene.render.filepath = os.path.join(folder, f"{make.__name__}_{engine.lower()}.exr")
            bpy.ops.render.render(write_still=True)
            out[engine.lower()] = blocks(scene.render.filepath).tolist()
        with open(os.path.join(folder, make.__name__ + ".json"), "w") as file:
            json.dump(out, file)


arguments = sys.argv[sys.argv.index("--") + 1 :]
main(arguments[0], arguments[1:])
