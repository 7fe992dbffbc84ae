"""Turns Blender's materials into shaders.

A graph of closures becomes one surface (closures.py), and this becomes one shader, which is usually `disney`. Where disney takes
no picture, the mean of the picture is used. A shader that the panel names replaces all nodes.
"""
from __future__ import annotations

import functools
import io
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import bpy
import tomales

from .closures import Closure, Reader
from .relief import relief_of
from .textures import Textures
from .values import is_picture, mean

Warn = Callable[[str], None]


@dataclass
class Look:
    """A surface shader and the attributes that belong to it."""

    shader: str = "disney"
    parameters: dict[str, Any] = field(default_factory=dict)
    color: list[float] | None = field(default_factory=lambda: [0.8, 0.8, 0.8])  #: The colour; None leaves the primitive's own.
    opacity: float = 1
    emission: list[float] | None = None  #: The radiance that an area light sends. The shader itself must not send it again.
    relief: dict[str, Any] | None = None  #: The parameters of the displacement shader tomales_relief.
    bound: float = 0  #: The greatest distance by which it moves the surface, in the object's space.

    @functools.cached_property
    def rib(self) -> str:
        """Returns the requests of the look. Every object that has it repeats them."""
        out = io.BytesIO()
        ri = tomales.Ri()
        ri.Begin(out)
        if self.color:
            ri.Color(self.color)
        if self.opacity < 1:
            ri.Opacity([self.opacity] * 3)
        if self.bound:
            ri.Attribute("displacementbound", {"float sphere": self.bound, "string coordinatesystem": "object"})
        if self.relief:
            ri.Displacement("tomales_relief", self.relief)
        ri.Surface(self.shader, self.parameters)
        ri.End()
        return "".join(line for line in out.getvalue().decode(errors="surrogateescape").splitlines(True) if not line.startswith(("#", "version")))


def look_of(material: bpy.types.Material | None, textures: Textures, reflections: int, warn: Warn) -> Look:
    """Returns the look of a material. `reflections` is the number of rays that each point sends to mirror the scene."""
    if material is None:
        return Look(parameters={"float roughness": 0.5})
    if material.tomales.shader:
        return _override(material)
    if not material.use_nodes:
        color = list(material.diffuse_color)
        return Look(color=color[:3], parameters={"float metallic": material.metallic, "float roughness": material.roughness})
    say = lambda text: warn(f"material {material.name}: {text}")  # noqa: E731
    reader = Reader(textures.pixels, say)
    look = _shaded(reader.surface(material), textures, reflections, say)
    if look.shader != "null":
        look.relief, look.bound = relief_of(material, reader, textures, say)
    return look


def changes(material: bpy.types.Material | bpy.types.World) -> bool:
    """Returns whether the material may look different in another frame."""
    trees = [material.node_tree] if material.use_nodes else []
    for tree in trees:
        trees += [node.node_tree for node in tree.nodes if node.type == "GROUP" and node.node_tree and node.node_tree not in trees]
    images = [node.image for tree in trees for node in tree.nodes if node.type == "TEX_IMAGE" and node.image]
    return any(owner.animation_data for owner in (material, *trees)) or any(image.source in ("SEQUENCE", "MOVIE") for image in images)


def _override(material: bpy.types.Material) -> Look:
    settings = material.tomales
    parameters = {f"{p.kind} {p.name}": p.value() for p in settings.parameters if p.is_set}
    return Look(settings.shader, parameters, color=list(material.diffuse_color)[:3])


def _shaded(closure: Closure, textures: Textures, reflections: int, say: Warn) -> Look:
    """Returns the shader with the parameters of this closure."""
    emission = mean(closure.emission)
    shows_glow = is_picture(closure.emission) and closure.kind == "disney"
    if is_picture(closure.emission) and not shows_glow:
        say("a glowing surface sends the mean of its picture")
    look = Look(opacity=mean(closure.opacity)[0], emission=emission if max(emission) > 0 and not shows_glow else None)
    if closure.kind == "null":
        return Look("null")
    if closure.kind == "glow":
        look.shader, look.color = "constant", [0, 0, 0]
        return look
    if closure.vertex_color:
        look.color = None
    elif is_picture(closure.color):
        look.color = [1, 1, 1]
    else:
        look.color = mean(closure.color)
    if closure.kind == "glass":
        look.shader = "glass"
        look.parameters = {"float eta": mean(closure.ior)[0], "color transmitcolor": mean(closure.color)}
    elif closure.kind == "matte" and not is_picture(closure.opacity) and not closure.over_second:
        _matte(look, closure, textures)
    else:
        _disney(look, closure, textures, reflections, say)
    return look


def _matte(look: Look, closure: Closure, textures: Textures) -> None:
    look.shader = "matte"
    if is_picture(closure.color):
        look.shader = "paintedplastic"
        look.parameters = {"Kd": 1, "Ks": 0, "string texturename": textures.file(closure.color)}


@functools.cache
def _maps() -> dict[str, str]:
    """Returns, for each parameter of disney, the parameter that takes a picture for it."""
    try:
        strings = {p["name"] for shader in tomales.info("disney")["shaders"] for p in shader["parameters"] if p["type"].endswith("string")}
    except (tomales.CommandFailed, tomales.RendererNotFound):
        strings = set()  # The program is missing, so the export uses the means of pictures.
    return {name.removesuffix("map"): name for name in strings if name.endswith("map")} | {"color": "texturename"}


def _disney(look: Look, closure: Closure, textures: Textures, reflections: int, say: Warn) -> None:
    parameters = look.parameters
    if is_picture(closure.color):
        parameters["string texturename"] = textures.file(closure.color)
    for name, value in closure.numbers.items():
        picture = _maps().get(name) if is_picture(value) else None
        parameters[f"float {name}"] = 1.0 if picture else mean(value)[0]
        if picture:
            parameters[f"string {picture}"] = textures.file(value)
        elif is_picture(value):
            say(f"{name} takes the mean of its picture, {mean(value)[0]:.3g}")
    if is_picture(closure.opacity):
        look.shader, look.opacity = "disneycutout", 1
        parameters["string opacitymap"] = textures.file(closure.opacity)
    if is_picture(closure.emission) and closure.kind == "disney":
        parameters["color emission"], parameters["string emissionmap"] = [1, 1, 1], textures.file(closure.emission)
        say("its picture glows, but lights other objects only by bounced light")
    second = [_maps()[name] for name in sorted(closure.over_second) if f"string {_maps().get(name)}" in parameters]
    if second:
        parameters["string secondset"] = " ".join(second)
    if reflections and max(mean(closure.numbers[name])[0] for name in ("metallic", "specular", "clearcoat")) > 0:
        parameters["float reflections"] = reflections
