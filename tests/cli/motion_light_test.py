"""Tests that an object that moves through changing light is reported with its place, and an object that moves in even light or
stands still is not."""
import re

from program import Suite

t = Suite()


def said(motion, light, depth=4):
    t.write("ball.rib", f"""Format 32 32 1 PixelSamples 2 2 Projection "perspective" "fov" [40] Shutter 0 1 Display "ball.exr" "openexr" "rgb" WorldBegin
Attribute "light" "shadows" "on" {light}
AttributeBegin Attribute "identifier" "name" ["ball"] MotionBegin [0 1] Translate -0.6 0 {depth} Translate {motion} 0 {depth} MotionEnd
Surface "matte" Sphere 0.4 -0.4 0.4 360 AttributeEnd
WorldEnd
""")
    return t.run("ball.rib", "-o", "ball.exr").stderr


LAMP = 'LightSource "pointlight" "bulb" "from" [0.6 0.5 3] "intensity" [4]'
SUN = 'LightSource "distantlight" "sun" "from" [1 1 -1] "to" [0 0 0] "intensity" [1]'
near = said(0.6, LAMP)
t.expect(re.search(r'"ball": light on it changes by \d+ % as it moves.*at pixel \d+,\d+.*\[motion-light\]', near) is not None, f"a ball that comes to a lamp: {near}")
t.expect("motion-light" not in said(-0.6, LAMP), "a ball that stands still")
t.expect("motion-light" not in said(-0.55, LAMP), "a ball that hardly moves")
t.expect("motion-light" not in said(0.6, SUN), "a ball in the sun")
t.expect("motion-light" not in said(0.6, LAMP + ' Illuminate "bulb" 0 ' + SUN), "a lamp that is switched off for the ball")
t.expect("motion-light" not in said(0.6, LAMP, depth=-4), "a ball behind the eye")

# Objects that rays do not meet are dropped once they are hidden.
t.write("part.rib", "Sphere 0.4 -0.4 0.4 360\n")
t.write("dropped.rib", f"""Format 32 32 1 PixelSamples 2 2 Projection "perspective" "fov" [40] Shutter 0 1 Display "dropped.exr" "openexr" "rgb" WorldBegin
Attribute "light" "shadows" "on" {LAMP}
Surface "matte" Polygon "P" [-2 -2 6  2 -2 6  2 2 6  -2 2 6]
Attribute "visibility" "diffuse" 0 "specular" 0 "transmission" 0 "photon" 0
MotionBegin [0 1] Translate -0.6 0 4 Translate 0.6 0 4 MotionEnd
Procedural "DelayedReadArchive" ["part.rib"] [-1 1 -1 1 -1 1]
WorldEnd
""")
for arguments in ((), ("--gi", "atlas", "--photons", "2000"), ("--gi", "gather")):
    t.expect_run(f"a moving procedural that rays do not meet, {' '.join(arguments)}", ["dropped.rib", *arguments], 0)
t.finish()
