"""One stream of RIB between Begin and End. It turns requests into lines, and sends the lines to a destination."""
from __future__ import annotations

from typing import Any

from .arguments import CallError, encoded
from .destination import Answer, Destination, open_destination
from .encoding import Ascii, Binary, Encoder, flat
from .requests import Signature

Place = tuple[str, int]  #: The file and the line of a script.


class Format:
    """The format that Option "rib" has set for a stream."""

    def __init__(self) -> None:
        self.encoder: Encoder = Ascii()
        self.compress = False
        self.indent = False

    def set(self, parameters: dict[str, Any]) -> None:
        for token, value in parameters.items():
            name, word = token.split()[-1], str(flat(value)[0])
            if name == "format":
                self.encoder = Binary() if word == "binary" else Ascii()
            elif name == "compression":
                self.compress = word == "gzip"
            elif name == "asciistyle":
                self.indent = "indented" in word


class Stream:
    _chunk_bytes = 1 << 16

    def __init__(self, name: object, form: Format, places: bool, answer: Answer) -> None:
        """With `places` the stream carries the script's lines, so that the renderer's messages name them. A renderer
        always gets them."""
        self.form = form
        self.color_samples = 3
        self.handles = 0
        self.errors = 0
        self._destination: Destination = open_destination(name, answer, form.compress)
        self._places = places or self._destination.takes_places
        self._waiting: list[bytes] = []
        self._waiting_bytes = 0
        self._depth = 0
        self._place: Place = ("", 0)
        self._answers: list[list[bytes]] = []

    @property
    def relay(self) -> str | None:
        """Returns the command that RunProgram requests name. None means that the renderer cannot ask later."""
        return self._destination.relay

    def request(self, signature: Signature, arguments: list[Any], parameters: dict[str, Any], place: Place) -> None:
        """Writes a request. Raises CallError, and then writes nothing."""
        encoder = self.form.encoder
        parts, more = encoded(signature, arguments, encoder, self.color_samples)
        parameters = {**parameters, **more}
        if parameters and not signature.takes_parameters:
            raise CallError("it takes no parameters")
        for token, value in parameters.items():
            try:
                parts += [encoder.string(str(token)), encoder.array(flat(value))]
            except TypeError as problem:
                raise CallError(f'"{token}": {problem}') from None
        if signature.name.endswith("End"):
            self._depth = max(0, self._depth - 1)
        self.line(place, self._margin() + signature.name.encode(), *parts)
        if signature.name.endswith("Begin"):
            self._depth += 1

    @property
    def _is_text(self) -> bool:
        return isinstance(self.form.encoder, Ascii)

    def _margin(self) -> bytes:
        return b"\t" * self._depth if self.form.indent and self._is_text else b""

    def line(self, place: Place | None, *parts: bytes) -> None:
        """Writes RIB unchanged."""
        if self._places and place and place != self._place:
            self._put(f'#line {place[1]} "{place[0]}"\n'.encode(errors="surrogateescape"))
        if place:
            self._place = (place[0], place[1] + 1)
        for part in (*parts, b"\n"):
            self._put(part)

    def _put(self, data: bytes) -> None:
        if self._answers:
            return self._answers[-1].append(data)
        if len(data) >= self._chunk_bytes:
            self._flush()
            return self._destination.write(data)  # Arrays must not be copied again.
        self._waiting.append(data)
        self._waiting_bytes += len(data)
        if self._waiting_bytes >= self._chunk_bytes:
            self._flush()

    def _flush(self) -> None:
        waiting, self._waiting, self._waiting_bytes = self._waiting, [], 0
        self._destination.write(b"".join(waiting))

    def begin_answer(self) -> None:
        """Makes the following requests the answer to a question of the renderer."""
        self._answers.append([])
        self._place = ("", 0)

    def end_answer(self) -> bytes:
        self._place = ("", 0)
        return b"".join(self._answers.pop())

    def close(self) -> int:
        self._flush()
        return self._destination.close()
