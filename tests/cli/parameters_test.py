"""Tests parameters without types, misspelt names, and the exit codes that follow."""
from program import GOOD, Suite

t = Suite()


def scene(surface, rest=""):
    return GOOD.replace('Surface "matte"', surface).replace("WorldEnd", rest + "WorldEnd")


def picture(name, text, code=0, *says):
    t.write(name + ".rib", text.replace("good.exr", name + ".exr"))
    return t.expect_run(name, [name + ".rib"], code, *says)


def same(a, b):
    return t.run("compare", a + ".exr", b + ".exr", "--json").stdout.find('"max_error": 0.0,') >= 0


# A built-in shader, a shader in RSL and a plugin (docs/rsl_plugins) all declare which parameters they take.
picture("typed", scene('Surface "disney" "float metallic" [1] "float clearcoat" [1] "float roughness" [.3]'))
picture("bare", scene('Surface "disney" "metallic" [1] "clearcoat" [1] "roughness" .3'))
picture("plain", scene('Surface "disney"'))
t.expect(same("typed", "bare"), "a built-in shader takes values without a type as with one")
t.expect(not same("bare", "plain"), "and they count")
t.write("tinted.sl", 'surface tinted(color tint = 0; string mode = ""; float weights[2] = {0, 0}; normal up = 0;) {\n'
        '  Oi = 1; Ci = mode == "on" ? tint * weights[1] : color(0, 0, 1);\n'
        '  if (zcomp(ntransform("shader", up)) != 1) Ci = 1; }\n')
picture("rsl_typed", scene('Surface "tinted" "color tint" [1 .5 0] "string mode" "on" "float[2] weights" [0 .5] "normal up" [0 0 1]'))
picture("rsl_bare", scene('Surface "tinted" "tint" [1 .5 0] "mode" "on" "weights" [0 .5] "up" [0 0 1]'))
picture("rsl_plain", scene('Surface "tinted"'))
t.expect(same("rsl_typed", "rsl_bare") and not same("rsl_bare", "rsl_plain"), "so does a shader in RSL")

# A parameter that no shader has is reported, with what may have been meant.
result = picture("unknown", scene('Surface "disney" "metalic" [1] "clearcoat" 1 "wobble" 3'), 0, 'did you mean "metallic"?', '"wobble"')
t.expect("clearcoat" not in result.stderr, "what it has is not named")
result = picture("strings", scene('Surface "disney" "metallic" ["much"]'), 0, "is a float and was given a string")

# The same RIB goes through catrib, also as binary.
t.expect_run("catrib keeps what is bare", ["catrib", "rsl_bare.rib", "-o", "again.rib"], 0)
t.expect('"tint"' in (t.folder / "again.rib").read_text(), "as it is")
t.expect_run("catrib in binary", ["catrib", "rsl_bare.rib", "--binary", "-o", "binary.rib"], 0)
t.expect_run("which is read", ["binary.rib", "-o", "binary.exr"], 0)
t.expect(same("binary", "rsl_bare"), "as the same picture")

# A deep frame buffer keeps parameters bare, and a later edit finds the shader.
t.expect_run("hide", ["hide", "rsl_bare.rib", "-o", "shot.dfb"], 0)
t.expect_run("shade", ["shade", "shot.dfb", "-o", "shot.exr"], 0)
t.expect(same("shot", "rsl_bare"), "is the same picture")

# A request is misspelt, a primitive variable is lost, and in one frame nothing is visible.
picture("request", scene('Surfaec "matte"'), 3, 'did you mean "Surface"?')
picture("primvar", GOOD.replace("360", '360 "wobble" [1 2 3 4]'), 3, '"wobble" is not declared')
picture("empty", GOOD.replace("Translate 0 0 4", "Translate 0 0 -4"), 3, "behind the camera")

# With --strict a warning changes the exit code, but a note does not.
picture("warned", scene('Surface "disney" "metalic" [1]'), 0, "warning:")
t.expect_run("--strict", ["warned.rib", "--strict"], 3, "warning:")
t.write("noted.rib", 'Option "limits" "threads" 2\n' + GOOD.replace("good.exr", "noted.exr"))
t.expect_run("--strict and a note", ["noted.rib", "--strict"], 0, "note:")
t.expect_run("--strict and nothing", ["plain.rib", "--strict"], 0)
t.expect_run("--strict with -q", ["warned.rib", "--strict", "-q"], 3)
t.expect_run("--strict and what cannot be read", ["nowhere.rib", "--strict"], 2)

t.finish()
