"""The settings that the add-on keeps in scenes, materials and preferences."""
from __future__ import annotations

from typing import Any

import bpy
from bpy.props import BoolProperty, CollectionProperty, EnumProperty, FloatProperty, FloatVectorProperty, IntProperty, PointerProperty, StringProperty

from . import register_engine


class TomalesScene(bpy.types.PropertyGroup):
    pixel_samples: IntProperty(name="Pixel Samples", description="Samples along each edge of a pixel", default=4, min=1, max=32)
    shading_rate: FloatProperty(name="Shading Rate", description="Area of a micropolygon in pixels", default=1, min=0.01, max=64)
    filter_width: FloatProperty(name="Filter Width", description="Width of the Gaussian pixel filter", default=2, min=1, max=8)
    bounces: IntProperty(name="Bounces", description="Diffuse bounces of indirect light; 0 leaves it out", default=1, min=0, max=16)
    gather_samples: IntProperty(name="Gather Samples", description="Rays of an irradiance sample", default=256, min=16, max=16384)
    light_samples: IntProperty(name="Light Samples", description="Samples of area lights and of the world for each shaded point", default=32, min=1, max=4096)
    reflection_samples: IntProperty(name="Reflection Samples", description="Rays that mirror the scene in glossy materials, for each shaded point; 0: they mirror lights alone", default=4, min=0, max=256)
    subdivide: BoolProperty(
        name="Smooth Subdivision",
        description="A Subdivision Surface modifier at the end of the stack becomes a subdivision surface with creases, as fine as the picture needs",
        default=True,
    )
    shutter_position: EnumProperty(
        name="Shutter", description="Where the frame is in the time that the shutter is open", default="CENTER",
        items=[("START", "Start on Frame", ""), ("CENTER", "Center on Frame", ""), ("END", "End on Frame", "")],
    )  # fmt: skip
    shutter_keys: IntProperty(name="Motion Keys", description="Times within the shutter at which motion is sampled", default=2, min=2, max=9)
    export_only: BoolProperty(name="Export Only", description="Write RIB files and archives, and render nothing", default=False)
    export_frames: BoolProperty(name="All Frames", description="Render Image exports every frame of the scene, and not the current one alone", default=False)
    folder: StringProperty(name="Folder", description="Where RIB files, archives and textures go; empty: a temporary folder", subtype="DIR_PATH")
    options: StringProperty(name="Options", description="More options of tomales render, such as --gi reference")


class TomalesParameter(bpy.types.PropertyGroup):
    """A parameter of the shader that replaces a material's nodes."""

    kind: StringProperty()
    is_set: BoolProperty(name="Set", description="Otherwise the shader's own default counts")
    number: FloatProperty()
    color: FloatVectorProperty(subtype="COLOR", size=3, soft_min=0, soft_max=1)
    text: StringProperty()
    description: StringProperty()

    def field(self) -> str:
        """Returns the name of the property that holds the value."""
        base = self.kind.split()[-1]
        return "number" if base == "float" else "text" if base == "string" else "color"

    def value(self) -> Any:
        value = getattr(self, self.field())
        return list(value) if self.field() == "color" else value


class TomalesMaterial(bpy.types.PropertyGroup):
    shader: StringProperty(name="Shader", description="A surface shader (built in, .sl or plugin) instead of the nodes; empty: the nodes")
    parameters: CollectionProperty(type=TomalesParameter)


def _look_again(preferences: bpy.types.AddonPreferences, context: bpy.types.Context) -> None:
    register_engine()


class TomalesPreferences(bpy.types.AddonPreferences):
    bl_idname = __package__

    program: StringProperty(name="Program", description="The program tomales; empty: the one that is installed", subtype="FILE_PATH",
                            update=_look_again)
    module: StringProperty(name="Python Module", description="The folder in which the folder tomales of the Python module lies; empty: where Python finds it",
                           subtype="DIR_PATH", update=_look_again)

    def draw(self, context: bpy.types.Context) -> None:
        self.layout.prop(self, "program")
        self.layout.prop(self, "module")
        if not register_engine():
            self.layout.label(text="There is no Python module tomales here: choose the program or the module's folder", icon="ERROR")


CLASSES = (TomalesScene, TomalesParameter, TomalesMaterial, TomalesPreferences)


def register() -> None:
    for cls in CLASSES:
        bpy.utils.register_class(cls)
    bpy.types.Scene.tomales = PointerProperty(type=TomalesScene)
    bpy.types.Material.tomales = PointerProperty(type=TomalesMaterial)


def unregister() -> None:
    del bpy.types.Material.tomales, bpy.types.Scene.tomales
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)
