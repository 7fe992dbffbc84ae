"""Blender's lights and world as light sources.

The units are Cycles': watts of a lamp that radiates into all directions, watts per square metre of a sun. A light of the
RISpec sends E/pi (docs/gi.md), so a pi is divided out.
"""
from __future__ import annotations

from collections.abc import Callable
from math import acos, cos, pi
from pathlib import Path

import bpy
import tomales
from mathutils import Matrix

from .camera import flat
from .textures import Textures

Warn = Callable[[str], None]


def write_light(ri: tomales.Ri, obj: bpy.types.Object, matrix: Matrix, handle: str, samples: int, warn: Warn) -> None:
    """Within an attribute block of its own; the caller illuminates with the handle."""
    light = obj.data
    ri.Attribute("light", {"string shadows": "on" if light.use_shadow else "off"})
    ri.ConcatTransform(flat(matrix.normalized() if light.type != "AREA" else matrix))
    color = list(light.color)
    if light.type == "SUN":
        ri.LightSource("distantlight", handle, {"intensity": light.energy / pi, "lightcolor": color, "point from": [0, 0, 0], "point to": [0, 0, -1]})
        if light.angle > 0.02:
            warn(f"{obj.name}: the sun has no size here, and its shadows are sharp")
    elif light.type == "AREA":
        _write_area(ri, obj, matrix, handle, samples)
    elif light.shadow_soft_size > 0 and light.type == "POINT":
        radius = light.shadow_soft_size
        radiance = light.energy / (4 * pi**2 * radius**2)
        ri.AreaLightSource("arealight", handle, {"intensity": radiance, "lightcolor": color, "float samples": samples, "float visible": 0})
        _hide_from_camera(ri)
        ri.Sphere(radius, -radius, radius, 360)
    elif light.type == "POINT":
        ri.LightSource("pointlight", handle, {"intensity": light.energy / (4 * pi**2), "lightcolor": color})
    else:
        _write_spot(ri, obj, handle, warn)


def _write_spot(ri: tomales.Ri, obj: bpy.types.Object, handle: str, warn: Warn) -> None:
    light = obj.data
    half = light.spot_size / 2
    edge = acos(min(1, cos(half) + (1 - cos(half)) * light.spot_blend))
    ri.LightSource("spotlight", handle, {
        "intensity": light.energy / (4 * pi**2), "lightcolor": list(light.color), "point from": [0, 0, 0], "point to": [0, 0, -1],
        "coneangle": half, "conedeltaangle": half - edge, "beamdistribution": 1,
    })  # fmt: skip
    if light.shadow_soft_size > 0.05:
        warn(f"{obj.name}: the spot light has no size here, and its shadows are sharp")


def _hide_from_camera(ri: tomales.Ri) -> None:
    ri.Attribute("visibility", {"int camera": 0, "int diffuse": 0, "int specular": 0, "int transmission": 0})
    ri.Surface("constant")


def _write_area(ri: tomales.Ri, obj: bpy.types.Object, matrix: Matrix, handle: str, samples: int) -> None:
    """It shines along -z of its object, from its whole size in the world.

    Cycles takes a quarter of the power over the area for its radiance, where a Lambertian emitter would have 1 / pi.
    """
    light = obj.data
    scale = matrix.to_scale()
    width, height = light.size, light.size if light.shape in ("SQUARE", "DISK") else light.size_y
    round_ = light.shape in ("DISK", "ELLIPSE")
    area = width * height * abs(scale.x * scale.y) * (pi / 4 if round_ else 1)
    ri.AreaLightSource("arealight", handle, {"intensity": light.energy / (4 * max(area, 1e-12)), "lightcolor": list(light.color), "float samples": samples, "float visible": 0})
    _hide_from_camera(ri)
    ri.Scale(width / 2, height / 2, -1)  # mirrored, so that what faces +z faces -z
    if round_:
        ri.Disk(0, 1, 360)
    else:
        ri.Polygon({"P": [[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]]})


SKY_SHADER = """surface tomales_sky(color tint = 1; string map = "";)
{
    Ci = tint;
    /* environment() turns its direction into world space: give it the one that has there what I has in this space */
    if (map != "") Ci *= environment(map, vtransform("world", "current", vtransform("shader", I)));
    Oi = 1;
}
"""

SKY_RADIUS_SHARE = 0.9  # of the far clipping distance


def write_world(ri: tomales.Ri, world: bpy.types.World, handle: str, textures: Textures, samples: int, warn: Warn) -> dict[str, object] | None:
    """A sky as a light; None if it is black. Returns parameters of the shader that shows it."""
    color, strength, image = _background(world, warn)
    tint = [c * strength for c in color]
    if max(tint) <= 0:
        return None
    path = textures.file(image) if image else None
    parameters: dict[str, object] = {"lightcolor": tint, "float samples": samples}
    if path:
        parameters.update({"string map": str(path), "string mapspace": "shader"})
    ri.Attribute("light", {"string shadows": "on"})
    ri.TransformBegin()
    ri.Scale(-1, 1, 1)  # longitudes run the other way round in Blender's panoramas
    ri.LightSource("environmentlight", handle, parameters)
    ri.TransformEnd()
    return {"color tint": tint, **({"string map": str(path)} if path else {})}


def write_sky(ri: tomales.Ri, parameters: dict[str, object], eye: Matrix, radius: float) -> None:
    """A sphere around the camera, which nothing else sees."""
    ri.AttributeBegin()
    ri.Attribute("visibility", {"int camera": 1, "int diffuse": 0, "int specular": 0, "int transmission": 0})
    ri.ConcatTransform(flat(Matrix.Translation(eye.translation)))
    ri.Scale(-1, 1, 1)
    ri.Surface("tomales_sky", parameters)
    ri.Sphere(radius, -radius, radius, 360)
    ri.AttributeEnd()


def _background(world: bpy.types.World, warn: Warn) -> tuple[list[float], float, bpy.types.Image | None]:
    """Colour, strength and panorama of the world's Background node."""
    if not world.use_nodes:
        return list(world.color), 1.0, None
    node = next((n for n in world.node_tree.nodes if n.type == "BACKGROUND"), None)
    if not node:
        warn(f"world {world.name}: it has no Background node; it is black")
        return [0, 0, 0], 0.0, None
    color, strength = node.inputs["Color"], node.inputs["Strength"].default_value
    if not color.is_linked:
        return list(color.default_value)[:3], strength, None
    source = color.links[0].from_node
    if source.type == "TEX_ENVIRONMENT" and source.image:
        return [1, 1, 1], strength, source.image
    warn(f"world {world.name}: the node {source.name} is not supported; its colour is taken as grey")
    return [0.5, 0.5, 0.5], strength, None


def write_shaders(folder: Path) -> None:
    """The shaders that worlds need, in RSL."""
    (folder / "tomales_sky.sl").write_text(SKY_SHADER)
