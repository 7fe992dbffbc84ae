"""Blender's materials as shaders.

A Principled BSDF becomes `disney`, with the image that its base colour comes from. Other nodes become the nearest shader,
and are named in a message where something is lost. A shader named in the panel takes the place of all nodes.
"""
from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import bpy
import tomales

from .textures import Textures

Warn = Callable[[str], None]


@dataclass
class Look:
    """A surface shader with what surrounds it."""

    shader: str = "disney"
    parameters: dict[str, Any] = field(default_factory=dict)
    color: list[float] = field(default_factory=lambda: [0.8, 0.8, 0.8])
    opacity: float = 1
    emission: list[float] | None = None  #: Radiance, which an area light brings: the shader itself must not.
    displacement: tuple[str, dict[str, Any]] | None = None

    def write(self, ri: tomales.Ri) -> None:
        ri.Color(self.color)
        if self.opacity < 1:
            ri.Opacity([self.opacity] * 3)
        if self.displacement:
            ri.Displacement(self.displacement[0], self.displacement[1])
        ri.Surface(self.shader, self.parameters)


#: Inputs of the Principled BSDF, in the names of Blender 3.4 and of 4.0, and parameters of disney.
_PRINCIPLED = {
    "metallic": ("Metallic",), "specular": ("Specular", "Specular IOR Level"), "speculartint": ("Specular Tint",),
    "roughness": ("Roughness",), "sheen": ("Sheen", "Sheen Weight"), "clearcoat": ("Clearcoat", "Coat Weight"),
}  # fmt: skip


def look_of(material: bpy.types.Material | None, textures: Textures, warn: Warn) -> Look:
    if material is None:
        return Look(parameters={"float roughness": 0.5})
    if material.tomales.shader:
        return _override(material)
    if not material.use_nodes:
        color = list(material.diffuse_color)
        return Look(color=color[:3], parameters={"float metallic": material.metallic, "float roughness": material.roughness})
    output = next((n for n in material.node_tree.nodes if n.type == "OUTPUT_MATERIAL" and n.is_active_output), None)
    surface = output.inputs["Surface"] if output else None
    if not surface or not surface.is_linked:
        return Look(shader="constant", color=[0, 0, 0])
    node = surface.links[0].from_node
    make = _MAKERS.get(node.type)
    if not make:
        warn(f"material {material.name}: the node {node.name} is not supported; its viewport colour is used")
        return Look(color=list(material.diffuse_color)[:3])
    return make(node, material, textures, warn)


def _override(material: bpy.types.Material) -> Look:
    settings = material.tomales
    parameters = {f"{p.kind} {p.name}": p.value() for p in settings.parameters if p.is_set}
    return Look(settings.shader, parameters, color=list(material.diffuse_color)[:3])


def _value(node: bpy.types.Node, names: tuple[str, ...], material: bpy.types.Material, warn: Warn) -> Any:
    """What an input is set to. A link is named, as nothing follows it."""
    socket = next((node.inputs[name] for name in names if name in node.inputs), None)
    if socket is None:
        return None
    if socket.is_linked:
        warn(f"material {material.name}: {socket.links[0].from_node.name} at {names[0]} is not followed; its default is used")
    value = socket.default_value
    return list(value)[:3] if hasattr(value, "__len__") else float(value)


def _color(socket: bpy.types.NodeSocket, material: bpy.types.Material, textures: Textures, warn: Warn) -> tuple[list[float], str | None]:
    """A colour, and the file of the picture that multiplies it."""
    if socket.is_linked:
        source = socket.links[0].from_node
        if source.type == "TEX_IMAGE" and source.image:
            path = textures.file(source.image)
            return ([1, 1, 1], str(path)) if path else (list(socket.default_value)[:3], None)
        if source.type == "RGB":
            return list(source.outputs[0].default_value)[:3], None
        warn(f"material {material.name}: {source.name} at {socket.name} is not followed; its default is used")
    return list(socket.default_value)[:3], None


def _principled(node: bpy.types.Node, material: bpy.types.Material, textures: Textures, warn: Warn) -> Look:
    color, texture = _color(node.inputs["Base Color"], material, textures, warn)
    transmission = _value(node, ("Transmission", "Transmission Weight"), material, warn) or 0
    if transmission > 0.5:
        return Look("glass", {"float eta": _value(node, ("IOR",), material, warn), "color transmitcolor": color})
    parameters = {name: _value(node, inputs, material, warn) for name, inputs in _PRINCIPLED.items()}
    parameters = {f"float {name}": value for name, value in parameters.items() if isinstance(value, float)}
    if texture:
        parameters["string texturename"] = texture
    emitted, strength = next(node.inputs[n] for n in ("Emission", "Emission Color") if n in node.inputs), _value(node, ("Emission Strength",), material, warn)
    radiance = [c * strength for c in list(emitted.default_value)[:3]]
    return Look("disney", parameters, color, _value(node, ("Alpha",), material, warn), radiance if max(radiance) > 0 else None)


def _emission(node: bpy.types.Node, material: bpy.types.Material, textures: Textures, warn: Warn) -> Look:
    color, _ = _color(node.inputs["Color"], material, textures, warn)
    radiance = [c * node.inputs["Strength"].default_value for c in color]
    return Look("constant", {}, [0, 0, 0], 1, radiance)


def _diffuse(node: bpy.types.Node, material: bpy.types.Material, textures: Textures, warn: Warn) -> Look:
    color, texture = _color(node.inputs["Color"], material, textures, warn)
    if not texture:
        return Look("matte", {}, color)
    return Look("paintedplastic", {"Kd": 1, "Ks": 0, "string texturename": texture}, color)


def _glossy(node: bpy.types.Node, material: bpy.types.Material, textures: Textures, warn: Warn) -> Look:
    color, texture = _color(node.inputs["Color"], material, textures, warn)
    parameters: dict[str, Any] = {"float metallic": 1, "float roughness": _value(node, ("Roughness",), material, warn), "float reflections": 4}
    return Look("disney", {**parameters, **({"string texturename": texture} if texture else {})}, color)


def _glass(node: bpy.types.Node, material: bpy.types.Material, textures: Textures, warn: Warn) -> Look:
    color, _ = _color(node.inputs["Color"], material, textures, warn)
    return Look("glass", {"float eta": _value(node, ("IOR",), material, warn), "color transmitcolor": color})


def _transparent(node: bpy.types.Node, material: bpy.types.Material, textures: Textures, warn: Warn) -> Look:
    return Look("null")


_MAKERS = {
    "BSDF_PRINCIPLED": _principled, "EMISSION": _emission, "BSDF_DIFFUSE": _diffuse, "BSDF_GLOSSY": _glossy, "BSDF_GLASS": _glass,
    "BSDF_REFRACTION": _glass, "BSDF_TRANSPARENT": _transparent,
}  # fmt: skip
