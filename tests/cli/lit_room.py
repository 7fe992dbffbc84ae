"""A small room with every source of light that an audit distinguishes: a lamp with an area, a spot, and the light that surfaces
reflect."""
ROOM = """Display "room.exr" "file" "rgba"
Format 20 16 1
Projection "perspective" "fov" [60]
Translate 0 0 2.5
WorldBegin
LightSource "indirectlight" "gi" "float samples" [64]
LightSource "spotlight" "spot" "from" [0 0.5 0] "to" [0.3 -1 0.2] "intensity" [4] "coneangle" [0.7]
AttributeBegin
AreaLightSource "arealight" "lamp" "intensity" [2] "samples" [2]
Surface "constant"
Polygon "P" [-0.3 0.9 -0.3  0.3 0.9 -0.3  0.3 0.9 0.3  -0.3 0.9 0.3]
AttributeEnd
Illuminate "lamp" 1
Surface "matte"
Polygon "P" [-1 -1 -1  -1 -1 1  1 -1 1  1 -1 -1]
Color 0.8 0.3 0.3
Polygon "P" [-1 -1 1  -1 1 1  1 1 1  1 -1 1]
Polygon "P" [-1 -1 -1  -1 1 -1  -1 1 1  -1 -1 1]
Opacity 0.5 0.5 0.5
Translate 0.2 -0.4 0
Sphere 0.4 -0.4 0.4 360
WorldEnd
"""
