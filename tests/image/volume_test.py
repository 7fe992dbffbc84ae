"""Compares volumes with closed forms: the light that boxes and OpenVDB files transmit and scatter, and their shadows. It also
tests the messages about bad volumes."""
import math
import pathlib
import struct
import subprocess
import sys
import tempfile

from pictures import pixels

tomales, root = str(pathlib.Path(sys.argv[1]).resolve()), pathlib.Path(sys.argv[2])
sys.path.append(str(root / "scenes"))
import vdb  # noqa: E402

failures = []
HEAD = """Display "out.exr" "file" "rgba"
Format 8 8 1
PixelSamples 2 2
PixelFilter "box" 1 1
Projection "orthographic"
ScreenWindow -1 1 -1 1
WorldBegin
"""
WALL = 'Surface "constant" Color [1 1 1]\nPolygon "P" [-9 -9 {0} 9 -9 {0} 9 9 {0} -9 9 {0}]\n'
BOX = 'Volume "box" [-2 2 -2 2 1 4] [0 0 0] "constant float density" [{}]\n'


def expect(condition, message):
    print(("ok      " if condition else "FAILED  ") + message)
    if not condition:
        failures.append(message)


def near(found, wanted, share, message):
    expect(abs(found - wanted) <= share * abs(wanted), f"{message}: {found:.5f} of {wanted:.5f}")


def run(body, *options):
    (folder / "v.rib").write_text(HEAD + body + "WorldEnd\n")
    return subprocess.run([tomales, "v.rib", *options], cwd=folder, capture_output=True, text=True)


def middle(body, *options):
    """Returns red and alpha in the middle of the picture."""
    result = run(body, "-q", *options)
    expect(result.returncode == 0, f"rendered {result.stderr}")
    values = pixels(folder / "out.exr")[(4, 4)]
    return values[0], values[3]


def photons_in_the_medium(body):
    """Returns the power of the photons that collide 1 to 3 below a layer of smoke, above a black floor."""
    light = 'LightSource "distantlight" 1 "from" [0 10 0] "to" [0 0 0]\nExterior "medium" "scattering" [0.05 0.05 0.05]\nSurface "matte" "Kd" [0]\n'
    (folder / "p.rib").write_text(f'WorldBegin\n{light}{body}Polygon "P" [-4 0 1  -4 0 9  4 0 9  4 0 1]\nWorldEnd\n')
    for command in (["photons", "p.rib", "-o", "maps", "--photons", "100000"], ["convert", "maps/scene.volume.ptc", "p.ply"]):
        subprocess.run([tomales, *command], cwd=folder, check=True, capture_output=True)
    header, values = (folder / "p.ply").read_bytes().split(b"end_header\n", 1)
    width = header.count(b"property float")
    rows = struct.iter_unpack(f"<{width}f", values)
    return sum(row[width - 1] for row in rows if 2 <= row[1] <= 4)


def openvdb(grid, file="fog.vdb", bound="-9 9 -9 9 -9 9"):
    return f'Volume "blobbydso:impl_openvdb" [{bound}] [0 0 0] "constant string[2] blobbydso:stringargs" ["{file}" "{grid}"]\n'


with tempfile.TemporaryDirectory() as name:
    folder = pathlib.Path(name)
    dark = "Color [0 0 0]\n"

    # The law of Beer and Lambert holds.
    near(middle(WALL.format(9) + dark + BOX.format(0.5))[0], math.exp(-1.5), 1e-4, "a wall behind it is dimmed")
    near(middle(WALL.format(3) + dark + BOX.format(0.5))[0], math.exp(-1), 1e-4, "a wall inside is dimmed by what is before it")
    near(middle(WALL.format(0.5) + dark + BOX.format(0.5))[0], 1, 1e-6, "a wall before it is not")
    near(middle(dark + BOX.format(0.5))[1], 1 - math.exp(-1.5), 1e-4, "before nothing it has its own alpha")
    near(middle(WALL.format(9) + dark + BOX.format(0.5) + BOX.format(0.3).replace("1 4", "5 6"))[0], math.exp(-1.8), 1e-4, "two are dimmed by both")
    near(middle(WALL.format(9) + dark + "Scale 1 1 2\n" + BOX.format(0.5))[0], math.exp(-3), 1e-4, "what counts is the length of the world")
    slope = " ".join(str(z) for z in range(4) for _ in range(4))
    near(middle(WALL.format(9) + dark + f'Volume "box" [-2 2 -2 2 1 4] [2 2 4] "varying float density" [{slope}]\n')[0], math.exp(-4.5), 1e-4,
         "a density that grows is integrated")

    # The file has 12 points of density 2, 0.25 apart. Density falls linearly to 0 beyond the outermost points.
    vdb.write(folder / "fog.vdb", "density", 12, lambda x, y, z: 2.0, 0.25, (-1.5, -1.5, 1))
    near(middle(WALL.format(9) + dark + openvdb("density"))[0], math.exp(-6), 1e-4, "the density of a file")
    near(middle(WALL.format(9) + dark + openvdb("density:fogvolume", bound="-9 9 -9 9 1 2"))[0], math.exp(-2), 1e-4, "the bound cuts it")
    near(middle(WALL.format(9) + dark + "Translate 0 0 1 Rotate 90 0 0 1\n" + openvdb("density"))[0], math.exp(-6), 1e-4, "it stands where the object stands")
    vdb.write(folder / "far.vdb", "density", 140, lambda x, y, z: 0.1 if x < 130 and 100 <= y < 132 and z in (2, 133) else 0.0, 1, (-70, -116, 1))
    near(middle(WALL.format(999) + dark + openvdb("density", "far.vdb", "-99 99 -99 99 -99 999"))[0], math.exp(-0.2), 1e-4, "bricks far apart, and none between")

    # Light of a lamp at the side is scattered once, as in air that is the same everywhere.
    lamp = 'LightSource "distantlight" 1 "to" [0 -1 0] "intensity" [2]\n'
    gas = 'Interior "medium" "scattering" [0.3 0.3 0.3] "absorption" [0.2 0.2 0.2]\n'
    near(middle(lamp + gas + BOX.format(0.5))[0], 2 / 4 * 0.6 * -math.expm1(-0.75), 1e-3, "it scatters in proportion to what it stops")
    near(middle(lamp + gas + f'Volume "box" [-2 2 -2 2 1 4] [2 2 4] "varying float density" [{slope}]\n')[0], 2 / 4 * 0.6 * -math.expm1(-2.25), 1e-3,
         "also where the density grows")
    beside = 'LightSource "pointlight" 1 "from" [0.5 0 2.5]\n'
    steps, black = gas.replace('"medium"', '"medium" "steps" [512]'), WALL.format(3.9).replace("[1 1 1]", "[0 0 0]")
    air = middle(beside + steps.replace("Interior", "Atmosphere") + black)[0]
    near(middle(beside + steps + BOX.format(1).replace("-2 2 -2 2 1 4", "-9 9 -9 9 0 3.9"))[0], air, 5e-3, "a lamp in it, as in even air")

    # The volume receives and casts shadows. Light comes from above, and has gone 1 to 3 units deep.
    shadow = 'Attribute "light" "string shadows" ["on"]\nLightSource "distantlight" 1 "to" [0 0 1]\n'
    near(middle(shadow + 'Surface "matte" Color [1 1 1]\nPolygon "P" [-9 -9 9 9 -9 9 9 9 9 -9 9 9]\n' + 'Attribute "visibility" "int camera" [0]\n' + dark + BOX.format(0.5))[0],
         math.exp(-1.5), 1e-3, "it casts a shadow")
    near(middle(shadow + gas + BOX.format(1))[0], 0.6 / 4 * -math.expm1(-2 * 0.5 * 3) / 2, 5e-3, "it dims the light on its way in")

    # Gather rays go through a slab: this is 2 E3(1), of the exponential integral.
    slab = 'Volume "box" [-900 900 -900 900 4 5] [0 0 0] "constant float density" [1]\n'
    glow = 'Surface "constant" Color [1 1 1]\nPolygon "P" [-9000 -9000 -9  9000 -9000 -9  9000 9000 -9  -9000 9000 -9]\n'
    floor = 'Surface "matte" Color [1 1 1]\nPolygon "P" [-9 -9 9 -9 9 9 9 9 9 9 -9 9]\n'
    unseen = 'Attribute "visibility" "int camera" [0]\n'
    near(middle('LightSource "indirectlight" 1 "samples" [4096]\n' + floor + unseen + glow + dark + slab)[0], 2 * 0.109692, 0.02, "gather rays are dimmed")
    near(middle('LightSource "indirectlight" 1 "samples" [1024]\n' + floor + unseen + glow + dark + slab, "--gi", "reference")[0], 2 * 0.109692, 0.03, "and paths")
    mirror = 'Surface "mirror"\nPolygon "P" [-9 -9 9 9 -9 9 9 9 9 -9 9 9]\n'
    near(middle(lamp + mirror + gas + unseen + BOX.format(0.5))[0], 2 / 4 * 0.6 * -math.expm1(-0.75), 0.02, "a mirror shows it, and nothing behind it")

    # The bits are the same for any number of threads, any buckets and any order.
    # Photons that collide in a medium below smoke have lost as much power in the smoke as rays lose light.
    smoke = 'AttributeBegin\nInterior "medium" "scattering" [0 0 0] "absorption" [2 2 2]\nVolume "box" [-5 5 5 6 0 10] [0 0 0] "constant float density" [{}]\nAttributeEnd\n'
    near(photons_in_the_medium(smoke.format(1)), math.exp(-2) * photons_in_the_medium(smoke.format(0)), 0.04, "smoke dims the photons of a medium behind it")

    body = shadow + gas + WALL.format(3) + openvdb("density") + BOX.format(0.2).replace("1 4", "3 6")
    bits = set()
    for options in ("-t 1", "-t 2", "-t 2 --bucket 4x4"):
        run(body, "-q", *options.split())
        bits.add(str(sorted(pixels(folder / "out.exr").items())))
    expect(len(bits) == 1, "the bits do not depend on threads and buckets")

    # A volume that cannot be used is reported with file and line.
    vdb.write(folder / "double.vdb", "density", 8, lambda x, y, z: 1.0, kind="double")
    whole = (folder / "fog.vdb").read_bytes()
    (folder / "broken.vdb").write_bytes(whole[:len(whole) // 2])
    (folder / "text.vdb").write_text("no volume")
    for body, words in ((openvdb("density", "none.vdb"), "none.vdb"), (openvdb("smoke"), 'it has no grid "smoke", but "density"'),
                        (openvdb("density", "double.vdb"), "holds double, where floats are wanted"), (openvdb("density", "broken.vdb"), "it ends too early"),
                        (openvdb("density", "text.vdb"), "not a VDB file"), (openvdb("density", bound="50 60 0 1 0 1"), "outside of the bound"),
                        (BOX.format(1).replace("1 4", "4 4"), "its bound has no volume"), ('Volume "cone" [0 1 0 1 0 1] [0 0 0]\n', "of type \"cone\""),
                        ('Volume "blobbydso:other" [0 1 0 1 0 1] [0 0 0]\n', 'there is no plugin "other"')):
        result = run("\n" + body)
        expect(result.returncode == 3 and "v.rib:9" in result.stderr and words in result.stderr, f"said: {words}  ({result.stderr.strip()[:300]})")
sys.exit(bool(failures))
