"""Tests display drivers: they must get the same values as a file. A driver that fails, crashes or is not trusted is reported, and
everything else goes on."""
import os
import pathlib
import re
import signal
import struct
import subprocess

from program import GOOD, Suite
from tev import Viewer

t = Suite()
source = pathlib.Path(__file__).resolve().parent.parent.parent
t.trust_shaders("drivers")
(t.folder / "drivers").mkdir()
(t.folder / "brought").mkdir()

# This driver writes all that it receives as text. Its parameters make it fail.
DRIVER = r"""#include <reyes/display_api.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
static int fails_at, how, rows_seen;
static void fail(void) {
  if (how == 1) abort();
  if (how == 2) _exit(7);
  if (how == 3) for (;;) sleep(1);
}
static void* openIt(const TmDisplayPicture* p, char* problem) {
  FILE* f = fopen(p->name, "w");
  int i;
  const TmDisplayParam *at = tmDisplayParam(p, "failsat"), *why = tmDisplayParam(p, "how"), *words = tmDisplayParam(p, "words");
  fails_at = at ? at->ints[0] : -1, how = why ? why->ints[0] : 0, rows_seen = 0;
  if (!f) return snprintf(problem, TM_DISPLAY_PROBLEM_BYTES, "no file"), (void*)0;
  fprintf(f, "size %d %d at %d %d of %d %d aspect %g mode %s near %g\n", p->width, p->height, p->x, p->y, p->fullWidth,
          p->fullHeight, p->pixelAspect, p->mode, p->worldToCamera[14]);
  for (i = 0; i < p->channelCount; ++i) fprintf(f, "channel %s\n", p->channels[i]);
  for (i = 0; words && i < words->count; ++i) fprintf(f, "word %s\n", words->strings[i]);
  if (fails_at == 0) {
    fail();
    fclose(f);
    strcpy(problem, "the paper is used up");
    return 0;
  }
  return f;
}
static int32_t rows(void* opened, const TmDisplayRows* r, char* problem) {
  int i, c, channels = 4;
  if (++rows_seen == fails_at) {
    fail();
    strcpy(problem, "the ink is used up");
    return 1;
  }
  for (i = 0; i < r->width * r->height; ++i) {
    fprintf(opened, "pixel %d %d", r->x + i % r->width, r->y + i / r->width);
    for (c = 0; c < channels; ++c) fprintf(opened, " %.9g", r->pixels[i * channels + c]);
    fprintf(opened, "\n");
  }
  fflush(opened);
  return 0;
}
static int32_t closeIt(void* opened, int32_t complete, char* problem) {
  fprintf(opened, "complete %d\n", complete);
  fclose(opened);
  if (fails_at == 99) return strcpy(problem, "the envelope does not close"), 1;
  return 0;
}
const TmDisplayDriver* tomales_display(void) {
  static const TmDisplayDriver driver = {ABI, sizeof(TmDisplayDriver), "text", openIt, rows, closeIt};
  return &driver;
}
"""


def build(name, code=DRIVER, folder="drivers", abi="TM_DISPLAY_ABI"):
    t.write(name + ".c", code)
    subprocess.run([os.environ["CC"], "-std=c99", "-D_DEFAULT_SOURCE", "-Wall", "-Werror", f"-DABI={abi}", "-shared", "-fPIC", "-I", source,
                    t.folder / (name + ".c"), "-o", t.folder / folder / (name + ".so")], check=True)


def scene(name, *displays, format="40 150 1"):
    lines = "".join(f"Display {d}\n" for d in displays)
    return t.write(name, GOOD.replace('Display "good.exr" "file" "rgba"\n', lines).replace("Format 24 24 1", f"Format {format}"))


def dumped(file):
    dump = subprocess.run(["oiiotool", "--dumpdata", "--info", "-v", file], cwd=t.folder, capture_output=True, text=True).stdout
    return {(int(x), int(y)): tuple(float(v) for v in rest.split()) for x, y, rest in re.findall(r"Pixel \((\d+), (\d+)\): ([^\n]*)", dump)}


def written(file):
    text = (t.folder / file).read_text()
    pixels = re.findall(r"pixel (\d+) (\d+) (.*)", text)
    return text, {(int(x), int(y)): tuple(float(v) for v in rest.split()) for x, y, rest in pixels}, len(pixels)


build("text")
FILE = '"+seen.exr" "openexr" "rgba"'
t.expect_run("a driver", [scene("text.rib", '"o.txt" "text" "rgba" "string[2] words" ["a" "b c"]', FILE)], 0)
text, pixels, count = written("o.txt")
t.expect(text.startswith("size 40 150 at 0 0 of 40 150 aspect 1 mode rgba near 4\nchannel R\nchannel G\nchannel B\nchannel A\nword a\nword b c\n"),
         "is told the picture and its parameters")
same = dumped("seen.exr")
t.expect(len(same) == 6000 and pixels.keys() == same.keys() and all(abs(a - b) < 1e-5 for at in same for a, b in zip(pixels[at], same[at])),
         "gets what a file holds")
t.expect(count == 6000 and text.endswith("complete 1\n"), "each pixel once, and is told that it has all")
t.expect_run("a crop", ["text.rib", "--crop", "0.5,1,0.5,0.75"], 0)
t.expect(written("o.txt")[0].startswith("size 20 38 at 20 75 of 40 150"), "has its place in the picture")
t.expect(set(written("o.txt")[1]) == {(x, y) for x in range(20, 40) for y in range(75, 113)}, "and rows with their own numbers")

t.expect_run("a parameter that the driver does not read", [scene("param.rib", '"o.txt" "text" "rgba" "float frames" [3] "float[2] exposure" [1 1]')], 0,
             'param.rib:1', 'display driver "text" has no parameter "frames"')
t.expect_run("through hide", ["hide", "text.rib", "-o", "o.dfb"], 0)
(t.folder / "o.txt").unlink()
t.expect_run("and shade", ["shade", "o.dfb"], 0)
t.expect(written("o.txt")[1] == pixels, "the same picture comes")

# Drivers fail.
def failing(what, params, code, *says, rows, complete):
    (t.folder / "seen.exr").unlink(missing_ok=True)
    t.expect_run(what, [scene("fails.rib", f'"o.txt" "text" "rgba" {params}', FILE), "-q"], code, "fails.rib:1", '"o.txt" could not be written', *says)
    t.expect(dumped("seen.exr") == same, f"{what}: the other Display is written")
    text, _, count = written("o.txt")
    t.expect(count == 40 * rows and text.endswith("complete 0\n") == complete, f"{what}: rows that were finished are kept ({count})")


AT = '"int failsat" [%d] "int how" [%d]'
failing("a driver that does not open", AT % (0, 0), 4, "text.so: the paper is used up", rows=0, complete=False)
failing("one that fails at its second rows", AT % (2, 0), 4, "text.so: the ink is used up", rows=64, complete=True)
failing("one that crashes there", AT % (2, 1), 4, "text.so crashes (Aborted)", rows=64, complete=False)
failing("one that crashes while it opens", AT % (0, 1), 4, "text.so crashes (Aborted)", rows=0, complete=False)
failing("one that ends its process", AT % (2, 2), 4, "text.so ends its process", rows=64, complete=False)
t.expect_run("one that fails at the end", [scene("end.rib", f'"o.txt" "text" "rgba" {AT % (99, 0)}')], 4, "text.so: the envelope does not close")
hangs = subprocess.Popen([t.program, scene("hangs.rib", f'"o.txt" "text" "rgba" {AT % (1, 3)}', FILE)], cwd=t.folder, stderr=subprocess.PIPE, text=True)
try:
    hangs.wait(2)
except subprocess.TimeoutExpired:
    pass
hangs.send_signal(signal.SIGINT)
said = hangs.communicate(timeout=50)[1]
t.expect("text.so does not answer for 5 s" in said and hangs.returncode in (4, 130), f"one that hangs is left alone when the program is to end ({hangs.returncode})")

build("old", abi="7")
t.expect_run("another ABI", [scene("old.rib", '"o.txt" "old" "rgba"')], 4, "built for display ABI 7")
build("shader", "int tomales_shaders(void) { return 0; }")
t.expect_run("a plugin of another kind", [scene("shader.rib", '"o.txt" "shader" "rgba"')], 4, "does not export tomales_display")
(t.folder / "drivers/torn.so").write_bytes(b"no library")
t.expect_run("a file that is no library", [scene("torn.rib", '"o.txt" "torn" "rgba"')], 4, "torn.so", "cannot be loaded")

# Drivers are trusted by the same rules as shaders (trust_test.py).
build("theirs", folder="brought")
untrusted = scene("theirs.rib", '"o.txt" "theirs" "rgba"')
t.write("theirs.rib", 'Option "searchpath" "string display" ["brought"]\n' + (t.folder / untrusted).read_text())
(t.folder / "o.txt").unlink()
t.expect_run("a driver of the scene's folders", [untrusted], 3, "theirs.rib:2", "theirs.so is native code", "--allow-plugins")
t.expect(not (t.folder / "o.txt").exists() and (t.folder / "o.exr").exists(), "is not loaded, and a file is written")
for leave in ("--allow-plugins", "--allow-system"):
    t.expect_run(f"with {leave}", [untrusted, leave], 0)
t.expect(written("o.txt")[2] == 6000, "it is")
upwards = scene("upwards.rib", '"o.txt" "../brought/theirs" "rgba"')
t.expect_run("a trusted folder is not left", [upwards], 0, "no display type")

# The drivers come with the program and its documentation.
viewer = Viewer()
t.expect_run("tev", [scene("tev.rib", f'"{viewer.address}" "tev" "rgba" "string title" ["beauty"]')], 0)
viewer.join(10)
t.expect(viewer.name == "beauty" and viewer.pixels.keys() == same.keys() and
         all(abs(a - b) < 1e-5 for at in same for a, b in zip(viewer.pixels[at], same[at])), "shows the picture")
viewer.server.close()
t.expect_run("tev without a viewer", ["tev.rib"], 4, "tev.rib:1", f"nobody listens at {viewer.address}")

subprocess.run([os.environ["CC"], "-O2", "-Wall", "-Wextra", "-Werror", "-shared", "-fPIC", "-I", source, source / "docs/example_plugin/shared_memory.c", "-o",
                t.folder / "drivers/shared_memory.so"], check=True)
memory = pathlib.Path(f"/dev/shm/tomales_test_{os.getpid()}")
t.expect_run("shared memory", [scene("shared.rib", f'"/{memory.name}" "shared_memory" "rgba"')], 0)
bytes_there = memory.read_bytes()
memory.unlink()
t.expect(struct.unpack_from("<4i", bytes_there) == (40, 150, 4, 150), "holds the picture's size and all of its rows")
floats = struct.unpack_from("<24000f", bytes_there, 16)
t.expect(all(abs(floats[(y * 40 + x) * 4 + c] - same[x, y][c]) < 1e-5 for x, y in same for c in range(4)), "and its pixels")
t.expect_run("a name that shared memory cannot have", [scene("shared.rib", '"/a/b" "shared_memory" "rgba"')], 4, "shared memory: ")
t.finish()
