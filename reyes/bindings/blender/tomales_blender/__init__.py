"""Renders Blender's scenes with Tomales: scenes go out as RIB, pictures come back into Blender's passes."""
from __future__ import annotations

import importlib.util
import os
import sys
from pathlib import Path

bl_info = {
    "name": "Tomales",
    "description": "A Reyes renderer with global illumination",
    "version": (0, 1, 0),
    "blender": (3, 4, 0),
    "category": "Render",
    "location": "Render properties > Render Engine",
}


def _find_module(folder: str) -> None:
    """Puts the module tomales on Python's path: that of the preferences, or the one in the same source tree."""
    if importlib.util.find_spec("tomales") is None:
        sys.path.append(folder or str(Path(__file__).resolve().parents[2] / "python"))


def register() -> None:
    import bpy

    from . import settings

    settings.register()
    addon = bpy.context.preferences.addons.get(__package__)
    _find_module(addon.preferences.module if addon else "")
    if addon and addon.preferences.program:
        os.environ["TOMALES"] = bpy.path.abspath(addon.preferences.program)
    from . import engine, panels

    engine.register()
    panels.register()


def unregister() -> None:
    from . import engine, panels, settings

    panels.unregister()
    engine.unregister()
    settings.unregister()
