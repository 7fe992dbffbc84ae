"""The panels of the render engine, and the operators that they need."""
from __future__ import annotations

import bpy
import tomales

from .engine import TomalesEngine

_ENGINE = TomalesEngine.bl_idname


class ReadParameters(bpy.types.Operator):
    """Asks the renderer for the parameters of the shader"""

    bl_idname = "tomales.read_parameters"
    bl_label = "Read Parameters"

    def execute(self, context: bpy.types.Context) -> set[str]:
        settings = context.material.tomales
        try:
            found = parameters_of(settings.shader)
        except (tomales.CommandFailed, tomales.RendererNotFound, ValueError) as problem:
            self.report({"ERROR"}, str(problem))
            return {"CANCELLED"}
        fill(settings, found)
        return {"FINISHED"}


def parameters_of(shader: str) -> list[dict]:
    """Returns what `tomales info NAME --json` prints of each parameter: name, type and default. Raises ValueError if
    it is no shader."""
    said = tomales.info(shader)
    shaders = said["shaders"] if "shaders" in said else [said]
    if "parameters" not in shaders[0]:
        raise ValueError(f"{shader} is no shader")
    return [p for p in shaders[0]["parameters"] if "output" not in p["type"].split()]


def fill(settings, found: list[dict]) -> None:
    """Makes a property for each parameter. It keeps values that are already set."""
    before = {p.name: p.value() for p in settings.parameters if p.is_set}
    settings.parameters.clear()
    for one in found:
        parameter = settings.parameters.add()
        parameter.name, parameter.kind, parameter.description = one["name"], one["type"], one.get("description", "")
        value = before.get(one["name"], one.get("default"))
        if parameter.field() == "color" and isinstance(value, (list, tuple)) and len(value) == 3:
            parameter.color = value
        elif parameter.field() == "number" and value is not None:
            parameter.number = value[0] if isinstance(value, (list, tuple)) else value
        elif parameter.field() == "text" and value is not None:
            parameter.text = value[0] if isinstance(value, (list, tuple)) else value
        parameter.is_set = one["name"] in before


class _Panel:
    COMPAT_ENGINES = {_ENGINE}
    bl_space_type = "PROPERTIES"
    bl_region_type = "WINDOW"

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return context.engine in cls.COMPAT_ENGINES


class TOMALES_PT_render(_Panel, bpy.types.Panel):
    bl_label = "Tomales"
    bl_context = "render"

    def draw(self, context: bpy.types.Context) -> None:
        layout, settings = self.layout, context.scene.tomales
        layout.use_property_split = True
        for name in ("pixel_samples", "filter_width", "shading_rate", "light_samples", "reflection_samples", "bounces", "gather_samples", "subdivide"):
            layout.prop(settings, name)
        layout.prop(context.scene.render, "film_transparent")
        layout.prop(context.scene.render, "use_motion_blur")
        if context.scene.render.use_motion_blur:
            layout.prop(context.scene.render, "motion_blur_shutter")
            layout.prop(settings, "shutter_position")
            layout.prop(settings, "shutter_keys")
        for name in ("export_only", *(("export_frames",) if settings.export_only else ()), "folder", "options"):
            layout.prop(settings, name)


class TOMALES_PT_material(_Panel, bpy.types.Panel):
    bl_label = "Tomales Shader"
    bl_context = "material"

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return context.material is not None and super().poll(context)

    def draw(self, context: bpy.types.Context) -> None:
        settings = context.material.tomales
        row = self.layout.row()
        row.prop(settings, "shader")
        row.operator(ReadParameters.bl_idname, text="", icon="FILE_REFRESH")
        for parameter in settings.parameters:
            row = self.layout.row()
            row.prop(parameter, "is_set", text=parameter.name)
            row.prop(parameter, parameter.field(), text="")


CLASSES = (ReadParameters, TOMALES_PT_render, TOMALES_PT_material)


def _shared_panels():
    """Yields Blender's own panels that make sense for any engine."""
    excluded = {"VIEWLAYER_PT_filter", "VIEWLAYER_PT_layer_passes", "RENDER_PT_simplify"}
    for panel in bpy.types.Panel.__subclasses__():
        if "BLENDER_RENDER" in getattr(panel, "COMPAT_ENGINES", ()) and panel.__name__ not in excluded:
            yield panel


def register() -> None:
    for cls in CLASSES:
        bpy.utils.register_class(cls)
    for panel in _shared_panels():
        panel.COMPAT_ENGINES.add(_ENGINE)


def unregister() -> None:
    for panel in _shared_panels():
        panel.COMPAT_ENGINES.discard(_ENGINE)
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)
