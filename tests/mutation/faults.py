"""Draws one-line faults of C++ sources at random: what can be wrong at a line."""
import random
import re
from dataclasses import dataclass

# Each row has a regular expression and its replacement. clang-format puts spaces around binary operators, which
# distinguishes them from templates, references and signs. Strings cannot be subtracted.
SWAPS = [(re.compile(pattern), new) for pattern, new in (
    (r"(?<= )<(?= )", "<="), (r"(?<= )<=(?= )", "<"), (r"(?<= )>(?= )", ">="), (r"(?<= )>=(?= )", ">"),
    (r"(?<= )==(?= )", "!="), (r"(?<= )!=(?= )", "=="), (r"(?<= )&&(?= )", "||"), (r"(?<= )\|\|(?= )", "&&"),
    (r"(?<=[^\"] )\+(?= [^\"])", "-"), (r"(?<= )-(?= )", "+"), (r"(?<= )\*(?= )", "/"), (r"(?<= )/(?= )", "*"),
    (r"(?<= )\+=(?= [^\"])", "-="), (r"(?<= )-=(?= )", "+="), (r"\+\+(?=[\w)])", "--"),
    (r"(?<=[ (])!(?=[\w(*])", ""), (r"(?<=[ (])-(?=[\w(])", ""), (r"\bmin(?=[(<])", "max"), (r"\bmax(?=[(<])", "min"),
    (r"\btrue\b", "false"), (r"\bfalse\b", "true"), (r"\bcontinue;", "break;"), (r"\bbreak;", "continue;"))]
NUMBER = re.compile(r"(?<![\w.\[<])(\d+)((?:\.\d+)?[fu]?)\b(?![\w.])")
CONDITION = re.compile(r"\b(?:if|while) \((?!const |auto |std::optional)")
# This matches a call, an assignment or a guarded statement, but no declaration.
STATEMENT = re.compile(r"(?:[\w.:>\[\]*()-]+(?:\(| [-+*/|&]?= |\+\+;)|(?:if|for|while) \().*;$|\+\+\w+;$|(?:continue|break);$")
# These lines state what is true at compile time, or what `check` asserts. Where the assertion holds, a fault in them
# changes nothing that runs.
PROMISES = re.compile(r"^\s*(#|using |static_assert|CHECK_\w+\(|friend |template |/\*|\*)")


@dataclass(frozen=True)
class Fault:
    path: str
    line: int  # Lines count from 1.
    old: str
    new: str

    def diff(self):
        return f"{self.path}:{self.line}\n  - {self.old.strip()}\n  + {self.new.strip()}"


def code_of(line):
    """Returns the line without its comment and with the insides of its strings blanked. Columns stay the same up to the
    comment."""
    blanked = re.sub(r'"(?:[^"\\]|\\.)*"|\'(?:[^\'\\]|\\.)\'', lambda text: '"' + "_" * (len(text[0]) - 2) + '"', line)
    return blanked.split("//")[0].rstrip()


def closing(code, start):
    """Returns where the parenthesis closes that opens before `start`, or None if that is on another line."""
    depth = 1
    for place in range(start, len(code)):
        depth += {"(": 1, ")": -1}.get(code[place], 0)
        if depth == 0:
            return place
    return None


def faults_of(line, before):
    """Yields all faulty forms of a line. `before` is the code above it."""
    code, comment = code_of(line), line[len(code_of(line)):]
    if PROMISES.match(code):
        return []
    spans = [(match.start(), match.end(), new) for pattern, new in SWAPS for match in pattern.finditer(code)]
    spans += [(match.start(1), match.end(1), str(int(match[1]) + 1)) for match in NUMBER.finditer(code)]
    for match in CONDITION.finditer(code):
        end = closing(code, match.end())
        if end:
            spans.append((match.end(), end, f"!({line[match.end():end]})"))
    out = [line[:start] + new + line[end:] for start, end, new in spans]
    indent = re.match(r" *", line)[0]
    if indent and re.search(r"([;{}]|\belse)$", before):  # The line begins a statement.
        if re.match(r" *return .+;$", code):
            out.append(f"{indent}return {{}};{comment}")
        if STATEMENT.match(code.strip()) and not code.strip().startswith("return"):
            out += [f"{indent};{comment}", f"{indent}return;{comment}"]
    return [new for new in dict.fromkeys(out) if new != line]


def faults_of_files(root, paths):
    """Returns, for each line that can be wrong, its faults."""
    out = []
    for path in paths:
        before = ""
        for number, line in enumerate((root / path).read_text().split("\n"), 1):
            faults = [Fault(path, number, line, new) for new in faults_of(line, before)]
            if faults:
                out.append(faults)
            before = code_of(line) or before
    return out


def drawn(root, paths, seed):
    """Yields a random fault of each line that can be wrong, in random order."""
    lines = faults_of_files(root, paths)
    draw = random.Random(seed)
    draw.shuffle(lines)
    for faults in lines:
        yield draw.choice(faults)
