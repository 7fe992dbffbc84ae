"""Tests which colours gather() of RSL returns: those of the surface that is met, and those seen through the volume in between."""
import math
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "image"))
from pictures import pixels  # noqa: E402
from program import Suite  # noqa: E402

t = Suite()
# The left half of the square before the eye meets a sheet behind the eye, four units away; the right half meets nothing.
SCENE = """Format 16 16 1
PixelFilter "box" 1 1
PixelSamples 1 1
Translate 0 0 3
WorldBegin
  Attribute "visibility" "trace" [1]
  AttributeBegin
    Color [0.8 0.4 0.2]
    Opacity [0.5 0.5 0.5]
    Surface "constant"
    Polygon "P" [-9 -9 -4  -9 9 -4  0 9 -4  0 -9 -4]
  AttributeEnd
  %s
  Surface "asks"
  Polygon "P" [-9 -9 0  -9 9 0  9 9 0  9 -9 0]
WorldEnd
"""
ASKS = """surface asks() {
  normal Nf = faceforward(normalize(N), I);
  color c = color(7, 7, 7), found = 0;
  gather("illuminance", P, Nf, 0, 1, %s) found = c; else found = c + 1;
  Oi = 1; Ci = found;
}
"""
t.write("mist.sl", """volume mist(float density = 0.25) {
  float clear = exp(-density * length(I));
  Ci = mix(color(0, 0, 1), Ci, clear);
  Oi = mix(color(1, 1, 1), Oi, clear);
}
""")
CLEAR = math.exp(-0.25 * 4)
BARE = [0.4, 0.2, 0.1]  # This is premultiplied.
MIXED = [CLEAR * c + (1 - CLEAR) * air for c, air in zip(BARE, (0, 0, 1))]


def expect(what, asked, volume, met, missed=(8, 8, 8)):
    t.write("asks.sl", ASKS % asked)
    t.write("scene.rib", SCENE % volume)
    result = t.expect_run(what, ["scene.rib", "-o", "scene.exr"], 0)
    t.expect(not result.stderr, f"  without a message ({result.stderr[:300]})")
    seen = pixels(t.folder / "scene.exr")
    for (x, wanted) in ((4, met), (12, missed)):
        far = max(abs(a - b) for a, b in zip(seen[x, 8], wanted))
        t.expect(far < 1e-3, f"  pixel {x} has {[round(v, 4) for v in seen[x, 8][:3]]}, and {list(wanted)} is wanted")


for name in ("surface:Ci", "volume:Ci"):
    expect(f"{name} without a volume is the colour of what is met", f'"{name}", c', "", BARE)
for name in ("surface:Oi", "volume:Oi"):
    expect(f"{name} without a volume is the opacity of what is met", f'"{name}", c', "", [0.5] * 3)
expect("surface:Ci takes no notice of a volume", '"surface:Ci", c', 'Exterior "mist"', BARE)
expect("volume:Ci has crossed the volume", '"volume:Ci", c', 'Exterior "mist"', MIXED)
expect("volume:Oi has crossed it too", '"volume:Oi", c', 'Exterior "mist"', [1 - 0.5 * CLEAR] * 3)
expect("the volume of the other side is not crossed", '"volume:Ci", c', 'Interior "mist"', BARE)
t.write("asks.sl", ASKS % '"volume:Ci", c, "volume:density", c')
t.write("scene.rib", SCENE % "")
t.expect_run("another value of a volume is warned of", ["scene.rib", "-o", "scene.exr"], 0, '"volume:density", which is unknown')

# The rays of BMRT, and those that the headers of "Advanced RenderMan" ask a server for in world space. The left half meets the sheet four units away.
t.write("world.h", """#define worldp(p) transform("world", p)
#define worldv(v) vtransform("world", v)
#define trace(p, d) rayserver(worldp(p), worldv(d))
#define visibility(p, q) rayserver(worldp(p), worldp(q))
#define rayhittest(p, d, phit, nhit) rayserver(worldp(p), worldv(d), phit, nhit)
#define fulltrace(p, d, chit, dist, phit, nhit, pmiss, rmiss) rayserver(worldp(p), worldv(d), chit, dist, phit, nhit, pmiss, rmiss)
""")
ASKED = """surface asks() {
  vector d = faceforward(normalize(N), I), n = 0, r = 0;
  color c = 7, seen = trace(P, d);
  point p = 0, q = 0;
  float far = rayhittest(P, d, p, n), way = 0, back = zcomp(P - p);
  fulltrace(P, d, c, way, p, n, q, r);
  Oi = 1;
  Ci = color(comp(c, 0), abs(zcomp(n)), min(way, far) < 5 ? way + back / 10 : 9);
  if (c != seen && comp(c, 0) > 0) Ci = -1;
  if (visibility(P, P + 9 * d) != (way < 5 ? color(.5) : color(1))) Ci = -2;
}
"""
for header in ("", '#include "world.h"\n'):
    t.write("asks.sl", header + ASKED)
    result = t.expect_run(f"fulltrace, rayhittest and visibility with header '{header.strip()}'", ["scene.rib", "-o", "scene.exr"], 0)
    seen = pixels(t.folder / "scene.exr")
    for (x, wanted) in ((4, (0.4, 1, 4.4)), (12, (0, 0, 9))):
        far = max(abs(a - b) for a, b in zip(seen[x, 8], wanted))
        t.expect(far < 1e-3, f"  pixel {x} has {[round(v, 4) for v in seen[x, 8][:3]]}, and {list(wanted)} is wanted")
t.finish()
