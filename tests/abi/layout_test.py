"""Tests that members of ABI 1 stay where they are. It compares the structs, enumerations and defaults of today's C headers with those of tests/abi/1.
The rule of growth is in reyes/shader_api.h."""
import os
import pathlib
import re
import subprocess
import sys
import tempfile

source = pathlib.Path(sys.argv[2])
frozen = pathlib.Path(__file__).resolve().parent / "1"
HEADERS = ("types", "options", "services")
bad = 0


def expect(condition, message):
    global bad
    if not condition:
        print("FAILED  " + message)
        bad += 1


def text_of(root):
    parts = [root / "reyes/shader" / (name + ".h") for name in HEADERS] + [root / "reyes/shader_api.h"]
    return re.sub(r"/\*.*?\*/", " ", "\n".join(p.read_text() for p in parts), flags=re.S)


def fields_of(body):
    """Returns {name: type} of the members of a struct, one for each declarator."""
    out = {}
    for member in filter(None, (re.sub(r"\s+", " ", m).strip() for m in body.split(";"))):
        function = re.match(r"(.*?)\(\*(\w+)\)(.*)$", member)
        if function:
            out[function[2]] = (function[1] + "(*)" + function[3]).replace(" ", "")
            continue
        kind, declarators = re.match(r"((?:const )?(?:struct )?\w+(?: const)?)\s*(.*)$", member).groups()
        for declarator in declarators.split(","):
            name = re.search(r"(\w+)(\[\w+\])*\s*$", declarator.strip())[1]
            out[name] = (kind + declarator.replace(name, "")).replace(" ", "")
    return out


def structs_of(text):
    return {m[2]: fields_of(m[1]) for m in re.finditer(r"typedef struct \w+ \{(.*?)\} (\w+);", text, flags=re.S)}


def constants_of(text):
    enums = re.findall(r"typedef enum \w+ \{(.*?)\} \w+;", text, flags=re.S)
    return [re.match(r"\w+", e.strip())[0] for body in enums for e in body.split(",") if e.strip()] + \
        ["TM_SHADER_ABI", "TM_LANES", "TM_OUTPUT", "TM_UNIFORM"]


def measured(root, structs, constants, defaults):
    """Returns {name: number}, measured by the compiler: sizes and offsets of the structs, and values of constants and defaults."""
    lines = []
    for struct, fields in structs.items():
        lines.append(f'printf("sizeof {struct} %zu\\n", sizeof({struct}));')
        for field in fields:
            lines.append(f'printf("offset {struct}.{field} %zu\\n", offsetof({struct}, {field}));')
            lines.append(f'printf("bytes {struct}.{field} %zu\\n", sizeof((({struct}*)0)->{field}));')
    lines += [f'printf("value {c} %ld\\n", (long)({c}));' for c in constants]
    for struct, function in defaults:
        lines.append(f"{{ {struct} made = {function}();")
        for field in structs[struct]:
            if field != "structBytes":
                lines.append(f'if (sizeof made.{field} == 4) {{ unsigned n; memcpy(&n, &made.{field}, 4); printf("default {struct}.{field} %u\\n", n); }}')
        lines.append("}")
    with tempfile.TemporaryDirectory() as folder:
        program = pathlib.Path(folder) / "measure"
        program.with_suffix(".c").write_text(
            "#include <reyes/shader_api.h>\n#include <stddef.h>\n#include <stdio.h>\n#include <string.h>\nint main(void) {\n" +
            "\n".join(lines) + "\nreturn 0; }\n")
        subprocess.run([os.environ.get("CC", "cc"), "-std=c99", "-Wall", "-Wextra", "-pedantic", "-Werror", "-I", root, program.with_suffix(".c"), "-o", program],
                       check=True)
        said = subprocess.run([program], check=True, capture_output=True, text=True).stdout
    return {name: int(number) for name, number in (line.rsplit(" ", 1) for line in said.splitlines())}


then_text, now_text = text_of(frozen), text_of(source)
then_structs, now_structs = structs_of(then_text), structs_of(now_text)
defaults = re.findall(r"static inline (\w+) (tm\w+)\(void\)", then_text)
expect(len(then_structs) > 15 and len(defaults) == 8 and len(then_structs["TmServices"]) > 25, "the headers are understood")
for struct, fields in then_structs.items():
    today = now_structs.get(struct, {})
    for field, kind in fields.items():
        expect(today.get(field) == kind, f"{struct}.{field} is {today.get(field, 'gone')}, and was {kind}")
if not bad:
    then = measured(frozen, then_structs, constants_of(then_text), defaults)
    now = measured(source, {name: now_structs[name] for name in now_structs}, constants_of(now_text), defaults)
    for name, number in then.items():
        grows = name.startswith("sizeof") and (name.split()[1] == "TmParamDecl" or "structBytes" in then_structs[name.split()[1]])
        expect(now.get(name) == number or (grows and now[name] > number), f"{name} is {now.get(name)}, and was {number}")
    for struct, fields in now_structs.items():
        end = 0
        for field in fields:
            expect(now[f"offset {struct}.{field}"] == end or now[f"offset {struct}.{field}"] == then.get(f"sizeof {struct}"), f"there is a hole before {struct}.{field}")
            end = now[f"offset {struct}.{field}"] + now[f"bytes {struct}.{field}"]
            if struct in then_structs and field not in then_structs[struct]:
                expect(now[f"offset {struct}.{field}"] >= then[f"sizeof {struct}"], f"{struct}.{field} begins within the struct of ABI 1")
print(f"{len(then_structs)} structs")
sys.exit(bool(bad))
