"""Turns Bump nodes, normal maps and displacement into one displacement shader, which reads pictures of heights and
normals."""
from __future__ import annotations

from collections.abc import Callable
from typing import Any

import bpy

from .closures import Reader, output_of
from .nodes import source
from .textures import Textures
from .values import constant, gray, is_picture

#: The shader in RSL. It takes slopes between the vertices of the grid, so bumps are as fine as micropolygons.
SHADER = """displacement tomales_relief(
    string heightmap = "";  /* heights over the texture coordinates */
    float scale = 1;        /* length of height 1 */
    float midlevel = 0;     /* the height that stays where it is */
    float moves = 0;        /* 1: the surface moves, by lengths of the object's space; 0: its normals alone turn */
    string normalmap = "";  /* normals in the space of tangents, as colours; the second tangent points up in the picture */
    float strength = 1;     /* of the normal map */
    float heightset = 1;    /* 2: the heights are over s1, t1 */
    float normalset = 1;    /* 2: the normals are */
    varying float s1 = 0;
    varying float t1 = 0;
)
{
    normal n = normalize(N);
    normal bent = n;
    if (normalmap != "") {
        float ss = normalset == 2 ? s1 : s;
        float tt = normalset == 2 ? t1 : t;
        float det = Du(ss) * Dv(tt) - Dv(ss) * Du(tt);
        if (det != 0) {
            vector right = normalize((Du(P) * Dv(tt) - Dv(P) * Du(tt)) / det);
            vector up = normalize((Du(P) * Dv(ss) - Dv(P) * Du(ss)) / det);
            color c = 2 * color texture(normalmap, ss, tt) - color(1);
            bent = normalize(strength * (c[0] * right + c[1] * up) + mix(1, c[2], strength) * n);
        }
    }
    if (heightmap != "") {
        float ss = heightset == 2 ? s1 : s;
        float tt = heightset == 2 ? t1 : t;
        float height = scale * (float texture(heightmap[0], ss, tt) - midlevel);
        if (moves == 1) height *= length(vtransform("object", "current", normalize(vtransform("object", n))));
        point moved = P + height * n;
        bent = normalize(bent + normalize(calculatenormal(moved)) - normalize(calculatenormal(P)));
        if (moves == 1) P = moved;
    }
    N = bent;
}
"""


def relief_of(material: bpy.types.Material, reader: Reader, textures: Textures, say: Callable[[str], None]) -> tuple[dict[str, Any] | None, float]:
    """Returns the parameters of the shader (None if the surface is smooth), and how far it moves the surface in the
    object's space."""
    parameters: dict[str, Any] = {}
    bound = 0.0
    output = output_of(material)
    if output is None:
        return None, 0.0
    shader = source(output.inputs["Surface"])
    if shader and "Normal" in shader.node.inputs:
        _add_normal(parameters, shader.node.inputs["Normal"], reader, textures, say)
    displaced = source(output.inputs["Displacement"])
    if displaced and displaced.node.type == "DISPLACEMENT":
        bound = _add_displacement(parameters, displaced.node, material, reader, textures, say)
    elif displaced:
        say(f"{displaced.node.name} at Displacement is not followed")
    return parameters or None, bound


def _add_normal(parameters: dict[str, Any], socket: bpy.types.NodeSocket, reader: Reader, textures: Textures, say: Callable[[str], None]) -> None:
    output = source(socket)
    if output is None:
        return
    node = output.node
    if node.type == "BUMP":
        sign = -1 if node.invert else 1
        scale = sign * reader.value(node.inputs["Strength"])[..., 0].mean() * reader.value(node.inputs["Distance"])[..., 0].mean()
        _add_heights(parameters, node.inputs["Height"], float(scale), 0, reader, textures)
        _add_normal(parameters, node.inputs["Normal"], reader, textures, say)
    elif node.type == "NORMAL_MAP" and node.space == "TANGENT":
        picture = reader.value(node.inputs["Color"])
        if is_picture(picture):
            parameters["string normalmap"] = textures.file(picture)
            parameters["float strength"] = float(reader.value(node.inputs["Strength"])[..., 0].mean())
            if reader.is_over_second(node.inputs["Color"]):
                parameters["float normalset"] = 2
    else:
        say(f"{node.name} at {socket.name} is not followed; the surface is smooth there")


def _add_heights(parameters: dict[str, Any], socket: bpy.types.NodeSocket, scale: float, midlevel: float, reader: Reader, textures: Textures) -> float:
    """Adds the picture of heights. Returns the greatest distance of a height from the middle. It is 0 if all heights
    are equal, which leaves the normals as they are."""
    heights = reader.value(socket) if source(socket) else constant(midlevel)
    if not is_picture(heights) or scale == 0:
        return 0.0
    parameters.update({"string heightmap": textures.file(gray(heights)), "float scale": scale, "float midlevel": midlevel, "float heightset": 1 + reader.is_over_second(socket)})
    return float(abs(gray(heights)[..., 0] - midlevel).max())


def _add_displacement(parameters: dict[str, Any], node: bpy.types.Node, material: bpy.types.Material, reader: Reader, textures: Textures, say: Callable[[str], None]) -> float:
    if "string heightmap" in parameters:
        say("the material has both a bump and a displacement; the displacement alone is rendered")
    scale, midlevel = (float(reader.value(node.inputs[name])[..., 0].mean()) for name in ("Scale", "Midlevel"))
    most = _add_heights(parameters, node.inputs["Height"], scale, midlevel, reader, textures)
    if getattr(getattr(material, "cycles", None), "displacement_method", "BUMP") == "BUMP" or not most:
        return 0.0
    parameters["float moves"] = 1
    return most * abs(scale)
