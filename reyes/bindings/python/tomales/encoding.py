"""Writes values of Python as tokens of RIB, as text or encoded (RISpec 3.2, appendix C).

Both encoders have the same three functions. Each returns bytes.
"""
from __future__ import annotations

import re
from array import array
from collections.abc import Iterable
from typing import Any, Protocol

#: A flat sequence of numbers or strings. Anything with a dtype counts as an array of numpy; this module works without
#: numpy.
Values = Any

_PLAIN = {int, float, bool}


def flat(value: Any) -> Values:
    """Flattens one string or number, or any nesting of lists, tuples and arrays.

    Raises TypeError for anything that is neither a number nor a string.
    """
    if hasattr(value, "dtype"):
        return value.ravel() if value.dtype.kind in "fiub" and value.ndim else flat(value.tolist())
    if isinstance(value, (str, bytes)) or not isinstance(value, Iterable):
        return [_plain(value)]
    values = value if isinstance(value, (list, tuple)) else list(value)
    kinds = set(map(type, values))
    if kinds <= _PLAIN or kinds == {str}:
        return values
    return [v for item in values for v in flat(item)]


def _plain(value: Any) -> str | int | float:
    if isinstance(value, bytes):
        return value.decode(errors="surrogateescape")
    if isinstance(value, (str, int, float)):
        return value
    if hasattr(value, "__fspath__"):
        return str(value)
    if hasattr(value, "__float__"):
        return float(value)
    raise TypeError(f"{value!r} of type {type(value).__name__} is neither a number nor a string")


def are_strings(values: Values) -> bool:
    """Returns whether the values are strings and not numbers. Raises TypeError if they are mixed."""
    if hasattr(values, "dtype"):
        return False
    strings = sum(isinstance(v, str) for v in values) if str in set(map(type, values)) else 0
    if strings not in (0, len(values)):
        raise TypeError("strings and numbers are mixed")
    return strings > 0


class Encoder(Protocol):
    """A way to write tokens. Its tokens may directly follow each other and the name of a request."""

    def number(self, value: float) -> bytes: ...
    def string(self, value: str) -> bytes: ...
    def array(self, values: Values) -> bytes:
        """Writes numbers or strings in brackets."""


class Ascii:
    """Writes text. Nine digits are what a float needs to be read back unchanged."""

    _special = re.compile(r'[\\"\x00-\x1f]')
    _escapes = {"\\": r"\\", '"': r"\"", "\n": r"\n", "\r": r"\r", "\t": r"\t", "\b": r"\b", "\f": r"\f"}

    def number(self, value: float) -> bytes:
        return ((" %d" if isinstance(value, int) else " %.9g") % value).encode()

    def string(self, value: str) -> bytes:
        text = self._special.sub(lambda m: self._escapes.get(m[0]) or f"\\{ord(m[0]):03o}", value)
        return b' "' + text.encode(errors="surrogateescape") + b'"'

    def array(self, values: Values) -> bytes:
        if are_strings(values):
            return b" [" + b"".join(map(self.string, values))[1:] + b"]"
        whole = values.dtype.kind != "f" if hasattr(values, "dtype") else set(map(type, values)) == {int}
        listed = values.tolist() if hasattr(values, "dtype") else values
        pattern = ("%d " if whole else "%.9g ") * len(listed)
        return b" [" + (pattern[:-1] % tuple(listed)).encode() + b"]"


class Binary:
    """Writes encoded tokens: floats as arrays of four bytes each, integers as one token each."""

    def number(self, value: float) -> bytes:
        if isinstance(value, int) and -(2**31) <= value < 2**31:
            size = self._size(value, value)
            return bytes([0o200 + size - 1]) + int(value).to_bytes(size, "big", signed=True)
        return b"\xa4" + _big_endian(array("f", [value]))

    def string(self, value: str) -> bytes:
        text = value.encode(errors="surrogateescape")
        return self._counted(0o240, len(text)) + text if len(text) > 15 else bytes([0o220 + len(text)]) + text

    def array(self, values: Values) -> bytes:
        if are_strings(values):
            return b"[" + b"".join(map(self.string, values)) + b"]"
        if len(values) == 0:
            return b"[]"
        if hasattr(values, "dtype"):
            floats = values.dtype.kind == "f" or int(values.min()) < -(2**31) or int(values.max()) >= 2**31
            if floats:
                return self._counted(0o310, len(values)) + values.astype(">f4").tobytes()
            return self._integers(int(values.min()), int(values.max()), values.astype(">i4").tobytes())
        if set(map(type, values)) == {int} and min(values) >= -(2**31) and max(values) < 2**31:
            return self._integers(min(values), max(values), _big_endian(array("i", values)))
        return self._counted(0o310, len(values)) + _big_endian(array("f", values))

    def _integers(self, least: int, most: int, words: bytes) -> bytes:
        """Writes integers of the size that the largest one needs. `words` must be big-endian and of four bytes each."""
        size = self._size(least, most)
        out = bytearray(len(words) // 4 * (size + 1))
        out[0 :: size + 1] = bytes([0o200 + size - 1]) * (len(words) // 4)
        for i in range(size):
            out[i + 1 :: size + 1] = words[4 - size + i :: 4]
        return b"[" + bytes(out) + b"]"

    @staticmethod
    def _size(least: int, most: int) -> int:
        return next(n for n in (1, 2, 3, 4) if -(1 << 8 * n - 1) <= least and most < 1 << 8 * n - 1)

    @staticmethod
    def _counted(code: int, count: int) -> bytes:
        size = max(1, (count.bit_length() + 7) // 8)
        return bytes([code + size - 1]) + count.to_bytes(size, "big")


def _big_endian(values: array) -> bytes:
    import sys

    if sys.byteorder == "little":
        values.byteswap()
    return values.tobytes()
