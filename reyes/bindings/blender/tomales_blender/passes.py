"""Converts Blender's render passes to the channels of one picture, and back."""
from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import bpy
import numpy
import tomales

from . import exr

_FAR = 1e10  #: The depth that Blender stores where there is nothing.
#: The renderer's Cryptomatte variables, with the names of Blender's passes (also used in the file) and the settings
#: that ask for them.
_MATTES = {"cryptoobject": ("CryptoObject", "use_pass_cryptomatte_object"), "cryptomaterial": ("CryptoMaterial", "use_pass_cryptomatte_material")}
_MATTE_PASSES = 3  #: The number of passes in the file for each matte. Each pass has two ranks.


@dataclass(frozen=True)
class Pass:
    """A pass of Blender that a variable of the renderer fills."""

    name: str  #: Blender's name.
    channels: str
    variable: str = ""  #: The renderer's variable, in the mode of a Display. If it is empty, there is none and the pass is white.
    setting: str = ""  #: The view layer's property that asks for the pass.
    kind: str = "COLOR"
    declared: str = ""  #: The type for DisplayChannel, if this is no standard variable of surfaces.
    source: str = ""  #: The parameters of DisplayChannel.
    is_light: bool = False  #: Whether the surface's colour is divided out, because Cycles keeps it in a pass of its own.
    own: bool = False  #: Whether this pass must be registered with Blender, because it is not built in.

    def plane_names(self) -> list[str]:
        """Returns the names of the pass's channels in the file."""
        if self.variable == "z":
            return ["Z"]
        if self.variable in _MATTES:
            return [f"{self.name}.{c}" for c in "RGBA"]
        if self.declared == "float":
            return [self.variable]
        return [f"{self.variable}.{c}" for c in ("XYZ" if self.kind == "VECTOR" and not self.declared else "RGB")]


PASSES = (
    Pass("Depth", "Z", "z", "use_pass_z", "VALUE"),
    Pass("Normal", "XYZ", "normal", "use_pass_normal", "VECTOR"),
    Pass("Position", "XYZ", "P", "use_pass_position", "VECTOR"),
    Pass("DiffCol", "RGB", "albedo", "use_pass_diffuse_color"),
    Pass("DiffDir", "RGB", "diffuse", "use_pass_diffuse_direct", declared="color", is_light=True),
    Pass("DiffInd", "RGB", "indirectdiffuse", "use_pass_diffuse_indirect", declared="color", is_light=True),
    Pass("GlossCol", "RGB", "", "use_pass_glossy_color"),
    Pass("GlossDir", "RGB", "specular", "use_pass_glossy_direct", declared="color"),
    Pass("GlossInd", "RGB", "reflection", "use_pass_glossy_indirect", declared="color"),
)  # fmt: skip


def wanted(layer: bpy.types.ViewLayer) -> list[Pass]:
    """Returns the passes that are switched on, the AOVs (shader outputs by name) and the light groups."""
    out = [p for p in PASSES if getattr(layer, p.setting)]
    for aov in layer.aovs:
        if aov.is_valid and aov.name.isidentifier():
            color = aov.type == "COLOR"
            out.append(Pass(aov.name, "RGBA" if color else "X", aov.name, "", "COLOR" if color else "VALUE", "color" if color else "float", own=True))
    for variable, (name, setting) in _MATTES.items():
        if getattr(layer, setting):
            passes = min(_MATTE_PASSES, (layer.pass_cryptomatte_depth + 1) // 2)
            out += [Pass(f"{name}{i:02}", "RGBA", variable, own=True) for i in range(passes)]
    for i, group in enumerate(layer.lightgroups):
        out.append(Pass(f"Combined_{group.name}", "RGB", f"lightgroup{i}", declared="color", source=f"lightgroup:{group.name}", own=True))
    return out


class Passes:
    """The passes of one view layer, which share one file."""

    def __init__(self, layer: bpy.types.ViewLayer, folder: Path, name: str) -> None:
        """`name` is the path of the picture, relative to the folder in which the renderer runs."""
        self._passes = wanted(layer)
        self._folder = folder
        self._name = name
        self._settings = {p.variable: p for p in self._passes if p.variable}
        if any(p.is_light for p in self._passes):
            self._settings.setdefault("albedo", PASSES[3])

    def write(self, ri: tomales.Ri) -> None:
        """Writes the DisplayChannels and the Display. The picture is linear, so that Blender's own view transform
        applies."""
        for p in self._settings.values():
            if p.declared:
                ri.DisplayChannel(f"{p.declared} {p.variable}", {"string source": p.source} if p.source else {})
        ri.Display(self._name, "openexr", ",".join(["Ci", "a", *self._settings]), {"string compression": "none", "string exrpixeltype": "float"})

    def read(self, result: bpy.types.RenderResult, to_world: numpy.ndarray) -> None:
        """Puts the picture into the result's layer, with the bottom row first. `to_world` is a matrix of 4 x 4 from
        camera space. Raises OSError."""
        channels = exr.read(self._folder / self._name)
        planes_of = lambda names: numpy.stack([_channel(channels, name) for name in names])  # noqa: E731
        layer = result.layers[0]
        fill(layer.passes["Combined"], planes_of("RGBA"), result)
        for p in self._passes:
            if p.name in layer.passes:
                planes = planes_of(p.plane_names()) if p.variable else numpy.ones((3, *channels["A"].shape), "f4")
                fill(layer.passes[p.name], self._converted(p, planes, planes_of, to_world), result)

    def stamp(self, layer: str, result: bpy.types.RenderResult) -> None:
        """Stores which names the numbers of mattes stand for, where Blender's compositor looks for them. `result` is
        the engine's result with all its layers. Raises OSError."""
        if not any(p.variable in _MATTES for p in self._passes):
            return
        for key, value in exr.texts(self._folder / self._name).items():
            if key.startswith("cryptomatte/"):
                result.stamp_data_add_field(key, f"{layer}.{value}" if key.endswith("/name") else value)

    def _converted(self, p: Pass, planes: numpy.ndarray, planes_of: Callable[[list[str]], numpy.ndarray], to_world: numpy.ndarray) -> numpy.ndarray:
        """Converts the channels to Blender's conventions."""
        if p.variable == "z":
            return numpy.where(numpy.isfinite(planes), planes, _FAR)
        if p.kind == "VECTOR":
            there = planes_of(["A"]) if p.variable == "P" else 0
            return numpy.tensordot(to_world[:3, :3], planes, 1) + to_world[:3, 3, None, None] * there
        if p.is_light:
            color = planes_of(PASSES[3].plane_names())
            return numpy.divide(planes, color, out=numpy.zeros_like(planes), where=color > 0)
        return numpy.concatenate([planes, planes_of(["A"])]) if p.channels == "RGBA" and p.variable not in _MATTES else planes


def fill(target: bpy.types.RenderPass, planes: numpy.ndarray, result: bpy.types.RenderResult) -> None:
    """Puts planes of shape (channels, height, width), with the top row first, into a pass of the result. Raises
    OSError."""
    _, height, width = planes.shape
    if (width, height) != (result.resolution_x, result.resolution_y):
        raise OSError(f"the picture has {width} x {height} pixels, not {result.resolution_x} x {result.resolution_y}")
    values = planes[: target.channels].transpose(1, 2, 0)[::-1]
    target.rect.foreach_set(numpy.ascontiguousarray(values, "f4").reshape(-1, target.channels)) if hasattr(target.rect, "foreach_set") else setattr(target, "rect", values.reshape(-1, target.channels).tolist())


def _channel(channels: dict[str, numpy.ndarray], name: str) -> numpy.ndarray:
    if name not in channels:
        raise OSError(f"the picture has no channel {name}")
    return channels[name]
