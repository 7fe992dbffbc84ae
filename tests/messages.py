"""Checks that docs/messages.md explains every code that the sources can report, and no other."""
import pathlib
import re
import sys

root = pathlib.Path(sys.argv[1])
# These have the shape of a code and are none: words of RIB, of HTTP, and of tests/bench/amendments.py.
words = {"b-spline", "blackman-harris", "built-in", "catmull-clark", "catmull-rom", "no-referrer", "no-store", "same-origin", "second-order", "separable-catmull-rom", "zigzag-x", "zigzag-y"}
# Codes have hyphens, or are the first text that is passed to a function `report`.
code = re.compile(r'"([a-z0-9]+(?:-[a-z0-9]+)+)"|\breport\((?!\))[^";]*"([a-z0-9]+)"')


def codes_in(file):
    text = re.sub(r"//.*", "", file.read_text())
    return {hyphened or single for hyphened, single in code.findall(text)} - words


sources = [file for folder in ("reyes", "gi", "raytrace", "shaders", "displays") for file in (root / folder).rglob("*")
           if file.suffix in (".h", ".cpp", ".c")]
reported = {found: file.relative_to(root) for file in sources for found in codes_in(file)}
page = (root / "docs/messages.md").read_text()
rows = re.findall(r"^\| (`[a-z0-9-]+`(?:, `[a-z0-9-]+`)*) \|", page, re.M)
explained = [name for row in rows for name in re.findall(r"`([a-z0-9-]+)`", row)]

bad = [f"{file} reports \"{name}\", which docs/messages.md does not explain" for name, file in sorted(reported.items()) if name not in explained]
bad += [f"docs/messages.md explains \"{name}\", which nothing reports" for name in explained if name not in reported]
bad += [f"docs/messages.md explains \"{name}\" twice" for name in sorted(set(explained)) if explained.count(name) > 1]
bad += [f"{file.relative_to(root)} computes a code, which nobody can look up in the sources" for file in sources
        if re.search(r"\breport\([\w:]+,\s*fmt::format\(", file.read_text())]
if len(reported) < 200:
    bad.append(f"only {len(reported)} codes were found in the sources: they are written in another way than this test knows")
print("\n".join(bad))
sys.exit(bool(bad))
