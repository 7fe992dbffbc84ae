"""Finds and runs the renderer's program."""
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
    """Returns the path of the program tomales. It is $TOMALES if that is set, else the program that was installed or
    built with this module, else the first on $PATH. Raises RendererNotFound.
    """
    if named := os.environ.get("TOMALES"):
        return named
    nearby = [parent / place for parent in _HERE.parents for place in ("bin/tomales", "build/release/tomales")]
    for path in [str(p) for p in nearby if p.is_file()] + [shutil.which("tomales")]:
        if path and os.access(path, os.X_OK):
            return path
    raise RendererNotFound("there is no program tomales: install it, add its folder to $PATH or set $TOMALES")


def more_options() -> list[str]:
    """Returns the options of every rendering that Python starts: those of Init and of $TOMALES_RENDER_OPTIONS."""
    return merged(_more + shlex.split(os.environ.get("TOMALES_RENDER_OPTIONS", "")))


def merged(options: Iterable[str]) -> list[str]:
    """Keeps the latest values of every option, because the command line takes no option twice."""
    groups: dict[str, list[str]] = {}
    name = ""
    for word in options:
        if word.startswith("-") and not word[1:2].isdigit():
            name = word
            groups.pop(name, None)
        groups.setdefault(name, []).append(word)
    return [word for group in groups.values() for word in group]


def from_prman(arguments: Iterable[str]) -> list[str]:
    """Turns options of PRMan's command line into those of tomales. It leaves out options without a counterpart."""
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
    """Sets options for later renderings, as PRMan's command line writes them ("-progress", "-t:4")."""
    _more[:] = from_prman(arguments)


def Cleanup() -> None:
    """Forgets the options that Init has set."""
    _more.clear()
