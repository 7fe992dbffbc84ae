"""What a stranger is told: each cause once, with how often and where it came."""
from program import GOOD, Suite

t = Suite()


def lines_with(result, *texts):
    return [line for line in result.stderr.splitlines() if all(text in line for text in texts)]


def scene(world):
    return 'Display "x.exr" "file" "rgba" Format 16 16 1 Translate 0 0 4 WorldBegin LightSource "distantlight" 1 ' + world + " WorldEnd\n"


# One message for each shader, however the file is broken into lines.
seven = scene(" ".join(f'Surface "rock{n}" Sphere 1 -1 1 360' for n in range(7)))
t.write("line.rib", seven)
t.run("catrib", "--binary", "line.rib", "-o", "binary.rib")
for file in ("line.rib", "binary.rib"):
    told = t.expect_run(f"seven shaders that are not there, {file}", [file], 3)
    t.expect(len(lines_with(told, "[shader-missing]")) == 7, "are seven messages: " + told.stderr)
    t.expect(all(lines_with(told, f'"rock{n}"') for n in range(7)), "which name them")

# One message for one shader, however often it is asked for.
t.write("many.rib", scene("\n".join('Surface "rock" "Kd" [%g] Sphere 1 -1 1 360' % (0.01 * n) for n in range(93))))
told = t.expect_run("one shader that 93 lines ask for", ["many.rib"], 3)
missing = lines_with(told, "[shader-missing]")
t.expect(len(missing) == 2 and "is unknown" in missing[0] and missing[0].startswith("many.rib:1:"), "is one message: " + told.stderr)
t.expect(missing[-1].startswith("tomales: 93 times:") and "many.rib:1, many.rib:2, many.rib:3, many.rib:4, ..." in missing[-1], "with its count and first places at the end: " + missing[-1])

# Frames over one picture.
t.write("frames.rib", "\n".join(f"FrameBegin {n}\n{GOOD}FrameEnd" for n in range(1, 21)))
told = t.expect_run("twenty frames over one picture", ["frames.rib", "--format", "4x4"], 0)
t.expect(len(lines_with(told, "written over")) == 2 and lines_with(told, "tomales: 19 times:", "written over"), "are one message and its count: " + told.stderr)
t.finish()
