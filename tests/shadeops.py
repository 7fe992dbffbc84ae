"""Checks that every shadeop of tests/unit/shade/shadeops.txt is in an installed header and has a test: `shadeops.py SOURCE HEADERS`, with
colons between headers."""
import pathlib
import re
import sys


def code(files):
    """Returns the files' text without comments, because a name in a comment proves nothing. What stands in the code is compiled, and
    tests/unit is run as a whole."""
    return "\n".join(re.sub(r"//.*|/\*.*?\*/", "", file.read_text()) for file in files)


source = pathlib.Path(sys.argv[1])
headers = code(source / name for name in sys.argv[2].split(":"))
tests = code(sorted(path for path in (source / "tests/unit").rglob("*") if path.suffix in (".cpp", ".h")))
bad = 0
rows = [line for line in (source / "tests/unit/shade/shadeops.txt").read_text().splitlines() if line and not line.startswith("#")]
for row in rows:
    name, symbol, proof = (part.strip() for part in re.split(r"\s{2,}", row))
    for text, where, place in ((symbol, headers, "installed header"), (proof, tests, "test")):
        if text not in where:
            print(f"{name}: no {place} has \"{text}\"")
            bad += 1
print(f"{len(rows)} shadeops")
sys.exit(bool(bad))
