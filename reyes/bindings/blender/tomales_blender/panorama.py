"""Makes panoramas of a world's nodes, by running Cycles in another Blender (bake_world.py)."""
from __future__ import annotations

import subprocess
import tempfile
from dataclasses import dataclass
from math import pi
from pathlib import Path

import bpy
import numpy
from mathutils import Vector

from . import exr
from .values import Value

_WIDTH = 1024  #: A pixel is a third of a degree wide, which is less than the sun.


@dataclass
class Sun:
    toward: Vector  #: The direction to the sun, in the world's space.
    color: list[float]  #: The irradiance of a surface that faces the sun, in the units of Cycles.
    angle: float  #: The angle across the disk.


@dataclass
class Panorama:
    """Pictures over directions, in the layout of an Environment Texture."""

    whole: Value
    sunless: Value  #: The picture without the disk of the sun, because the sun becomes a light of its own.
    sun: Sun | None


def panorama_of(world: bpy.types.World, frame: int) -> Panorama:
    """Makes the panorama of a world. It replaces several suns by one between them. Raises OSError."""
    with tempfile.TemporaryDirectory(prefix="tomales_") as folder:
        library = str(Path(folder, "world.blend"))
        bpy.data.libraries.write(library, {world}, path_remap="ABSOLUTE")
        script = Path(__file__).with_name("bake_world.py")
        command = [bpy.app.binary_path, "-b", "--factory-startup", "--python-exit-code", "9", "-P", str(script), "--", library, world.name, str(frame), str(_WIDTH), folder]
        done = subprocess.run(command, capture_output=True, text=True, errors="replace")
        if done.returncode:
            raise OSError(f"Cycles has not rendered it: {(done.stderr.strip().splitlines() or [''])[-1]}")
        whole = _picture(Path(folder, "whole.exr"))
        sunless = Path(folder, "sunless.exr")
        if not sunless.exists():
            return Panorama(whole, whole, None)
        left = _picture(sunless)
    angle = next(node.sun_size for node in world.node_tree.nodes if getattr(node, "sun_disc", False))
    return Panorama(whole, left, _sun(whole - left, angle))


def _picture(path: Path) -> Value:
    channels = exr.read(path)
    return numpy.stack([channels[c] for c in "RGB"], -1)


def _sun(disk: Value, angle: float) -> Sun | None:
    """Returns the mean direction of a picture's light, and its sum over solid angle. Returns None if the picture is
    dark, as when the sun is below the horizon."""
    height, width = disk.shape[:2]
    polar, turn = numpy.arange(height + 1) / height * pi, (0.5 - (numpy.arange(width) + 0.5) / width) * 2 * pi
    solid_angle = -numpy.diff(numpy.cos(polar)) * 2 * pi / width
    by_row = polar[:-1] + pi / height / 2
    directions = numpy.stack(numpy.broadcast_arrays(numpy.sin(by_row)[:, None] * numpy.cos(turn), numpy.sin(by_row)[:, None] * numpy.sin(turn), numpy.cos(by_row)[:, None]), -1)
    sent = disk * solid_angle[:, None, None]
    toward = Vector((directions * sent.sum(-1, keepdims=True)).sum((0, 1)))
    return Sun(toward.normalized(), sent.sum((0, 1)).tolist(), angle) if toward.length > 0 else None
