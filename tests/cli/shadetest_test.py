"""One shader over a grid: what it says of values that are known, and of shaders that there are not."""
import re

from program import GOOD, Suite

t = Suite()


def figure(result, name):
    return [float(x) for x in re.search(f"^{name}: (.*)$", result.stdout, re.MULTILINE)[1].split()]


constant = t.expect_run("constant", ["shadetest", "constant", "--grid", "8x4", "-o", "c.exr"], 0, "points: 8 x 4")
t.expect(figure(constant, "Ci mean") == [1, 1, 1], "is white")
t.expect((t.folder / "c.exr").exists(), "the picture is written")
t.expect(figure(constant, "nanoseconds a point")[0] > 0, "takes time")
light = t.expect_run("a light is tried on matte", ["shadetest", "ambientlight"], 0)
t.expect(figure(light, "Ci greatest") == [1, 1, 1], "and lights it")
bump = t.expect_run("a displacement", ["shadetest", "noisybump"], 0)
t.expect(0 < figure(bump, "longest displacement")[0] <= 0.1, "stays within its Km")
fog = t.expect_run("a volume lies before a lit square", ["shadetest", "fog", "--grid", "3x3"], 0)
plain = t.expect_run("which is as bright as", ["shadetest", "matte", "--grid", "3x3"], 0)
t.expect(abs(figure(fog, "Ci greatest")[0] / figure(plain, "Ci greatest")[0] - 2.718281828 ** -5) < 1e-4, "without five units of fog")
imager = t.expect_run("an imager", ["shadetest", "background", "--grid", "5x2", "-o", "i.exr"], 0)
t.expect(figure(imager, "Ci least") == [0.5] * 3 and figure(imager, "Ci greatest") == [1] * 3, "fills what alpha leaves of its wedge")
t.expect_run("an unknown name", ["shadetest", "nosuch"], 2, "nosuch")
t.expect_run("a file that is no plugin", ["shadetest", t.write("no.so", "text")], 3, "no.so")
t.expect_run("a grid of one point", ["shadetest", "matte", "--grid", "1x1"], 1)
profile = t.expect_run("--profile-shaders", [t.write("good.rib", GOOD), "--profile-shaders"], 0, "matte", "ns a point")
t.expect(int(re.search(r"^matte +(\d+) ", profile.stdout, re.MULTILINE)[1]) > 0, "counts the points of matte")
t.finish()
