"""Checks that all C++ is as clang-format leaves it: `format.py SOURCE`. The exit code is 77 (skipped) if the version that formats
the tree is not installed."""
import pathlib
import re
import shutil
import subprocess
import sys

VERSION = re.search(r"^clang_format_version=(\d+)$", (pathlib.Path(sys.argv[1]) / "dev").read_text(), re.MULTILINE)[1]
SKIPPED = 77


def formatter():
    """Returns the program of that version. Other versions differ in details, and each change of machine would need a commit."""
    for name in (f"clang-format-{VERSION}", "clang-format"):
        if shutil.which(name) and f"version {VERSION}." in subprocess.run([name, "--version"], capture_output=True, text=True).stdout:
            return name
    return None


root = pathlib.Path(sys.argv[1])
folders = ("reyes", "raytrace", "gi", "shaders", "displays", "tests", "docs", "scenes")
files = sorted(f for folder in folders for f in (root / folder).rglob("*") if f.suffix in (".cpp", ".h"))
if not formatter():
    print(f"clang-format {VERSION} is not installed")
    sys.exit(SKIPPED)
done = subprocess.run([formatter(), "--dry-run", "-Werror", *files], capture_output=True, text=True)
rough = sorted(set(re.findall(r"^(\S+?):\d+:\d+: error:", done.stderr, re.MULTILINE)))
for file in rough:
    print(f"{file} is not as `./dev format` leaves it")
print(f"{len(files)} files")
sys.exit(bool(rough) or done.returncode)
