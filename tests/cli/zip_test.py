"""Tests ReadArchive "archives.zip!name.rib": files within zip files, good and damaged ones."""
import zipfile

from program import GOOD, Suite

t = Suite()
ball = "Sphere 1 -1 1 360\n"
with zipfile.ZipFile(t.folder / "a.zip", "w", zipfile.ZIP_DEFLATED) as z:
    z.writestr("ball.rib", ball)
    z.writestr("job/outer.rib", 'ReadArchive "a.zip!ball.rib"\n')
    z.writestr("bomb.rib", " " * (65 << 20))
    z.writestr("scene.rib", GOOD.replace("good.exr", "zipped.exr"))


def scene(name, archive):
    return t.write(name + ".rib", GOOD.replace("good.exr", name + ".exr").replace(ball, f'ReadArchive "{archive}"\n'))


def same(a, b):
    return '"max_error": 0.0,' in t.run("compare", a, b, "--json").stdout


t.write("good.rib", GOOD)
t.expect_run("the scene without archives", ["good.rib"], 0)
t.expect_run("a member", [scene("member", "a.zip!ball.rib")], 0)
t.expect(same("member.exr", "good.exr"), "is read in place")
t.expect_run("a member that reads another", [scene("nested", "a.zip!job/outer.rib")], 0)
t.expect(same("nested.exr", "good.exr"), "is read in place, too")
t.expect_run("a scene in a zip file", ["a.zip!scene.rib"], 0)
t.expect(same("zipped.exr", "good.exr"), "is rendered")
t.expect_run("no such member", [scene("lost", "a.zip!nosuch.rib")], 3, "nosuch.rib", "holds no file of that name")
t.expect_run("no such zip file", [scene("nowhere", "b.zip!ball.rib")], 3, "b.zip")
t.expect_run("a member that swells to a thousand times its size", [scene("bomb", "a.zip!bomb.rib")], 3, "bomb.rib", "it swells beyond 64 MiB and 200 times its size")
t.expect_run("named as the scene", ["a.zip!bomb.rib"], 2, "it swells beyond 64 MiB and 200 times its size")

# A member is damaged, and a file is no zip file.
data = bytearray((t.folder / "a.zip").read_bytes())
start = data.index(b"ball.rib") + len("ball.rib")
data[start + 4] ^= 0xFF
t.write("damaged.zip", bytes(data))
t.expect_run("a damaged member", [scene("damaged", "damaged.zip!ball.rib")], 3)
t.write("text.zip", "no zip file")
t.expect_run("what is no zip file", [scene("text", "text.zip!ball.rib")], 3, "text.zip is no zip file, or damaged")

t.finish()
