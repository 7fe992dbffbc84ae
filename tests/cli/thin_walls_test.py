"""Tests that offset-thin is reported once for all objects of a name, at the place of the worst, with the number of others. Other names get
messages of their own."""
import re

from program import Suite

t = Suite()


def bowls(*shells):
    """Returns bowls, each with another bowl around it. Each pair is an attribute state of its own: (name, radius of the outer one)."""
    out = ['Format 144 48 1 PixelSamples 1 1 PixelFilter "box" 1 1 Projection "orthographic" ScreenWindow -3 3 -1 1 Display "bowls.exr" "openexr" "rgb" WorldBegin '
           'LightSource "indirectlight" "gi" "float samples" [64] LightSource "distantlight" 1 "from" [0 0 -3] "to" [0 0 0] Surface "matte"']
    for k, (name, radius) in enumerate(shells):
        out.append(f'AttributeBegin Attribute "identifier" "string name" ["{name}"] Color 0.{5 + k} 0.7 0.7 Translate {2 * k - 2} 0 4 '
                   f"Sphere 0.8 0 0.8 -360 Sphere {radius} 0 {radius} 360 AttributeEnd")
    return "\n".join(out) + "\nWorldEnd\n"


def told(*shells):
    """Returns (name, line, share in %, how many more) of each message."""
    t.write("bowls.rib", bowls(*shells))
    said = t.run("bowls.rib", "--gi", "gather", "--max-error", "0.5").stderr
    found = re.findall(r'rib:(\d+): warning: "(\w+)": (\d+) % of the rays.*?leak through(?:; so do (\d+) more of that name)? \(.*\[offset-thin\]', said)
    t.expect(len(found) == said.count("[offset-thin]"), "every message can be read")
    return [(name, int(line), int(share), int(more or 0)) for line, name, share, more in found]


house = told(("house", 0.83), ("house", 0.802), ("house", 0.82))
t.expect(len(house) == 1 and house[0][0] == "house" and house[0][3] == 2, f"three of a name are one message: {house}")
alone = told(("house", 0.83), ("shed", 0.802), ("barn", 0.82))
t.expect([(name, more) for name, _, _, more in sorted(alone)] == [("barn", 0), ("house", 0), ("shed", 0)], f"three names are three: {alone}")
worst = max(alone, key=lambda w: w[2], default=())
t.expect(house[0][1:3] == worst[1:3], f"the message for all is that of the worst: {house}, {worst}")
t.expect(told(("house", 0.9), ("house", 0.9), ("house", 0.9)) == [], "walls that rays know are not told")
t.finish()
