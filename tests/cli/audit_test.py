"""Tests every request, option and attribute of RISpec 3.2 and PRMan, by the table rispec.txt: it works, or it is named once
with its line."""
import collections
import pathlib
import re

from program import Suite

t = Suite()
here = pathlib.Path(__file__).resolve().parent
rows = [line.split(None, 2) for line in (here / "rispec.txt").read_text().splitlines()
        if line.strip() and not line.startswith("# ") and not line.startswith("#  ")]

# Each row stands on a line of its own, and small objects are drawn.
lines, expected = ['Option "user" "float x" 1 Format 8 8 1 Display "out.exr" "file" "rgba"'], {}


def put(rib, expectation=None):
    lines.append(rib)
    if expectation:
        expected[len(lines)] = expectation


for place, expectation, rib in rows:
    if place == "option":
        put(rib, expectation)
put('Projection "perspective" "fov" 40 Translate 0 0 50 WorldBegin')
for place, expectation, rib in rows:
    if place == "world":
        put("AttributeBegin")
        put(rib, expectation)
        put("AttributeEnd")
put("WorldEnd")
t.write("audit.rib", "\n".join(lines) + "\n")
result = t.run("audit.rib", "-t", "1")
t.expect(result.returncode == 3, "the scene is rendered, and what is missing is in the exit code")

said = collections.defaultdict(list)
for line in result.stderr.splitlines():
    found = re.match(r"audit\.rib:(\d+): \w+: (.*) \[([^\]]*)\]$", line)
    if found:
        said[int(found[1])].append((found[3], found[2]))
    elif not line.startswith("tomales"):
        t.expect(False, "a message without a place: " + line)

for number, expectation in expected.items():
    messages = said.pop(number, [])
    request = lines[number - 1].split()[0]
    right = not messages if expectation == "works" else (
        len(messages) == 1 and messages[0][0] == expectation and request in messages[0][1])
    if not right:
        t.expect(False, f"{lines[number - 1]}: {expectation} expected, but {messages or 'nothing'} said")
for number, messages in said.items():
    t.expect(False, f"{lines[number - 1]}: {messages}")

source = (here.parent.parent / "reyes/rib/request_table.cpp").read_text()
known = set(re.findall(r'^    \{"(\w+)", "', source, re.M))
shown = {word for _, _, rib in rows for word in re.findall(r"\w+", rib)} | {
    "FrameBegin", "FrameEnd", "WorldBegin", "WorldEnd"}
t.expect(not known - shown, f"every request has a row ({', '.join(sorted(known - shown)) or len(known)})")
t.expect(not t.failures, f"{len(expected)} rows behave as the table says")
t.finish()
