"""Computes the values of nodes. They are whole arrays (values.py), so a graph becomes a constant or one picture."""
from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import bpy
import numpy

from .values import Value, constant, gray, looked_up, matched

_MOST_PIXELS = 4096  #: The number of pixels along an edge of a picture that is computed.


class Unsupported(Exception):
    """A node that cannot be computed. The text of the exception names it."""


class Graph:
    """The values of a material's node tree."""

    def __init__(self, pixels: Callable[[bpy.types.Image], numpy.ndarray | None]) -> None:
        """`pixels` returns an image as a linear array of four channels, or None."""
        self._pixels = pixels
        self._known: dict[tuple, Value] = {}
        self._groups: list[bpy.types.Node] = []  #: The groups that contain the current node, with the innermost last.

    def of(self, socket: bpy.types.NodeSocket) -> Value:
        """Returns the value that arrives at an input. Raises Unsupported."""
        link = source(socket)
        if link is None:
            return constant(getattr(socket, "default_value", 0.0))
        value = self._output(link)
        return gray(value) if socket.type in ("VALUE", "INT", "BOOLEAN") else value

    def _output(self, output: bpy.types.NodeSocket) -> Value:
        key = (*(group.as_pointer() for group in self._groups), output.as_pointer())
        if key not in self._known:
            make = _NODES.get(output.node.type)
            if make is None:
                raise Unsupported(output.node.name)
            self._known[key] = make(self, output.node, output)
        return self._known[key]

    def across(self, output: bpy.types.NodeSocket, visit: Callable[[bpy.types.NodeSocket], Any]) -> Any:
        """Crosses the border of a group: visits the input inside that feeds an output of the group, or the input
        outside that feeds an input of the group."""
        node = output.node
        i = list(node.outputs).index(output)
        if node.type == "GROUP":
            inner = next((n for n in node.node_tree.nodes if n.type == "GROUP_OUTPUT" and n.is_active_output), None) if node.node_tree else None
            if inner is None:
                raise Unsupported(node.name)
            within, there = [*self._groups, node], inner.inputs[i]
        else:
            if not self._groups:
                raise Unsupported(node.name)
            within, there = self._groups[:-1], self._groups[-1].inputs[i]
        before, self._groups = self._groups, within
        try:
            return visit(there)
        finally:
            self._groups = before

    def uv_maps(self, socket: bpy.types.NodeSocket) -> set[str]:
        """Returns the UV maps of the pictures that feed an input. An empty name means the active map. Raises
        Unsupported."""
        output = source(socket)
        if output is None:
            return set()
        if output.node.type in ("GROUP", "GROUP_INPUT"):
            return self.across(output, self.uv_maps)
        if output.node.type == "TEX_IMAGE":
            return {uv_map(output.node)}
        return set().union(*(self.uv_maps(i) for i in output.node.inputs))

    def image(self, node: bpy.types.Node, output: bpy.types.NodeSocket) -> Value:
        pixels = self._pixels(node.image) if node.image else None
        if pixels is None:
            raise Unsupported(node.name)
        values = pixels[..., :3] if output.name == "Color" else numpy.repeat(pixels[..., 3:4], 3, -1)
        return _mapped(values, node)


def source(socket: bpy.types.NodeSocket) -> bpy.types.NodeSocket | None:
    """Returns the output that feeds an input, through reroutes, or None if nothing feeds it."""
    while socket.is_linked:
        output = socket.links[0].from_socket
        if output.node.type != "REROUTE":
            return output
        socket = output.node.inputs[0]
    return None


def uv_map(node: bpy.types.Node) -> str:
    """Returns the UV map that an Image Texture reads. An empty name means the active map. Raises Unsupported for
    other coordinates."""
    output = source(node.inputs["Vector"])
    if output and output.node.type == "MAPPING":
        output = source(output.node.inputs["Vector"])
    if output is None or output.node.type == "TEX_COORD" and output.name == "UV":
        return ""
    if output.node.type == "UVMAP":
        return output.node.uv_map
    raise Unsupported(f"{output.node.name} at {node.name}")


def _mapped(picture: Value, node: bpy.types.Node) -> Value:
    """Returns the picture over texture coordinates from 0 to 1, after a Mapping node."""
    output = source(node.inputs["Vector"])
    if node.type == "TEX_ENVIRONMENT":  # The picture lies over directions.
        return picture
    uv_map(node)
    if output is None or output.node.type != "MAPPING":
        return picture
    mapping = output.node
    if mapping.vector_type not in ("POINT", "TEXTURE") or any(i.is_linked for i in list(mapping.inputs)[1:]):
        raise Unsupported(mapping.name)
    move, scale = (mapping.inputs[name].default_value if name in mapping.inputs else one for name, one in (("Location", (0, 0, 0)), ("Scale", (1, 1, 1))))
    turn = mapping.inputs["Rotation"].default_value.z
    share = max(1, math.ceil(max(abs(scale[0]), abs(scale[1])))) if mapping.vector_type == "POINT" else 1
    height, width = (min(_MOST_PIXELS, size * share) for size in picture.shape[:2])
    row, column = numpy.mgrid[0:height, 0:width]
    u, v = (column + 0.5) / width, 1 - (row + 0.5) / height
    cosine, sine = math.cos(turn), math.sin(turn)
    if mapping.vector_type == "POINT":
        u, v = u * scale[0], v * scale[1]
        u, v = cosine * u - sine * v + move[0], sine * u + cosine * v + move[1]
    else:  # A Mapping node of this kind moves, turns and scales the picture itself.
        u, v = u - move[0], v - move[1]
        u, v = (cosine * u + sine * v) / (scale[0] or 1), (-sine * u + cosine * v) / (scale[1] or 1)
    return looked_up(picture, u, 1 - v)


def _inputs(graph: Graph, node: bpy.types.Node, *names: str) -> list[Value]:
    return matched([graph.of(node.inputs[name]) for name in names])


def _default(graph: Graph, node: bpy.types.Node, output: bpy.types.NodeSocket) -> Value:
    return constant(output.default_value)


_BLENDS: dict[str, Callable[[Value, Value], Value]] = {
    "MIX": lambda a, b: b, "ADD": lambda a, b: a + b, "MULTIPLY": lambda a, b: a * b, "SUBTRACT": lambda a, b: a - b,
    "SCREEN": lambda a, b: 1 - (1 - a) * (1 - b), "DIFFERENCE": lambda a, b: abs(a - b),
    "DARKEN": numpy.minimum, "LIGHTEN": numpy.maximum,
    "DIVIDE": lambda a, b: numpy.divide(a, b, out=numpy.array(numpy.broadcast_to(a, numpy.broadcast_shapes(a.shape, b.shape))), where=b != 0),
    "OVERLAY": lambda a, b: numpy.where(a < 0.5, 2 * a * b, 1 - 2 * (1 - a) * (1 - b)),
}  # fmt: skip


def _mix(graph: Graph, node: bpy.types.Node, output: bpy.types.NodeSocket) -> Value:
    """Computes the node Mix of Blender 3.4, and MixRGB of earlier versions. One Mix node has sockets of the same
    names for every data type."""
    inputs = [i for i in node.inputs if i.enabled]
    factor, a, b = matched([graph.of(i) for i in inputs[:3]])
    kind = getattr(node, "data_type", "RGBA")
    blend = node.blend_type if kind == "RGBA" else "MIX"
    if blend not in _BLENDS:
        raise Unsupported(f"{node.name} ({blend.lower()})")
    if getattr(node, "clamp_factor", True):
        factor = factor.clip(0, 1)
    out = a + factor * (_BLENDS[blend](a, b) - a)
    return out.clip(0, 1) if getattr(node, "clamp_result", getattr(node, "use_clamp", False)) else out


_MATH: dict[str, Callable[..., Value]] = {
    "ADD": lambda a, b, c: a + b, "SUBTRACT": lambda a, b, c: a - b, "MULTIPLY": lambda a, b, c: a * b,
    "DIVIDE": lambda a, b, c: numpy.where(b == 0, 0, a / numpy.where(b == 0, 1, b)), "MULTIPLY_ADD": lambda a, b, c: a * b + c,
    "POWER": lambda a, b, c: numpy.power(numpy.maximum(a, 0), b), "SQRT": lambda a, b, c: numpy.sqrt(numpy.maximum(a, 0)),
    "ABSOLUTE": lambda a, b, c: abs(a), "MINIMUM": lambda a, b, c: numpy.minimum(a, b), "MAXIMUM": lambda a, b, c: numpy.maximum(a, b),
    "LESS_THAN": lambda a, b, c: (a < b) * 1.0, "GREATER_THAN": lambda a, b, c: (a > b) * 1.0, "FRACT": lambda a, b, c: a - numpy.floor(a),
    "FLOOR": lambda a, b, c: numpy.floor(a), "CEIL": lambda a, b, c: numpy.ceil(a), "ROUND": lambda a, b, c: numpy.floor(a + 0.5),
    "SINE": lambda a, b, c: numpy.sin(a), "COSINE": lambda a, b, c: numpy.cos(a),
}  # fmt: skip


def _math(graph: Graph, node: bpy.types.Node, output: bpy.types.NodeSocket) -> Value:
    if node.operation not in _MATH:
        raise Unsupported(f"{node.name} ({node.operation.lower()})")
    used = [graph.of(i) if i.enabled else constant(0.0) for i in node.inputs]
    out = _MATH[node.operation](*matched(used)).astype("f4")
    return out.clip(0, 1) if node.use_clamp else out


def _invert(graph: Graph, node: bpy.types.Node, output: bpy.types.NodeSocket) -> Value:
    factor, color = _inputs(graph, node, "Fac", "Color")
    return color + factor * (1 - 2 * color)


def _gamma(graph: Graph, node: bpy.types.Node, output: bpy.types.NodeSocket) -> Value:
    color, gamma = _inputs(graph, node, "Color", "Gamma")
    return numpy.power(numpy.maximum(color, 0), gamma)


def _contrast(graph: Graph, node: bpy.types.Node, output: bpy.types.NodeSocket) -> Value:
    color, bright, contrast = _inputs(graph, node, "Color", "Bright", "Contrast")
    return numpy.maximum((1 + contrast) * color + bright - contrast / 2, 0)


def _hue(graph: Graph, node: bpy.types.Node, output: bpy.types.NodeSocket) -> Value:
    hue, saturation, value, factor, color = _inputs(graph, node, "Hue", "Saturation", "Value", "Fac", "Color")
    h, s, v = _hsv(color)
    h = (h + hue[..., 0] + 0.5) % 1
    s = (s * saturation[..., 0]).clip(0, 1)
    turned = numpy.stack(numpy.broadcast_arrays(h, s, v * value[..., 0]), -1)
    return color + factor * (numpy.maximum(_rgb(turned), 0) - color)


def _hsv(color: Value) -> tuple[numpy.ndarray, numpy.ndarray, numpy.ndarray]:
    most, least = color.max(-1), color.min(-1)
    span = numpy.where(most == least, 1, most - least)
    r, g, b = (color[..., i] for i in range(3))
    hue = numpy.where(most == r, (g - b) / span % 6, numpy.where(most == g, (b - r) / span + 2, (r - g) / span + 4)) / 6
    return numpy.where(most == least, 0, hue), numpy.where(most > 0, (most - least) / numpy.where(most > 0, most, 1), 0), most


def _rgb(hsv: Value) -> Value:
    h, s, v = (hsv[..., i : i + 1] for i in range(3))
    ramp = abs(h * 6 - numpy.array([3, 2, 4]))
    shares = numpy.concatenate([ramp[..., :1] - 1, 2 - ramp[..., 1:2], 2 - ramp[..., 2:3]], -1).clip(0, 1)
    return (v * (1 + s * (shares - 1))).astype("f4")


def _ramp(graph: Graph, node: bpy.types.Node, output: bpy.types.NodeSocket) -> Value:
    steps = 1024
    table = numpy.array([list(node.color_ramp.evaluate(i / (steps - 1))) for i in range(steps)], "f4")
    table = table[:, :3] if output.name == "Color" else numpy.repeat(table[:, 3:4], 3, 1)
    (factor,) = _inputs(graph, node, "Fac")
    return table[(factor[..., 0].clip(0, 1) * (steps - 1) + 0.5).astype(int)]


def _clamp(graph: Graph, node: bpy.types.Node, output: bpy.types.NodeSocket) -> Value:
    value, least, most = _inputs(graph, node, "Value", "Min", "Max")
    return numpy.minimum(numpy.maximum(value, least), most)


def _range(graph: Graph, node: bpy.types.Node, output: bpy.types.NodeSocket) -> Value:
    if node.interpolation_type != "LINEAR" or getattr(node, "data_type", "FLOAT") != "FLOAT":
        raise Unsupported(node.name)
    value, a, b, c, d = _inputs(graph, node, "Value", "From Min", "From Max", "To Min", "To Max")
    share = (value - a) / numpy.where(a == b, 1, b - a)
    return c + (share.clip(0, 1) if node.clamp else share) * (d - c)


def _separate(graph: Graph, node: bpy.types.Node, output: bpy.types.NodeSocket) -> Value:
    if getattr(node, "mode", "RGB") != "RGB":
        raise Unsupported(node.name)
    i = list(node.outputs).index(output)
    return numpy.repeat(graph.of(node.inputs[0])[..., i : i + 1], 3, -1)


def _combine(graph: Graph, node: bpy.types.Node, output: bpy.types.NodeSocket) -> Value:
    if getattr(node, "mode", "RGB") != "RGB":
        raise Unsupported(node.name)
    channels = matched([graph.of(i) for i in list(node.inputs)[:3]])
    return numpy.stack(numpy.broadcast_arrays(*[c[..., 0] for c in channels]), -1)


def _curves(graph: Graph, node: bpy.types.Node, output: bpy.types.NodeSocket) -> Value:
    factor, color = _inputs(graph, node, "Fac", "Color")
    steps, curves = 1024, node.mapping
    curves.initialize()
    at = numpy.linspace(0, 1, steps)
    master = numpy.array([curves.evaluate(curves.curves[3], x) for x in at])
    tables = [numpy.interp(master, at, [curves.evaluate(curves.curves[i], x) for x in at]) for i in range(3)]
    bent = numpy.stack([numpy.interp(color[..., i], at, tables[i]) for i in range(3)], -1).astype("f4")
    return color + factor * (bent - color)


def _across(graph: Graph, node: bpy.types.Node, output: bpy.types.NodeSocket) -> Value:
    return graph.across(output, graph.of)


_NODES: dict[str, Callable[[Graph, bpy.types.Node, bpy.types.NodeSocket], Value]] = {
    "RGB": _default, "VALUE": _default, "MIX": _mix, "MIX_RGB": _mix, "MATH": _math, "INVERT": _invert, "GAMMA": _gamma,
    "BRIGHTCONTRAST": _contrast, "HUE_SAT": _hue, "VALTORGB": _ramp, "CLAMP": _clamp, "MAP_RANGE": _range,
    "RGBTOBW": lambda graph, node, output: gray(graph.of(node.inputs[0])), "CURVE_RGB": _curves,
    "SEPRGB": _separate, "SEPARATE_COLOR": _separate, "COMBRGB": _combine, "COMBINE_COLOR": _combine,
    "TEX_IMAGE": Graph.image, "TEX_ENVIRONMENT": Graph.image, "GROUP": _across, "GROUP_INPUT": _across,
}  # fmt: skip
