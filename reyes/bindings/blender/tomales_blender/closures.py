"""Turns shader nodes into one surface with the parameters of Principled BSDF, to which mixtures of closures are
reduced."""
from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field, replace

import bpy
import numpy

from .geometry import Uses
from .nodes import Graph, Unsupported, source, uv_map
from .values import Value, constant, is_picture, matched, mean

_BLACK, _ONE = constant(0.0), constant(1.0)

#: Each parameter of disney, and the names of its Principled BSDF input in Blender 3.4 and 4.0.
_PRINCIPLED = {
    "metallic": ("Metallic",), "specular": ("Specular", "Specular IOR Level"), "speculartint": ("Specular Tint",), "roughness": ("Roughness",),
    "sheen": ("Sheen", "Sheen Weight"), "sheentint": ("Sheen Tint",), "clearcoat": ("Clearcoat", "Coat Weight"),
    "clearcoatgloss": ("Clearcoat Roughness", "Coat Roughness"),
}  # fmt: skip


def _numbers(**values: float) -> dict[str, Value]:
    """Returns the numbers of a surface without highlights. Arguments take the place of these defaults."""
    rest = {"metallic": 0, "specular": 0, "speculartint": 0, "roughness": 1, "sheen": 0, "sheentint": 0.5, "clearcoat": 0, "clearcoatgloss": 1}
    return {name: constant(float(value)) for name, value in {**rest, **values}.items()}


@dataclass
class Closure:
    kind: str  #: The kind is matte, disney or glass; or glow, which only sends light; or null, which is invisible.
    color: Value = field(default_factory=lambda: _BLACK)
    numbers: dict[str, Value] = field(default_factory=_numbers)
    opacity: Value = field(default_factory=lambda: _ONE)
    emission: Value = field(default_factory=lambda: _BLACK)
    ior: Value = field(default_factory=lambda: constant(1.45))
    vertex_color: str = ""  #: The name of the colour attribute that holds the colour.
    #: The parameters whose pictures use the material's second UV map: color, opacity, emission, and names of numbers.
    over_second: frozenset[str] = frozenset()
    normal: bpy.types.NodeSocket | None = None  #: The input that bends the normals.


class Reader:
    """Walks from a material's output to its closures."""

    def __init__(self, pixels: Callable[[bpy.types.Image], numpy.ndarray | None], say: Callable[[str], None]) -> None:
        self.graph = Graph(pixels)
        self._say = say
        self._second: str | None = None  #: The name of the material's second UV map.

    def surface(self, material: bpy.types.Material) -> Closure:
        self._second = uses_of(material).second_uv_map
        output = output_of(material)
        return self._closure(output.inputs["Surface"]) if output else Closure("glow")

    def value(self, socket: bpy.types.NodeSocket) -> Value:
        """Returns the value of an input. If it cannot be computed, this reports the node and uses the socket's own
        value."""
        try:
            return self.graph.of(socket)
        except Unsupported as problem:
            self._say(f"{problem} at {socket.name} is not followed; its default is used")
            return constant(socket.default_value)

    def is_over_second(self, socket: bpy.types.NodeSocket | None) -> bool:
        """Returns whether the pictures of an input use the second UV map. An input that mixes both maps counts as
        using the first."""
        try:
            maps = self.graph.uv_maps(socket) if socket and self._second is not None else set()
        except Unsupported:  # The method value() has already reported this node.
            return False
        if len(maps) > 1:
            self._say(f"{socket.name} mixes pictures over several UV maps; the first map counts for all")
        return maps == {self._second}

    def _closure(self, socket: bpy.types.NodeSocket) -> Closure:
        output = source(socket)
        if output is None:
            return Closure("glow")
        node = output.node
        if node.type in ("MIX_SHADER", "ADD_SHADER"):
            return self._mixed(node) if node.type == "MIX_SHADER" else _sum(*[self._closure(i) for i in node.inputs], self._say)
        if node.type in ("GROUP", "GROUP_INPUT"):
            return self.graph.across(output, self._closure)
        make = _MAKERS.get(node.type)
        if make is None:
            self._say(f"the node {node.name} is not supported; it is grey")
            return Closure("matte", constant(0.5))
        closure = make(self, node)
        closure.normal = node.inputs.get("Normal")
        return closure

    def colored(self, kind: str, socket: bpy.types.NodeSocket, **more: object) -> Closure:
        attribute = color_attribute(socket)
        if attribute:
            return Closure(kind, _ONE, vertex_color=attribute, **more)
        second = more.pop("over_second", frozenset()) | ({"color"} if self.is_over_second(socket) else set())
        return Closure(kind, self.value(socket), over_second=second, **more)

    def _mixed(self, node: bpy.types.Node) -> Closure:
        share = self.value(node.inputs[0]).clip(0, 1)
        a, b = self._closure(node.inputs[1]), self._closure(node.inputs[2])
        if not is_picture(share) and share[0] in (0, 1):
            return b if share[0] else a
        out = _between(a, b, share, self._say)
        return replace(out, over_second=out.over_second | {"opacity"}) if self.is_over_second(node.inputs[0]) else out


def output_of(material: bpy.types.Material) -> bpy.types.Node | None:
    outputs = [n for n in material.node_tree.nodes if n.type == "OUTPUT_MATERIAL" and n.is_active_output and n.target in ("ALL", "CYCLES")]
    return outputs[0] if outputs else None


def color_attribute(socket: bpy.types.NodeSocket) -> str:
    """Returns the name of the colour attribute that feeds an input, or an empty name if none does."""
    output = source(socket)
    if output and output.name == "Color" and output.node.type == "VERTEX_COLOR":
        return output.node.layer_name
    if output and output.name == "Color" and output.node.type == "ATTRIBUTE" and output.node.attribute_type == "GEOMETRY":
        return output.node.attribute_name
    return ""


def uses_of(material: bpy.types.Material | None) -> Uses:
    """Returns the UV maps and the colour attribute that the nodes read. If they read several, the first ones count."""
    if material is None or not material.use_nodes or material.tomales.shader:
        return Uses()
    maps, colors = [], []
    for node in _all_nodes(material.node_tree):
        if node.type == "TEX_IMAGE" and any(output.is_linked for output in node.outputs):
            try:
                maps.append(uv_map(node))
            except Unsupported:
                continue
        elif node.type in _MAKERS:
            colors.append(color_attribute(_input(node, ("Base Color", "Color"))))
    first, second = [*dict.fromkeys(maps), None, None][:2]
    return Uses(first or "", second, next(filter(None, colors), ""))


def _all_nodes(tree: bpy.types.NodeTree | None) -> Iterator[bpy.types.Node]:
    for node in tree.nodes if tree else ():
        if node.type == "GROUP":
            yield from _all_nodes(node.node_tree)
        else:
            yield node


def _between(a: Closure, b: Closure, share: Value, say: Callable[[str], None]) -> Closure:
    """Returns (1 - share) a + share b. It mixes the parameters, which is exact for proportions and nearly right for
    others.

    If one of two mixed pictures uses the second UV map, both are taken to use it.
    """
    rest = 1 - share
    if a.kind == "null" or b.kind == "null":
        there, weight = (b, share) if a.kind == "null" else (a, rest)
        return replace(there, opacity=_product(there.opacity, weight), emission=_product(there.emission, weight))
    emission = _lerp(a.emission, b.emission, share)
    if a.kind == "glow" or b.kind == "glow":
        there, weight = (b, share) if a.kind == "glow" else (a, rest)
        return replace(there, color=_product(there.color, weight), emission=emission)
    if "glass" in (a.kind, b.kind):
        if a.kind != b.kind:
            say("a mixture with glass becomes the one with the larger share")
        return b if mean(share)[0] > 0.5 else a
    numbers = {name: _lerp(a.numbers[name], b.numbers[name], share) for name in a.numbers}
    kind = "matte" if a.kind == b.kind == "matte" else "disney"
    if a.vertex_color != b.vertex_color:
        say("a mixture of colour attributes uses only the first")
    return Closure(kind, _lerp(a.color, b.color, share), numbers, _lerp(a.opacity, b.opacity, share), emission, a.ior, a.vertex_color or b.vertex_color, a.over_second | b.over_second, a.normal or b.normal)


def _sum(a: Closure, b: Closure, say: Callable[[str], None]) -> Closure:
    emission = numpy.add(*matched([a.emission, b.emission]))
    for one, other in ((a, b), (b, a)):
        if one.kind in ("glow", "null"):
            return replace(other, emission=emission)
    if {a.kind, b.kind} == {"matte"}:
        return replace(a, color=numpy.add(*matched([a.color, b.color])), emission=emission)
    shiny, dull = (a, b) if a.kind != "matte" else (b, a)
    say("a sum of closures keeps the brighter colour, and the highlights of only one")
    return replace(shiny, kind="disney", emission=emission) if max(mean(shiny.color)) > max(mean(dull.color)) else replace(dull, kind="disney", numbers=shiny.numbers, emission=emission)


def _lerp(a: Value, b: Value, share: Value) -> Value:
    a, b, share = matched([a, b, share])
    return a + share * (b - a)


def _product(a: Value, b: Value) -> Value:
    return numpy.multiply(*matched([a, b]))


def _input(node: bpy.types.Node, names: tuple[str, ...]) -> bpy.types.NodeSocket | None:
    return next((node.inputs[name] for name in names if name in node.inputs), None)


def _principled(reader: Reader, node: bpy.types.Node) -> Closure:
    transmission = reader.value(_input(node, ("Transmission", "Transmission Weight")))
    emitted, strength = _input(node, ("Emission", "Emission Color")), node.inputs.get("Emission Strength")
    emission = _product(reader.value(emitted), reader.value(strength))
    sockets = {name: _input(node, inputs) for name, inputs in _PRINCIPLED.items()}
    sockets = {name: socket for name, socket in sockets.items() if socket and socket.type == "VALUE"}  # Since Blender 4.0 this input is a colour, but disney takes a number.
    numbers = {**_numbers(), **{name: reader.value(socket) for name, socket in sockets.items()}}
    numbers["clearcoatgloss"] = 1 - numbers["clearcoatgloss"]
    second = frozenset(name for name, socket in {**sockets, "opacity": node.inputs["Alpha"], "emission": emitted}.items() if reader.is_over_second(socket))
    more = {"numbers": numbers, "opacity": reader.value(node.inputs["Alpha"]), "emission": emission, "ior": reader.value(node.inputs["IOR"]), "over_second": second}
    return reader.colored("glass" if mean(transmission)[0] > 0.5 else "disney", node.inputs["Base Color"], **more)


def _emission(reader: Reader, node: bpy.types.Node) -> Closure:
    return Closure("glow", emission=_product(reader.value(node.inputs["Color"]), reader.value(node.inputs["Strength"])))


def _diffuse(reader: Reader, node: bpy.types.Node) -> Closure:
    return reader.colored("matte", node.inputs["Color"])


def _glossy(reader: Reader, node: bpy.types.Node) -> Closure:
    rough = node.inputs["Roughness"]
    second = frozenset({"roughness"} if reader.is_over_second(rough) else ())
    return reader.colored("disney", node.inputs["Color"], numbers={**_numbers(metallic=1), "roughness": reader.value(rough)}, over_second=second)


def _glass(reader: Reader, node: bpy.types.Node) -> Closure:
    return reader.colored("glass", node.inputs["Color"], ior=reader.value(node.inputs["IOR"]))


def _transparent(reader: Reader, node: bpy.types.Node) -> Closure:
    return Closure("null")


_MAKERS: dict[str, Callable[[Reader, bpy.types.Node], Closure]] = {
    "BSDF_PRINCIPLED": _principled, "EMISSION": _emission, "BSDF_DIFFUSE": _diffuse, "BSDF_GLOSSY": _glossy, "BSDF_GLASS": _glass,
    "BSDF_REFRACTION": _glass, "BSDF_TRANSPARENT": _transparent, "BSDF_VELVET": _diffuse,
}  # fmt: skip
