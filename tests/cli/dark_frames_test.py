"""Tests frames that are dark, too bright, or lit by another renderer's rules: the program must say why."""
import json
import pathlib
import sys

from program import Suite

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "image"))
from pictures import pixels  # noqa: E402

t = Suite()
HEAD = """Display "{name}.exr" "file" "rgba"
Format 32 32 1
PixelSamples 2 2
Projection "perspective" "fov" [40]
{options}
Translate 0 0 5
WorldBegin
{world}
WorldEnd
"""
BALL = 'Attribute "identifier" "name" "ball"\nSurface "matte"\nSphere 1 -1 1 360\n'


def told(name, world, options="", code=0, *arguments):
    """Returns the codes of the messages about a scene, and the statistics."""
    t.write(name + ".rib", HEAD.format(name=name, options=options, world=world))
    t.expect_run(name, [name + ".rib", "--stats", name + ".json", *arguments], code)
    warnings = json.loads((t.folder / (name + ".json")).read_text())["warnings"]
    return {w["code"]: w["message"] for w in warnings}


def picture(name):
    return pixels(t.folder / (name + ".exr"))


def middle(name):
    return picture(name)[16, 16][0]


# There is no light at all.
said = told("no_light", BALL)
t.expect("ball" in said.get("light-none", ""), f"a world without light says which surface asks for it: {said}")
t.expect(not told("default_surface", 'Sphere 1 -1 1 360'), "the default surface needs no light")
t.expect(not told("constant", 'Surface "constant"\nSphere 1 -1 1 360'), "neither does constant")
said = told("mixed", 'Attribute "identifier" "name" "glow"\nSurface "constant"\nTranslate .2 0 0 Sphere .5 -.5 .5 360\n' + BALL)
t.expect("ball" in said["light-none"] and "glow" not in said["light-none"], "only surfaces that ask are named")

# A surface that is cut out by its opacity is shaded for a depth map too, but a depth map shows no light.
t.write("leaf.sl", "surface leaf() { Oi = step(.5, s); Ci = Oi * diffuse(N); }")
t.write("map.rib", 'Display "map.z" "zfile" "z"\nFormat 32 32 1\nWorldBegin\nSurface "leaf"\nTranslate 0 0 5\nSphere 1 -1 1 360\nWorldEnd\n')
t.expect("light-none" not in t.run("map.rib").stderr, "a map for later frames needs no light")

# A light shines on nothing that follows it, or is switched off.
said = told("scoped", 'AttributeBegin\nLightSource "distantlight" 1\nAttributeEnd\n' + BALL)
t.expect("light-off" in said and "light-none" not in said, f"a light that ends with its block: {said}")

# Lights have no effect, and the message says why.
said = told("zero", 'LightSource "distantlight" 1 "intensity" 0\n' + BALL)
t.expect("sends no light" in said.get("light-useless", ""), f"intensity 0: {said}")
said = told("aside", 'LightSource "spotlight" 1 "from" [0 0 -5] "to" [0 0 -9] "intensity" 50\n' + BALL)
t.expect("sends no light" in said.get("light-useless", ""), f"a spotlight that looks away: {said}")
said = told("behind", 'LightSource "distantlight" 1 "from" [0 0 9] "to" [0 0 0]\n' + BALL)
t.expect("faces away" in said.get("light-useless", ""), f"a light behind everything: {said}")
for shadows in ("off", "on"):
    said = told("inside_" + shadows, f'Attribute "light" "shadows" "{shadows}"\nLightSource "pointlight" 1 "from" [0 0 0] "intensity" 9\n' + BALL)
    t.expect('within the bounds of "ball"' in said.get("light-useless", ""), f"a light inside a solid, shadows {shadows}: {said}")
said = told("shadowed", 'Attribute "light" "shadows" "on"\nLightSource "pointlight" 1 "from" [0 0 -3] "intensity" 9\n' + BALL +
            'Attribute "identifier" "name" "shield"\nAttribute "visibility" "camera" 0\nTranslate 0 0 -2 Disk 0 9 360\n')
t.expect("lies in its shadow" in said.get("light-useless", ""), f"a light whose shadow covers all: {said}")
t.expect(not told("useful", 'LightSource "distantlight" 1\n' + BALL), "a light that is seen is no matter")
t.expect(not told("cropped", 'LightSource "distantlight" 1 "intensity" 0\n' + BALL, "CropWindow 0 .5 0 .5").get("light-useless"),
         "a part of a frame says nothing of its lights")
said = told("behind_the_camera", 'LightSource "distantlight" 1\nTranslate 0 0 -10\n' + BALL, "", 3)
t.expect("behind the camera" in said.get("frame-empty", ""), f"everything behind the camera: {said}")

said = told("turned_away", 'LightSource "distantlight" 1\nSides 1\nDisk 0 1 360\n', "", 3)
t.expect("turned away from the camera (Sides 1)" in said.get("frame-empty", ""), f"a disk that faces away: {said}")

# One lamp is far too bright.
said = told("glare", 'LightSource "distantlight" 1\nLightSource "distantlight" 2 "intensity" 100\n' + BALL)
t.expect('"2"' in said.get("light-glare", "") and "64 times" in said["light-glare"], f"the lamp is named, and how much: {said}")
t.expect("light-glare" not in told("exposed", 'LightSource "distantlight" 2 "intensity" 100\n' + BALL, "Exposure .01 1"), "Exposure counts")

# The two conventions of arealight are compared: a patch of area 1 is at distance 3 in front of the camera's wall.
AREA = 'AttributeBegin\nTranslate 0 0 -3\nAttribute "visibility" "camera" 0\nAreaLightSource "arealight" 1 "intensity" 9 {given}\nPatch "bilinear" "P" [{p}]\nAttributeEnd\nIlluminate 1 1\n'
WALL = 'Surface "matte" "Ka" 0 "Kd" 1\nPatch "bilinear" "P" [-.1 .1 0 .1 .1 0 -.1 -.1 0 .1 -.1 0]\n'


def lamp(size, given=""):
    s = size / 2
    return AREA.format(given=given, p=f"{-s} {-s} 0 {s} {-s} 0 {-s} {s} 0 {s} {s} 0")


for size in (.2, .4):
    told(f"bmrt{size}", lamp(size, '"samples" 64') + WALL, 'Option "shade" "arealight" "bmrt"\nPixelSamples 4 4\nScreenWindow -.01 .01 -.01 .01')
    told(f"radiance{size}", lamp(size, '"samples" 64') + WALL, "ScreenWindow -.01 .01 -.01 .01")
small, large = middle("bmrt0.2"), middle("bmrt0.4")
t.expect(abs(small - 1) < .02 and abs(large - 1) < .02, f"intensity / distance^2 is 1 at 3, whatever the size: {small} {large}")
small, large = middle("radiance0.2"), middle("radiance0.4")
t.expect(abs(large / small - 4) < .1, f"a radiance of four times the area brings four times as much: {small} {large}")
said = told("of_bmrt", 'Attribute "radiosity" "patchsize" [10]\n' + lamp(.2) + WALL, "ScreenWindow -.01 .01 -.01 .01")
t.expect("scene-bmrt" in said and abs(middle("of_bmrt") - 1) < .05, f"a scene of BMRT's has BMRT's: {said}")
told("not_of_bmrt", 'Attribute "radiosity" "patchsize" [10]\n' + lamp(.2) + WALL, 'ScreenWindow -.01 .01 -.01 .01', 0, "--arealight", "radiance")
t.expect(middle("not_of_bmrt") < .2, "unless the command line says otherwise")

# The exponent of specular() depends on the convention.
SHINE = 'LightSource "distantlight" 1\nSurface "metal" "Ka" 0 "roughness" .1\nSphere 1 -1 1 360\n'
told("prman", SHINE)
told("rispec", SHINE, 'Option "shade" "specular" "rispec"')
told("switch", SHINE, "", 0, "--specular", "rispec")
told("bmrt_option", SHINE, 'Option "render" "prmanspecular" 0')
told("bmrt_twice", SHINE, 'Option "render" "prmanspecular" 1\nOption "render" "prmanspecular" 0')
told("bmrt_attribute", 'Attribute "render" "casts_shadows" "none"\n' + SHINE)
t.expect(picture("prman") != picture("rispec"), "the two exponents differ")
for name in ("switch", "bmrt_option", "bmrt_twice"):
    t.expect(picture(name) == picture("rispec"), f"{name} has RISpec's")
t.expect(picture("bmrt_attribute") == picture("prman"), "other requests of BMRT's change nothing")
t.write("brdf.sl", "surface brdf() { normal n = normalize(N); Oi = 1; illuminance (P, n, PI / 2) Ci += Cl * specularbrdf(normalize(L), n, -normalize(I), .1); }")
for name, option in (("brdf_rispec", 'Option "shade" "specular" "rispec"'), ("brdf_bmrt", 'Option "render" "prmanspecular" 0'), ("brdf_prman", "")):
    told(name, SHINE.replace('Surface "metal" "Ka" 0 "roughness" .1', 'Surface "brdf"'), option)
t.expect(picture("brdf_bmrt") == picture("brdf_rispec") != picture("brdf_prman"), "specularbrdf() has the exponent of specular()")
told("back", SHINE, 'Option "render" "prmanspecular" 0', 0, "--specular", "prman")
t.expect(picture("back") == picture("prman"), "and the command line decides")

t.finish()
