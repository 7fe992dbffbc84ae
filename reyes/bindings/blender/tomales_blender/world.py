"""Blender's world as a light, and as a sphere that the camera sees behind everything."""
from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

import bpy
import tomales
from mathutils import Matrix

from . import relief
from .camera import flat
from .lights import group_of, write_sun
from .nodes import Graph, Unsupported, source
from .panorama import Panorama, Sun
from .textures import Textures
from .values import is_picture, mean

Warn = Callable[[str], None]

SKY_SHADER = """surface tomales_sky(color tint = 1; string map = "";)
{
    Ci = tint;
    /* environment() turns its direction into world space: give it the one that has there what I has in this space */
    if (map != "") Ci *= environment(map, vtransform("world", "current", vtransform("shader", I)));
    Oi = 1;
}
"""

SKY_RADIUS_SHARE = 0.9  # This is a fraction of the far clipping distance.


@dataclass
class Background:
    """The sky that the world's nodes show."""

    tint: list[float]
    seen: str = ""  #: The file of a panorama, which the tint multiplies.
    lights: str = ""  #: The same panorama without the sun.
    turned: Matrix = field(default_factory=lambda: Matrix.Identity(4))  #: The rotation from the panorama's space to the world's.
    sun: Sun | None = None


def write_world(ri: tomales.Ri, world: bpy.types.World, textures: Textures, panorama_of: Callable[[bpy.types.World], Panorama], samples: int, warn: Warn) -> Sky | None:
    """Writes a sky as a light, and its sun as another. Returns None if the sky is black."""
    shown = _background(world, textures, panorama_of, lambda text: warn(f"world {world.name}: {text}"))
    if max(shown.tint) <= 0:
        return None
    parameters: dict[str, object] = {"lightcolor": shown.tint, "float samples": samples, **group_of(world)}
    if shown.lights:
        parameters.update({"string map": shown.lights, "string mapspace": "shader"})
    ri.Attribute("light", {"string shadows": "on"})
    ri.TransformBegin()
    sky = Sky({"color tint": shown.tint, **({"string map": shown.seen} if shown.seen else {})}, shown.turned)
    sky.place(ri)
    ri.LightSource("environmentlight", "world", parameters)
    ri.TransformEnd()
    if shown.sun:
        ri.AttributeBegin()
        ri.ConcatTransform(flat(shown.sun.toward.to_track_quat("Z", "Y").to_matrix().to_4x4()))
        write_sun(ri, shown.sun.angle, 1, "sun", samples, {"lightcolor": shown.sun.color, **group_of(world)})
        ri.AttributeEnd()
        ri.Illuminate("sun", 1)
    return sky


@dataclass
class Sky:
    """The sky that the camera sees."""

    parameters: dict[str, object]
    turned: Matrix  #: The rotation from the panorama's space to the world's.

    def place(self, ri: tomales.Ri) -> None:
        ri.ConcatTransform(flat(self.turned))
        ri.Scale(-1, 1, 1)  # Longitudes run the other way round in Blender's panoramas.

    def write(self, ri: tomales.Ri, eye: Matrix, radius: float) -> None:
        """Writes a sphere around the camera that only the camera sees."""
        ri.AttributeBegin()
        ri.Attribute("visibility", {"int camera": 1, "int diffuse": 0, "int specular": 0, "int transmission": 0})
        ri.ConcatTransform(flat(Matrix.Translation(eye.translation)))
        self.place(ri)
        ri.Surface("tomales_sky", self.parameters)
        ri.Sphere(radius, -radius, radius, 360)
        ri.AttributeEnd()


def _background(world: bpy.types.World, textures: Textures, panorama_of: Callable[[bpy.types.World], Panorama], say: Warn) -> Background:
    if not world.use_nodes:
        return Background(list(world.color))
    output = next((n for n in world.node_tree.nodes if n.type == "OUTPUT_WORLD" and n.is_active_output), None)
    closure = source(output.inputs["Surface"]) if output else None
    if not closure:
        return Background([0, 0, 0])
    try:
        return _computed(world, closure.node, textures)
    except Unsupported as problem:
        try:
            shown = panorama_of(world)
        except OSError as failure:
            say(f"the node {problem} is not supported; the sky is grey: {failure}")
            return Background([0.5] * 3)
    return Background([1.0] * 3, textures.file(shown.whole), textures.file(shown.sunless), sun=shown.sun)


def _computed(world: bpy.types.World, node: bpy.types.Node, textures: Textures) -> Background:
    """Returns the sky of a Background node before a colour or one panorama. Raises Unsupported for anything else."""
    if node.type != "BACKGROUND":
        raise Unsupported(node.name)
    graph = Graph(textures.pixels)
    value = graph.of(node.inputs["Color"]) * mean(graph.of(node.inputs["Strength"]))[0]
    if not is_picture(value):
        return Background(mean(value))
    file = textures.file(value)
    return Background([1.0] * 3, file, file, rotation_of(next(n for n in world.node_tree.nodes if n.type == "TEX_ENVIRONMENT")))


def rotation_of(node: bpy.types.Node) -> Matrix:
    """Returns the inverse of the rotation of a Mapping node before an Environment Texture. The node turns
    directions, and the inverse turns the sky."""
    output = source(node.inputs["Vector"])
    turned = output is not None and output.node.type == "MAPPING"
    matrix = output.node.inputs["Rotation"].default_value.to_matrix().to_4x4() if turned else Matrix.Identity(4)
    return matrix if turned and output.node.vector_type == "TEXTURE" else matrix.transposed()


def write_shaders(folder: Path) -> None:
    """Writes the RSL shaders that frames need."""
    for name, text in (("tomales_sky", SKY_SHADER), ("tomales_relief", relief.SHADER)):
        (folder / f"{name}.sl").write_text(text)
