"""All C++ is as clang-format leaves it: `format.py SOURCE`. Exit code 77 (skipped) where the version that formats it is not there."""
import pathlib
import re
import shutil
import subprocess
import sys

VERSION = re.search(r"^clang_format_version=(\d+)$", (pathlib.Path(sys.argv[1]) / "dev").read_text(), re.MULTILINE)[1]
SKIPPED = 77


def formatter():
    """The program of that version. Others differ in details, which would be a commit for each change of machine."""
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
