"""Compares the add-on with Cycles in the same Blender: the same scenes must give the same pictures."""
import json
import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest

HERE = pathlib.Path(__file__).resolve().parent


def blender(script, *arguments):
    command = [os.environ["BLENDER"], "-b", "--factory-startup", "--python-exit-code", "9", "-P", str(HERE / script), "--", *map(str, arguments)]
    # The Python within Blender takes the modules of the first python3 on the path, so that must be the one beside it.
    path = os.pathsep.join([os.path.dirname(command[0]), os.environ["PATH"]])
    return subprocess.run(command, capture_output=True, text=True, errors="replace", timeout=1500, env={**os.environ, "PATH": path})


def pairs(figures):
    """Yields the values of blocks that are bright enough to compare: Cycles', Tomales', and the brightest of Cycles'."""
    cycles, tomales = ([v for row in figures[e] for block in row for v in block] for e in ("cycles", "tomales"))
    return list(zip(cycles, tomales)), max(cycles)


class Pictures(unittest.TestCase):
    """Compares the mean colours of 48 blocks of each picture with Cycles at 256 samples per pixel."""

    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)
        cls.said = blender("scenes.py", folder.name)

    def figures(self, name):
        path = self.folder / f"{name}.json"
        self.assertTrue(path.exists(), self.said.stdout[-3000:] + self.said.stderr[-2000:])
        return json.loads(path.read_text())

    def expect_mean(self, name, share):
        """Compares the light of the whole picture."""
        values, _ = pairs(self.figures(name))
        cycles, tomales = sum(c for c, _ in values), sum(t for _, t in values)
        self.assertGreater(cycles, 0)
        self.assertAlmostEqual(tomales / cycles, 1, delta=share, msg=name)

    def expect_blocks(self, name, share):
        """Compares every block; `share` is of the brightest."""
        values, brightest = pairs(self.figures(name))
        self.assertGreater(brightest, 0)
        worst = max(abs(c - t) for c, t in values) / brightest
        self.assertLess(worst, share, name)

    def test_lamps_are_as_strong_as_in_cycles(self):
        for name in ("area", "disk_lamp", "sun", "soft_sun", "point", "spot", "soft_spot"):
            with self.subTest(name):
                self.expect_mean(name, 0.03)
                self.expect_blocks(name, 0.08)

    def test_cameras_see_the_same(self):
        for name in ("camera_shift", "orthographic", "focus", "motion", "deformation"):
            with self.subTest(name):
                self.expect_mean(name, 0.02)
                self.expect_blocks(name, 0.05)

    def test_pictures_lie_the_same_way(self):
        self.expect_blocks("texture", 0.05)

    def test_every_picture_of_a_principled_material_counts(self):
        self.expect_mean("pictures_of_all", 0.03)
        self.expect_blocks("pictures_of_all", 0.06)

    def test_skies_are_turned_the_same_way(self):
        self.expect_blocks("panorama", 0.06)
        self.expect_blocks("turned_sky", 0.03)

    def test_skies_that_nodes_compute(self):
        """The horizon of a Sky Texture and the sun's disk are sharper than the pixels of a panorama."""
        self.expect_mean("sky", 0.03)
        self.expect_blocks("sky", 0.08)
        self.expect_mean("woven_sky", 0.02)
        self.expect_blocks("woven_sky", 0.05)

    def test_bumps_and_normal_maps_turn_the_same_way(self):
        for name in ("bump", "normal_map"):
            with self.subTest(name):
                self.expect_mean(name, 0.03)
                self.expect_blocks(name, 0.06)

    def test_each_picture_is_over_its_own_uv_map(self):
        self.expect_mean("second_uv", 0.03)
        self.expect_blocks("second_uv", 0.06)

    def test_displacement_moves_the_surface(self):
        self.expect_mean("displaced", 0.03)
        self.expect_blocks("displaced", 0.08)

    def test_graphs_of_nodes_compute_the_same_colours(self):
        self.expect_mean("graph", 0.02)
        self.expect_blocks("graph", 0.03)

    def test_mixtures_of_closures_and_colour_attributes(self):
        self.expect_mean("mixture", 0.01)
        self.expect_blocks("mixture", 0.01)

    def test_metals_mirror_the_scene(self):
        self.expect_mean("metal", 0.04)
        self.expect_blocks("metal", 0.03)

    def test_hair_is_as_thick(self):
        """Blender scatters strands again for each rendering, so single blocks differ."""
        self.expect_mean("hair", 0.05)

    def test_instances_stand_in_their_places(self):
        self.expect_blocks("instances", 0.05)

    def test_light_bounces(self):
        self.expect_mean("room", 0.05)
        self.expect_blocks("room", 0.08)

    def test_subdivision_surfaces_are_those_of_the_cage(self):
        self.expect_blocks("subdivision", 0.05)
        self.expect_blocks("creases", 0.05)


class Addon(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)
        cls.said = blender("features.py", folder.name)
        path = cls.folder / "features.json"
        cls.found = json.loads(path.read_text()) if path.exists() else {}

    def of(self, name):
        self.assertIn(name, self.found, self.said.stdout[-3000:] + self.said.stderr[-2000:])
        return self.found[name]

    def test_passes_hold_what_they_say(self):
        passes = self.of("passes")
        self.assertAlmostEqual(passes["Depth"], 5, delta=0.05)
        self.assertAlmostEqual(passes["NormalZ"], 1, delta=0.01)
        self.assertAlmostEqual(passes["DiffCol"], 0.25, delta=0.01)

    def test_archives_are_shared_between_frames(self):
        """Only transformations change, so twelve frames of a hundred objects must write as many archives as one."""
        animation = self.of("animation")
        self.assertEqual(animation["frames"], 12)
        self.assertEqual(animation["archives"], 2)
        self.assertEqual((animation["at_once"], animation["different"]), (12, []))

    def test_deformation_is_a_motion_block_of_points(self):
        self.assertEqual(self.of("deformation"), {"keys": 2, "moves": True})

    def test_faults_of_the_addon_are_messages(self):
        self.assertEqual(self.of("faults"), [True, True])

    def test_hair_curves_and_particles_are_drawn(self):
        strands = self.of("strands")
        self.assertIn("Curves", strands)
        self.assertIn("Points", strands)

    def test_shaders_take_the_place_of_nodes(self):
        self.assertRegex(self.of("override"), re.compile(r'Surface "plastic".*"float Kd" \[0\.25\]'))

    def test_panoramic_cameras_are_refused_clearly(self):
        self.assertIn("panoramic cameras are not supported", self.said.stdout)

    def test_what_is_not_supported_is_named(self):
        self.assertIn("Wave Texture", self.said.stdout)

    def test_a_rendering_is_given_up_when_the_user_wants(self):
        self.assertLess(self.of("cancel"), 30)

    def test_progress_rises(self):
        self.assertEqual(self.of("progress"), {"rises": True, "last": 1, "warnings": []})

    def test_the_picture_is_shown_while_it_is_made(self):
        preview = self.of("preview")
        self.assertGreater(preview["shown"], 1)
        self.assertEqual(preview["rows"], sorted(preview["rows"]))
        self.assertEqual(preview["different"], 0)

    def test_each_view_layer_has_its_passes(self):
        layers = self.of("layers")
        middle = layers["middle"]
        self.assertGreater(middle["ViewLayer.Combined.R"], 0)
        self.assertAlmostEqual(middle["Second.Combined.R"], middle["ViewLayer.Combined.R"], delta=1e-4)
        for channel, value in (("R", 0.25), ("G", 0.5), ("B", 0.75)):
            self.assertAlmostEqual(middle[f"Second.warm.{channel}"], value, delta=1e-4)
        self.assertAlmostEqual(middle["Second.Position.Z"], 0, delta=1e-3)
        self.assertAlmostEqual(layers["light"]["Second.Combined_key.R"], layers["light"]["Second.Combined.R"], delta=0.05)

    def test_mattes_are_those_of_cycles(self):
        cycles, tomales = (self.of("mattes")[engine] for engine in ("CYCLES", "TOMALES"))
        self.assertEqual(set(tomales["ranks"]), set(cycles["ranks"]))
        for name in ("cryptoobject00.r", "cryptomaterial00.r"):
            self.assertEqual(tomales["ranks"][name], cycles["ranks"][name], name)
            self.assertAlmostEqual(tomales["ranks"][name.replace(".r", ".g")], 1, delta=0.02)
        for name in ("ViewLayer.CryptoObject", "ViewLayer.CryptoMaterial"):
            named = {k: v for k, v in tomales["layers"][name].items() if v in cycles["layers"][name].values()}
            self.assertTrue(named and named.items() <= cycles["layers"][name].items(), name)

    def test_exported_frames_can_be_moved(self):
        moved = self.of("moved")
        self.assertEqual(moved["code"], 0, moved["said"])
        self.assertGreater(moved["moved"], 0.1)
        self.assertEqual(moved["frames"], [moved["frames"][0]] * 2)
        self.assertAlmostEqual(moved["frames"][0], moved["moved"], delta=1e-4)

    def test_parameters_of_shaders_become_properties(self):
        found = self.of("interface")
        self.assertEqual(found["Kd"][0], "float")
        self.assertEqual(found["specularcolor"], ["color", [1, 1, 1]])
        self.assertNotIn("albedo", found, "an output is not set")


class InstalledAddon(unittest.TestCase):
    """Tests the add-on as a user copies it into Blender's folder, away from the Python module."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        source = pathlib.Path(os.environ["TOMALES_SOURCE"]) / "reyes/bindings"
        shutil.copytree(source / "blender/tomales_blender", self.folder / "scripts/addons/tomales_blender")
        self.packages = self.folder / "prefix/lib/python3.11/dist-packages"
        shutil.copytree(source / "python/tomales", self.packages / "tomales")
        program = self.folder / "prefix/bin/tomales"
        program.parent.mkdir()
        program.write_text(f'#!/bin/sh\nexec "{os.environ["TOMALES"]}" "$@"\n')
        program.chmod(0o755)

    def engines(self, expression="pass", path=()):
        """Returns whether the engine is there after the add-on is switched on, and whether it is still there after the expression."""
        script = ("import bpy; bpy.ops.preferences.addon_enable(module='tomales_blender'); there = lambda: print('THERE', any(e.bl_idname == 'TOMALES' for e in bpy.types.RenderEngine.__subclasses__())); "
                  f"there(); preferences = bpy.context.preferences.addons['tomales_blender'].preferences; {expression}; there()")
        said = subprocess.run([os.environ["BLENDER"], "-b", "--factory-startup", "--python-exit-code", "9", "--python-expr", script], capture_output=True, text=True, timeout=300,
                              env={**{k: v for k, v in os.environ.items() if k not in ("TOMALES", "PYTHONPATH")}, "BLENDER_USER_SCRIPTS": str(self.folder / "scripts"),
                                   "PATH": os.pathsep.join([*map(str, path), "/usr/bin", "/bin"])})
        self.assertEqual(said.returncode, 0, said.stdout + said.stderr)
        return [word == "True" for word in re.findall(r"THERE (\w+)", said.stdout)], said.stdout

    def test_finds_the_module_that_was_installed_with_the_program(self):
        self.assertEqual(self.engines(path=[self.folder / "prefix/bin"])[0], [True, True])

    def test_without_the_module_it_asks_for_it_and_goes_on_once_the_preferences_name_it(self):
        there, said = self.engines(f"preferences.module = {str(self.packages)!r}")
        self.assertEqual(there, [False, True])
        self.assertIn("there is no Python module tomales", said)

    def test_the_program_of_the_preferences_leads_to_the_module(self):
        self.assertEqual(self.engines(f"preferences.program = {str(self.folder / 'prefix/bin/tomales')!r}")[0], [False, True])
