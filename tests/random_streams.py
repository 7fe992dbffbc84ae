"""Checks that one table names all random numbers (reyes/base/random_streams.h): no use mixes a number of its own into a hash, and every name
is used."""
import pathlib
import re
import sys

root = pathlib.Path(sys.argv[1])
table = root / "reyes/base/random_streams.h"
names = re.findall(r'^    \{"([^"]+)", "', table.read_text(), re.M)
own = {table.name, "rng.h", "rng.cpp"}  # These files define the hashes.
mixes = re.compile(r"\b(?:hashCombine|hash32|permutation|sobol[12]|owenScramble)\(")
bad, used = [], set()
for folder in ("reyes", "raytrace", "gi"):
    for file in sorted((root / folder).rglob("*.[hc]*")):
        text = file.read_text()
        used |= set(re.findall(r'randomStream\("([^"]+)"\)', text))
        if file.name in own:
            continue
        for number, line in enumerate(text.splitlines(), 1):
            if mixes.search(line) and re.search(r"\b0x[0-9a-fA-F]{5,}", line):
                bad.append(f"{file.relative_to(root)}:{number}: a hash is given a number that no table names")
            if re.search(r"\buint32_t k\w*Stream = (?!randomStream)", line):
                bad.append(f"{file.relative_to(root)}:{number}: a random stream outside of {table.name}")
bad += [f'nobody uses the random stream "{name}"' for name in names if name not in used]
print("\n".join(bad) or f"{len(names)} random streams")
sys.exit(bool(bad) or not names)
