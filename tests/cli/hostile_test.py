"""Tests scenes that would take all time or memory if they were allowed to: each must end soon, say where, and exit with 3 or 4."""
import gzip
import resource
import subprocess

from program import GOOD, Suite

t = Suite()
HEAD = 'Display "o.exr" "file" "rgba" Format 16 16 1 Translate 0 0 5 WorldBegin\n'
DOT = "Sphere .1 -.1 .1 360"


def limited(what, name, content, code, *says):
    t.write(name, content if isinstance(content, bytes) else HEAD + content)
    t.expect_run(what, [name, "-t", "2"], code, *says)


def doubling(begin, call, end, levels):
    return "".join(f"{begin % k} {call % (k - 1)} {call % (k - 1)} {end}\n" for k in range(1, levels + 1))


objects = f"ObjectBegin 0 {DOT} ObjectEnd\n" + doubling("ObjectBegin %d", "ObjectInstance %d", "ObjectEnd", 20)
limited("2^20 instances of instances", "objects.rib", objects + "ObjectInstance 20\nWorldEnd\n", 3, "objects.rib:", "objects within objects")
wide = f"ObjectBegin 0 {DOT} ObjectEnd\n" + "".join(
    f"ObjectBegin {k} {f'ObjectInstance {k - 1} ' * 128} ObjectEnd\n" for k in (1, 2, 3))
limited("2^21 instances three deep", "wide.rib", wide + "Translate 0 0 -50 ObjectInstance 3\nWorldEnd\n", 3, "wide.rib:6", "stands for more than")
for what, of in (("an archive", 'ReadArchive "{}b.rib"'), ("a texture", 'Surface "paintedplastic" "texturename" "{}b.tif"' + DOT)):
    t.write("folders.rib", HEAD + of.format("a/" * 100000) + "\nWorldEnd\n")
    t.expect(t.run("folders.rib", cpu_s=3).returncode == 3, f"{what} in 100000 folders is given up at once")
t.write("a.rib", 'ReadArchive "b.rib" Sphere 1 -1 1 360\n')
t.write("b.rib", 'ReadArchive "a.rib"\n')
limited("archives that read each other", "cycle.rib", 'ReadArchive "a.rib"\nWorldEnd\n', 3, "b.rib:1", "reads itself")
limited("a procedural of itself", "self.rib", f'ArchiveBegin "p" {DOT} Procedural "DelayedReadArchive" ["p"] [-1 1 -1 1 -1 1] ArchiveEnd\n'
        'Procedural "DelayedReadArchive" ["p"] [-1 1 -1 1 -1 1]\nWorldEnd\n', 3, "self.rib:2", "reads itself")
for begin, end in (("AttributeBegin", "AttributeEnd"), ('SolidBegin "union"', "SolidEnd"), ('IfBegin "1"', "IfEnd"),
                   ("ResourceBegin", "ResourceEnd"), ("TransformBegin", "TransformEnd")):
    body = f"{begin}\n" * 30000 + ("" if "Solid" in begin else DOT + "\n") + f"{end}\n" * 30000
    limited(f"30000 times {begin}", "deep.rib", body + DOT + "\nWorldEnd\n", 0)
limited("30000 archives in archives", "deep.rib", 'ArchiveBegin "a"\n' * 30000 + DOT + "\n" + "ArchiveEnd\n" * 30000 + DOT + "\nWorldEnd\n", 0)
limited("a program that dies", "dies.rib", 'Procedural "RunProgram" ["exit 3" ""] [-1 1 -1 1 -1 1]\nWorldEnd\n', 3, "dies.rib:2")
t.expect_run("and may run", ["dies.rib", "--allow-system"], 3, "dies.rib:2", "exit code 3")

limited("2^40 archives of archives", "doubles.rib", f'ArchiveBegin "a0" {DOT} ArchiveEnd\n' + "".join(
    f'ArchiveBegin "a{k}" ReadArchive "a{k - 1}" ReadArchive "a{k - 1}" ArchiveEnd\n' for k in range(1, 41)) + 'ReadArchive "a40"\nWorldEnd\n',
    3, "stands for more than 1000000 requests")

# A definition that holds its own old value doubles with every line.
limited("a search path that doubles", "path.rib", 'Option "searchpath" "string archive" "a"\n' + 'Option "searchpath" "string archive" "&:&"\n' * 60 + DOT + "\nWorldEnd\n",
        0, "path.rib:18", "longer than 65536 bytes")
limited("a variable that doubles", "variable.rib", 'Option "ribparse" "string varsubst" "$" Option "user" "string a" "0123456789"\n'
        + 'Option "user" "string a" "${a}${a}"\n' * 60 + DOT + "\nWorldEnd\n", 0, "variable.rib:19", "longer than 1048576 bytes")

# Nesting is deeper than a stack of 8 MB.
t.write("furnace.rib", 'Display "o.exr" "file" "rgba" Format 4 4 1 PixelSamples 1 1 Projection "perspective" "fov" [40] WorldBegin\n'
        'LightSource "pointlight" 1 LightSource "indirectlight" 2 Attribute "visibility" "int diffuse" 1 "int specular" 1 "int transmission" 1\n'
        'Surface "matte" "Kd" 1 Color 1 1 1 Sphere 5 -5 5 360 WorldEnd\n')
t.expect_run("a path of 1000 bounces", ["furnace.rib", "--gi", "reference", "--bounces", "1000", "--samples", "1", "-t", "2"], 0)
t.expect_run("more are refused", ["furnace.rib", "--bounces", "1001"], 1, "range 1 to 1000")

# The input is compressed and encoded.
scene = (HEAD + "Sphere 1 -1 1 360\n").encode()
limited("a bomb of blanks", "blanks.rib.gz", gzip.compress(scene + b" " * (80 << 20) + b"WorldEnd\n"), 3, "blanks.rib.gz", "64 MiB and 200 times")
limited("a bomb of numbers", "numbers.rib.gz", gzip.compress(scene + b'Points "P" [' + b"0 " * (40 << 20) + b"] WorldEnd\n"), 3, "64 MiB")
limited("gzip that is cut off", "cut.rib.gz", gzip.compress(scene + b"WorldEnd\n" * 1000)[:-40], 3, "damaged or cut off")
binary = subprocess.run([t.program, "catrib", "--binary", t.write("good.rib", GOOD)], cwd=t.folder, capture_output=True).stdout
for k in range(0, len(binary), 7):
    t.write("broken.rib", binary[:k] + b"\xfe\xcb\xff\xff\xff\xff" + binary[k:])
    code = t.run("broken.rib", "-q").returncode
    if code not in (0, 2, 3):
        t.expect(False, f"binary RIB broken at byte {k}: exit {code}")

# Numbers are extreme.
t.write("huge.rib", HEAD.replace("16 16 1", "1e9 1e9 1") + DOT + "\nWorldEnd\n")
t.expect_run("a Format of 1e18 pixels", ["huge.rib"], 3, "huge.rib:1", "Format", "more than the 32768 pixels")
for number in ("nan", "inf", "-inf", "1e999", "1e38", "99999999999999999999", "1e-45", "-0"):
    limited(f"{number} everywhere", "number.rib", f"""Sphere 1 -1 1 360
AttributeBegin Translate {number} 0 0 Rotate {number} 0 1 0 Scale {number} {number} {number} {DOT} AttributeEnd
AttributeBegin Color {number} 0 0 ShadingRate {number} {DOT} Sphere {number} -{number} {number} {number} AttributeEnd
PointsPolygons [{number}] [0 1 2] "P" [0 0 0 1 0 0 0 1 0] PointsPolygons [3] [0 1 {number}] "P" [0 0 0 1 0 0 0 1 0]
Patch "bilinear" "P" [{number} 0 0 1 0 0 0 1 0 1 1 0] PatchMesh "bilinear" {number} "periodic" {number} "nonperiodic" "P" [0 0 0]
Curves "linear" [{number}] "nonperiodic" "P" [0 0 0 1 0 0] "constantwidth" {number} Points "P" [0 {number} 0] "constantwidth" {number}
NuPatch {number} 2 [0 0 1 1] 0 1 2 2 [0 {number} 1 1] 0 1 "P" [0 0 0 1 0 0 0 1 0 1 1 0] TrimCurve [{number}] [] [] [] [] [] [] [] []
MotionBegin [0 {number}] Translate 0 0 0 Translate 1 0 0 MotionEnd Attribute "displacementbound" "float sphere" {number} {DOT}
WorldEnd
""", 3 if number != "-0" else 3, "number.rib:")

# A file that ends in the middle of its world is no finished picture.
for end in range(GOOD.index("WorldBegin") + len("WorldBegin\n"), GOOD.index("WorldEnd"), 5):
    t.write("part.rib", GOOD[:end])
    code = t.run("part.rib", "-q").returncode
    if code != 3:
        t.expect(False, f"a scene cut after {end} bytes: exit {code}")
most = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss >> 10
t.expect(most < 1500, f"no more than {most} MB were needed by any of them")
t.finish()
