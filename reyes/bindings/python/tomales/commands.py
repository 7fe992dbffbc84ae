"""Offers the commands of the program tomales as functions.

A keyword is an option of the command line. For example, `shading_rate=4` is --shading-rate 4 and `t=2` is -t 2. True
stands for an option without a value, and an option that may be repeated takes a list. `tomales render --help` lists the
options. An option that does not exist raises CommandFailed with the program's own message.
"""
from __future__ import annotations

import json
import os
import pathlib
import subprocess
import tempfile
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

from . import program
from .pictures import Picture, read

Path = str | os.PathLike[str]
#: A scene is a RIB file, several files as one stream, or RIB itself as bytes.
Scene = Path | Sequence[Path] | bytes

_USAGE, _INCOMPLETE = 1, 3
_PAIRS = {"format", "pixel-samples", "grid"}  # Their values are written NxM. Other tuples have commas.
_SHORT = {"output": "-o", "threads": "-t", "quiet": "-q", "verbose": "-v"}


class CommandFailed(Exception):
    """The exit code was neither 0 nor 3. `exit_code` and `messages` say why."""

    def __init__(self, command: Sequence[str], exit_code: int, messages: list[str]) -> None:
        super().__init__(f"{' '.join(command)} has ended with exit code {exit_code}\n" + "\n".join(messages))
        self.exit_code = exit_code
        self.messages = messages


@dataclass
class Result:
    """The result of a command."""

    exit_code: int  #: It is 0, or 3 if the renderer reported something as missing.
    messages: list[str]  #: The lines of standard error.
    output: str = ""  #: The text of standard output.
    file: str | None = None  #: The file that the option -o named.
    statistics: dict[str, Any] = field(default_factory=dict)  #: The statistics that --stats wrote.

    def picture(self) -> Picture:
        """Returns the picture. Raises OSError if `output` asked for none."""
        if self.file is None:
            raise OSError("the picture has no name: give `output`, or read what the Displays of the scene wrote")
        return read(self.file)


def options(**given: Any) -> list[str]:
    """Returns keywords as options of the command line."""
    out: list[str] = []
    for key, value in given.items():
        name = key.replace("_", "-")
        flag = _SHORT.get(key, "-" + name if len(name) == 1 else "--" + name)
        for one in value if isinstance(value, list) else [value]:
            if one is True:
                out.append(flag)
            elif isinstance(one, tuple):
                out += [flag, ("x" if name in _PAIRS else ",").join(map(str, one))]
            elif one is not None and one is not False:
                out += [flag, os.fspath(one) if hasattr(one, "__fspath__") else str(one)]
    return out


def run(command: str, *files: Scene, check: bool = True, **given: Any) -> Result:
    """Runs `tomales COMMAND OPTIONS FILES`. Bytes go to its standard input.

    With `check`, an exit code other than 0 and 3 raises CommandFailed. Raises program.RendererNotFound.
    """
    stdin = next((f for f in files if isinstance(f, bytes)), None)
    names = [os.fspath(f) for some in files for f in ([some] if isinstance(some, (str, os.PathLike)) else ["-"] if isinstance(some, bytes) else some)]
    arguments = [program.find(), command, *options(**given), *names]
    done = subprocess.run(arguments, input=stdin or b"", capture_output=True)
    messages = done.stderr.decode(errors="replace").splitlines()
    if check and done.returncode not in (0, _INCOMPLETE):
        raise CommandFailed(arguments, done.returncode, messages)
    file = given.get("output", given.get("o"))
    return Result(done.returncode, messages, done.stdout.decode(errors="replace"), os.fspath(file) if file else None)


def _with_statistics(command: str, scene: Scene, output: Path | None, given: dict[str, Any]) -> Result:
    with tempfile.TemporaryDirectory(prefix="tomales_") as folder:
        stats = pathlib.Path(given.pop("stats", None) or pathlib.Path(folder, "stats.json"))
        result = run(command, scene, output=output, stats=stats, **given)
        if stats.exists():
            result.statistics = json.loads(stats.read_text())
        return result


def render(scene: Scene, output: Path | None = None, **given: Any) -> Result:
    """Renders a picture: `render("ball.rib", "ball.exr", format=(320, 240), gi="none").picture()["rgb"]`."""
    return _with_statistics("render", scene, output, given)


def hide(scene: Scene, output: Path, **given: Any) -> Result:
    """Writes a deep frame buffer: `hide("ball.rib", "ball.dfb")`."""
    return _with_statistics("hide", scene, output, given)


def gather(shot: Path, output: Path, **given: Any) -> Result:
    """Writes the irradiance cache of a deep frame buffer: `gather("ball.dfb", "ball.icf")`."""
    return _with_statistics("gather", shot, output, given)


def shade(shot: Path, output: Path | None = None, **given: Any) -> Result:
    """Shades a deep frame buffer: `shade("ball.dfb", "ball.exr", irradiance="ball.icf")`."""
    return _with_statistics("shade", shot, output, given)


def photons(scene: Scene, output: Path, **given: Any) -> Result:
    """Writes photon maps into a folder."""
    return _with_statistics("photons", scene, output, given)


def chart(scenes: Scene, output: Path, **given: Any) -> dict[str, Any]:
    """Writes a page that plots error against time for every method. Returns its figures, which also stand beside it
    as JSON."""
    run("chart", scenes, output=output, **given)
    return json.loads(pathlib.Path(output).with_suffix(".json").read_text())


def info(file: Path) -> dict[str, Any]:
    """Returns what is in a file: a scene, a shot, a picture or a shader."""
    return json.loads(run("info", file, json=True).output)


def compare(picture: Path, reference: Path, **given: Any) -> dict[str, Any]:
    """Returns the errors of a picture against a reference."""
    return json.loads(run("compare", picture, reference, json=True, **given).output)
