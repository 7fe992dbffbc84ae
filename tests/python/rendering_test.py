"""Tests that scenes go from Python straight into the renderer, and that the module returns pictures, figures and messages."""
import math
import os
import subprocess
import sys
import tempfile
import textwrap
import unittest

import prman
import tomales

try:
    import OpenImageIO
except ImportError:
    OpenImageIO = None


def ball(ri, radius=1.0):
    ri.Format(64, 64, 1)
    ri.Projection(ri.ORTHOGRAPHIC)
    ri.ScreenWindow(-2, 2, -2, 2)
    ri.PixelSamples(8, 8)
    ri.PixelFilter("box", 1, 1)
    ri.Translate(0, 0, 5)
    ri.WorldBegin()
    ri.Surface("constant")
    ri.Color([1, 0.5, 0.25])
    ri.Sphere(radius, -radius, radius, 360)
    ri.WorldEnd()


class InFolder(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir(folder.name)

    def script(self, text, **environment):
        with open("scene.py", "w") as file:
            file.write(textwrap.dedent(text))
        return subprocess.run([sys.executable, "scene.py"], capture_output=True, text=True, timeout=120, env={**os.environ, **environment})


class Rendering(InFolder):
    @unittest.skipUnless(OpenImageIO, "OpenImageIO's module is not here")
    def test_a_sphere_covers_its_area(self):
        for radius in (1.0, 0.5):
            ri = prman.Ri()
            ri.Begin(ri.RENDER)
            ri.Display("ball.exr", "openexr", "rgba")
            ball(ri, radius)
            ri.End()
            self.assertEqual(ri.ExitCode, 0)
            picture = tomales.read("ball.exr")
            area = picture["A"].mean() * 16
            self.assertAlmostEqual(area, math.pi * radius**2, delta=0.02 * math.pi * radius**2)
            self.assertAlmostEqual(float(picture["rgb"][32, 32, 1]), 0.5, places=6)
            self.assertEqual(picture.pixels.shape, (64, 64, 4))

    @unittest.skipUnless(OpenImageIO, "OpenImageIO's module is not here")
    def test_commands_are_functions(self):
        ri = prman.Ri()
        ri.Begin("ball.rib")
        ball(ri)
        ri.End()
        result = tomales.render("ball.rib", "a.exr", format=(32, 16), threads=1, pixel_samples=(2, 2))
        self.assertEqual(result.picture()["A"].shape, (16, 32))
        self.assertGreater(result.statistics["geometry"]["micropolygons_visible"], 0)
        tomales.hide("ball.rib", "ball.dfb", format=(32, 16), pixel_samples=(2, 2))
        shot = tomales.shade("ball.dfb", "b.exr")
        self.assertEqual(tomales.compare("a.exr", "b.exr")["max_error"], 0)
        self.assertTrue((shot.picture().pixels == result.picture().pixels).all())
        with open("ball.rib", "rb") as file:
            tomales.render(file.read(), "c.exr", format=(32, 16), pixel_samples="2x2")
        self.assertEqual(tomales.compare("a.exr", "c.exr")["max_error"], 0)
        self.assertIsInstance(tomales.info("ball.rib"), dict)

    def test_commands_that_fail_say_why(self):
        with self.assertRaisesRegex(tomales.CommandFailed, "frobnicate") as caught:
            tomales.render("none.rib", frobnicate=True)
        self.assertEqual(caught.exception.exit_code, 1)
        with self.assertRaisesRegex(tomales.CommandFailed, "none.rib"):
            tomales.render("none.rib")
        self.assertEqual(tomales.render("none.rib", check=False).exit_code, 2)

    def test_messages_of_the_renderer_name_the_line_of_the_script(self):
        for form in ("ascii", "binary"):
            done = self.script(f"""\
                import prman
                ri = prman.Ri()
                ri.Option("rib", {{"string format": "{form}"}})
                ri.Begin(ri.RENDER)
                ri.Format(8, 8, 1)
                ri.WorldBegin()
                ri.Surface("plastic", {{"nosuchthing": 1}})
                ri.Sphere(1, -1, 1, 360)
                ri.ReadArchive("nothere.rib")
                ri.WorldEnd()
                ri.End()
                print("exit", ri.ExitCode)
                """)
            self.assertRegex(done.stderr, r"scene\.py:7: .*nosuchthing")
            self.assertRegex(done.stderr, r"scene\.py:9: .*nothere\.rib")
            self.assertEqual(done.stdout, "exit 3\n")
            self.assertEqual(done.returncode, 0)

    def test_files_name_lines_when_they_are_asked_to(self):
        self.script("""\
            import prman
            ri = prman.Ri()
            ri.places = True
            ri.Begin("scene.rib")
            ri.Format(8, 8, 1)
            ri.WorldBegin()
            ri.ReadArchive("nothere.rib")
            ri.WorldEnd()
            ri.End()
            """)
        self.assertTrue(any("scene.py:7: " in m and "nothere" in m for m in tomales.render("scene.rib").messages))

    def test_options_of_the_command_line_reach_every_rendering(self):
        text = """\
            import prman
            prman.Init(["-t:1"])
            ri = prman.Ri()
            ri.Begin("launch:prman? -t:1 -ctrl $ctrlin $ctrlout")
            ri.Display("a.exr", "openexr", "rgba")
            ri.WorldBegin()
            ri.Sphere(1, -1, 1, 360)
            ri.WorldEnd()
            ri.End()
            print(ri.ExitCode)
            """
        done = self.script(text, TOMALES_RENDER_OPTIONS="--format 24x20")
        self.assertEqual(done.stdout, "0\n", done.stderr)
        self.assertEqual(tomales.info("a.exr").get("width", 24), 24)

    def test_a_renderer_that_is_not_there_is_told(self):
        done = self.script("import prman\nprman.Ri().Begin('__render')\n", TOMALES="/nowhere/tomales")
        self.assertIn("/nowhere/tomales", done.stderr)

    def test_a_renderer_that_ends_early_is_told(self):
        done = self.script("""\
            import prman
            ri = prman.Ri()
            ri.Begin(ri.RENDER)
            for i in range(20000):
                ri.Points({"P": [0] * 300})
            ri.End()
            """, TOMALES="/bin/false")
        self.assertIn("has ended with exit code 1", done.stderr)


class Procedurals(InFolder):
    """A procedural of a Python function must give the picture of the objects that it describes."""

    def picture(self, describe, *options):
        ri = prman.Ri()
        ri.Begin(ri.RENDER)
        ri.Display("a.exr", "openexr", "rgba")
        ri.Format(48, 48, 1)
        ri.Projection("perspective", {"fov": 40})
        ri.Translate(0, 0, 6)
        ri.WorldBegin()
        ri.LightSource("distantlight")
        ri.Surface("matte")
        describe(ri)
        ri.WorldEnd()
        ri.End()
        self.assertEqual(ri.ExitCode, 0)
        os.replace("a.exr", f"{describe.__name__}.exr")
        return f"{describe.__name__}.exr"

    def test_it_is_asked_by_the_renderer(self):
        asked, freed = [], []

        def balls(ri):
            def one(x, detail):
                asked.append(detail)
                ri.Translate(x, 0, 0)
                ri.Color([0.5 + x / 4, 0.5, 1])
                ri.Sphere(0.6, -0.6, 0.6, 360)

            def both(xs, detail):
                for x in xs:
                    ri.Procedural(x, [x - 0.6, x + 0.6, -0.6, 0.6, -0.6, 0.6], one, freed.append)

            ri.Procedural((-1, 1), [-2, 2, -1, 1, -1, 1], both, freed.append)

        def plain(ri):
            for x in (-1, 1):
                ri.AttributeBegin()
                ri.Translate(x, 0, 0)
                ri.Color([0.5 + x / 4, 0.5, 1])
                ri.Sphere(0.6, -0.6, 0.6, 360)
                ri.AttributeEnd()

        first, second = self.picture(balls), self.picture(plain)
        self.assertEqual(tomales.compare(first, second)["max_error"], 0)
        self.assertEqual(len(asked), 2)
        self.assertTrue(all(0 < detail < 48 * 48 for detail in asked), asked)
        self.assertEqual(freed, [(-1, 1), -1, 1])

    def test_it_is_asked_while_the_script_goes_on(self):
        """A procedural with an infinite bound is read at once, and then the renderer waits while much more comes through the pipe."""

        def late(ri):
            ri.Procedural(0.5, [-1e38, 1e38] * 3, lambda radius, detail: ri.Sphere(radius, -radius, radius, 360))
            for i in range(3000):
                ri.Points({"P": [100, 100, 0] * 50, "constantwidth": 0.1})

        self.picture(late)
        self.assertGreater(tomales.compare("late.exr", "late.exr")["ssim"], 0.99)

    def test_what_it_raises_is_told_and_missing(self):
        done = self.script("""\
            import prman
            ri = prman.Ri()
            ri.Begin(ri.RENDER)
            ri.Format(8, 8, 1)
            ri.WorldBegin()
            ri.Procedural(0, [-1, 1, -1, 1, 1, 2], lambda data, detail: 1 / data)
            ri.WorldEnd()
            ri.End()
            print(ri.ExitCode)
            """)
        self.assertIn("ZeroDivisionError", done.stderr)
        self.assertEqual(done.stdout, "3\n", done.stderr)

    def test_other_programs_are_not_started(self):
        done = self.script("""\
            import prman
            ri = prman.Ri()
            ri.Begin(ri.RENDER)
            ri.Format(8, 8, 1)
            ri.WorldBegin()
            ri.Procedural(["touch started", ""], [-1, 1, -1, 1, 1, 2], ri.ProcRunProgram)
            ri.WorldEnd()
            ri.End()
            """)
        self.assertIn("--allow-system", done.stderr)
        self.assertFalse(os.path.exists("started"))

    def test_a_file_holds_what_it_describes(self):
        ri = prman.Ri()
        ri.Begin("a.rib")
        ri.Procedural(2, [-2, 2] * 3, lambda radius, detail: ri.Sphere(radius, -radius, radius, 360))
        ri.Procedural(["b.rib"], [-2, 2] * 3, "ProcDelayedReadArchive", None)
        ri.End()
        with open("a.rib") as file:
            self.assertTrue(file.read().endswith('AttributeBegin\nSphere 2 -2 2 360\nAttributeEnd\nProcedural "DelayedReadArchive" ["b.rib"] [-2 2 -2 2 -2 2]\n'))
