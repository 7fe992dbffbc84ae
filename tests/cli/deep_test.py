"""Tests input that nests or chains as deep as a file can: every recursion over it must end in a message or a picture, and signals must be
answered."""
import signal
import subprocess
import time

from program import Suite

t = Suite()
N = 30000
HEAD = 'Display "o.exr" "file" "rgba" Format 8 8 1 PixelSamples 1 1 Projection "perspective" "fov" [40] Translate 0 0 5\n'
WORLD = HEAD + "WorldBegin\n%s\nWorldEnd\n"
DOT = "Sphere .1 -.1 .1 360"


def ends(what, name, text, codes=(0, 3)):
    t.write(name, text)
    try:
        result = t.run(name, "-t", "2")
    except subprocess.TimeoutExpired:
        return t.expect(False, f"{what}: does not end within 60 s")
    t.expect(result.returncode in codes, f"{what}: exit {result.returncode} {result.stderr[-200:] if result.returncode not in codes else ''}")
    return result


# RIB nests.
for begin, end in (("MotionBegin [0 1]", "MotionEnd"), ('SolidBegin "union"', "SolidEnd"), ('SolidBegin "difference"', "SolidEnd"), ('SolidBegin "primitive"', "SolidEnd"),
                   ("AttributeBegin", "AttributeEnd"), ('IfBegin "1"', "IfEnd"), ('ArchiveBegin "a"', "ArchiveEnd"), ("ResourceBegin", "ResourceEnd"),
                   ("ObjectBegin 1", "ObjectEnd"), ("FrameBegin 1", "FrameEnd"), ("WorldBegin", "WorldEnd"), ('EditBegin "a"', "EditEnd")):
    ends(f"{N} times {begin}", "deep.rib", WORLD % (f"{begin}\n" * N + DOT + f"\n{end}" * N))
leaf = 'SolidBegin "primitive" ' + DOT + " SolidEnd\n"
for operation in ("union", "intersection", "difference"):
    chain = (f'SolidBegin "{operation}" ' + leaf) * 1000 + leaf + "SolidEnd\n" * 1000
    ends(f"a chain of 1000 solids ({operation})", "deep.rib", WORLD % chain)
ends("3000 operands of one solid", "deep.rib", WORLD % ('SolidBegin "union"\n' + leaf * 3000 + "SolidEnd"))
ends("brackets in brackets", "deep.rib", WORLD % ("Color " + "[" * N + "]" * N + DOT))
ends("a chain of 20000 instances", "deep.rib", WORLD % (f"ObjectBegin 0 {DOT} ObjectEnd\n" + "".join(
    f"ObjectBegin {k} ObjectInstance {k - 1} ObjectEnd\n" for k in range(1, 20001)) + "ObjectInstance 20000"))
ends("a chain of 20000 inline archives", "deep.rib", WORLD % (f'ArchiveBegin "a0" {DOT} ArchiveEnd\n' + "".join(
    f'ArchiveBegin "a{k}" ReadArchive "a{k - 1}" ArchiveEnd\n' for k in range(1, 20001)) + 'ReadArchive "a20000"'))
for bound in ("[-1 1 -1 1 -1 1]", "[-1e39 1e39 -1 1 -1 1]"):
    ends(f"a chain of 5000 procedurals, bound {bound}", "deep.rib", WORLD % (f'ArchiveBegin "a0" {DOT} ArchiveEnd\n' + "".join(
        f'ArchiveBegin "a{k}" Procedural "DelayedReadArchive" ["a{k - 1}"] {bound} ArchiveEnd\n' for k in range(1, 5001)) +
        f'Procedural "DelayedReadArchive" ["a5000"] {bound}'))
for what, text in (("parentheses", "(" * N + "1" + ")" * N), ("negations", "!" * N + "1"), ("signs", "-" * N + "1"), ("a sum", "1" + "+1" * N),
                   ("a product", "1" + "*1" * N), ("alternatives", "0" + "||0" * N), ("calls", "concat(" * N + "'a'" + ")" * N), ("variables", "$(" * N + "1" + ")" * N)):
    ends(f"a condition of {what}", "deep.rib", WORLD % f'IfBegin "{text}" {DOT} IfEnd {DOT}')
ends("variables in variables", "deep.rib", WORLD % ('Option "ribparse" "string varsubst" "$" Option "user" "string a" "' + "${" * N + "}" * N + f'" {DOT}'))
ends("a chain of 20000 patterns", "deep.rib", WORLD % ('Pattern "PxrConstant" "p0" "float f" 1\n' + "".join(
    f'Pattern "PxrBlend" "p{k}" "reference color topRGB" ["p{k - 1}:resultRGB"]\n' for k in range(1, 20001)) +
    'Bxdf "PxrDiffuse" "b" "reference color diffuseColor" ["p20000:resultRGB"]\n' + DOT))
ends("a chain of patterns that closes", "deep.rib", WORLD % (
    'Pattern "PxrBlend" "a" "reference color topRGB" ["b:resultRGB"]\nPattern "PxrBlend" "b" "reference color topRGB" ["a:resultRGB"]\n'
    'Bxdf "PxrDiffuse" "x" "reference color diffuseColor" ["a:resultRGB"]\n' + DOT))
ends("a token of 20 MB", "deep.rib", WORLD % ("A" * (20 << 20) + "\n" + DOT))
ends("a string of 20 MB", "deep.rib", WORLD % ('Attribute "identifier" "name" "' + "A" * (20 << 20) + '"\n' + DOT))

# Shaders nest.
t.write("scene.rib", WORLD % ('Surface "deep" ' + DOT))


def shader(what, body, parameters="", before=""):
    t.write("deep.sl", f"{before}\nsurface deep({parameters}) {{ float x = 1; color c = 1;\n{body}\nCi = c; Oi = 1; }}\n")
    for arguments in (["compile", "deep.sl"], ["scene.rib"]):
        try:
            result = t.run(*arguments)
        except subprocess.TimeoutExpired:
            t.expect(False, f"{what}: {arguments[0]} does not end within 60 s")
            return
        if result.returncode not in (0, 2, 3):
            t.expect(False, f"{what}: {arguments[0]} ends with {result.returncode} {result.stderr[-200:]}")
            return
    t.expect(True, what)


for what, body in (("parentheses", "x = " + "(" * N + "1" + ")" * N + ";"), ("signs", "x = " + "- " * N + "1;"), ("negations", "if (" + "!" * N + "(x == 1)) x = 2;"),
                   ("calls", "x = " + "sin(" * N + "1" + ")" * N + ";"), ("casts", "c = " + "color " * N + "1;"), ("a sum", "x = 1" + "+x" * N + ";"),
                   ("a product", "x = 1" + "*x" * 20000 + ";"), ("a chain of ?:", "x = " + "x > 1 ? 2 : " * N + "3;"), ("a chain of assignments", "x = " * N + "1;"),
                   ("a chain of else if", "if (x > 1) x = 2;" + " else if (x > 1) x = 3;" * N), ("blocks", "{" * N + "}" * N), ("ifs", "if (x > 0) " * N + "x = 1;"),
                   ("whiles", "while (x > 9) " * N + "x = 1;"), ("illuminance", "illuminance (P) " * N + "x = 1;"), ("statements", "x += 1;\n" * 20000),
                   ("commas in tuples", "c = color(" + "1," * N + "1);"), ("arrays", "float a[1] = " + "{" * N + "1" + "}" * N + ";"), ("strings", 'printf("a" ' + '"a" ' * N + ");"),
                   ("and", "if (x > 0" + " && x > 0" * N + ") x = 1;"), ("dots", "x = N" + ".N" * 20000 + ";"),
                   ("an unfinished comment", "/*" * N), ("an unfinished string", '"' + "a" * N)):
    shader(what, body)
shader("functions in functions", "".join(f"float f{k}() {{" for k in range(N)) + "return 1;" + "}" * N)
shader("a chain of functions", f"x = f{2000}();", before="float f0() { return 1; }\n" + "".join(f"float f{k}() {{ return f{k - 1}(); }}\n" for k in range(1, 2001)))
shader("functions that double", "x = f60();", before="float f0() { return 1; }\n" + "".join(f"float f{k}() {{ return f{k - 1}() + f{k - 1}(); }}\n" for k in range(1, 61)))
shader("a function of itself", "x = f(1);", before="float f(float a) { return f(a); }")
shader("parameters", "x = 1;", parameters=";".join(f"float p{k} = 1" for k in range(1000)))
shader("#if in #if", "x = 1;", before="#if 1\n" * N + "#endif\n" * N)
shader("#if of parentheses", "x = 1;", before="#if " + "(" * N + "1" + ")" * N + "\n#endif\n")
shader("#if of negations", "x = 1;", before="#if " + "!" * N + "1\n#endif\n")
shader("#if of signs", "x = 1;", before="#if " + "- " * N + "1\n#endif\n")
shader("#if of ?:", "x = 1;", before="#if " + "1 ? 0 : " * N + "1\n#endif\n")
shader("#if of sums", "x = 1;", before="#if 1" + "+1" * N + "\n#endif\n")
shader("a chain of macros", f"x = A{20000};", before="#define A0 1\n" + "".join(f"#define A{k} A{k - 1}\n" for k in range(1, 20001)))
shader("macros that double", "x = A40;", before="#define A0 1\n" + "".join(f"#define A{k} A{k - 1} + A{k - 1}\n" for k in range(1, 41)))
shader("macros in arguments", "x = " + "F(" * N + "1" + ")" * N + ";", before="#define F(a) (a)\n")
shader("a file that includes itself", "x = 1;", before='#include "deep.sl"\n')
for k in range(300):
    t.write(f"h{k}.h", f'#include "h{k + 1}.h"\n')
t.write("h300.h", "float last() { return 1; }\n")
shader("a chain of 300 files", "x = 1;", before='#include "h0.h"\n')
shader("lines that go on", "x = 1" + "\\\n" * N + ";")


# Signals end what takes long.
def answers(what, name, text, command=()):
    t.write(name, text)
    process = subprocess.Popen([t.program, *(command or [name])], cwd=t.folder, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    time.sleep(1.5)
    if process.poll() is not None:
        return t.expect(True, f"{what}: ended within 1.5 s")
    begin = time.monotonic()
    process.send_signal(signal.SIGTERM)
    process.wait(60)
    seconds = time.monotonic() - begin
    t.expect(seconds < 10 and process.returncode in (143, -signal.SIGTERM), f"{what}: a signal is answered in {seconds:.1f} s (exit {process.returncode})")


pair = "".join(f'ArchiveBegin "a{k}" ReadArchive "a{k - 1}" ReadArchive "a{k - 1}" ArchiveEnd\n' for k in range(1, 31))
answers("archives of archives", "long.rib", WORLD % (f'ArchiveBegin "a0" {DOT} ArchiveEnd\n{pair}' + 'ReadArchive "a30"\n' * 30))
answers("a long Blobby", "long.rib", WORLD % (f"Blobby 20000 [{' '.join(f'1001 {16 * k}' for k in range(20000))} 0 20000 {' '.join(map(str, range(20000)))}] [" +
                                              " ".join(f".3 0 0 0 0 .3 0 0 0 0 .3 0 {k % 100 / 50 - 1} {k // 100 / 100 - 1} 0 1" for k in range(20000)) + '] [""]'))
t.finish()
