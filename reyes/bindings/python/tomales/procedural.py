"""Procedurals that are Python functions."""
from __future__ import annotations

import traceback
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from .requests import SIGNATURES
from .tokens import TOKENS

if TYPE_CHECKING:
    from .ri import Ri


_CLOSED = b"\xff"  # This is the protocol of RunProgram: RISpec 3.2, section 5.10.


class Procedurals:
    """The procedurals of one stream. The renderer knows them by their numbers."""

    def __init__(self, ri: Ri) -> None:
        self._ri = ri
        self._all: list[tuple[Any, Callable[[Any, float], None], Callable[[Any], None] | None]] = []

    def add(self, data: Any, bound: Any, subdivide: Callable[[Any, float], None], free: Callable[[Any], None] | None) -> None:
        stream = self._ri._running("Procedural")
        if not stream:
            return
        if relay := stream.relay:
            self._all.append((data, subdivide, free))
            call = ("RunProgram", [relay, str(len(self._all) - 1)], bound)
            return self._ri._call(SIGNATURES["Procedural"], call, {})
        self._ri._call(SIGNATURES["AttributeBegin"], (), {})
        subdivide(data, float(TOKENS["INFINITY"] or 0))
        self._ri._call(SIGNATURES["AttributeEnd"], (), {})
        if free:
            free(data)

    def answer(self, detail: float, number: str) -> bytes:
        """Returns the RIB of a procedural and its closing byte. If the function raises, the byte is missing, and the
        renderer reports an error."""
        data, subdivide, _ = self._all[int(number)]
        stream = self._ri._stream
        assert stream is not None
        stream.begin_answer()
        try:
            subdivide(data, detail)
        except Exception:
            self._ri._error("Procedural", traceback.format_exc().rstrip())
            return stream.end_answer()
        return stream.end_answer() + _CLOSED

    def free(self) -> None:
        for data, _, free in self._all:
            if free:
                free(data)
        self._all.clear()
