"""The scenes of tests/bench/truth.py. Each is RIB for the renderer, and lines for truth_tracer.cpp or a closed form."""
import math

class Scene:
    """A scene that both programs read: RIB, and the lines of truth_tracer.cpp. `known` is the radiance of every pixel if a formula gives it."""
    size = 128  # This is the number of pixels along each edge.

    def __init__(self, eye, yaw=0, pitch=0, fov=70, shutter=False, samples=256, known=None, more=()):
        self.rib, self.lines, self.lights, self.count, self.shutter, self.known, self.more = [], [], "", 0, shutter, known, list(more)
        self.surface = 'Surface "matte"'
        a, b = math.radians(yaw), math.radians(pitch)
        forward = (math.sin(a) * math.cos(b), -math.sin(b), math.cos(a) * math.cos(b))
        up = (math.sin(a) * math.sin(b), math.cos(b), math.cos(a) * math.sin(b))
        right = (math.cos(a), 0, -math.sin(a))
        self.line("size", self.size, self.size)
        self.line("camera", fov, *eye, *right, *up, *forward)
        self.head = (f'Format {self.size} {self.size} 1\nPixelSamples 4 4\nPixelFilter "box" 1 1\nProjection "perspective" "fov" [{fov}]\n'
                     + "Shutter 0 1\n" * shutter + f"Rotate {-pitch} 1 0 0\nRotate {-yaw} 0 1 0\nTranslate {-eye[0]} {-eye[1]} {-eye[2]}\n")
        self.indirect = f'LightSource "indirectlight" "bounce" "samples" [{samples}]\n'

    def line(self, *words):
        self.lines.append(" ".join(str(w) for w in words))

    def color(self, albedo, name):
        named = f'Attribute "identifier" "name" ["{name}"]\n' if name else ""
        return f"{named}Color {albedo} {albedo} {albedo}\n"

    def quad(self, a, b, c, d, albedo=0.7, name=""):
        self.line("quad", *a, *b, *c, *d, albedo, 0)
        self.rib.append(self.color(albedo, name) + f'Polygon "P" [{" ".join(str(x) for p in (a, b, c, d) for x in p)}]\n')

    def box(self, low, high, albedo=0.7, name="", without=""):
        """Adds the six sides of a box, without those named (of -x +x -y +y -z +z)."""
        (x, y, z), (X, Y, Z) = low, high
        sides = {"-x": ((x, y, z), (x, Y, z), (x, Y, Z), (x, y, Z)), "+x": ((X, y, z), (X, y, Z), (X, Y, Z), (X, Y, z)),
                 "-y": ((x, y, z), (x, y, Z), (X, y, Z), (X, y, z)), "+y": ((x, Y, z), (X, Y, z), (X, Y, Z), (x, Y, Z)),
                 "-z": ((x, y, z), (X, y, z), (X, Y, z), (x, Y, z)), "+z": ((x, y, Z), (x, Y, Z), (X, Y, Z), (X, y, Z))}
        for side, corners in sides.items():
            if side not in without.split():
                self.quad(*corners, albedo, name)

    def ball(self, center, radius, albedo=0.7, motion=(0, 0, 0), name=""):
        self.line("sphere", *center, radius, albedo, 0, *motion)
        moves = "MotionBegin [0 1]\nTranslate 0 0 0\nTranslate {} {} {}\nMotionEnd\n".format(*motion) * any(motion)
        self.rib.append("AttributeBegin\n" + self.color(albedo, name) + moves + "Translate {} {} {}\n".format(*center)
                        + f"Sphere {radius} {-radius} {radius} 360\nAttributeEnd\n")

    def lamp(self, corner, u, v, radiance):
        """Adds a rectangle that shines to the side of u x v."""
        a, b, d = corner, [p + q for p, q in zip(corner, u)], [p + q for p, q in zip(corner, v)]
        c = [p + q for p, q in zip(b, v)]
        self.line("lamp", *a, *b, *c, *d, 0, radiance)
        self.count += 1
        self.lights += (f'AttributeBegin\nAreaLightSource "arealight" {self.count} "intensity" [{radiance}] "samples" [16]\nColor 0 0 0\n'
                        f'Patch "bilinear" "P" [{" ".join(str(x) for p in (a, b, d, c) for x in p)}]\nAttributeEnd\nIlluminate {self.count} 1\n')

    def aim(self, a, b, c, d):
        """Names an opening through which the tracer sends a fifth of its paths."""
        self.line("aim", *a, *b, *c, *d)

    def gloss(self, Ks, roughness):
        """Makes the following surfaces plastic with this highlight. With Ks 0 they are matte."""
        self.line("gloss", Ks, 8 / roughness)
        self.rib.append(f'Surface "plastic" "Kd" [1] "Ks" [{Ks}] "roughness" [{roughness}]\n')

    def point(self, at, intensity):
        self.line("point", *at, intensity)
        self.lights += f'LightSource "pointlight" "bulb" "from" [{at[0]} {at[1]} {at[2]}] "intensity" [{intensity}]\n'

    def sky(self, radiance, more=""):
        self.line("sky", radiance)
        self.lights += f'LightSource "environmentlight" "sky" "intensity" [{radiance}] "samples" [64] {more}\n'

    def mesh(self, corners, triangles, albedo, rib):
        """Adds a mesh. The tracer gets triangles, and the renderer gets the primitive that they stand for."""
        for t in triangles:
            self.line("triangle", *(x for i in t for x in corners[i]), albedo, 0)
        self.rib.append(rib)

    def text(self):
        return (self.head + 'WorldBegin\nAttribute "light" "shadows" ["on"]\n' + self.indirect + self.lights + f'Sides 2\n{self.surface}\n'
                + "".join(self.rib) + "WorldEnd\n")


def thin_walls():
    s = Scene((2.6, 1.2, -1.2), yaw=-60, fov=80)
    s.box((-3, 0, -1.5), (3, 2.5, 1.5), name="room")
    s.box((-0.01, 0, -1.5), (0.01, 2.5, 1.5), name="thin wall", without="-y +y -z +z")
    s.line("point", -1.5, 2, 0, 8)
    s.line("point", 1.5, 2, 0, 0.05)
    s.lights += ('LightSource "pointlight" "bright" "from" [-1.5 2 0] "intensity" [8]\nLightSource "pointlight" "dim" "from" [1.5 2 0] "intensity" [0.05]\n')
    return s


def niche():
    """Returns a lamp of 26 cm that shines upwards between walls of 40 cm."""
    s = Scene((-1.7, 1.5, -1.7), yaw=45, pitch=5, fov=80)
    s.box((-2, 0, -2), (2, 3, 2), name="room")
    s.lamp((0.87, 0.02, 0.87), (0, 0, 0.26), (0.26, 0, 0), 300)
    for low, high in (((0.8, 0, 0.8), (0.82, 0.4, 1.2)), ((1.18, 0, 0.8), (1.2, 0.4, 1.2)), ((0.82, 0, 0.8), (1.18, 0.4, 0.82)),
                      ((0.82, 0, 1.18), (1.18, 0.4, 1.2))):
        s.box(low, high, name="low wall")
    s.aim((0.82, 0.4, 0.82), (1.18, 0.4, 0.82), (1.18, 0.4, 1.18), (0.82, 0.4, 1.18))
    return s


def slot():
    """Returns a room without a lamp beside one with a lamp, with a slot of 2 cm between them."""
    s = Scene((2.6, 1.2, -1.2), yaw=-60, fov=80)
    s.box((-3, 0, -1.5), (3, 2.5, 1.5), name="room")
    for low, high in ((0, 1), (1.02, 2.5)):
        s.box((-0.05, low, -1.5), (0.05, high, 1.5), name="wall")
    s.point((-1.5, 2, 0), 8)
    for x in (0, 0.05):  # its middle, and its end, through which all light of the dark room comes
        s.aim((x, 1, -1.5), (x, 1.02, -1.5), (x, 1.02, 1.5), (x, 1, 1.5))
    return s


def window(more=""):
    """Returns a closed room with a window of 1 x 1 to an even sky."""
    s = Scene((-1.7, 1.5, -1.7), yaw=40, fov=80)
    s.box((-2, 0, -2), (2, 3, 2), name="room", without="+x")
    for (y, Y), (z, Z) in (((0, 1), (-2, 2)), ((2, 3), (-2, 2)), ((1, 2), (-2, -0.5)), ((1, 2), (0.5, 2))):
        s.quad((2, y, z), (2, y, Z), (2, Y, Z), (2, Y, z), name="wall with a window")
    s.sky(3, more)
    s.aim((2, 1, -0.5), (2, 2, -0.5), (2, 2, 0.5), (2, 1, 0.5))
    return s


def contact():
    s = Scene((0, 1.2, -3), pitch=18, fov=50)
    s.quad((-8, 0, -8), (-8, 0, 8), (8, 0, 8), (8, 0, -8), 0.6, "floor")
    s.ball((0, 0.7, 0), 0.7, 0.6, name="ball")
    s.sky(1)
    return s


def moving_ball():
    s = Scene((0, 1.6, -3), pitch=22, fov=50, shutter=True)
    s.quad((-8, 0, -8), (-8, 0, 8), (8, 0, 8), (8, 0, -8), 0.6, "floor")
    s.ball((-0.6, 0.8, 0), 0.4, 0.6, (1.2, 0, 0), name="ball")
    s.lamp((-0.2, 4, -0.2), (0.4, 0, 0), (0, 0, 0.4), 60)
    return s


def displaced_ball(amplitude=0.08, waves=9, more=""):
    """Returns a ball of radius 0.7 with bumps. The tracer gets 320 x 160 x 2 triangles of it."""
    s = Scene((0, 1.2, -3), pitch=12, fov=50)
    s.quad((-8, 0, -8), (-8, 0, 8), (8, 0, 8), (8, 0, -8), 0.6, "floor")
    s.lamp((-2.5, 3, -1.5), (0.8, 0, 0), (0, 0, 0.8), 20)
    rings, sectors = 160, 320
    corners = []
    for j in range(rings + 1):
        for i in range(sectors):
            t, p = math.pi * j / rings, 2 * math.pi * i / sectors
            n = (math.sin(t) * math.cos(p), math.sin(t) * math.sin(p), math.cos(t))
            r = 0.7 + amplitude * math.prod(math.sin(waves * x) for x in n)
            corners.append((r * n[0], 0.8 + r * n[1], r * n[2]))
    triangles = []
    for j in range(rings):
        for i in range(sectors):
            a, b = j * sectors + i, j * sectors + (i + 1) % sectors
            triangles += [(a, b, b + sectors), (a, b + sectors, a + sectors)]
    s.mesh(corners, triangles, 0.6,
           f'AttributeBegin\n{s.color(0.6, "displaced ball")}{more}Translate 0 0.8 0\nAttribute "displacementbound" "float sphere" [{amplitude}] "coordinatesystem" ["object"]\n'
           f'Displacement "bumps" "amplitude" [{amplitude}] "waves" [{waves}]\nSphere 0.7 -0.7 0.7 360\nAttributeEnd\n')
    return s


def plastic():
    """A shining ball on a shining floor: the ball's lower half sees the lamp's highlight on the floor, and all of it mirrors the sky."""
    s = Scene((0, 1.2, -3), pitch=12, fov=50)
    s.lamp((-1.6, 3, -1.5), (0.8, 0, 0), (0, 0, 0.8), 20)
    s.gloss(0.5, 0.3)
    s.quad((-8, 0, -8), (-8, 0, 8), (8, 0, 8), (8, 0, -8), 0.3, "floor")
    s.ball((0, 0.8, 0), 0.7, 0.3, name="ball")
    s.sky(0.1)
    return s


def mirrored(surroundings, Ks=0.5, roughness=0.3):
    """A shining floor from far above, in light of radiance 1: the highlight is 1 / pi times the integral of (N.H)^e over the hemisphere."""
    e = 8 / roughness
    s = Scene((0, 100, 0), pitch=90, fov=1, known=0.3 + Ks * 8 / (e + 2) * (1 - 2 ** (-(e + 2) / 2)))
    s.gloss(Ks, roughness)
    s.quad((-400, 0, -400), (-400, 0, 400), (400, 0, 400), (400, 0, -400), 0.3, "floor")
    surroundings(s)
    return s


def dome(s):
    """Surfaces that shine by themselves all around: no lamp, but indirect light."""
    s.line("gloss", 0, 1)
    s.line("sphere", 0, 0, 0, 600, 0, 1, 0, 0, 0)
    s.rib.append('AttributeBegin\nColor 1 1 1\nSurface "constant"\nSphere 600 -600 600 360\nAttributeEnd\n')


def sphere(albedo, known, surface, more=()):
    """Looks about in a sphere of radius 1. A closed, even sphere has one radiance everywhere."""
    s = Scene((0.2, 0.1, -0.3), fov=90, known=known, more=more)
    s.surface = surface
    s.ball((0, 0, 0), 1, albedo, name="sphere")
    return s


def glowing(albedo):
    """Returns a surface that sends 1 and reflects. Its radiance is 1 / (1 - albedo)."""
    return sphere(albedo, 1 / (1 - albedo), 'Surface "glow"')


def white(albedo):
    """Returns a sphere with a bulb of intensity 1 in the middle. Light counts that is reflected at least twice."""
    s = sphere(albedo, albedo ** 2 / (1 - albedo), 'Surface "matte"', ["--indirect-only"])
    s.point((0, 0, 0), 1)
    return s


GLOW = "surface glow() { Ci = 1 + Cs * diffuse(normalize(faceforward(normalize(N), I))); Oi = 1; }\n"
BUMPS = """displacement bumps(float amplitude = 0.1; float waves = 9) {
  vector n = normalize(vector transform("shader", P));
  normal out = normalize(N);
  P += out * amplitude * sin(waves * xcomp(n)) * sin(waves * ycomp(n)) * sin(waves * zcomp(n));
  N = calculatenormal(P);
}
"""
SHADERS = {"bumps": BUMPS, "glow": GLOW}
# Each scene has a function that makes it, and the tracer's paths per pixel. With these the truth is more accurate than
# the methods that it judges.
SCENES = {"thin_walls": (thin_walls, 512), "niche": (niche, 2048), "slot": (slot, 2048), "window": (window, 512), "contact": (contact, 512),
          "moving_ball": (moving_ball, 512), "displaced_ball": (displaced_ball, 512), "plastic": (plastic, 512), "mirrored_sky": (lambda: mirrored(lambda s: s.sky(1)), 0),
          "mirrored_dome": (lambda: mirrored(dome), 0)}
SCENES |= {f"glowing_{int(100 * a)}": (lambda a=a: glowing(a), 0) for a in (0.5, 0.8, 0.9)}
SCENES |= {f"white_{int(100 * a)}": (lambda a=a: white(a), 0) for a in (0.8, 0.9)}
