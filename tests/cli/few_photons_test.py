"""Tests that a picture of places with few photons is reported with the place (photon-few), and a picture of a lit room beside
them is not."""
import re

from program import Suite

t = Suite()


def quad(*corners):
    return f'Polygon "P" [{" ".join(str(x) for p in corners for x in p)}]\n'


def box(x, y, z, X, Y, Z):
    return (quad((x, y, z), (x, Y, z), (x, Y, Z), (x, y, Z)) + quad((X, y, z), (X, y, Z), (X, Y, Z), (X, Y, z)) + quad((x, y, z), (x, y, Z), (X, y, Z), (X, y, z))
            + quad((x, Y, z), (X, Y, z), (X, Y, Z), (x, Y, Z)) + quad((x, y, z), (X, y, z), (X, Y, z), (x, Y, z)) + quad((x, y, Z), (x, Y, Z), (X, Y, Z), (X, y, Z)))


# A room with a bulb and one without are joined by a slot of 2 cm.
ROOMS = box(-3, 0, -1.5, 3, 2.5, 1.5) + box(-0.05, 0, -1.5, 0.05, 1, 1.5) + box(-0.05, 1.02, -1.5, 0.05, 2.5, 1.5)


def said(name, x, turn, projection='"perspective" "fov" [80]'):
    t.write(f"{name}.rib", f"""Format 24 24 1 PixelSamples 2 2 Projection {projection} Display "{name}.exr" "openexr" "rgb"
Rotate {turn} 0 1 0 Translate {-x} -1.2 0 WorldBegin
Attribute "light" "shadows" "on" Attribute "identifier" "name" ["rooms"]
LightSource "indirectlight" "bounce" "samples" [16] LightSource "pointlight" "bulb" "from" [-1.5 2 0] "intensity" [8]
Sides 2 Surface "matte" Color 0.7 0.7 0.7
{ROOMS}WorldEnd
""")
    return t.run(f"{name}.rib", "-o", f"{name}.exr", "--gi", "atlas", "--photons", "100000").stderr


dark = said("dark", 2.6, 90)
t.expect(re.search(r'"rooms": \d+ % of the lit picture, about pixel \d+,\d+, .*\[photon-few\]', dark) is not None, f"a room without a lamp: {dark}")
lit = said("lit", -2.6, -90)
t.expect("photon-few" not in lit, f"the room with the lamp: {lit}")
flat = said("flat", -2.6, -90, '"orthographic" ScreenWindow -1 1 -1 1')
t.expect("photon-few" not in flat, f"nor by parallel rays, which end at the camera: {flat}")
t.finish()
