"""The places where a stream of RIB can go: a file, standard output, or a program that reads it while it is written."""
from __future__ import annotations

import gzip
import os
import pathlib
import selectors
import shlex
import shutil
import socket
import subprocess
import sys
import tempfile
from collections.abc import Callable
from typing import IO, Protocol

from . import program

#: A function that gets the detail and the data of a procedural, and returns what relay.py passes on.
Answer = Callable[[float, str], bytes]


class Destination(Protocol):
    #: The command that RunProgram requests name, so that the renderer can ask. None means that nothing can answer later.
    relay: str | None
    takes_places: bool  #: Whether the reader's messages use places that the stream carries (#line 12 "scene.py").

    def write(self, data: bytes) -> None: ...
    def close(self) -> int:
        """Waits for the reader. Returns the exit code if that is a program, else 0."""


def open_destination(name: object, answer: Answer, compress: bool) -> Destination:
    """Opens the destination of a stream. `name` is the argument of Ri.Begin. Raises OSError and
    program.RendererNotFound."""
    if hasattr(name, "write"):
        return File(name, compress, close=False)
    text = str(name)
    if text == "-":
        return File(sys.stdout.buffer, compress, close=False)
    if text == "__render":
        return Renderer(program.more_options(), answer)
    if text.startswith("launch:"):
        command, _, arguments = text[len("launch:") :].partition("?")
        given = [a for a in shlex.split(arguments) if not a.startswith(("-ctrl", "$ctrl", "-xcpt"))]
        if pathlib.Path(command.strip()).name in ("prman", "render", "tomales"):
            return Renderer(program.merged(program.from_prman(given) + program.more_options()), answer)
        return Piped([command.strip(), *given])
    return File(open(text, "wb"), compress, close=True)


class File:
    relay: str | None = None
    takes_places = False

    def __init__(self, stream: IO[bytes], compress: bool, close: bool) -> None:
        self._below = stream if close else None
        self._stream = gzip.GzipFile(fileobj=stream, mode="wb") if compress else stream

    def write(self, data: bytes) -> None:
        self._stream.write(data)

    def close(self) -> int:
        if isinstance(self._stream, gzip.GzipFile):
            self._stream.close()
        elif hasattr(self._stream, "flush"):  # an object of the script may have write() alone
            self._stream.flush()
        if self._below:
            self._below.close()
        return 0


class Piped:
    """A program that reads RIB from its standard input."""

    relay: str | None = None
    takes_places = False

    def __init__(self, command: list[str]) -> None:
        self._process = subprocess.Popen(command, stdin=subprocess.PIPE)
        assert self._process.stdin is not None
        self._pipe: IO[bytes] = self._process.stdin

    def write(self, data: bytes) -> None:
        try:
            self._pipe.write(data)
        except BrokenPipeError:
            pass  # The program has ended. Its exit code will say why.

    def close(self) -> int:
        try:
            self._pipe.close()
        except BrokenPipeError:
            pass
        return self._process.wait()


class Renderer(Piped):
    """The program tomales render, which reads while the script goes on.

    Procedurals that are Python functions are called in the thread that writes, whenever the pipe is full and while
    close() waits. So a script needs no locks. These functions may run in the middle of any call of Ri.
    """

    takes_places = True
    _step_bytes = 1 << 16
    _look_s = 0.05  #: The time between two looks of close() at whether the renderer has ended.

    def __init__(self, options: list[str], answer: Answer) -> None:
        self._folder = pathlib.Path(tempfile.mkdtemp(prefix="tomales_"))
        self._socket = self._folder / "socket"
        self._listener: socket.socket | None = None
        self._selector = selectors.DefaultSelector()
        self._answer = answer
        python, relay_file = sys.executable or "python3", pathlib.Path(__file__).with_name("relay.py")
        command = shlex.join([python, str(relay_file), str(self._socket)])
        super().__init__([program.find(), "render", "-", "--allow-program", command, *options])
        self._command = command

    @property
    def relay(self) -> str:  # type: ignore[override]
        if self._listener is None:
            self._pipe.flush()
            self._listener = socket.socket(socket.AF_UNIX)
            self._listener.bind(str(self._socket))
            self._listener.listen()
            self._selector.register(self._listener, selectors.EVENT_READ)
            os.set_blocking(self._pipe.fileno(), False)
        return self._command

    def write(self, data: bytes) -> None:
        if self._listener is None:
            return super().write(data)
        left = memoryview(data)
        self._selector.register(self._pipe, selectors.EVENT_WRITE)
        while left:
            if self._serve(None):
                try:
                    left = left[os.write(self._pipe.fileno(), left[: self._step_bytes]) :]
                except BlockingIOError:
                    continue
                except BrokenPipeError:
                    break
        self._selector.unregister(self._pipe)

    def close(self) -> int:
        try:
            self._pipe.close()
        except BrokenPipeError:
            pass
        while self._listener and self._process.poll() is None:
            self._serve(self._look_s)
        code = self._process.wait()
        if self._listener:
            self._listener.close()
        self._selector.close()
        shutil.rmtree(self._folder, ignore_errors=True)
        return code

    def _serve(self, patience_s: float | None) -> bool:
        """Answers the questions that have arrived. Returns whether the pipe accepts more data."""
        ready = [key.fileobj for key, _ in self._selector.select(patience_s)]
        for one in ready:
            if one is self._listener:
                self._selector.register(self._listener.accept()[0], selectors.EVENT_READ)
            elif one is not self._pipe:
                self._reply(one)  # type: ignore[arg-type]
        return self._pipe in ready

    def _reply(self, relay: socket.socket) -> None:
        question = b""
        while not question.endswith(b"\n"):
            part = relay.recv(4096)
            if not part:
                self._selector.unregister(relay)
                return relay.close()
            question += part
        detail, _, data = question.decode().rstrip("\n").partition(" ")
        answer = self._answer(float(detail), data)
        relay.sendall(len(answer).to_bytes(8, "big") + answer)
