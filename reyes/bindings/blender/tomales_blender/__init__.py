"""Renders Blender's scenes with Tomales: it writes scenes as RIB, and reads the pictures into Blender's passes."""
from __future__ import annotations

import importlib.util
import os
import shutil
import sys
from collections.abc import Iterator
from pathlib import Path

bl_info = {
    "name": "Tomales",
    "description": "A Reyes renderer with global illumination",
    "version": (1, 0, 0),
    "blender": (3, 4, 0),
    "category": "Render",
    "location": "Render properties > Render Engine",
}


def _folders(named: str) -> Iterator[Path]:
    """Yields the folders where the module tomales may lie. Blender's own Python does not look in the system's
    folders."""
    if named:
        yield Path(named)
    yield Path(__file__).resolve().parents[2] / "python"  # The source tree holds it here.
    if program := shutil.which(os.environ.get("TOMALES", "tomales")):
        above = list(Path(program).resolve().parents)
        yield from sorted(folder for prefix in above[1:2] for folder in prefix.glob("lib/python3*/dist-packages"))
        yield from (tree / "reyes/bindings/python" for tree in above[2:3])  # This is the folder above build/release/tomales, which lies in a source tree.


def _find_module(named: str) -> bool:
    """Puts the module tomales on Python's path. Returns whether it was found."""
    if importlib.util.find_spec("tomales") is None:
        sys.path.extend(str(folder) for folder in list(_folders(named)) if (folder / "tomales").is_dir())
        importlib.invalidate_caches()
    return importlib.util.find_spec("tomales") is not None


_registered = False  #: Whether the engine is registered.


def register_engine() -> bool:
    """Registers the engine once its module is found, and returns whether it is registered. The preferences may name
    the module, so they call this when they change."""
    import bpy

    global _registered
    addon = bpy.context.preferences.addons.get(__package__)
    if addon and addon.preferences.program:
        os.environ["TOMALES"] = bpy.path.abspath(addon.preferences.program)
    if not _registered and _find_module(bpy.path.abspath(addon.preferences.module) if addon else ""):
        from . import engine, panels

        engine.register()
        panels.register()
        _registered = True
    return _registered


def register() -> None:
    from . import settings

    settings.register()
    if not register_engine():
        print("Tomales: there is no Python module tomales; name its folder in the preferences of this add-on")


def unregister() -> None:
    from . import settings

    global _registered
    if _registered:
        from . import engine, panels

        panels.unregister()
        engine.unregister()
        _registered = False
    settings.unregister()
