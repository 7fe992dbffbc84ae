"""A scene for tests of many frames: a ball moves over a floor from frame to frame, with indirect light."""
FRAME = """FrameBegin %d
WorldBegin
LightSource "pointlight" 1 "from" [3 3 -3] "intensity" [20]
LightSource "indirectlight" "gi" "float samples" [%d]
Surface "plastic"
Translate %g 0 0
Sphere 1 -1 1 360
Polygon "P" [-4 -1 -4 -4 -1 4 4 -1 4 4 -1 -4]
WorldEnd
FrameEnd
"""


def head(width, height):
    return f'Format {width} {height} 1\nProjection "perspective" "fov" [40]\nTranslate 0 0 5\nPixelSamples 2 2\n'


def frame(number, samples, step):
    return FRAME % (number, samples, step * number)
