"""Tests what becomes of a model's colours, pictures and texture coordinates by the numbers of the RIB."""
import math
import re

from models import Gltf, png
from program import Suite

t = Suite()
SQUARE = [(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)]
UV = [(0, 0), (1, 0), (1, 1), (0, 1)]  # v runs up.
FACES = [(0, 1, 2), (0, 2, 3)]
DOWN = [(u, 1 - v) for u, v in UV]  # As glTF and RIB have it.
white = png(2, lambda *_: (255, 255, 255))


def imported(name, model, code=0, *says):
    """Imports a model. Returns the text of the RIB, and what was said."""
    t.write(name, model)
    made = t.expect_run(f"{name} comes in", ["import", name, "-o", "out.rib"], code, *says)
    t.expect(says or not made.stderr, f"{name}: without a word {made.stderr}")
    return (t.folder / "out.rib").read_text()


def numbers(rib, name):
    """Returns the numbers of a variable or parameter."""
    found = re.search(rf'"[^"]* {name}" \[([^\]]*)\]', rib)
    return [float(x) for x in found[1].split()] if found else []


def near(what, seen, expected, tolerance=1e-5):
    flat = [c for row in expected for c in (row if isinstance(row, tuple) else (row,))]
    t.expect(len(seen) == len(flat) and all(abs(a - b) <= tolerance for a, b in zip(seen, flat)), f"{what}: {seen}, expected {flat}")


def scene_of(look, **attributes):
    """Returns a square of a material of glTF. `look` makes it of the scene."""
    scene = Gltf()
    scene.node(mesh=scene.mesh(SQUARE, FACES, NORMAL=[(0, 0, 1)] * 4, material=scene.add("materials", look(scene)), **{"TEXCOORD_0": UV, **attributes}))
    return scene


def using(scene, *names):
    scene.document.setdefault("extensionsUsed", []).extend(names)
    return scene


def transformed(coordinates, offset=(0, 0), rotation=0, scale=(1, 1)):
    """KHR_texture_transform by its definition: scaled, turned counterclockwise as seen with v downwards, moved."""
    c, s = math.cos(rotation), math.sin(rotation)
    return [(offset[0] + c * scale[0] * u + s * scale[1] * v, offset[1] - s * scale[0] * u + c * scale[1] * v) for u, v in coordinates]


def textured(scene, **transform):
    return {"index": scene.image(white), **({"extensions": {"KHR_texture_transform": transform}} if transform else {})}


CASES = ({"scale": [2, 2]}, {"scale": [0.5, 3]}, {"offset": [0.25, 2.75]}, {"rotation": 0.3}, {"rotation": -2.5}, {"scale": [-1, 1.5], "rotation": 4, "offset": [-3, 0.5]})
for k, case in enumerate(CASES):
    scene = using(scene_of(lambda s: {"pbrMetallicRoughness": {"baseColorTexture": textured(s, **case)}}), "KHR_texture_transform")
    near(f"texture coordinates of {case}", numbers(imported(f"transform{k}.glb", scene.glb()), "st"), transformed(DOWN, **case))
both = using(scene_of(lambda s: {"pbrMetallicRoughness": {"baseColorTexture": textured(s)}, "emissiveTexture": textured(s, scale=[2, 2], offset=[0.5, 0])}), "KHR_texture_transform")
rib = imported("both.glb", both.glb())
other = transformed(DOWN, scale=(2, 2), offset=(0.5, 0))
near("the first picture's coordinates are st", numbers(rib, "st"), DOWN)
near("another's are s1 and t1", numbers(rib, "s1") + numbers(rib, "t1"), [u for u, _ in other] + [v for _, v in other])
t.expect('secondset" [ "emissionmap"]' in rib, "as secondset says")

t.finish()
