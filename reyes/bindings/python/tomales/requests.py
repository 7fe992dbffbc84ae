"""The requests of RIB and their arguments, as the renderer knows them.

`requests.txt` is what `tomales requests` prints. A test compares the two.
"""
from __future__ import annotations

import pathlib
from dataclasses import dataclass

TABLE = pathlib.Path(__file__).with_name("requests.txt")


@dataclass(frozen=True)
class Signature:
    """One request. `arguments` has a letter for each positional argument:

    f is a number, i an integer, s a string and h a handle; F, I and S are arrays of numbers, integers and strings; c is
    a color, and a digit from 2 to 9 stands for that many numbers; m is 16 numbers and b a basis (a name or 16 numbers).
    All arguments after a ? are given together or left out together.
    """

    name: str
    arguments: str
    takes_parameters: bool
    support: str  #: What the renderer does with the request: "works", "draws", "ignored" or "missing".

    @property
    def makes_handle(self) -> bool:
        """Returns whether the request defines the object that its handle names. Other requests refer to defined objects."""
        return "h" in self.arguments and self.name not in ("ObjectInstance", "Illuminate")


def _parse(line: str) -> Signature:
    name, arguments, parameters, support = line.split()
    return Signature(name, arguments.strip("-"), parameters == "parameters", support)


SIGNATURES: dict[str, Signature] = {s.name: s for s in map(_parse, TABLE.read_text().splitlines())}
