"""The render engine. It writes a RIB file for each frame, runs the program tomales, and puts its picture into
Blender's passes."""
from __future__ import annotations

import re
import shlex
import subprocess
import tempfile
import threading
import time
import traceback
from pathlib import Path

import bpy
import numpy
import tomales

from .camera import UnsupportedCamera, resolution
from .frame import Frame
from .passes import Passes, fill, wanted
from .preview import Preview
from .snapshot import Cache, ends_in_subdivision

_OF_FRAME = re.compile(rb"R9\d+ +(\d+)%")  #: A line of progress that `--progress` prints for render farms.
_OF_PASS = re.compile(rb"(\w.*?) +(\d+) %")
_LOOK_S = 0.1  #: The time between two looks at whether the user wants to stop.
_SHOW_S = 1.0  #: The time between two updates of an unfinished picture. They cost time, because Blender converts the whole picture.


class Session:
    """One rendering of one frame or of many frames. Blender makes a new engine for each frame, so this state lives
    outside of it."""

    def __init__(self) -> None:
        self.cache = Cache()
        self._temporary: tempfile.TemporaryDirectory[str] | None = None
        self._switched_off: list[tuple[str, str]] = []  #: The names of an object and of its modifier.

    def folder(self, chosen: str) -> Path:
        if chosen:
            return Path(bpy.path.abspath(chosen))
        if not self._temporary:
            self._temporary = tempfile.TemporaryDirectory(prefix="tomales_")
        return Path(self._temporary.name)

    def begin(self, scene: bpy.types.Scene) -> None:
        """Switches off the modifiers whose cages are exported as subdivision surfaces."""
        for obj in scene.objects if scene.tomales.subdivide else ():
            if obj.type == "MESH" and not obj.library and ends_in_subdivision(obj) and obj.modifiers[-1].show_render:
                obj.modifiers[-1].show_render = False
                self._switched_off.append((obj.name, obj.modifiers[-1].name))

    def end(self) -> None:
        for name, modifier in self._switched_off:
            obj = bpy.data.objects.get((name, None))
            if obj and modifier in obj.modifiers:
                obj.modifiers[modifier].show_render = True
        if self._temporary:
            self._temporary.cleanup()


_session = Session()


class TomalesEngine(bpy.types.RenderEngine):
    bl_idname = "TOMALES"
    bl_label = "Tomales"
    bl_use_preview = False
    bl_use_shading_nodes_custom = False
    bl_use_postprocess = True

    def render(self, depsgraph: bpy.types.Depsgraph) -> None:
        self._messages: list[str] = []
        for p in wanted(depsgraph.view_layer):
            if p.own:
                self.add_pass(p.name, len(p.channels), p.channels, layer=depsgraph.view_layer.name)
        result = self.begin_result(0, 0, *self._size(depsgraph.scene), layer=depsgraph.view_layer.name)
        try:
            self._render(depsgraph, _session.folder(depsgraph.scene.tomales.folder), result)
        except (UnsupportedCamera, OSError, tomales.RiError, tomales.RendererNotFound) as problem:
            self._error(str(problem))
        except Exception:
            self._error(traceback.format_exc())
        finally:
            # Blender 3.4 crashes if the next rendering begins before this result has ended.
            self.end_result(result)

    def _render(self, depsgraph: bpy.types.Depsgraph, folder: Path, result: bpy.types.RenderResult) -> None:
        scene = depsgraph.scene
        if not scene.camera:
            return self._error("the scene has no camera")
        if scene.tomales.export_only and scene.tomales.export_frames:
            return self._export_frames(depsgraph, folder)
        passes, rib = self._write(depsgraph, folder)
        if scene.tomales.export_only:
            return
        self.update_stats("", "Rendering")
        if self._run(rib, folder, shlex.split(scene.tomales.options), result):
            passes.read(result, numpy.array(scene.camera.matrix_world.normalized()) @ numpy.diag([1, 1, -1, 1]))
            passes.stamp(depsgraph.view_layer.name, self.get_result())

    def _write(self, depsgraph: bpy.types.Depsgraph, folder: Path) -> tuple[Passes, Path]:
        """Exports the current frame. Returns its passes and its RIB file."""
        scene, layer = depsgraph.scene, depsgraph.view_layer
        name = f"{Path(bpy.data.filepath).stem or 'untitled'}.{scene.frame_current:04d}"
        if len(scene.view_layers) > 1:
            name = f"{name}.{bpy.path.clean_name(layer.name)}"
        passes = Passes(layer, folder, f"{name}.exr")
        self.update_stats("", f"Writing RIB of frame {scene.frame_current}")
        return passes, Frame(self, depsgraph, folder, _session.cache, self._warn).write(name, passes)

    def _export_frames(self, depsgraph: bpy.types.Depsgraph, folder: Path) -> None:
        """Exports all frames of the scene in one rendering, because Blender needs longer to prepare a rendering than
        this needs to write a frame."""
        scene = depsgraph.scene
        now, frames = scene.frame_current, range(scene.frame_start, scene.frame_end + 1, scene.frame_step)
        for i, frame in enumerate(frames):
            self.frame_set(frame, 0.0)
            self._write(depsgraph, folder)
            self._progress = (i + 1) / len(frames)
            self._show_progress()
            if self._is_given_up():
                break
        self.frame_set(now, 0.0)

    @staticmethod
    def _size(scene: bpy.types.Scene) -> tuple[int, int]:
        width, height = resolution(scene)
        render = scene.render
        if not render.use_border:
            return width, height
        return int(width * render.border_max_x) - int(width * render.border_min_x), int(height * render.border_max_y) - int(height * render.border_min_y)

    def _run(self, rib: Path, folder: Path, options: list[str], result: bpy.types.RenderResult) -> bool:
        """Runs the renderer and returns whether there is a picture. It shows progress and the unfinished picture,
        and ends the program when the user wants to stop."""
        is_asked_for = any(option.startswith("--preview") for option in options)  # The user has asked for another viewer.
        preview = Preview() if self._has_viewer and not is_asked_for else None
        shown = [f"--preview={preview.address}"] if preview else []
        command = [tomales.program.find(), "render", "--progress", *shown, *options, *tomales.program.more_options(), str(rib)]
        process = subprocess.Popen(command, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        reader = threading.Thread(target=self._listen, args=(process,), daemon=True)
        reader.start()
        try:
            while process.poll() is None:
                reader.join(_LOOK_S)
                self._show_progress()
                self._show_picture(preview, result)
                if self._is_given_up():
                    process.terminate()
                    process.wait()
                    return False
        finally:
            if preview:
                preview.close()
        reader.join()
        self._show_progress()
        for message in self._messages:
            self._warn(message)
        if process.returncode not in (0, 3):
            self._error(f"the renderer has ended with exit code {process.returncode}: {self._messages[-1] if self._messages else ''}")
        return process.returncode in (0, 3)

    _progress = 0.0
    _pass = "Rendering"
    _shown_s = 0.0
    _has_viewer = not bpy.app.background

    def _show_progress(self) -> None:
        self.update_progress(self._progress)
        self.update_stats("", self._pass)

    def _show_picture(self, preview: Preview | None, result: bpy.types.RenderResult) -> None:
        """Shows the part of the picture that the renderer has finished."""
        if preview is None or time.monotonic() - self._shown_s < _SHOW_S:
            return
        picture = preview.take()
        if picture is not None and picture.shape[:2] == (result.resolution_y, result.resolution_x):
            self._shown_s = time.monotonic()
            fill(result.layers[0].passes["Combined"], picture.transpose(2, 0, 1), result)
            self.update_result(result)

    def _is_given_up(self) -> bool:
        return self.test_break()

    def _listen(self, process: subprocess.Popen[bytes]) -> None:
        """Reads the renderer's messages in a thread of its own. It must not touch Blender's data."""
        assert process.stdout is not None
        for line in process.stdout:
            if of_frame := _OF_FRAME.match(line):
                self._progress = int(of_frame[1]) / 100
            elif of_pass := _OF_PASS.fullmatch(line.rstrip()):
                self._pass = of_pass[1].decode().capitalize()
            elif line.strip():
                self._messages.append(line.decode(errors="replace").strip())

    def _warn(self, message: str) -> None:
        print("Tomales:", message)
        self.report({"WARNING"}, message)

    def _error(self, message: str) -> None:
        print("Tomales:", message)
        self.report({"ERROR"}, message)

    def update_render_passes(self, scene: bpy.types.Scene, layer: bpy.types.ViewLayer) -> None:
        self.register_pass(scene, layer, "Combined", 4, "RGBA", "COLOR")
        for p in wanted(layer):
            self.register_pass(scene, layer, p.name, len(p.channels), p.channels, p.kind)


@bpy.app.handlers.persistent
def begin(scene: bpy.types.Scene, *_: object) -> None:
    """Blender calls this before it renders frames."""
    global _session
    _session.end()
    _session = Session()
    if scene.render.engine == TomalesEngine.bl_idname:
        _session.begin(scene)


@bpy.app.handlers.persistent
def end(*_: object) -> None:
    """Blender calls this after it has rendered frames, or when the user cancels."""
    global _session
    _session.end()
    _session = Session()


_HANDLERS = (("render_init", begin), ("render_complete", end), ("render_cancel", end))


def register() -> None:
    bpy.utils.register_class(TomalesEngine)
    for name, handler in _HANDLERS:
        getattr(bpy.app.handlers, name).append(handler)


def unregister() -> None:
    end()
    for name, handler in _HANDLERS:
        getattr(bpy.app.handlers, name).remove(handler)
    bpy.utils.unregister_class(TomalesEngine)
