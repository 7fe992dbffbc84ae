"""Writes Blender's lights as light sources.

The units are those of Cycles: watts for a lamp, which counts as radiating into all directions, and watts per square
metre for a sun. A light of the RISpec sends E/pi (docs/gi.md), so a pi is divided out.
"""
from __future__ import annotations

from math import acos, cos, pi, tan

import bpy
import tomales
from mathutils import Matrix

from .camera import flat


def write_light(ri: tomales.Ri, obj: bpy.types.Object, matrix: Matrix, handle: str, samples: int) -> None:
    """Writes a lamp in an attribute block of its own. The caller switches it on by the handle."""
    light = obj.data
    ri.Attribute("light", {"string shadows": "on" if light.use_shadow else "off"})
    ri.ConcatTransform(flat(matrix.normalized() if light.type != "AREA" else matrix))
    common: dict[str, object] = {"lightcolor": list(light.color), **group_of(obj)}
    if light.type == "SUN":
        write_sun(ri, light.angle, light.energy, handle, samples, common)
    elif light.type == "AREA":
        _write_area(ri, light, matrix, handle, samples, common)
    elif light.type == "SPOT":
        _write_point(ri, light, handle, samples, {**common, **_cone(light)})
    else:
        _write_point(ri, light, handle, samples, common)


def group_of(owner: bpy.types.Object | bpy.types.World) -> dict[str, object]:
    """Returns the light group as a parameter, so that the group can have a pass of its own."""
    name = getattr(owner, "lightgroup", "")
    return {"uniform string __group": name} if name else {}


def _emit(ri: tomales.Ri, handle: str, radiance: float, samples: int, common: dict[str, object]) -> None:
    """Makes the geometry that follows a lamp that neither the camera nor rays see."""
    ri.AreaLightSource("arealight", handle, {"intensity": radiance, "float samples": samples, "float visible": 0, **common})
    ri.Attribute("visibility", {"int camera": 0, "int diffuse": 0, "int specular": 0, "int transmission": 0})
    ri.Surface("constant")


_SUN_DISTANCE = 1e6  # From here, a scene of a kilometre sees the sun in one direction to within a milliradian.


def write_sun(ri: tomales.Ri, angle: float, energy: float, handle: str, samples: int, common: dict[str, object]) -> None:
    """Writes a sun, which stands at +z. Its strength is the irradiance of a surface that faces it. It is a disk of
    the given angle, so its shadows are soft."""
    if angle < 1e-4:
        ri.LightSource("distantlight", handle, {"intensity": energy / pi, "point from": [0, 0, 0], "point to": [0, 0, -1], **common})
        return
    radius = tan(min(angle, pi - 0.01) / 2) * _SUN_DISTANCE
    _emit(ri, handle, energy * (1 + (_SUN_DISTANCE / radius) ** 2) / pi, samples, common)
    ri.Translate(0, 0, _SUN_DISTANCE)
    ri.Scale(radius, radius, -1)
    ri.Disk(0, 1, 360)


def _cone(light: bpy.types.SpotLight) -> dict[str, object]:
    half = light.spot_size / 2
    edge = acos(min(1, cos(half) + (1 - cos(half)) * light.spot_blend))
    return {"coneangle": half, "conedeltaangle": half - edge, "beamdistribution": 1}


def _write_point(ri: tomales.Ri, light: bpy.types.PointLight | bpy.types.SpotLight, handle: str, samples: int, common: dict[str, object]) -> None:
    """Writes a ball of the light's radius. A spot is such a ball that shines into a cone along -z."""
    radius, is_spot = light.shadow_soft_size, "coneangle" in common
    if radius > 0:
        axis = {"vector axis": [0, 0, -1]} if is_spot else {}
        _emit(ri, handle, light.energy / (4 * pi**2 * radius**2), samples, {**common, **axis})
        ri.Sphere(radius, -radius, radius, 360)
    else:
        places = {"point from": [0, 0, 0], "point to": [0, 0, -1]} if is_spot else {}
        ri.LightSource("spotlight" if is_spot else "pointlight", handle, {"intensity": light.energy / (4 * pi**2), **places, **common})


def _write_area(ri: tomales.Ri, light: bpy.types.AreaLight, matrix: Matrix, handle: str, samples: int, common: dict[str, object]) -> None:
    """Writes a lamp that shines along -z of its object, with the size that it has in the world.

    Its radiance is a quarter of the power over the area, as in Cycles. A Lambertian emitter would have 1 / pi instead of a
    quarter.
    """
    scale = matrix.to_scale()
    width, height = light.size, light.size if light.shape in ("SQUARE", "DISK") else light.size_y
    round_ = light.shape in ("DISK", "ELLIPSE")
    area = width * height * abs(scale.x * scale.y) * (pi / 4 if round_ else 1)
    _emit(ri, handle, light.energy / (4 * max(area, 1e-12)), samples, common)
    ri.Scale(width / 2, height / 2, -1)  # This mirrors the shape, so that it faces -z instead of +z.
    if round_:
        ri.Disk(0, 1, 360)
    else:
        ri.Polygon({"P": [[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]]})
