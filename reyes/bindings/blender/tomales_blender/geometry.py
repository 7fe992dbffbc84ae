"""Writes meshes, curves and points of evaluated objects as RIB.

Every shape becomes one piece for each of its materials. A piece is RIB without attributes, so it can be an archive.
"""
from __future__ import annotations

import io
from dataclasses import dataclass, field

import bpy
import numpy
import tomales


@dataclass
class Piece:
    """The geometry of one material."""

    slot: int
    calls: list[tuple]  #: Calls of Ri: the name, the positional arguments and the parameters. The values are arrays.
    #: The parameters P and N of each call, which may move.
    moving: tuple[str, ...] = ("P", "N")

    def rib(self, *later: Piece) -> bytes:
        """Returns the piece as binary RIB. It is in motion with the pieces `later` if these differ from it only in P and N."""
        out = io.BytesIO()
        ri = tomales.Ri()
        ri.ErrorHandler("abort")
        ri.Option("rib", {"string format": "binary"})
        ri.Begin(out)
        for i, (name, arguments, parameters) in enumerate(self.calls):
            keys = [self] + [piece for piece in later if piece.fits(self)]
            if len(keys) == 1 or not self._moves(i, keys[1:]):
                getattr(ri, name)(*arguments, parameters)
                continue
            ri.MotionBegin(*TIMES(len(keys)))
            for piece in keys:
                getattr(ri, name)(*piece.calls[i][1], piece.calls[i][2])
            ri.MotionEnd()
        ri.End()
        return out.getvalue()

    def fits(self, other: Piece) -> bool:
        """Returns whether both pieces have the same requests with equal numbers of values."""
        return len(self.calls) == len(other.calls) and all(
            a[0] == b[0] and all(numpy.shape(a[2].get(k)) == numpy.shape(b[2].get(k)) for k in {*a[2], *b[2]})
            for a, b in zip(self.calls, other.calls)
        )

    def _moves(self, i: int, later: list[Piece]) -> bool:
        return any(not numpy.array_equal(self.calls[i][2]["P"], piece.calls[i][2]["P"]) for piece in later)


@dataclass(frozen=True)
class Uses:
    """The UV maps and the colour attribute that a material's shader expects under the standard names of the RISpec."""

    uv_map: str = ""  #: The UV map that becomes st. An empty name means the active map.
    second_uv_map: str | None = None  #: The UV map that becomes s1 and t1. None means that all pictures use the first map.
    color: str = ""  #: The colour attribute that becomes Cs.


def TIMES(count: int) -> list[float]:
    """Returns the times of a shutter that opens at 0 and closes at 1."""
    return [i / (count - 1) for i in range(count)]


@dataclass
class _Faces:
    """A mesh as arrays."""

    points: numpy.ndarray
    starts: numpy.ndarray
    counts: numpy.ndarray
    vertices: numpy.ndarray
    materials: numpy.ndarray
    corners: dict[str, numpy.ndarray] = field(default_factory=dict)  #: Face-varying values, with a row for each corner.

    @classmethod
    def of(cls, mesh: bpy.types.Mesh) -> _Faces:
        return cls(
            _values(mesh.vertices, "co", "f4", 3),
            _values(mesh.polygons, "loop_start", "i4"),
            _values(mesh.polygons, "loop_total", "i4"),
            _values(mesh.loops, "vertex_index", "i4"),
            _values(mesh.polygons, "material_index", "i4"),
        )

    def only(self, chosen: numpy.ndarray) -> tuple[numpy.ndarray, numpy.ndarray]:
        """Returns the number of corners of each chosen face, and the indices of these corners."""
        of_corner = numpy.repeat(chosen, self.counts)
        return self.counts[chosen], numpy.flatnonzero(of_corner)


def _values(items, name: str, kind: str, width: int = 1) -> numpy.ndarray:
    out = numpy.empty(len(items) * width, kind)
    items.foreach_get(name, out)
    return out.reshape(-1, width) if width > 1 else out


def _add_texture_coordinates(mesh: bpy.types.Mesh, faces: _Faces) -> None:
    """Adds every UV map under its own name. RIB has the origin of pictures at the top, so v is turned."""
    for layer in mesh.uv_layers:
        uv = _values(layer.data, "uv", "f4", 2)
        uv[:, 1] = 1 - uv[:, 1]
        faces.corners[f"facevarying float[2] uv_{_word(layer.name)}"] = uv


def _add_colors(mesh: bpy.types.Mesh, faces: _Faces) -> None:
    for layer in mesh.color_attributes:
        color = _values(layer.data, "color", "f4", 4)[:, :3]
        by_corner = color[faces.vertices] if layer.domain == "POINT" else color
        faces.corners[f"facevarying color color_{_word(layer.name)}"] = by_corner


def _variables_of(mesh: bpy.types.Mesh, faces: _Faces, use: Uses) -> dict[str, numpy.ndarray]:
    """Returns all variables of the faces of one material, with st, s1, t1 and Cs as its shader expects them."""
    active = next((layer.name for layer in mesh.uv_layers if layer.active_render), "")
    uv_of = lambda name: faces.corners.get(f"facevarying float[2] uv_{_word(name or active)}")  # noqa: E731
    out, known = dict(faces.corners), {"float[2] st": uv_of(use.uv_map), "color Cs": faces.corners.get(f"facevarying color color_{_word(use.color)}")}
    second = uv_of(use.second_uv_map) if use.second_uv_map is not None else None
    if second is not None:
        known |= {"float s1": second[:, 0], "float t1": second[:, 1]}
    return out | {f"facevarying {token}": values for token, values in known.items() if values is not None}


def _word(name: str) -> str:
    return "".join(c if c.isalnum() else "_" for c in name)


def mesh_pieces(mesh: bpy.types.Mesh, subdivision: bpy.types.SubsurfModifier | None, uses: list[Uses]) -> list[Piece]:
    """Returns polygons with normals, or the subdivision surface that the modifier would make. `uses` has an entry
    for each slot."""
    faces = _Faces.of(mesh)
    if len(faces.counts) == 0:
        return []
    _add_texture_coordinates(mesh, faces)
    _add_colors(mesh, faces)
    slots = sorted(set(faces.materials.tolist()))
    pieces = []
    for slot in slots:
        variables = _variables_of(mesh, faces, uses[min(slot, len(uses) - 1)] if uses else Uses())
        chosen = faces.materials == slot
        call = _subdivision(mesh, faces, chosen, variables, subdivision) if subdivision else _polygons(mesh, faces, chosen, variables)
        pieces.append(Piece(slot, [call]))
    return pieces


def _polygons(mesh: bpy.types.Mesh, faces: _Faces, chosen: numpy.ndarray, variables: dict[str, numpy.ndarray]) -> tuple:
    counts, corners = faces.only(chosen)
    parameters = {"P": faces.points}
    smooth = _values(mesh.polygons, "use_smooth", "?")
    if smooth[chosen].any() or mesh.use_auto_smooth or mesh.has_custom_normals:
        mesh.calc_normals_split()
        parameters["facevarying normal N"] = _values(mesh.loops, "normal", "f4", 3)[corners]
    parameters.update({token: values[corners] for token, values in variables.items()})
    return "PointsPolygons", (counts, faces.vertices[corners]), parameters


def _subdivision(mesh: bpy.types.Mesh, faces: _Faces, chosen: numpy.ndarray, variables: dict[str, numpy.ndarray], modifier: bpy.types.SubsurfModifier) -> tuple:
    """Writes faces of other materials as holes, so that the surface stays smooth across the seam."""
    tags, counts, integers, floats = ["interpolateboundary"], [1, 0], [2 if modifier.boundary_smooth == "ALL" else 1], []
    if modifier.use_creases:
        edges = _values(mesh.edges, "vertices", "i4", 2)
        corners = _values(mesh.vertex_creases[0].data, "value", "f4") if len(getattr(mesh, "vertex_creases", ())) else numpy.zeros(0)
        for tag, sharpness, ends in (("crease", _values(mesh.edges, "crease", "f4"), edges), ("corner", corners, None)):
            for i in numpy.flatnonzero(sharpness > 0):
                on = edges[i].tolist() if ends is not None else [int(i)]
                tags.append(tag)
                counts += [len(on), 1]
                integers += on
                floats.append(10 * float(sharpness[i]) ** 2)  # Blender passes these values to OpenSubdiv.
    holes = numpy.flatnonzero(~chosen).tolist()
    if holes:
        tags.append("hole")
        counts += [len(holes), 0]
        integers += holes
    return "SubdivisionMesh", ("catmull-clark", faces.counts, faces.vertices, tags, counts, integers, floats), {"P": faces.points, **variables}


def curve_pieces(curves: bpy.types.Curves) -> list[Piece]:
    """Returns hair curves. Their radii come from the points; curves without radii are a millimetre wide."""
    points = _values(curves.points, "position", "f4", 3)
    counts = _values(curves.curves, "points_length", "i4")
    if len(counts) == 0:
        return []
    radius = curves.attributes.get("radius")
    width = 2 * _values(radius.data, "value", "f4") if radius else numpy.full(len(points), 0.001, "f4")
    return [Piece(0, [_strands(points, counts, width)])]


def hair_pieces(obj: bpy.types.Object, system: bpy.types.ParticleSystem) -> list[Piece]:
    """Returns the strands of a particle system in the space of the object."""
    settings = system.settings
    steps = 2**settings.render_step + 1
    first = len(system.particles) if system.settings.child_type != "NONE" and not settings.use_parent_particles else 0
    count = len(system.particles) + len(system.child_particles)
    to_object = obj.matrix_world.inverted_safe()
    strands = [[to_object @ system.co_hair(obj, particle_no=i, step=step) for step in range(steps)] for i in range(first, count)]
    if not strands:
        return []
    points = numpy.array(strands, "f4").reshape(-1, 3)
    # Cycles takes the values that Blender calls radii as diameters. The taper here is the one of Cycles.
    power = 1 + settings.shape if settings.shape < 0 else 1 / max(1 - settings.shape, 1e-3)
    along = numpy.linspace(1, 0, steps, dtype="f4") ** power
    widths = (settings.tip_radius + (settings.root_radius - settings.tip_radius) * along) * settings.radius_scale
    if settings.use_close_tip:
        widths[-1] = 0
    width = numpy.tile(widths, len(strands))
    return [Piece(settings.material - 1, [_strands(points, numpy.full(len(strands), steps), width)])]


def _strands(points: numpy.ndarray, counts: numpy.ndarray, width: numpy.ndarray) -> tuple:
    return "Curves", ("linear", counts, "nonperiodic"), {"P": points, "width": width}


def particle_pieces(obj: bpy.types.Object, system: bpy.types.ParticleSystem) -> list[Piece]:
    """Returns particles that are drawn as halos: disks in the space of the object."""
    alive = [p for p in system.particles if p.alive_state == "ALIVE"]
    if not alive:
        return []
    to_object = obj.matrix_world.inverted_safe()
    points = numpy.array([to_object @ p.location for p in alive], "f4")
    return [Piece(system.settings.material - 1, [("Points", (), {"P": points, "width": numpy.array([2 * p.size for p in alive], "f4")})])]
