"""Writes the rooms as scenes of each program, and runs it. Every writer returns the text of a scene."""
import math


def rib(room, size):
    def points(values):
        return " ".join(f"{v:.9g}" for p in values for v in p)

    lamp = room.lamp
    x, y, z = lamp.centre
    corners = [(x + sx * lamp.width / 2, y, z + sz * lamp.depth / 2) for sz in (-1, 1) for sx in (-1, 1)]
    lines = [f'Format {size} {size} 1\nPixelSamples 4 4\nPixelFilter "box" 1 1\nProjection "perspective" "fov" [{room.fov_deg}]',
             'Clipping 0.01 100\nDisplay "out.exr" "openexr" "rgb"\nWorldBegin',
             'LightSource "indirectlight" "gi" "float samples" [600]\nAttributeBegin',
             f'AreaLightSource "arealight" "lamp" "float intensity" [{lamp.radiance}] "float samples" [64]',
             f'Surface "matte"\nColor 0 0 0\nPatch "bilinear" "P" [{points(corners)}]\nAttributeEnd\nIlluminate "lamp" 1\nSurface "matte"']
    for quad in room.quads:
        lines.append(f'Color {points([quad.color])}\nPolygon "P" [{points(quad.corners)}]')
    for ball in room.balls:
        lines.append(f'Color {points([ball.color])}\nTransformBegin\nTranslate {points([ball.centre])}\nSphere {ball.radius} {-ball.radius} {ball.radius} 360\nTransformEnd')
    return "\n".join(lines + ["WorldEnd\n"])


def povray(room, radiosity, lamps):
    """`radiosity` is the contents of that block, or None for direct light. The rectangle is a raster of lamps x lamps spotlights, which shine with
    the cosine. POV-Ray's own area_light spans its samples from edge to edge, and is 17 % low where light grazes."""
    def vector(p):
        return "<" + ",".join(f"{v:.9g}" for v in p) + ">"

    def finish(color):
        return f"pigment {{ rgb {vector(color)} }} finish {{ ambient 0 diffuse 1 emission 0 }}"

    settings = f"radiosity {{ {radiosity} }}" if radiosity else ""
    lamp, lines = room.lamp, [f"#version 3.7;\nglobal_settings {{ assumed_gamma 1 max_trace_level 10 {settings} }}\ndefault {{ finish {{ ambient 0 diffuse 1 }} }}"]
    lines.append(f"camera {{ perspective location 0 direction z right x up y angle {room.fov_deg} }}")
    power = lamp.radiance * lamp.width * lamp.depth / lamps**2 / math.pi / 2e-6  # With d = 1e-3 POV-Ray's fade is 2 d^2 / r^2.
    for i in range(lamps):
        for j in range(lamps):
            p = (lamp.centre[0] + ((i + 0.5) / lamps - 0.5) * lamp.width, lamp.centre[1] - 1e-5, lamp.centre[2] + ((j + 0.5) / lamps - 0.5) * lamp.depth)
            lines.append(f"light_source {{ {vector(p)} rgb {power:.9g} spotlight point_at {vector((p[0], p[1] - 1, p[2]))} radius 90 falloff 90 tightness 1 "
                         "fade_distance 1e-3 fade_power 2 }")
    w, d = lamp.width / 2, lamp.depth / 2
    quads = [(q.corners, q.color) for q in room.quads]
    quads.append(([tuple(c + o for c, o in zip(lamp.centre, offset)) for offset in ((-w, 0, -d), (w, 0, -d), (w, 0, d), (-w, 0, d))], (0, 0, 0)))
    for corners, color in quads:
        lines.append(f"polygon {{ 5, {', '.join(vector(p) for p in corners + corners[:1])} {finish(color)} }}")
    for ball in room.balls:
        lines.append(f"sphere {{ {vector(ball.centre)}, {ball.radius} {finish(ball.color)} }}")
    return "\n".join(lines) + "\n"


def cycles(room, size, samples, bounces, out):
    """Returns a script for Blender, whose z is our y. Light passes are written apart. Lamps of Cycles let light through, but ours and POV-Ray's are
    black on both sides, so a black sheet lies on this one."""
    x, y, z = room.lamp.centre
    w, d = room.lamp.width / 2, room.lamp.depth / 2
    sheet = [(x - w, y + 1e-4, z - d), (x + w, y + 1e-4, z - d), (x + w, y + 1e-4, z + d), (x - w, y + 1e-4, z + d)]
    quads = [([(x, z, y) for x, y, z in corners], color) for corners, color in [*((q.corners, q.color) for q in room.quads), (sheet, (0, 0, 0))]]
    balls = [((b.centre[0], b.centre[2], b.centre[1]), b.radius, b.color) for b in room.balls]
    lamp = room.lamp
    energy = lamp.radiance * 4 * lamp.width * lamp.depth
    return f"""
import bpy, math
bpy.ops.wm.read_factory_settings(use_empty=True)
scene = bpy.context.scene
def material(color):
    m = bpy.data.materials.new("m")
    m.use_nodes = True
    m.node_tree.nodes.clear()
    bsdf, out = m.node_tree.nodes.new("ShaderNodeBsdfDiffuse"), m.node_tree.nodes.new("ShaderNodeOutputMaterial")
    bsdf.inputs["Color"].default_value = (*color, 1)
    m.node_tree.links.new(bsdf.outputs[0], out.inputs[0])
    return m
def add(data, color):
    data.materials.append(material(color))
    scene.collection.objects.link(bpy.data.objects.new("o", data))
for corners, color in {quads!r}:
    mesh = bpy.data.meshes.new("q")
    mesh.from_pydata(corners, [], [(0, 1, 2, 3)])
    add(mesh, color)
for centre, radius, color in {balls!r}:
    n, m = 512, 256
    ring = [(centre[0] + radius * math.sin(math.pi * j / m) * math.cos(2 * math.pi * i / n), centre[1] + radius * math.sin(math.pi * j / m) * math.sin(2 * math.pi * i / n),
             centre[2] + radius * math.cos(math.pi * j / m)) for j in range(m + 1) for i in range(n)]
    mesh = bpy.data.meshes.new("s")
    mesh.from_pydata(ring, [], [(j * n + i, j * n + (i + 1) % n, (j + 1) * n + (i + 1) % n, (j + 1) * n + i) for j in range(m) for i in range(n)])
    mesh.polygons.foreach_set("use_smooth", [True] * len(mesh.polygons))
    add(mesh, color)
light = bpy.data.lights.new("lamp", "AREA")
light.shape, light.size, light.size_y, light.energy = "RECTANGLE", {lamp.width}, {lamp.depth}, {energy!r}
lamp = bpy.data.objects.new("lamp", light)
lamp.location = {(lamp.centre[0], lamp.centre[2], lamp.centre[1])!r}
scene.collection.objects.link(lamp)
camera = bpy.data.cameras.new("eye")
camera.sensor_fit, camera.angle = "HORIZONTAL", math.radians({room.fov_deg})
camera.clip_start = 0.01
eye = bpy.data.objects.new("eye", camera)
eye.rotation_euler = (math.pi / 2, 0, 0)
scene.collection.objects.link(eye)
scene.camera = eye
scene.render.engine = "CYCLES"
c = scene.cycles
c.device, c.samples, c.use_adaptive_sampling, c.use_denoising = "CPU", {samples}, False, False
c.max_bounces = c.diffuse_bounces = {bounces}
c.sample_clamp_direct = c.sample_clamp_indirect = 0
c.min_light_bounces = c.min_transparent_bounces = 0
c.light_sampling_threshold = 0
c.pixel_filter_type = "BOX"
c.filter_width = 1
scene.render.threads_mode, scene.render.threads = "FIXED", 1
scene.render.resolution_x = scene.render.resolution_y = {size}
scene.render.resolution_percentage = 100
scene.view_settings.view_transform = "Raw"
layer = scene.view_layers[0]
layer.use_pass_diffuse_direct = layer.use_pass_diffuse_indirect = layer.use_pass_diffuse_color = True
scene.render.image_settings.file_format = "OPEN_EXR_MULTILAYER"
scene.render.image_settings.color_depth = "32"
scene.render.filepath = {out!r}
bpy.ops.render.render(write_still=True)
"""
