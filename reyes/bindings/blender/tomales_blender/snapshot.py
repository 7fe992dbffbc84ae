"""The contents of the scene at one time: every object and instance with its place, and the shapes that they show."""
from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

import bpy
from mathutils import Matrix

from . import geometry
from .closures import uses_of
from .materials import Look
from .panorama import Panorama

Warn = Callable[[str], None]

#: Types of objects that have no surface. An unknown type that is not listed here is reported.
_EMPTY = {"EMPTY", "ARMATURE", "LATTICE", "CAMERA", "LIGHT", "SPEAKER", "LIGHT_PROBE"}


@dataclass
class Shape:
    """Geometry that instances share. It must not refer to Blender's evaluated data, which Blender frees with the
    frame."""

    name: str
    materials: list[str]  #: The full names of the materials by slot. An empty name means none.
    pieces: list[geometry.Piece]


@dataclass
class Placed:
    """One object, or one instance of it, in the world."""

    key: tuple
    shape: str  #: The key in Snapshot.shapes.
    name: str
    matrix: Matrix
    visibility: dict[str, bool]


@dataclass
class Snapshot:
    camera: Matrix
    placed: dict[tuple, Placed] = field(default_factory=dict)
    lights: dict[tuple, tuple[bpy.types.Object, Matrix]] = field(default_factory=dict)  #: The original objects.
    shapes: dict[str, Shape] = field(default_factory=dict)


class Cache:
    """What stays the same in all frames of an animation: the looks, and the shapes of objects without modifiers,
    shape keys and animation."""

    def __init__(self) -> None:
        self.shapes: dict[str, Shape] = {}
        self.archives: dict[tuple[str, int], str] = {}
        self.looks: dict[str, Look] = {}  #: The keys are full names of materials.
        self.panoramas: dict[str, Panorama] = {}  #: The keys are full names of worlds.


def take(depsgraph: bpy.types.Depsgraph, camera: bpy.types.Object, subdivide: bool, cache: Cache, warn: Warn) -> Snapshot:
    out = Snapshot(camera.evaluated_get(depsgraph).matrix_world.copy())
    for instance in depsgraph.object_instances:
        # The object of an instance is a copy that lasts for this step of the loop, and it has no meshes and particles.
        obj = instance.instance_object if instance.is_instance else instance.object
        key = (obj.name_full, instance.parent.name_full if instance.parent else "", tuple(instance.persistent_id) if instance.is_instance else ())
        if obj.type == "LIGHT":
            out.lights[key] = (obj.original, instance.matrix_world.copy())
            continue
        systems = [] if instance.is_instance else list(_strand_systems(obj))
        if instance.show_self:
            _add(out, key, obj, instance, lambda: _surface(obj, subdivide, warn), cache, "")
        for system in systems:
            _add(out, (*key, system.name), obj, instance, lambda: _strands(obj, system), None, " " + system.name)
    return out


def _add(out: Snapshot, key: tuple, obj: bpy.types.Object, instance: bpy.types.DepsgraphObjectInstance, make: Callable[[], Shape | None], cache: Cache | None, suffix: str) -> None:
    original = obj.original
    shape_key = f"{obj.name_full if suffix or obj.modifiers or obj.type != 'MESH' else original.data.name_full}{suffix}"
    if shape_key not in out.shapes:
        keeps = cache is not None and _is_static(original)
        shape = cache.shapes.get(shape_key) if keeps else None
        shape = shape or make()
        if shape is None:
            return
        if keeps:
            cache.shapes[shape_key] = shape
        out.shapes[shape_key] = shape
    visibility = {
        "camera": obj.visible_camera, "diffuse": obj.visible_diffuse, "specular": obj.visible_glossy, "transmission": obj.visible_shadow,
    }  # fmt: skip
    out.placed[key] = Placed(key, shape_key, obj.name, instance.matrix_world.copy(), visibility)


def _is_static(obj: bpy.types.Object) -> bool:
    data = obj.data
    return obj.type == "MESH" and all(m.type == "SUBSURF" for m in obj.modifiers) and not data.shape_keys and not data.animation_data


def _surface(obj: bpy.types.Object, subdivide: bool, warn: Warn) -> Shape | None:
    if obj.type == "CURVES":
        return _shape(obj, geometry.curve_pieces(obj.data))
    if obj.type not in ("MESH", "CURVE", "SURFACE", "FONT", "META"):
        if obj.type not in _EMPTY:
            warn(f"{obj.name}: objects of type {obj.type} are not supported")
        return None
    mesh = obj.to_mesh()
    if mesh is None:
        return None
    try:
        last = obj.original.modifiers[-1] if subdivide and ends_in_subdivision(obj.original) else None
        return _shape(obj, geometry.mesh_pieces(mesh, last, [uses_of(slot.material) for slot in obj.material_slots]))
    finally:
        obj.to_mesh_clear()


def ends_in_subdivision(obj: bpy.types.Object) -> bool:
    """Returns whether the last modifier is a Catmull-Clark subdivision. The engine switches it off during the export."""
    last = obj.modifiers[-1] if obj.modifiers else None
    return bool(last and last.type == "SUBSURF" and last.subdivision_type == "CATMULL_CLARK" and last.render_levels > 0)


def _shape(obj: bpy.types.Object, pieces: list[geometry.Piece]) -> Shape | None:
    names = [slot.material.name_full if slot.material else "" for slot in obj.material_slots]
    return Shape(obj.name, names, pieces) if pieces else None


def _strand_systems(obj: bpy.types.Object):
    for system in getattr(obj, "particle_systems", ()):
        if system.settings.type == "HAIR" and system.settings.render_type == "PATH" or system.settings.type == "EMITTER" and system.settings.render_type == "HALO":
            yield system


def _strands(obj: bpy.types.Object, system: bpy.types.ParticleSystem) -> Shape | None:
    make = geometry.hair_pieces if system.settings.type == "HAIR" else geometry.particle_pieces
    return _shape(obj, make(obj, system))
