"""Compares caustics of `--gi reference` with those of Cycles: a large lamp over a ball of glass, and over a slanting pane of
glass, above a floor.

    caustic_cycles.py TOMALES FOLDER [--seeds 4] [--cycles 4096] [--paths 1024] [--photons 4000000] [--blender blender]

The eye looks straight down and does not see the glass or the lamp. Both renderers make a picture for each seed. It prints both
means, and the differences of blocks of 4 x 4 pixels, with the noise that is estimated from the seeds. FOLDER gets the pictures,
and keeps those of Cycles for the next call.
"""
import argparse
import json
import math
import pathlib
import statistics
import subprocess
import sys

SIZE, BLOCK = 32, 4
# The floor is so dark that less than a thousandth of the light is reflected from it to the glass and back.
ALBEDO, RADIANCE, LAMP, HEIGHT = 0.05, 10, 0.7, 3
BALL, UP = 0.4, 0.8
PANE, THICKNESS, SLANT = 0.8, 0.05, 25

if "--" in sys.argv:  # in Blender
    import bpy
    import mathutils

    folder, name, seeds, samples = sys.argv[sys.argv.index("--") + 1:]
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    scene.world = bpy.data.worlds.new("World")
    scene.world.color = (0, 0, 0)
    render, cycles = scene.render, scene.cycles
    render.engine = "CYCLES"
    render.resolution_x = render.resolution_y = SIZE
    render.image_settings.file_format, render.image_settings.color_depth, render.image_settings.exr_codec = "OPEN_EXR", "32", "NONE"
    render.threads_mode, render.threads = "FIXED", 1
    cycles.samples, cycles.use_adaptive_sampling, cycles.use_denoising, cycles.pixel_filter_type = int(samples), False, False, "BOX"
    cycles.max_bounces, cycles.diffuse_bounces, cycles.glossy_bounces, cycles.transmission_bounces = 32, 1, 32, 32
    cycles.caustics_reflective = cycles.caustics_refractive = True
    cycles.blur_glossy = cycles.sample_clamp_direct = cycles.sample_clamp_indirect = cycles.light_sampling_threshold = 0

    def material(kind, **values):
        out = bpy.data.materials.new(kind)
        out.use_nodes = True
        nodes = out.node_tree.nodes
        nodes.clear()
        shader = nodes.new(kind)
        for key, value in values.items():
            shader.inputs[key].default_value = value
        out.node_tree.links.new(shader.outputs[0], nodes.new("ShaderNodeOutputMaterial").inputs["Surface"])
        return out

    def put(look, seen=True):
        thing = bpy.context.object
        thing.data.materials.append(look)
        thing.visible_camera = seen

    glass = material("ShaderNodeBsdfGlass", IOR=1.5, Roughness=0, Color=(1, 1, 1, 1))
    glass.node_tree.nodes["Glass BSDF"].distribution = "SHARP"
    bpy.ops.mesh.primitive_plane_add(size=8)
    put(material("ShaderNodeBsdfDiffuse", Color=(ALBEDO, ALBEDO, ALBEDO, 1)))
    bpy.ops.mesh.primitive_plane_add(size=2 * LAMP, location=(0, 0, HEIGHT))
    put(material("ShaderNodeEmission", Strength=RADIANCE), False)
    if name == "ball":
        bpy.ops.mesh.primitive_uv_sphere_add(segments=256, ring_count=128, radius=BALL, location=(0, 0, UP))
        bpy.ops.object.shade_smooth()
    else:
        bpy.ops.mesh.primitive_cube_add(size=1, location=(0, 0, UP), rotation=(0, math.radians(SLANT), 0))
        bpy.context.object.scale = (2 * PANE, 2 * PANE, THICKNESS)
    put(glass, False)
    bpy.ops.object.camera_add(location=(0, 0, 5))
    scene.camera = bpy.context.object
    scene.camera.data.type, scene.camera.data.ortho_scale = "ORTHO", 2
    for seed in range(int(seeds)):
        render.filepath = f"{folder}/{name}_cycles_{seed}.exr"
        if pathlib.Path(render.filepath).with_suffix(".json").exists():
            continue
        cycles.seed = seed
        bpy.ops.render.render(write_still=True)
        image = bpy.data.images.load(render.filepath)
        pixels = list(image.pixels)  # from the lowest row
        rows = [[pixels[4 * (SIZE * y + x) + 1] for x in range(SIZE)] for y in reversed(range(SIZE))]
        pathlib.Path(render.filepath).with_suffix(".json").write_text(json.dumps(rows))
    sys.exit()

# World z is up, as in Blender. The eye looks down with x to the right and y upwards in the picture.
RIB = f"""Display "{{name}}.exr" "file" "rgb"
Format {SIZE} {SIZE} 1
PixelSamples 8 8
PixelFilter "box" 1 1
ShadingRate 0.0625
Projection "orthographic"
ScreenWindow -1 1 -1 1
Translate 0 0 5
Scale 1 1 -1
WorldBegin
LightSource "indirectlight" "gi"
Attribute "light" "shadows" ["on"]
Attribute "trace" "int maxspeculardepth" [32] "float tessellation" [1]
AttributeBegin
Attribute "visibility" "int camera" [0]
Surface "matte"
Color 0 0 0
AreaLightSource "arealight" "lamp" "intensity" [{RADIANCE}] "samples" [64]
Polygon "P" [{" ".join(f"{x * LAMP} {y * LAMP} {HEIGHT}" for x, y in ((-1, -1), (-1, 1), (1, 1), (1, -1)))}]
AttributeEnd
Illuminate "lamp" 1
AttributeBegin
Surface "matte"
Color {ALBEDO} {ALBEDO} {ALBEDO}
Polygon "P" [-4 -4 0 4 -4 0 4 4 0 -4 4 0]
AttributeEnd
Attribute "visibility" "int camera" [0]
Attribute "photon" "string shadingmodel" ["glass"]
Surface "glass"
Color 1 1 1
Translate 0 0 {UP}
{{thing}}
WorldEnd
"""
FACES = [[(i, j, s)[-k:] + (i, j, s)[:-k] for i, j in ((-1, -1), (1, -1), (1, 1), (-1, 1))][::s] for k in (1, 2, 3) for s in (-1, 1)]
SIZES = (PANE, PANE, THICKNESS / 2)
BOX = "\n".join('Polygon "P" [' + " ".join(str(c * s) for corner in face for c, s in zip(corner, SIZES)) + "]" for face in FACES)
THINGS = {"ball": f"Sphere {BALL} {-BALL} {BALL} 360", "pane": f"Rotate {SLANT} 0 1 0\n{BOX}"}

parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
parser.add_argument("tomales", type=pathlib.Path)
parser.add_argument("folder", type=pathlib.Path)
parser.add_argument("--seeds", type=int, default=4)
parser.add_argument("--cycles", type=int, default=4096, help="samples of a pixel of Cycles")
parser.add_argument("--paths", type=int, default=1024, help="paths of a pixel of tomales, shared by its 16 micropolygons")
parser.add_argument("--photons", type=int, default=4_000_000)
parser.add_argument("--blender", default="blender")
options = parser.parse_args()
sys.path.insert(0, str(pathlib.Path(__file__).parents[1] / "image"))
from pictures import pixels as pixels_of  # noqa: E402

options.folder.mkdir(parents=True, exist_ok=True)


def run(*command):
    subprocess.run([str(c) for c in command], check=True, cwd=options.folder, stdout=subprocess.DEVNULL)


def blocks(rows):
    """Returns the means of blocks of a picture of rows, over the floor's albedo."""
    starts = range(0, SIZE, BLOCK)
    return [sum(rows[y + j][x + i] for j in range(BLOCK) for i in range(BLOCK)) / BLOCK**2 / ALBEDO for y in starts for x in starts]


def ours(name):
    (options.folder / f"{name}.rib").write_text(RIB.format(name=name, thing=THINGS[name]))
    for seed in range(options.seeds):
        run(options.tomales.resolve(), f"{name}.rib", "--gi", "reference", "--bounces", 1, "--samples", max(1, options.paths // 16), "--light-samples", 64,
            "--photons", options.photons, "--light-seed", seed, "-t", 1, "-q", "-o", f"{name}_tomales_{seed}.exr")
        found = pixels_of(options.folder / f"{name}_tomales_{seed}.exr")
        yield [[found[x, y][1] for x in range(SIZE)] for y in range(SIZE)]


def theirs(name):
    run(options.blender, "-b", "--factory-startup", "-P", pathlib.Path(__file__).resolve(), "--", options.folder.resolve(), name, options.seeds, options.cycles)
    for seed in range(options.seeds):
        yield json.loads((options.folder / f"{name}_cycles_{seed}.json").read_text())


for name in THINGS:
    found = [[blocks(rows) for rows in renderer(name)] for renderer in (ours, theirs)]
    means = [[statistics.mean(picture) for picture in pictures] for pictures in found]
    level = statistics.mean(means[1])
    worst, off = 0, []
    errors = [[statistics.variance(b) / options.seeds for b in zip(*pictures)] for pictures in found]
    for k, (a, b) in enumerate(zip(*(map(statistics.mean, zip(*pictures)) for pictures in found))):
        off.append((a - b) / level)
        worst = max(worst, abs(a - b) / max(1e-12, b))
    noise = math.sqrt(sum(map(sum, errors)) / len(off)) / level
    error = math.sqrt(sum(statistics.variance(m) / options.seeds for m in means)) / level
    print(f"{name}: mean {statistics.mean(means[0]):.5f} and {level:.5f} ({100 * (statistics.mean(means[0]) / level - 1):+.3f} % +- {100 * error:.3f}); "
          f"blocks: rms difference {100 * math.sqrt(statistics.mean(o * o for o in off)):.3f} % of the mean, of which noise {100 * noise:.3f} %; worst {100 * worst:.2f} % of its own")
