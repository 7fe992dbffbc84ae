"""Blender's world as a light, and as what the camera sees behind everything."""
from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import bpy
import tomales
from mathutils import Matrix

from . import relief
from .camera import flat
from .lights import group_of
from .nodes import Graph, Unsupported, source
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

SKY_RADIUS_SHARE = 0.9  # of the far clipping distance


def write_world(ri: tomales.Ri, world: bpy.types.World, handle: str, textures: Textures, samples: int, warn: Warn) -> Sky | None:
    """A sky as a light; None if it is black."""
    tint, picture, turned = _background(world, textures, lambda text: warn(f"world {world.name}: {text}"))
    if max(tint) <= 0:
        return None
    parameters: dict[str, object] = {"lightcolor": tint, "float samples": samples, **group_of(world)}
    if picture:
        parameters.update({"string map": picture, "string mapspace": "shader"})
    ri.Attribute("light", {"string shadows": "on"})
    ri.TransformBegin()
    sky = Sky({"color tint": tint, **({"string map": picture} if picture else {})}, turned)
    sky.place(ri)
    ri.LightSource("environmentlight", handle, parameters)
    ri.TransformEnd()
    return sky


@dataclass
class Sky:
    """What the camera sees of the world."""

    parameters: dict[str, object]
    turned: Matrix  #: The world's space from the panorama's.

    def place(self, ri: tomales.Ri) -> None:
        ri.ConcatTransform(flat(self.turned))
        ri.Scale(-1, 1, 1)  # longitudes run the other way round in Blender's panoramas

    def write(self, ri: tomales.Ri, eye: Matrix, radius: float) -> None:
        """A sphere around the camera, which nothing else sees."""
        ri.AttributeBegin()
        ri.Attribute("visibility", {"int camera": 1, "int diffuse": 0, "int specular": 0, "int transmission": 0})
        ri.ConcatTransform(flat(Matrix.Translation(eye.translation)))
        self.place(ri)
        ri.Surface("tomales_sky", self.parameters)
        ri.Sphere(radius, -radius, radius, 360)
        ri.AttributeEnd()


def _background(world: bpy.types.World, textures: Textures, say: Warn) -> tuple[list[float], str, Matrix]:
    """Colour, panorama and its rotation, of the world's Background node."""
    still = Matrix.Identity(4)
    if not world.use_nodes:
        return list(world.color), "", still
    node = next((n for n in world.node_tree.nodes if n.type == "BACKGROUND"), None)
    if not node:
        say("it has no Background node; it is black")
        return [0, 0, 0], "", still
    graph = Graph(textures.pixels)
    try:
        value = graph.of(node.inputs["Color"]) * mean(graph.of(node.inputs["Strength"]))[0]
    except Unsupported as problem:
        say(f"the node {problem} is not supported; the sky is grey")
        return [0.5 * node.inputs["Strength"].default_value] * 3, "", still
    if not is_picture(value):
        return mean(value), "", still
    return [1.0, 1.0, 1.0], textures.file(value), rotation_of(next(n for n in world.node_tree.nodes if n.type == "TEX_ENVIRONMENT"))


def rotation_of(node: bpy.types.Node) -> Matrix:
    """Of a Mapping node before an Environment Texture, the other way round: it turns directions, not the sky."""
    output = source(node.inputs["Vector"])
    turned = output is not None and output.node.type == "MAPPING"
    matrix = output.node.inputs["Rotation"].default_value.to_matrix().to_4x4() if turned else Matrix.Identity(4)
    return matrix if turned and output.node.vector_type == "TEXTURE" else matrix.transposed()


def write_shaders(folder: Path) -> None:
    """The shaders that frames need, in RSL."""
    for name, text in (("tomales_sky", SKY_SHADER), ("tomales_relief", relief.SHADER)):
        (folder / f"{name}.sl").write_text(text)
