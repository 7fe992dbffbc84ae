"""Blender's render passes as the channels of one picture, and back."""
from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import bpy
import numpy
import tomales

from . import exr


@dataclass(frozen=True)
class Pass:
    """One of Blender's passes, from a variable of the renderer."""

    name: str  #: Blender's.
    channels: str
    variable: str  #: The renderer's, in Display's mode.
    setting: str = ""  #: The view layer's property that asks for it; empty: always there.
    kind: str = "COLOR"


PASSES = (
    Pass("Depth", "Z", "z", "use_pass_z", "VALUE"),
    Pass("Normal", "XYZ", "normal", "use_pass_normal", "VECTOR"),
    Pass("DiffCol", "RGB", "albedo", "use_pass_diffuse_color"),
    Pass("DiffDir", "RGB", "diffuse", "use_pass_diffuse_direct"),
    Pass("DiffInd", "RGB", "indirectdiffuse", "use_pass_diffuse_indirect"),
    Pass("GlossDir", "RGB", "specular", "use_pass_glossy_direct"),
    Pass("GlossInd", "RGB", "reflection", "use_pass_glossy_indirect"),
)  # fmt: skip


def wanted(layer: bpy.types.ViewLayer) -> list[Pass]:
    return [p for p in PASSES if getattr(layer, p.setting)]


class Passes:
    """Those of one view layer, in one file."""

    def __init__(self, layer: bpy.types.ViewLayer, picture: Path) -> None:
        self._passes = wanted(layer)
        self._picture = picture

    def write(self, ri: tomales.Ri) -> None:
        """DisplayChannels and the Display. The picture is raw, so that Blender's own view transform applies."""
        for p in self._passes:
            if p.variable not in ("z", "albedo", "normal"):
                ri.DisplayChannel(f"color {p.variable}")
        mode = ",".join(["Ci", "a", *[p.variable for p in self._passes]])
        ri.Display(self._picture, "openexr", mode, {"string compression": "none", "string exrpixeltype": "float"})

    def read(self, result: bpy.types.RenderResult, to_world: numpy.ndarray) -> None:
        """Into the first layer of the result, bottom row first. `to_world` turns normals of camera space. Raises OSError."""
        channels = exr.read(self._picture)
        layer = result.layers[0]
        self._fill(layer.passes["Combined"], [channels[c] for c in "RGBA"], result)
        for p in self._passes:
            if p.name not in layer.passes:
                continue
            if p.variable == "z":
                planes = [numpy.where(numpy.isfinite(channels["Z"]), channels["Z"], 1e10)]
            else:
                suffixes = "xyz" if f"{p.variable}.x" in channels else "XYZ" if f"{p.variable}.X" in channels else "RGB"
                planes = [channels[f"{p.variable}.{c}"] for c in suffixes]
            if p.kind == "VECTOR":
                planes = list(numpy.tensordot(to_world, numpy.stack(planes), 1))
            self._fill(layer.passes[p.name], planes, result)

    @staticmethod
    def _fill(target: bpy.types.RenderPass, planes: list[numpy.ndarray], result: bpy.types.RenderResult) -> None:
        height, width = planes[0].shape
        if (width, height) != (result.resolution_x, result.resolution_y):
            raise OSError(f"the picture has {width} x {height} pixels, not {result.resolution_x} x {result.resolution_y}")
        values = numpy.stack(planes[: target.channels], -1)[::-1]
        target.rect.foreach_set(numpy.ascontiguousarray(values, "f4").reshape(-1, target.channels)) if hasattr(target.rect, "foreach_set") else setattr(target, "rect", values.reshape(-1, target.channels).tolist())
