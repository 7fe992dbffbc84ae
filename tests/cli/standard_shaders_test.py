"""Tests that a scene's folder may hold shaders with the names of built-in ones."""
import json

from program import GOOD, Suite

t = Suite()
RED = "{kind} {name}() {{ {body} }}"
t.write("plastic.sl", RED.format(kind="surface", name="plastic", body="Oi = 1; Ci = color(1, 0, 0);"))
t.write("glass.sl", RED.format(kind="surface", name="glass", body="Oi = 1; Ci = color(1, 0, 0);"))


def scene(name, surface):
    return t.write(name + ".rib", GOOD.replace("good.exr", name + ".exr").replace('Surface "matte"', surface))


def same(a, b):
    return json.loads(t.run("compare", a + ".exr", b + ".exr", "--json").stdout)["max_error"] < 1e-5


t.expect_run("red", [scene("red", 'Color [1 0 0] Surface "constant"')], 0)
result = t.expect_run("a shader that RISpec does not have", [scene("glass", 'Surface "glass"')], 0)
t.expect(same("glass", "red") and not result.stderr, "is the user's own, without a word")
twice = 'Surface "plastic"\nSphere .1 -.1 .1 360\nSurface "plastic" "Ks" 0'
result = t.expect_run("one of RISpec's", [scene("plastic", twice)], 0, "plastic.sl", "the built-in one is used", "--standard-shaders files")
t.expect(result.stderr.count("shader-standard") == 1, "is the built-in one, which is said once")
t.expect(not same("plastic", "red"), "and is the built-in one")
result = t.expect_run("--standard-shaders files", ["plastic.rib", "--standard-shaders", "files"], 0, "this file is used", "--standard-shaders built-in")
t.expect('has no parameter "Ks"' in result.stderr, "is the file, and what that lacks is said")
result = t.expect_run("without what it lacks", [scene("files", 'Surface "plastic"'), "--standard-shaders", "files"], 0)
t.expect(same("files", "red"), "is the file")
t.write("matte.sl", "surface matte(float Kg = 1) { Oi = 1; Ci = color(Kg, 0, 0); }")
t.expect_run("a file with a parameter of its own", [scene("own", 'Surface "matte"')], 0, "this file is used", 'no parameter "Kg"')
t.expect(same("own", "red"), "is another shader, which the scene means")
t.expect_run("but not with --standard-shaders built-in", ["own.rib", "--standard-shaders", "built-in"], 0, "the built-in one is used")
t.expect(not same("own", "red"), "which takes the built-in one")
t.write("metal.sl", "surface metal(float Kg = 1) { Oi = 1; Ci = Kg;")
result = t.expect_run("a file that does not compile", [scene("broken", 'Surface "metal"')], 0, "the built-in one is used", "does not compile", "metal.sl:1:")
t.expect("--standard-shaders" not in result.stderr, "and cannot be asked for")
t.expect_run("--strict", ["plastic.rib", "--strict"], 0)
result = t.expect_run("a name of RISpec's without a file", [scene("constant", 'Surface "constant"'), "--standard-shaders", "files"], 0)
t.expect(not result.stderr, "is the built-in one")
t.expect_run("another word", ["plastic.rib", "--standard-shaders", "mine"], 1)

t.finish()
