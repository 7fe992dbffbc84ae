"""Scenes with a caustic, for tests and benchmarks."""
# The eye looks down on a floor, through objects that are invisible to it.
ABOVE = """Display "{name}.exr" "file" "rgb"
Format 24 24 1
PixelSamples 2 2
PixelFilter "box" 1 1
ShadingRate 0.25
Projection "orthographic"
ScreenWindow -1 1 -1 1
Rotate -90 1 0 0
Translate 0 -5 0
WorldBegin
LightSource "indirectlight" "gi" "samples" [16]
Attribute "light" "shadows" ["on"]
Attribute "trace" "maxspeculardepth" [8]
{light}
AttributeBegin
Attribute "photon" "causticmap" ["floor"]
Surface "matte"
Color 0.7 0.7 0.7
Polygon "P" [-{half} 0 -{half}  -{half} 0 {half}  {half} 0 {half}  {half} 0 -{half}]
AttributeEnd
Attribute "visibility" "int camera" [0]
Attribute "trace" "float tessellation" [4]
{thing}
WorldEnd
"""
SPOT = 'LightSource "spotlight" "lamp" "from" [{}] "to" [{}] "intensity" [20] "coneangle" [{}] "conedeltaangle" [0.05]'
WAVES = " ".join(f"{-2.4 + 0.6 * i} {0.6 + 0.06 * ((i * i + 2 * j) % 5 - 2)} {-2.4 + 0.6 * j}" for j in range(9) for i in range(9))
SCENES = {
    "pool": ('LightSource "distantlight" "sun" "from" [0.3 1 0.2] "to" [0 0 0]',
             'Attribute "photon" "shadingmodel" ["water"]\nSurface "glass" "eta" [1.33]\nColor 1 1 1\nBasis "b-spline" 1 "b-spline" 1\n'
             f'PatchMesh "bicubic" 9 "nonperiodic" 9 "nonperiodic" "P" [{WAVES}]'),
    "glass": (SPOT.format("-0.8 4 0.3", "0 1.2 0", 0.2),
              'Attribute "photon" "shadingmodel" ["glass"]\nSurface "glass"\nColor 1 1 1\nTranslate 0 1.2 0\nSphere 0.35 -0.35 0.35 360'),
    "ring": (SPOT.format("2.5 2 0", "0 0 0", 0.4),
             'Attribute "photon" "shadingmodel" ["chrome"]\nSurface "mirror" "color specularcolor" [0.95 0.78 0.45]\nColor 0.95 0.78 0.45\n'
             "Translate 0 0.2 0\nRotate -90 1 0 0\nCylinder 0.6 0 0.25 360\nCylinder 0.65 0 0.25 360\nHyperboloid 0.6 0 0.25 0.65 0 0.25 360"),
}


def text(name, half=2):
    """Returns the RIB of a scene, whose picture is NAME.exr. The floor has edges of twice `half`."""
    light, thing = SCENES[name]
    return ABOVE.format(name=name, light=light, thing=thing, half=half)
