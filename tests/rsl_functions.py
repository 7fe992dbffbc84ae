"""Checks that docs/rsl_reference.md lists exactly the built-in functions of RSL that the compiler has: `rsl_functions.py
SOURCE`."""
import pathlib
import re
import sys

source = pathlib.Path(sys.argv[1])
types = "void|float|color|point|vector|normal|matrix|string"
table = re.findall(rf'\{{"(?:{types}|T|V) (\w+)\(', (source / "reyes/rsl/builtins.cpp").read_text())
prelude = re.search(r'R"RSL\((.*)\)RSL"', (source / "reyes/rsl/prelude.cpp").read_text(), re.S)[1]
written = re.findall(rf"^(?:{types}) (\w+)\(", prelude, re.M)
compiler = {name for name in table + written if not name.startswith("__")}

section = re.search(r"^## Built-in functions\n(.*?)^## ", (source / "docs/rsl_reference.md").read_text(), re.M | re.S)[1]
cells = re.findall(r"^\| (`.*?) \|", section, re.M)
page = [name for cell in cells for name in re.findall(r"(\w+)\(", cell)]

bad = [f"docs/rsl_reference.md does not list {name}(), which the compiler has" for name in sorted(compiler - set(page))]
bad += [f"docs/rsl_reference.md lists {name}(), which the compiler does not have" for name in sorted(set(page) - compiler)]
if len(table) < 100 or len(written) < 20:  # If the tables were written otherwise, nothing would be compared.
    bad.append(f"only {len(table)} rows of builtins.cpp and {len(written)} functions of prelude.cpp were found")
print("\n".join(bad))
sys.exit(bool(bad))
