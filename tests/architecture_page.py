"""Every file and function that docs/architecture.md names as `path:function` exists."""
import pathlib
import re
import sys

root = pathlib.Path(sys.argv[1])
bad = []
page = (root / "docs/architecture.md").read_text()
for path, function in re.findall(r"`((?:reyes|raytrace|gi|shaders|scenes|tests|docs)/[\w./-]+)(?::([\w:~]+))?`", page):
    if not (root / path).exists():
        bad.append(f"docs/architecture.md names {path}, which does not exist")
    elif function and function.split("::")[-1] not in (root / path).read_text():
        bad.append(f"docs/architecture.md names {function} in {path}, which does not mention it")
print("\n".join(bad))
sys.exit(bool(bad))
