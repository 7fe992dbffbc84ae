"""Writes one frame as a RIB file, and beside it archives that later frames use again."""
from __future__ import annotations

import hashlib
from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass
from math import floor
from pathlib import Path

import bpy
import tomales

from . import lights
from .camera import write_camera, write_motion
from .geometry import TIMES
from .materials import Look, changes, look_of
from .panorama import Panorama, panorama_of
from .passes import Passes
from .settings import TomalesScene
from .snapshot import Placed, Cache, Snapshot, take
from .textures import Textures
from .world import SKY_RADIUS_SHARE, write_shaders, write_world

Warn = Callable[[str], None]


@dataclass
class _Part:
    """The part of a shape that has one material."""

    archive: str
    look: Look
    material: str  #: The name of the piece.
    handle: str | int | None = None  #: The attributes of the object that the instances show.


class Frame:
    """Writes FOLDER/NAME.rib, FOLDER/archives/HASH.rib and FOLDER/textures/HASH.exr."""

    def __init__(self, engine: bpy.types.RenderEngine, depsgraph: bpy.types.Depsgraph, folder: Path, cache: Cache, warn: Warn) -> None:
        self._engine = engine
        self._depsgraph = depsgraph
        self._scene = depsgraph.scene
        self._folder = folder
        self._cache = cache
        self._warn = warn
        self._textures = Textures(folder, warn)
        self._looks: dict[str, Look] = {}
        self._materials = {m.name_full: m for m in bpy.data.materials}
        self._changing = {name for name, m in self._materials.items() if changes(m)}

    @property
    def _settings(self) -> TomalesScene:
        """Returns the scene's settings. They must be asked for each time, because Blender frees them when the frame
        changes."""
        return self._scene.tomales

    def write(self, name: str, passes: Passes) -> Path:
        """Writes the frame and returns the RIB file. Raises UnsupportedCamera and OSError."""
        camera = self._scene.camera
        snapshots = self._snapshots(camera)
        times = TIMES(len(snapshots)) if len(snapshots) > 1 else [0.0]  # The shutter opens at 0 and closes at 1.
        first = snapshots[0]
        path = self._folder / f"{name}.rib"
        self._folder.mkdir(parents=True, exist_ok=True)
        write_shaders(self._folder)
        ri = tomales.Ri()
        ri.Begin(path)
        ri.Option("searchpath", {"string texture": f"{self._folder}:.:@"})  # the working folder is searched too, in case the export is moved
        passes.write(ri)
        self._write_options(ri)
        if len(times) > 1:
            ri.Shutter(0, 1)
        write_camera(ri, self._scene, camera, self._depsgraph, times, [s.camera for s in snapshots])
        ri.WorldBegin()
        ri.Orientation("rh")
        self._write_lights(ri, first)
        self._write_objects(ri, times, snapshots)
        ri.WorldEnd()
        ri.End()
        return path

    # The times of the frame.

    def _snapshots(self, camera: bpy.types.Object) -> list[Snapshot]:
        """Returns the scene at every time of the shutter, or only at the frame if nothing is blurred."""
        if not self._scene.render.use_motion_blur:
            return [self._take(camera)]
        shutter, frame, out = self._scene.render.motion_blur_shutter, self._scene.frame_current, []
        begin = frame + {"START": 0, "CENTER": -shutter / 2, "END": -shutter}[self._settings.shutter_position]
        for share in TIMES(self._settings.shutter_keys):
            time = begin + shutter * share
            self._engine.frame_set(floor(time), time - floor(time))
            out.append(self._take(camera))
        self._engine.frame_set(frame, 0.0)
        return out

    def _take(self, camera: bpy.types.Object) -> Snapshot:
        return take(self._depsgraph, camera, self._settings.subdivide, self._cache, self._warn)

    # Options and lights.

    def _write_options(self, ri: tomales.Ri) -> None:
        s = self._settings
        ri.PixelSamples(s.pixel_samples, s.pixel_samples)
        ri.PixelFilter("gaussian", s.filter_width, s.filter_width)
        ri.ShadingRate(s.shading_rate)

    def _write_lights(self, ri: tomales.Ri, snapshot: Snapshot) -> None:
        s = self._settings
        if s.bounces > 0:
            ri.LightSource("indirectlight", "indirect", {"float samples": s.gather_samples, "float bounces": s.bounces})
        sky = write_world(ri, self._scene.world, self._textures, self._panorama, s.light_samples, self._warn) if self._scene.world else None
        for i, (obj, matrix) in enumerate(snapshot.lights.values()):
            ri.AttributeBegin()
            ri.Attribute("identifier", {"string name": obj.name})
            lights.write_light(ri, obj.evaluated_get(self._depsgraph), matrix, f"light{i}", s.light_samples)
            ri.AttributeEnd()
            ri.Illuminate(f"light{i}", 1)
        if sky and not self._scene.render.film_transparent:
            sky.write(ri, snapshot.camera, SKY_RADIUS_SHARE * self._scene.camera.data.clip_end)

    def _panorama(self, world: bpy.types.World) -> Panorama:
        known = {} if changes(world) else self._cache.panoramas
        if world.name_full not in known:
            known[world.name_full] = panorama_of(world, self._scene.frame_current)
        return known[world.name_full]

    # Objects.

    def _write_objects(self, ri: tomales.Ri, times: list[float], snapshots: list[Snapshot]) -> None:
        first = snapshots[0]
        uses = Counter(placed.shape for placed in first.placed.values())
        parts: dict[str, list[_Part]] = {}
        for key, shape in first.shapes.items():
            parts[key] = [self._part(self._archive(key, i, snapshots), shape.materials, piece.slot) for i, piece in enumerate(shape.pieces)]
            for part in parts[key]:
                if uses[key] > 1 and not part.look.emission:
                    part.handle = ri.ObjectBegin()
                    ri.ReadArchive(part.archive)
                    ri.ObjectEnd()
        emits = {key for key, some in parts.items() if any(part.look.emission for part in some)}
        for placed in sorted(first.placed.values(), key=lambda p: p.shape not in emits):
            self._write_placed(ri, placed, times, snapshots, parts[placed.shape])

    def _write_placed(self, ri: tomales.Ri, placed: Placed, times: list[float], snapshots: list[Snapshot], parts: list[_Part]) -> None:
        handles = []
        ri.AttributeBegin()
        ri.Attribute("identifier", {"string name": placed.name})
        if not all(placed.visibility.values()):
            ri.Attribute("visibility", {f"int {ray}": int(seen) for ray, seen in placed.visibility.items()})
        write_motion(ri, times, [s.placed[placed.key].matrix if placed.key in s.placed else placed.matrix for s in snapshots])
        for part in parts:
            if part.look.emission:
                handles.append(ri.AreaLightSource("arealight", {"lightcolor": part.look.emission, "float samples": self._settings.light_samples}))
            ri.Attribute("identifier", {"string shadinggroup": part.material})
            ri.ArchiveRecord(ri.VERBATIM, part.look.rib)
            ri.ReadArchive(part.archive) if part.handle is None else ri.ObjectInstance(part.handle)
        ri.AttributeEnd()
        for handle in handles:
            ri.Illuminate(handle, 1)

    def _part(self, archive: str, materials: list[str], slot: int) -> _Part:
        name = materials[min(slot, len(materials) - 1)] if materials else ""
        looks = self._looks if name in self._changing else self._cache.looks
        if name not in looks:
            material = self._materials.get(name)
            evaluated = material.evaluated_get(self._depsgraph) if material else None
            looks[name] = look_of(evaluated, self._textures, self._settings.reflection_samples, self._warn)
        return _Part(archive, looks[name], name)

    def _archive(self, key: str, i: int, snapshots: list[Snapshot]) -> str:
        """Returns the file of a piece, relative to the folder. Its name is a hash of its contents, so that each
        piece is written once."""
        shape = snapshots[0].shapes[key]
        known = self._cache.archives.get((key, i)) if self._cache.shapes.get(key) is shape else None
        if known:
            return known
        later = [s.shapes[key].pieces[i] for s in snapshots[1:] if key in s.shapes and len(s.shapes[key].pieces) == len(shape.pieces)]
        rib = shape.pieces[i].rib(*later)
        name = f"archives/{hashlib.sha256(rib).hexdigest()[:20]}.rib"
        path = self._folder / name
        if not path.exists():
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(rib)
        if self._cache.shapes.get(key) is shape:
            self._cache.archives[key, i] = name
        return name
