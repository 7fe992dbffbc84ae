"""Tests that the renderer reads what Ri writes, as text and encoded."""
import gzip
import io
import os
import random
import subprocess
import sys
import tempfile
import unittest

import prman
import tomales
from tomales.requests import SIGNATURES, TABLE

try:
    import numpy
except ImportError:
    numpy = None

TOMALES = os.environ["TOMALES"]
ONE = {"f": [0.1], "i": [-3], "s": ['a "b" \\ c\n'], "h": ["handle"], "F": [[0.25, 1e-7, 3]], "I": [[1, -2, 70000]], "S": [["x", "y" * 20]],
       "c": [[0.1, 0.2, 0.3]], "m": [[[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0.5, 0, 0, 1]]], "b": ["bezier"], "?": []}


def arguments_of(signature):
    """Returns good arguments for any signature."""
    out = []
    for letter in signature.arguments:
        out += ONE[letter] if letter in ONE else [0.1 * i for i in range(int(letter))]
    return out


def written(form, *calls):
    """Returns the RIB of calls on Ri, each a function of it. `form` is "ascii" or "binary"."""
    out = io.BytesIO()
    ri = prman.Ri()
    ri.ErrorHandler("abort")
    ri.Option("rib", {"string format": form})
    ri.Begin(out)
    for call in calls:
        call(ri)
    ri.End()
    return out.getvalue()


def read_by_renderer(rib):
    """Returns the requests as the renderer understands them, and its messages."""
    done = subprocess.run([TOMALES, "catrib", "-"], input=rib, capture_output=True)
    return done.stdout.decode(), done.stderr.decode()


class Requests(unittest.TestCase):
    def test_the_table_is_that_of_the_renderer(self):
        """If this fails, run: tomales requests > reyes/bindings/python/tomales/requests.txt"""
        said = subprocess.run([TOMALES, "requests"], capture_output=True, text=True).stdout
        self.assertEqual(said, TABLE.read_text())
        self.assertGreater(len(SIGNATURES), 120)

    def test_every_request_is_a_method_that_the_renderer_reads(self):
        special = {"version", "Option", "Procedural", "Declare"}  # These have tests of their own.
        for form in ("ascii", "binary"):
            for name, signature in SIGNATURES.items():
                if name in special:
                    continue
                parameters = [{"uniform float[2] mine": [0.5, 2]}] if signature.takes_parameters else []
                rib = written(form, lambda ri: getattr(ri, name)(*arguments_of(signature), *parameters))
                text, messages = read_by_renderer(rib)
                self.assertEqual(messages, "", name)
                self.assertIn(name, text)
                self.assertEqual("0.5 2" in text, bool(parameters), text)

    def test_declarations_return_their_names(self):
        names = []
        rib = written("ascii", lambda ri: names.append(ri.Declare("heat", "varying float")))
        self.assertTrue(rib.endswith(b'Declare "heat" "varying float"\n'))
        self.assertEqual(names, ["heat"])

    def test_text_and_code_say_the_same(self):
        def calls(ri):
            for name, signature in SIGNATURES.items():
                if name not in ("version", "Option", "Procedural", "Declare", "ColorSamples"):
                    getattr(ri, name)(*arguments_of(signature))
            for size in (1, 127, 128, -128, -129, 32767, 8388608, 2**31 - 1, -(2**31)):
                ri.PointsPolygons([size], [1, size], {"float[4] mine": [size, 0.5, 1e30, -1e-30], "string[2] s": ["", "z" * 300]})
            ri.Points({"P": [random.Random(1).uniform(-9, 9) for _ in range(3000)]})

        text, binary = (read_by_renderer(written(form, calls)) for form in ("ascii", "binary"))
        self.assertEqual(text, binary)
        self.assertGreater(text[0].count("\n"), 130)

    @unittest.skipUnless(numpy, "numpy is not here")
    def test_arrays_of_numpy_are_lists_of_the_same_numbers(self):
        points = numpy.random.default_rng(1).uniform(-1, 1, (1000, 3)).astype("f4")
        for form in ("ascii", "binary"):
            for kind in ("f4", "f8", ">f4"):
                by_list = written(form, lambda ri: ri.PointsPolygons([4] * 250, list(range(1000)), {"P": points.tolist()}))
                by_array = written(form, lambda ri: ri.PointsPolygons(numpy.full(250, 4), numpy.arange(1000, dtype="u2"), {"P": points.astype(kind)}))
                self.assertEqual(by_list, by_array)
        self.assertIn(b"Sphere 1 -1 1 360", written("ascii", lambda ri: ri.Sphere(numpy.float32(1), numpy.int64(-1), 1, 360)))


class Spellings(unittest.TestCase):
    def line(self, call):
        return written("ascii", call).decode().splitlines()[-1]

    def test_numbers_may_be_bare_or_in_lists(self):
        self.assertEqual(self.line(lambda ri: ri.Rotate(30, [0, 1, 0])), "Rotate 30 0 1 0")
        self.assertEqual(self.line(lambda ri: ri.Color(1, 0.5, 0)), "Color [1 0.5 0]")
        self.assertEqual(self.line(lambda ri: ri.Color((1, 0.5, 0))), "Color [1 0.5 0]")
        self.assertEqual(self.line(lambda ri: ri.MotionBegin(0, 0.5)), "MotionBegin [0 0.5]")
        self.assertEqual(self.line(lambda ri: ri.ConcatTransform(*range(16))), self.line(lambda ri: ri.ConcatTransform([range(0, 8), range(8, 16)])))

    def test_parameters_are_dictionaries_or_keywords(self):
        expected = 'Surface "plastic" "Kd" [0.5] "texturename" ["a.tif"]'
        self.assertEqual(self.line(lambda ri: ri.Surface("plastic", {"Kd": 0.5, "texturename": "a.tif"})), expected)
        self.assertEqual(self.line(lambda ri: ri.Surface("plastic", Kd=[0.5], texturename=["a.tif"])), expected)
        self.assertEqual(self.line(lambda ri: ri.Surface("plastic", {"Kd": 0.5}, "texturename", "a.tif")), expected)
        self.assertEqual(self.line(lambda ri: ri.Surface("plastic", None)), 'Surface "plastic"')

    def test_handles_are_given_or_made(self):
        handles = []
        text = written("ascii", lambda ri: handles.extend([
            ri.LightSource("pointlight", {ri.HANDLEID: "key", "intensity": 2}), ri.LightSource("pointlight"), ri.ObjectBegin(), ri.Light("PxrRectLight", "rect"),
        ])).decode()
        self.assertEqual(handles, ["key", "1", "2", "rect"])
        for line in ('LightSource "pointlight" "key" "intensity" [2]\n', 'LightSource "pointlight" 1\n', "ObjectBegin 2\n", 'Light "PxrRectLight" "rect"\n'):
            self.assertIn(line, text)

    def test_constants_are_those_of_the_interface(self):
        ri = prman.Ri()
        for name, value in {"P": "P", "CS": "Cs", "ST": "st", "FOV": "fov", "PERSPECTIVE": "perspective", "RGBA": "rgba", "CATMULLCLARK": "catmull-clark",
                            "INTERPBOUNDARY": "interpolateboundary", "BSplineBasis": "b-spline", "BSPLINESTEP": 1, "INFINITY": 1e38, "CREASE": "crease"}.items():
            self.assertEqual(getattr(ri, name), value)
            self.assertEqual(getattr(prman, "RI_" + name), value)

    def test_levels_of_color_samples_count(self):
        self.assertEqual(self.line(lambda ri: (ri.ColorSamples([1, 1, 1], [1, 0, 0]), ri.Color(0.5))), "Color [0.5]")

    def test_records_are_comments_or_verbatim(self):
        text = written("ascii", lambda ri: (ri.ArchiveRecord(ri.COMMENT, "one ", 2, "\nthree"), ri.ArchiveRecord(ri.STRUCTURE, "Frame 1"), ri.ArchiveRecord(ri.VERBATIM, "Sides 1\n")))
        self.assertTrue(text.endswith(b"# one 2\n# three\n##Frame 1\nSides 1\n"), text)


class Streams(unittest.TestCase):
    def test_files_are_plain_or_compressed_and_indented(self):
        with tempfile.TemporaryDirectory() as folder:
            texts = []
            for compression in ("none", "gzip"):
                path = os.path.join(folder, compression)
                ri = prman.Ri()
                ri.Option("rib", {"string compression": compression, "string asciistyle": "indented"})
                ri.Begin(path)
                ri.WorldBegin()
                ri.Sides(1)
                ri.WorldEnd()
                ri.End()
                with open(path, "rb") as file:
                    texts.append(file.read())
            self.assertTrue(texts[0].endswith(b"WorldBegin\n\tSides 1\nWorldEnd\n"), texts[0])
            self.assertEqual(gzip.decompress(texts[1]), texts[0])

    def test_an_object_needs_no_more_than_write(self):
        class Sink:
            def __init__(self):
                self.bytes = b""

            def write(self, data):
                self.bytes += data

        for compression, read in (("none", bytes), ("gzip", gzip.decompress)):
            ri, sink = prman.Ri(), Sink()
            ri.Option("rib", {"string compression": compression})
            ri.Begin(sink)
            ri.Sides(1)
            ri.End()
            self.assertTrue(read(sink.bytes).endswith(b"Sides 1\n"), sink.bytes)

    def test_contexts_are_streams_side_by_side(self):
        ri, first, second = prman.Ri(), io.BytesIO(), io.BytesIO()
        ri.Begin(first)
        one = ri.GetContext()
        ri.Begin(second)
        ri.Sides(2)
        ri.Context(one)
        ri.Sides(1)
        ri.End()
        self.assertTrue(first.getvalue().endswith(b"Sides 1\n") and second.getvalue() == b"")
        self.assertIsNone(ri.GetContext())

    def test_a_program_gets_the_stream(self):
        with tempfile.TemporaryDirectory() as folder:
            ri, path = prman.Ri(), os.path.join(folder, "out")
            ri.Begin(f"launch:dd? of={path} status=none")
            ri.Sides(1)
            ri.End()
            with open(path) as file:
                self.assertIn("Sides 1\n", file.read())

    def test_standard_output_gets_the_stream(self):
        code = "import prman; ri = prman.Ri(); ri.Begin('-'); ri.Sides(1); ri.End()"
        self.assertIn("Sides 1\n", subprocess.run([sys.executable, "-c", code], capture_output=True, text=True).stdout)


class Errors(unittest.TestCase):
    def said(self, call):
        messages = []
        ri = prman.Ri()
        ri.ErrorHandler(lambda code, severity, message: messages.append(message))
        out = io.BytesIO()
        ri.Begin(out)
        call(ri)
        ri.End()
        self.assertNotIn(b"Sphere", out.getvalue())
        self.assertEqual(len(messages), 1)
        return messages[0]

    def test_a_call_that_is_no_request_is_told_by_its_line_and_left_out(self):
        line = sys._getframe().f_lineno + 1
        message = self.said(lambda ri: ri.Sphere(1, -1, 1))
        self.assertEqual(message, f"{__file__}:{line}: Sphere: argument 1: number 4 of 4 is missing; the request is left out")
        self.assertIn("1 arguments more", self.said(lambda ri: ri.Sphere(1, -1, 1, 360, 5)))
        self.assertIn('"P": strings and numbers are mixed', self.said(lambda ri: ri.Sphere(1, -1, 1, 360, {"P": [1, "x"]})))
        self.assertIn("neither a number nor a string", self.said(lambda ri: ri.Sphere(1, -1, 1, 360, {"P": [1, object()]})))
        self.assertIn('not "a"', self.said(lambda ri: ri.Sphere("a", -1, 1, 360)))
        self.assertIn("an integer is needed, not 1.5", self.said(lambda ri: ri.FrameBegin(1.5)))
        self.assertIn("argument 2: strings are needed", self.said(lambda ri: ri._call(SIGNATURES["Procedural"], ("RunProgram", [1], [0] * 6), {})))
        self.assertIn("takes no parameters", self.said(lambda ri: ri.Sides(1, {"a": 1})))

    def test_calls_outside_of_a_stream_are_told(self):
        ri = prman.Ri()
        ri.ErrorHandler(ri.ErrorIgnore)
        ri.Sphere(1, -1, 1, 360)
        self.assertIn("outside Begin and End", ri.LastError)

    def test_errors_can_be_exceptions(self):
        ri = prman.Ri()
        ri.ErrorHandler(ri.ErrorAbort)
        with self.assertRaisesRegex(tomales.RiError, "writing_test.py:[0-9]+: Sides"):
            ri.Sides(1)

    def test_a_request_that_does_not_exist_is_an_attribute_that_does_not_exist(self):
        with self.assertRaisesRegex(AttributeError, "Spere"):
            prman.Ri().Spere(1, -1, 1, 360)
