"""Writes Blender's camera as options of RIB."""
from __future__ import annotations

from collections.abc import Sequence

import bpy
import tomales
from mathutils import Matrix


def flat(matrix: Matrix) -> list[float]:
    """Returns the 16 numbers of a matrix for RIB, whose matrices multiply row vectors."""
    return [matrix[row][column] for column in range(4) for row in range(4)]


def resolution(scene: bpy.types.Scene) -> tuple[int, int]:
    render = scene.render
    share = render.resolution_percentage / 100
    return max(1, int(render.resolution_x * share)), max(1, int(render.resolution_y * share))


class UnsupportedCamera(Exception):
    """The camera has a kind of projection that this renderer lacks."""


def write_camera(ri: tomales.Ri, scene: bpy.types.Scene, camera: bpy.types.Object, depsgraph: bpy.types.Depsgraph, times: Sequence[float], placed: Sequence[Matrix]) -> None:
    """Writes the format, the projection, the focus, and the camera's place at each time of the shutter. Raises
    UnsupportedCamera."""
    data, render = camera.data, scene.render
    if data.type == "PANO":
        raise UnsupportedCamera("panoramic cameras are not supported: choose perspective or orthographic")
    width, height = resolution(scene)
    ri.Format(width, height, render.pixel_aspect_x / render.pixel_aspect_y)
    if render.use_border:
        ri.CropWindow(render.border_min_x, render.border_max_x, 1 - render.border_max_y, 1 - render.border_min_y)
    to_screen = camera.calc_matrix_camera(depsgraph, x=width, y=height, scale_x=render.pixel_aspect_x, scale_y=render.pixel_aspect_y)
    perspective = data.type == "PERSP"
    ri.Projection("perspective", {"fov": 90}) if perspective else ri.Projection("orthographic")
    ri.ScreenWindow(*[edge for axis in (0, 1) for edge in _window(to_screen, axis, perspective)])
    ri.Clipping(data.clip_start, data.clip_end)
    if data.dof.use_dof and perspective:
        _write_focus(ri, camera)
    ri.Scale(1, 1, -1)
    _write_motion(ri, times, [m.normalized().inverted_safe() for m in placed])


def _window(to_screen: Matrix, axis: int, perspective: bool) -> tuple[float, float]:
    """Returns left and right (or bottom and top) of the picture at depth 1. The matrix maps them to -1 and 1."""
    scale = to_screen[axis][axis]
    shift = to_screen[axis][2] if perspective else -to_screen[axis][3]
    return (shift - 1) / scale, (shift + 1) / scale


def _write_focus(ri: tomales.Ri, camera: bpy.types.Object) -> None:
    dof = camera.data.dof
    distance = dof.focus_distance
    if dof.focus_object:
        to_camera = camera.matrix_world.normalized().inverted_safe()
        distance = abs((to_camera @ dof.focus_object.matrix_world.translation).z)
    ri.DepthOfField(dof.aperture_fstop, camera.data.lens / 1000, max(distance, 1e-4))
    if dof.aperture_blades >= 3:
        ri.Hider("hidden", {"float[4] aperture": [dof.aperture_blades, dof.aperture_rotation * 57.29577951, 0, 0]})


def _write_motion(ri: tomales.Ri, times: Sequence[float], matrices: Sequence[Matrix]) -> None:
    """Writes a ConcatTransform, in a motion block if the matrices differ."""
    if all(m == matrices[0] for m in matrices):
        return ri.ConcatTransform(flat(matrices[0]))
    ri.MotionBegin(list(times))
    for m in matrices:
        ri.ConcatTransform(flat(m))
    ri.MotionEnd()


write_motion = _write_motion
