"""The requests of RIB and their arguments, as the renderer knows them.

`requests.txt` is what `tomales requests` prints. A test holds the two against each other.
"""
from __future__ import annotations

import pathlib
from dataclasses import dataclass

TABLE = pathlib.Path(__file__).with_name("requests.txt")


@dataclass(frozen=True)
class Signature:
    """One request. `arguments` has a letter for each positional argument:

    f number, i integer, s string, h handle, F I S array of numbers, integers, strings, c color, 2 to 9 that many
    numbers, m 16 numbers, b a basis (name or 16 numbers), ? what follows is given as a whole or left out.
    """

    name: str
    arguments: str
    takes_parameters: bool
    support: str  #: What the renderer does with it: "works", "draws", "ignored" or "missing".

    @property
    def makes_handle(self) -> bool:
        """Whether it defines what its handle names. Others refer to what has been defined."""
        return "h" in self.arguments and self.name not in ("ObjectInstance", "Illuminate")


def _parse(line: str) -> Signature:
    name, arguments, parameters, support = line.split()
    return Signature(name, arguments.strip("-"), parameters == "parameters", support)


SIGNATURES: dict[str, Signature] = {s.name: s for s in map(_parse, TABLE.read_text().splitlines())}
