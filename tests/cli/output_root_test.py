"""Tests that with --output-root all files that a scene writes lie below one folder, and that later frames find them there."""

from program import Suite

t = Suite()
t.root = t.folder / "work/kept"
(t.folder / "work").mkdir()
WORLD = """Projection "perspective" "fov" [40]
Translate 0 0 4
WorldBegin
%s
Sphere 1 -1 1 360
WorldEnd
"""
PICTURE = "Format 16 16 1\n" + WORLD


def files():
    """Returns the files of the test's folder that lie outside of the root, and those inside."""
    all_files = {p.relative_to(t.folder).as_posix() for p in t.folder.rglob("*") if p.is_file()}
    inside = {f for f in all_files if f.startswith("work/kept/")}
    return all_files - inside - scenes, {f.removeprefix("work/kept/") for f in inside}


def scene(name, text):
    scenes.add(name)
    return t.write(name, text)


def expect_kept(what, name, text, written, *says, code=0, arguments=()):
    """Tests that the scene writes these files below the root, and nothing outside of it."""
    scene(name, text)
    result = t.expect_run(what, [name, "--output-root", "work/kept", *arguments], code, *says)
    outside, inside = files()
    t.expect(not outside, f"{what}: nothing lies outside ({', '.join(sorted(outside))})")
    missing = set(written) - inside
    t.expect(not missing, f"{what}: {', '.join(written)} below it (missing: {', '.join(missing)})")
    return result


scenes = set()
expect_kept("Displays", "display.rib", 'Display "a.exr" "file" "rgba" Display "+below/b.tif" "file" "rgb"\n' + PICTURE % "", ["a.exr", "below/b.tif"])
expect_kept("a name that stays inside", "inside.rib", 'Display "below/../c.exr" "file" "rgba"\n' + PICTURE % "", ["c.exr"])
for what, name in (("upwards", "../out.exr"), ("upwards from below", "new/../../out.exr"), ("absolute", f"{t.folder}/out.exr"), ("by a link", "link/out.exr"),
                   ("a link", "out.exr")):
    if what == "by a link":
        (t.root / "link").symlink_to(t.folder)
        (t.root / "out.exr").symlink_to(t.folder / "out.exr")
    expect_kept(f"a Display {what}", "out.rib", f'Display "{name}" "file" "rgba"\n' + PICTURE % "", [], "would lie outside of \"work/kept\"", code=4)
expect_kept("an absolute name inside", "absolute.rib", f'Display "{t.root}/d.exr" "file" "rgba"\n' + PICTURE % "", ["d.exr"])
scene("mine.rib", f'Display "/nowhere/x.exr" "file" "rgba" Display "+other.exr" "file" "rgba"\n' + PICTURE % "")
t.expect_run("-o is the user's", ["mine.rib", "--output-root", "work/kept", "-o", "mine.exr"], 0)
t.expect((t.folder / "mine.exr").exists() and (t.root / "other.exr").exists(), "-o is as it is named, the scene's own Display below the folder")
(t.folder / "mine.exr").unlink()

SHADOW = 'FrameBegin 1 Display "z.shad" "shadow" "z"\n' + PICTURE % "" + "FrameEnd\n"
ZFILE = 'FrameBegin 1 Display "depth.z" "zfile" "z"\n' + PICTURE % "" + 'FrameEnd\nMakeShadow "depth.z" "made.shad"\n'
USES = 'FrameBegin 2 Display "%s" "file" "rgba"\n' + PICTURE % 'LightSource "shadowspot" 1 "string shadowname" "%s"' + "FrameEnd\n"
expect_kept("a shadow map", "shadow.rib", SHADOW + USES % ("lit.exr", "z.shad"), ["z.shad", "lit.exr"])
expect_kept("MakeShadow", "make.rib", ZFILE + USES % ("lit2.exr", "made.shad"), ["depth.z", "made.shad", "lit2.exr"])
scene("texture.rib", 'Display "tex.tif" "file" "rgb"\n' + PICTURE % "" + 'MakeTexture "tex.tif" "tex.tx" "black" "black" "box" 1 1\n'
      'Display "textured.exr" "file" "rgba"\n' + PICTURE % 'Surface "paintedplastic" "string texturename" "tex.tx"')
expect_kept("MakeTexture", "texture.rib", (t.folder / "texture.rib").read_text(), ["tex.tif", "tex.tx", "textured.exr"])
expect_kept("MakeTexture upwards", "make_out.rib", 'MakeTexture "tex.tif" "../out.tx" "black" "black" "box" 1 1\n', [], "MakeTexture:", "would lie outside", code=4)

scene("bakes.sl", 'surface bakes(string file = "";) { float one = 1; bake3d(file, "", P, N, "one", one); Ci = Cs; }')
BAKE = 'Display "p.exr" "file" "rgba"\n' + PICTURE % 'Surface "bakes" "string file" "%s"'
expect_kept("bake3d()", "bake.rib", BAKE % "points.ptc", ["points.ptc"])
expect_kept("bake3d() upwards", "bake_out.rib", BAKE % "../out.ptc", ["p.exr"], "would lie outside", code=4)
ATLAS = 'Display "i.exr" "file" "rgba"\n' + PICTURE % ('LightSource "pointlight" 2 "from" [0 0 -3] LightSource "indirectlight" 1 "string atlas" "%s" '
                                                    '"string radiance" "atlas" Surface "matte"')
expect_kept("an atlas that lights name", "atlas.rib", ATLAS % "maps", [], arguments=["--photons", "1000"])
t.expect(any((t.root / "maps").rglob("*.bkm")), "its maps are below the folder")
expect_kept("an atlas upwards", "atlas_out.rib", ATLAS % "../maps", [], "would lie outside", code=4, arguments=["--photons", "1000"])
scene("picture.tif", (t.root / "tex.tif").read_bytes())
CACHE = 'Option "searchpath" "string texturecache" "%s" Display "t.exr" "file" "rgba"\n' + PICTURE % 'Surface "paintedplastic" "string texturename" "picture.tif"'
expect_kept("converted textures", "cache.rib", CACHE % "converted", ["t.exr"])
t.expect(any((t.root / "converted").rglob("*")), "the scene's folder of converted textures is below the folder")
expect_kept("converted textures upwards", "cache_out.rib", CACHE % "../converted", [], "would lie outside", code=4)

scene("shot.rib", 'Display "shot.exr" "file" "rgba"\n' + PICTURE % "")
t.expect_run("hide", ["hide", "shot.rib", "-o", "shot.dfb", "--output-root", "work/kept"], 0)
scenes.add("shot.dfb")
t.expect_run("shade", ["shade", "shot.dfb", "--output-root", "work/kept"], 0)
t.expect((t.root / "shot.exr").exists() and not files()[0], "shade puts the Displays of a shot there, too")
t.finish()
