"""Reads the pages of the guide: their order, and the blocks of code in them."""
import pathlib
import re
from typing import NamedTuple

ROOT = pathlib.Path(__file__).parents[2]


class Block(NamedTuple):
    page: str
    line: int
    language: str
    text: str

    @property
    def file(self):
        """Returns the file that a comment in the first line names. The reader saves the block under that name."""
        named = re.match(r"(?:#|//|/\*) ([\w.]+\.(?:rib|sl|py|c|cpp|h))(?: \*/)?\n", self.text)
        return named and named[1]

    @property
    def place(self):
        return f"{self.page}:{self.line}"


def pages():
    """Returns README.md and then the pages in the order of docs/README.md, as paths from the root."""
    listed = re.findall(r"^(?:- |\| |\d+\. )\[[^]]*\]\(([\w.]+\.md)\)", (ROOT / "docs/README.md").read_text(), re.M)
    return ["README.md", *("docs/" + page for page in listed)]


def blocks(page):
    out, language, begin, lines = [], None, 0, []
    for number, line in enumerate((ROOT / page).read_text().splitlines(), 1):
        fence = re.match(r"```(\w*)$", line)
        if fence and language is None:
            language, begin, lines = fence[1], number + 1, []
        elif line == "```" and language is not None:
            out.append(Block(page, begin, language, "\n".join(lines) + "\n"))
            language = None
        elif language is not None:
            lines.append(line)
        elif line.startswith("    ") and line.strip() and not re.match(r"\s+([-*|]|\d+\.) ", line):
            out.append(Block(page, number, "indented", line + "\n"))
    return out
