"""Tests features that can be checked without another renderer. It writes FOLDER/features.json.

blender -b --factory-startup -P features.py -- FOLDER
"""
import glob
import json
import os
import re
import shutil
import subprocess
import sys
import time

arguments = sys.argv[sys.argv.index("--") + 1 :]
sys.argv = [*sys.argv[: sys.argv.index("--")], "--", arguments[0], "nothing"]  # With this name scenes.py renders nothing, and only provides its functions.
sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import bpy  # noqa: E402
import numpy  # noqa: E402
import scenes  # noqa: E402
from scenes import add, camera, empty_scene, exr, light, material  # noqa: E402
from tomales_blender import engine, panels, passes as passes_module  # noqa: E402
from tomales_blender.engine import TomalesEngine  # noqa: E402

FOLDER, found = arguments[0], {}


def render(scene, name, **settings):
    """Renders and returns the RIB of the frame."""
    scene.render.engine = "TOMALES"
    scene.tomales.folder = os.path.join(FOLDER, name)
    scene.render.filepath = os.path.join(FOLDER, name, "picture.exr")
    for key, value in settings.items():
        setattr(scene.tomales, key, value)
    bpy.ops.render.render(write_still=True, animation=False)
    with open(sorted(glob.glob(os.path.join(FOLDER, name, "*.rib")))[0]) as file:
        return file.read()


def archives(name):
    """Returns the archives of a frame as text."""
    files = sorted(glob.glob(os.path.join(FOLDER, name, "archives", "*.rib")))
    return "".join(subprocess.run([os.environ["TOMALES"], "catrib", f], capture_output=True, text=True).stdout for f in files)


def passes():
    scene = empty_scene()
    add(bpy.ops.mesh.primitive_plane_add, material("m", (0.25, 0.25, 0.25), "ShaderNodeBsdfPrincipled")[0], size=10)
    camera(scene, (0, 0, 5))
    light(scene, "SUN", (0, 0, 5), energy=3, angle=0)
    scene.tomales.bounces = 0
    layer = scene.view_layers[0]
    layer.use_pass_z = layer.use_pass_normal = layer.use_pass_diffuse_color = True
    scene.render.image_settings.file_format = "OPEN_EXR_MULTILAYER"
    render(scene, "passes")
    channels = exr.read(scene.render.filepath)
    middle = {name: float(values[36, 48]) for name, values in channels.items()}
    value = lambda end: next(v for name, v in middle.items() if name.endswith(end))  # noqa: E731
    return {"Depth": value("Depth.Z"), "NormalZ": value("Normal.Z"), "DiffCol": value("DiffCol.R")}


def animation():
    scene = empty_scene()
    camera(scene, (0, -30, 20))
    for i in range(100):
        add(bpy.ops.mesh.primitive_cube_add if i % 2 else bpy.ops.mesh.primitive_cone_add, None, location=(i % 10, i // 10, 0))
        obj = bpy.context.object
        obj.keyframe_insert("location", frame=1)
        obj.location.z += 1
        obj.keyframe_insert("location", frame=12)
    scene.frame_start, scene.frame_end = 1, 12
    scene.render.engine = "TOMALES"
    scene.tomales.folder, scene.tomales.export_only = os.path.join(FOLDER, "animation"), True
    scene.render.filepath = os.path.join(FOLDER, "animation", "x")
    bpy.ops.render.render(animation=True)
    count = lambda pattern: len(glob.glob(os.path.join(FOLDER, "animation", pattern)))  # noqa: E731
    before = {"frames": count("*.rib"), "archives": count("archives/*.rib")}
    scene.tomales.folder, scene.tomales.export_frames = os.path.join(FOLDER, "at_once"), True
    bpy.ops.render.render()
    different = [f for f in os.listdir(os.path.join(FOLDER, "at_once")) if f.endswith(".rib") and lines(os.path.join(FOLDER, "at_once", f)) != lines(os.path.join(FOLDER, "animation", f))]
    return {**before, "at_once": len(glob.glob(os.path.join(FOLDER, "at_once", "*.rib"))), "different": different}


def lines(path):
    """Returns the lines of a frame's RIB without its folder."""
    with open(path) as file:
        return [line for line in file if "searchpath" not in line]


def deformation():
    scene = empty_scene()
    camera(scene, (0, -6, 2))
    plane = add(bpy.ops.mesh.primitive_plane_add)
    plane.shape_key_add(name="Basis")
    key = plane.shape_key_add(name="up")
    key.data[0].co.z = 1
    for frame, value in ((0, 0), (2, 1)):
        key.value = value
        key.keyframe_insert("value", frame=frame)
    scene.render.use_motion_blur = True
    scene.frame_set(1)
    render(scene, "deformation", export_only=True)
    text = archives("deformation")
    points = re.findall(r'"vertex point P" \[([^]]*)\]', text)
    return {"keys": text.count("PointsPolygons"), "moves": len(set(points)) == 2}


def faults():
    """Returns whether Blender goes on after a fault in the add-on itself, which once crashed it at the second rendering."""
    read = passes_module.Passes.read
    passes_module.Passes.read = lambda *_: {}["a fault of ours"]
    scene = empty_scene()
    camera(scene, (0, -6, 2))
    scene.render.engine = "TOMALES"
    messages = []
    for _ in range(2):
        try:
            bpy.ops.render.render()
        except RuntimeError as problem:
            messages.append(str(problem))
    passes_module.Passes.read = read
    return ["a fault of ours" in message for message in messages]


def strands():
    scene = empty_scene()
    camera(scene, (0, -6, 2))
    for kind in ("HAIR", "EMITTER"):
        plane = add(bpy.ops.mesh.primitive_plane_add)
        settings = plane.modifiers.new(kind, "PARTICLE_SYSTEM").particle_system.settings
        settings.type, settings.count = kind, 20
        if kind == "EMITTER":
            settings.frame_start, settings.frame_end, settings.render_type = -10, 0, "HALO"
    render(scene, "strands", export_only=True)
    return archives("strands")


def override():
    scene = empty_scene()
    made, _ = material("m", (0.5, 0.5, 0.5))
    add(bpy.ops.mesh.primitive_plane_add, made)
    camera(scene, (0, -6, 2))
    made.tomales.shader = "plastic"
    parameter = made.tomales.parameters.add()
    parameter.name, parameter.kind, parameter.number, parameter.is_set = "Kd", "float", 0.25, True
    return render(scene, "override", export_only=True)


def refused():
    scene = empty_scene()
    camera(scene, (0, -6, 2)).data.type = "PANO"
    scene.render.engine = "TOMALES"
    try:
        bpy.ops.render.render()
    except RuntimeError as problem:
        return str(problem)
    return ""


def unsupported():
    scene = empty_scene()
    made, shader = material("m", (0.5, 0.5, 0.5))
    made.node_tree.links.new(made.node_tree.nodes.new("ShaderNodeTexWave").outputs["Color"], shader.inputs["Color"])
    add(bpy.ops.mesh.primitive_plane_add, made)
    camera(scene, (0, -6, 2))
    return render(scene, "unsupported", export_only=True)


def cancel():
    """Stops when the engine first asks whether it should. Returns the seconds until the rendering, which would take minutes, has
    ended."""
    scene = scenes.area()
    scene.render.engine, scene.tomales.pixel_samples, scene.tomales.light_samples = "TOMALES", 32, 4096
    asked, TomalesEngine._is_given_up = TomalesEngine._is_given_up, lambda self: True
    begin = time.time()
    bpy.ops.render.render()
    TomalesEngine._is_given_up = asked
    return time.time() - begin


def progress():
    """Returns the progress that the engine reports while it renders. The shares rise to the whole."""
    scene = scenes.area()
    scene.render.engine = "TOMALES"
    shares, warnings = [], []
    show, TomalesEngine._show_progress = TomalesEngine._show_progress, lambda self: shares.append(self._progress)
    warn, TomalesEngine._warn = TomalesEngine._warn, lambda self, message: warnings.append(message)
    bpy.ops.render.render()
    TomalesEngine._show_progress, TomalesEngine._warn = show, warn
    return {"rises": shares == sorted(shares), "last": shares[-1], "warnings": warnings}


def preview():
    """Returns the pictures that are shown before the whole one. Their finished rows are those of the whole, and the others are empty."""
    scene = scenes.area()
    scene.render.resolution_y = 288  # Rows come in groups of 64.
    scene.tomales.bounces, scene.tomales.light_samples = 0, 128
    shown, fill = [], engine.fill
    engine.fill = lambda target, planes, result: (shown.append(planes.transpose(1, 2, 0)), fill(target, planes, result))
    TomalesEngine._has_viewer, engine._SHOW_S = True, 0
    render(scene, "preview")
    TomalesEngine._has_viewer, engine._SHOW_S, engine.fill = False, 1, fill
    channels = exr.read(os.path.join(FOLDER, "preview", "untitled.0001.exr"))
    whole = numpy.stack([channels[c] for c in "RGBA"], -1)
    filled = [picture.any((1, 2)) for picture in shown]
    return {
        "shown": len(shown),
        "rows": [int(rows.sum()) for rows in filled],
        "different": float(max((abs(picture - whole)[rows].max() for picture, rows in zip(shown, filled) if rows.any()), default=0)),
    }


GLOW = "surface glow(output varying color warm = 0;) { warm = color(0.25, 0.5, 0.75); Ci = Cs * diffuse(faceforward(normalize(N), I)); Oi = 1; }"


def layers():
    """Renders two view layers. The second one has an AOV of a shader's output, and a light group."""
    scene = scenes.area()
    scene.objects["Plane"].data.materials[0].tomales.shader = "glow"
    scene.objects["AREA"].lightgroup = "key"
    scene.view_layers.new("Second")
    layer = scene.view_layers["Second"]
    layer.aovs.add().name = "warm"
    layer.lightgroups.add(name="key")
    layer.use_pass_position = True
    scene.render.image_settings.file_format = "OPEN_EXR_MULTILAYER"
    os.makedirs(os.path.join(FOLDER, "layers"), exist_ok=True)
    with open(os.path.join(FOLDER, "layers", "glow.sl"), "w") as file:
        file.write(GLOW)
    render(scene, "layers")
    channels = exr.read(scene.render.filepath)
    middle = {name: float(values[36, 48]) for name, values in channels.items()}
    light = {name: float(values.mean()) for name, values in channels.items() if "Combined" in name and name.endswith("R")}
    return {"middle": middle, "light": light}


def mattes():
    """Returns Cryptomatte of Cycles and of Tomales: the first rank of a pixel in the middle of the floor, and the names in the file."""
    out = {}
    for engine in ("CYCLES", "TOMALES"):
        scene = scenes.area()
        scene.view_layers[0].use_pass_cryptomatte_object = scene.view_layers[0].use_pass_cryptomatte_material = True
        scene.render.image_settings.file_format = "OPEN_EXR_MULTILAYER"
        scene.cycles.samples = 8
        scene.render.engine = engine
        scene.tomales.folder = os.path.join(FOLDER, "mattes")
        scene.render.filepath = os.path.join(FOLDER, f"mattes_{engine}.exr")
        bpy.ops.render.render(write_still=True)
        channels = exr.read(scene.render.filepath)
        ranks = {name.split(".", 1)[1].lower(): float(values[36, 48]) for name, values in channels.items() if "Crypto" in name and "00." in name}
        texts = exr.texts(scene.render.filepath)
        layers = {texts[key]: json.loads(texts[key.replace("/name", "/manifest")]) for key in texts if key.startswith("cryptomatte/") and key.endswith("/name")}
        out[engine] = {"ranks": ranks, "layers": layers}
    return out


def moved():
    """Exports a frame with pictures, moves it and renders it there. Then renders two frames without a folder."""
    scene = scenes.texture()
    render(scene, "exported", export_only=True)
    there = os.path.join(FOLDER, "moved")
    shutil.move(os.path.join(FOLDER, "exported"), there)
    done = subprocess.run([os.environ["TOMALES"], "untitled.0001.rib"], cwd=there, capture_output=True, text=True)
    scene.tomales.export_only, scene.tomales.folder = False, ""
    scene.frame_start, scene.frame_end, scene.render.filepath = 1, 2, os.path.join(FOLDER, "animated")
    bpy.ops.render.render(animation=True)
    means = [float(exr.read(f"{FOLDER}/animated{frame:04d}.exr")["R"].mean()) for frame in (1, 2)]
    return {"code": done.returncode, "said": done.stderr, "moved": float(exr.read(os.path.join(there, "untitled.0001.exr"))["R"].mean()), "frames": means}


def interface():
    """Returns the properties that the button makes of a shader's parameters."""
    made, _ = material("m", (0.5, 0.5, 0.5))
    made.tomales.shader = "plastic"
    panels.fill(made.tomales, panels.parameters_of("plastic"))
    return {p.name: [p.kind.split()[-1], p.value()] for p in made.tomales.parameters}


FEATURES = (passes, animation, deformation, faults, strands, override, refused, unsupported, cancel, progress, preview, layers, mattes, moved, interface)
for feature in FEATURES:
    found[feature.__name__] = feature()
    with open(os.path.join(FOLDER, "features.json"), "w") as file:
        json.dump(found, file)
