"""The RenderMan Interface for Python, as PRMan's module has it: a method of Ri for each request.

    import prman
    ri = prman.Ri()
    ri.Begin(ri.RENDER)
    ri.Display("ball.exr", "openexr", "rgba")
    ri.Projection(ri.PERSPECTIVE, {ri.FOV: 40})
    ri.WorldBegin()
    ri.Translate(0, 0, 4)
    ri.Sphere(1, -1, 1, 360, {"Cs": [1, .5, .2]})
    ri.WorldEnd()
    ri.End()

The methods come from the renderer's own request table (requests.py). Those that differ from RIB are written out here.
"""
from __future__ import annotations

import os
import sys
from collections.abc import Callable
from typing import Any

from .arguments import CallError
from .procedural import Procedurals
from .requests import SIGNATURES, Signature
from .stream import Format, Place, Stream
from .tokens import TOKENS

_HERE = os.path.dirname(os.path.abspath(__file__)) + os.sep


class RiError(Exception):
    """An error was found while the error handler is "abort"."""


def _place() -> Place:
    """Returns the line outside of this package that is being run."""
    frame = sys._getframe(1)
    while frame.f_back and frame.f_code.co_filename.startswith(_HERE):
        frame = frame.f_back
    return frame.f_code.co_filename, frame.f_lineno


class Ri:
    """One description of frames, or several at a time in contexts. One thread at a time may use it."""

    #: Whether RIB files, too, hold comments of the form #line 12 "scene.py". With them a renderer's messages name the
    #: script.
    places: bool = False

    def __init__(self) -> None:
        self.LastError: str | None = None  #: The latest message.
        self.ExitCode = 0  #: The exit code of the program that the latest End has waited for.
        self._stream: Stream | None = None
        self._form = Format()
        self._handler: Any = "print"
        self._procedurals = Procedurals(self)

    # Streams and contexts.

    def Begin(self, name: object = None) -> None:
        """Begins a stream of RIB in a new context.

        `name` is a file's name, "-" for standard output, Ri.RENDER or None for the renderer itself, "launch:PROGRAM?
        ARGUMENTS" for a program that reads RIB, or an object with a method write for bytes.
        """
        self._stream = Stream(self.RENDER if name is None else name, self._form, self.places, self._procedurals.answer)
        self._form = Format()
        self._stream.line(None, b"##RenderMan RIB-Structure 1.1\nversion 3.04")

    def End(self) -> None:
        """Ends the stream and waits for the program that reads it, if there is one."""
        if stream := self._running("End"):
            self.ExitCode = stream.close()
            self._stream = None
            self._procedurals.free()
            if self.ExitCode not in (0, 3):
                self._error("End", f"the renderer has ended with exit code {self.ExitCode}")

    def GetContext(self) -> object:
        """Returns the current context, which Context() takes."""
        return self._stream

    def Context(self, context: object) -> None:
        """Continues the stream of another Begin."""
        self._stream = context if isinstance(context, Stream) else None

    # These calls do more than write a request.

    def Option(self, name: str, *arguments: Any, **parameters: Any) -> None:
        """Writes an option. Option "rib" instead chooses "format" ("ascii", "binary"), "compression" ("none",
        "gzip") and "asciistyle" ("indented") of this stream, or before Begin of the next one."""
        if name != "rib":
            self._call(SIGNATURES["Option"], (name, *arguments), parameters)
        else:
            (self._stream.form if self._stream else self._form).set(self._split(arguments, parameters)[1])

    def ArchiveRecord(self, kind: str, *parts: Any) -> None:
        """Writes a comment (kinds "comment" and "structure"), or with "verbatim" any text unchanged."""
        written = "".join(map(str, parts))
        marks = {"comment": "# ", "structure": "##"}
        lines = written.splitlines() if kind in marks else [written.rstrip("\n")]
        if stream := self._running("ArchiveRecord"):
            for line in lines:
                text = (marks.get(kind, "") + line).encode(errors="surrogateescape")
                stream.line(None if kind in marks else _place(), text)

    def ReadArchive(self, name: str, *arguments: Any, **parameters: Any) -> None:
        """Writes `ReadArchive(name, parameters)`. It leaves out a callback before the parameters, because the
        renderer reads the archive."""
        rest = tuple(a for a in arguments if not callable(a))
        self._call(SIGNATURES["ReadArchive"], (name, *rest), parameters)

    def Declare(self, name: str, declaration: str) -> str:
        """Returns the name, to be used as a token."""
        self._call(SIGNATURES["Declare"], (name, declaration), {})
        return name

    def ErrorHandler(self, handler: Any) -> None:
        """Sets the handler: "print" (messages go to standard error), "ignore", "abort" (RiError is raised), or a
        function of code (1), severity (2) and message."""
        self._handler = handler
        if isinstance(handler, str) and self._stream:
            self._call(SIGNATURES["ErrorHandler"], (handler,), {})

    def Procedural(self, data: Any, bound: Any, subdivide: Any, free: Callable[[Any], None] | None = None) -> None:
        """Writes a procedural. `subdivide` is a function of data and detail, which is called when the renderer asks
        for the contents of the bound. If the stream goes to a file, it is called at once, with infinite detail. Or
        `subdivide` is the name of one of the renderer's own procedurals, and data holds its strings."""
        if callable(subdivide):
            self._procedurals.add(data, bound, subdivide, free)
        else:
            kind = str(subdivide).removeprefix("Proc")
            self._call(SIGNATURES["Procedural"], (kind, [data] if isinstance(data, str) else data, bound), {})

    def TransformPoints(self, source: str, destination: str, points: Any) -> None:
        """Reports an error, because a stream of RIB cannot return points."""
        self._error("TransformPoints", "a stream of RIB answers nothing")

    # All other requests are written by the following functions.

    def _call(self, signature: Signature, arguments: tuple[Any, ...], parameters: dict[str, Any]) -> Any:
        """Writes a request. Returns its handle if it makes one."""
        stream = self._running(signature.name)
        if not stream:
            return None
        positional, named = self._split(arguments, parameters)
        handle = self._add_handle(signature, positional, named, stream) if signature.makes_handle else None
        if signature.name == "ColorSamples" and positional and hasattr(positional[0], "__len__"):
            stream.color_samples = len(positional[0]) // 3
        try:
            stream.request(signature, positional, named, _place())
        except CallError as problem:
            self._error(signature.name, f"{problem}; the request is left out")
        return handle

    @staticmethod
    def _split(arguments: tuple[Any, ...], parameters: dict[str, Any]) -> tuple[list[Any], dict[str, Any]]:
        """Separates positional arguments from the parameters of dictionaries and keywords. None stands for no
        parameters."""
        positional = [a for a in arguments if a is not None and not isinstance(a, dict)]
        named = {key: value for a in arguments if isinstance(a, dict) for key, value in a.items()}
        return positional, {**named, **parameters}

    @staticmethod
    def _add_handle(signature: Signature, positional: list[Any], named: dict[str, Any], stream: Stream) -> Any:
        """Returns the handle: the argument in its place, or the parameter "__handleid", or else a free number."""
        at = signature.arguments.index("h")
        key = next((k for k in named if str(k).split()[-1] == TOKENS["HANDLEID"]), None)
        given = named.pop(key) if key is not None else None
        if len(positional) <= at:
            stream.handles += given is None
            value = str(stream.handles) if given is None else given
            positional.append(value[0] if isinstance(value, (list, tuple)) else value)
        return positional[at]

    def _running(self, name: str) -> Stream | None:
        if not self._stream:
            self._error(name, "it is called outside Begin and End")
        return self._stream

    def _error(self, name: str, problem: str) -> None:
        file, line = _place()
        self.LastError = f"{file}:{line}: {name}: {problem}"
        if self._stream:
            self._stream.errors += 1
        if callable(self._handler):
            self._handler(1, 2, self.LastError)
        elif self._handler == "abort":
            raise RiError(self.LastError)
        elif self._handler == "print":
            print(self.LastError, file=sys.stderr)

    # Type checkers know only the names of these constants.
    def __getattr__(self, name: str) -> Any:
        raise AttributeError(f"Ri has no {name}: neither a request of RIB nor a constant of the RenderMan Interface")


def _method(signature: Signature) -> Callable[..., Any]:
    def call(self: Ri, *arguments: Any, **parameters: Any) -> Any:
        return self._call(signature, arguments, parameters)

    call.__name__ = call.__qualname__ = signature.name
    call.__doc__ = f"{signature.name}: arguments {signature.arguments or 'none'} (tomales/requests.py)" + (
        ", then parameters" if signature.takes_parameters else ""
    )
    return call


for _signature in SIGNATURES.values():
    if _signature.name[0].isupper() and _signature.name not in vars(Ri):
        setattr(Ri, _signature.name, _method(_signature))
for _name, _value in TOKENS.items():
    setattr(Ri, _name, _value)
