"""Tests where the add-on of Blender looks for the Python module: beside an installed program, and in the tree of a
built one."""
import contextlib
import io
import os
import pathlib
import sys
import tempfile
import unittest
from unittest import mock

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "reyes/bindings/blender"))
import tomales_blender  # noqa: E402


class Folders(unittest.TestCase):
    def found(self, program, named=""):
        """Returns the folders of the list that hold the module, for a program in that place of a folder of its own."""
        with tempfile.TemporaryDirectory() as temporary:
            base = pathlib.Path(temporary).resolve()
            for place in ("usr/lib/python3.11/dist-packages", "tree/reyes/bindings/python"):
                (base / place / "tomales").mkdir(parents=True)
            file = base / program
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_text("#!/bin/sh\n")
            file.chmod(0o755)
            with mock.patch.dict(os.environ, {"TOMALES": str(file)}):
                folders = list(tomales_blender._folders(named))
            return [str(f.relative_to(base)) for f in folders if f.is_relative_to(base) and (f / "tomales").is_dir()]

    def test_an_installed_program_has_it_beside_itself(self):
        self.assertEqual(self.found("usr/bin/tomales"), ["usr/lib/python3.11/dist-packages"])

    def test_a_program_that_is_built_has_it_in_its_tree(self):
        self.assertEqual(self.found("tree/build/release/tomales"), ["tree/reyes/bindings/python"])

    def test_a_program_elsewhere_has_none(self):
        self.assertEqual(self.found("other/tomales"), [])

    def test_a_program_at_the_root_of_all_folders_is_no_error(self):
        with mock.patch("shutil.which", return_value="/tomales"), contextlib.redirect_stdout(io.StringIO()):
            self.assertTrue(list(tomales_blender._folders("")))

    def test_a_folder_that_is_named_comes_first(self):
        self.assertEqual(next(tomales_blender._folders("/named")), pathlib.Path("/named"))


if __name__ == "__main__":
    unittest.main()
