"""Renders the corpus of ugly geometry. The second line of each file tells the exit code and the warnings that are expected."""
import pathlib
import re

from program import Suite

t = Suite()
files = sorted(pathlib.Path(__file__).parent.parent.glob("corpus/geometry/*.rib"))
for file in files:
    exit_code, codes = re.match(r"# exit (\d), warns (.*)", file.read_text().splitlines()[1]).groups()
    result = t.run(str(file), "-o", "ugly.exr")
    said = sorted(set(re.findall(r"\[([a-z0-9-]+)\]$", result.stderr, re.MULTILINE)) - {"frame-empty"})  # This warning follows from the others.
    if "[frame-empty]" in result.stderr:
        exit_code = max(int(exit_code), 3)
    good = result.returncode == int(exit_code) and (" ".join(said) or "nothing") == codes
    t.expect(good, f"{file.name}: {codes}")
    if not good:
        print(f"        exit {result.returncode}, expected {exit_code}\n        {result.stderr[:600]}")
t.expect(len(files) >= 60, "there are at least 60")

t.finish()
