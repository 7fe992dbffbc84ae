"""The renderer's program: where it is, and how it is run."""
from __future__ import annotations

import os
import pathlib
import shlex
import shutil
from collections.abc import Iterable

_HERE = pathlib.Path(__file__).resolve().parent
_more: list[str] = []


class RendererNotFound(Exception):
    """There is no program tomales."""


def find() -> str:
    """The path of the program tomales.

    It is $TOMALES if that is set; else the one that was installed, or built, with this module; else one on $PATH.
    Raises RendererNotFound.
    """
    if named := os.environ.get("TOMALES"):
        return named
    nearby = [parent / place for parent in _HERE.parents for place in ("bin/tomales", "build/release/tomales")]
    for path in [str(p) for p in nearby if p.is_file()] + [shutil.which("tomales")]:
        if path and os.access(path, os.X_OK):
            return path
    raise RendererNotFound("there is no program tomales: install it, add its folder to $PATH or set $TOMALES")


def more_options() -> list[str]:
    """Options of every rendering that is started from Python: those of Init and of $TOMALES_RENDER_OPTIONS."""
    return merged(_more + shlex.split(os.environ.get("TOMALES_RENDER_OPTIONS", "")))


def merged(options: Iterable[str]) -> list[str]:
    """Every option once, with its latest values: the command line takes none twice."""
    groups: dict[str, list[str]] = {}
    name = ""
    for word in options:
        if word.startswith("-") and not word[1:2].isdigit():
            name = word
            groups.pop(name, None)
        groups.setdefault(name, []).append(word)
    return [word for group in groups.values() for word in group]


def from_prman(arguments: Iterable[str]) -> list[str]:
    """Options of PRMan's command line as those of tomales. What has no counterpart is left out."""
    out: list[str] = []
    for argument in arguments:
        name, _, value = argument.partition(":")
        if name in ("-progress", "-Progress"):
            out.append("--progress")
        elif name == "-t" and value.isdigit() and int(value) > 0:
            out += ["-t", value]
        elif argument.startswith("--"):
            out.append(argument)
    return out


def Init(arguments: Iterable[str] = ()) -> None:
    """Options for renderings that are started from now on, as PRMan's command line has them ("-progress", "-t:4")."""
    _more[:] = from_prman(arguments)


def Cleanup() -> None:
    """Forgets what Init has set."""
    _more.clear()
