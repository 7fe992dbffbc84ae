"""Converts the arguments of a call, in any of their usual forms, into the arguments of a request in RIB."""
from __future__ import annotations

from typing import Any

from .encoding import Encoder, are_strings, flat
from .requests import Signature


class CallError(Exception):
    """A call cannot become a request. The text of the exception says why."""


def encoded(signature: Signature, arguments: list[Any], encoder: Encoder, color_samples: int = 3) -> tuple[list[bytes], dict[str, Any]]:
    """Returns pieces of RIB for the positional arguments, and the parameters that follow these as tokens and values (as
    in C: Surface("plastic", "Kd", 0.5)). Raises CallError.

    Where a request takes a fixed count of numbers, they may be bare or in lists, and lists may be nested: Rotate(30, 1,
    0, 0), Rotate(30, [1, 0, 0]).
    """
    left = list(arguments)
    out: list[bytes] = []
    for at, letter in enumerate(signature.arguments):
        if letter == "?":
            if not left:
                break
            continue
        kind = f"argument {at + 1 - signature.arguments[:at].count('?')}"
        try:
            out += _one(letter, left, encoder, color_samples)
        except (TypeError, ValueError, OverflowError) as problem:
            raise CallError(f"{kind}: {problem}") from None
    tokens, values = left[::2], left[1::2]
    if len(tokens) != len(values) or not all(isinstance(token, str) for token in tokens):
        raise CallError(f"{len(left)} arguments more than it takes")
    return out, dict(zip(tokens, values))


def _one(letter: str, left: list[Any], encoder: Encoder, color_samples: int) -> list[bytes]:
    if letter == "c":
        return _numbers(color_samples, left, encoder, True)
    if letter.isdigit() or letter == "m":
        return _numbers(16, left, encoder, True) if letter == "m" else _numbers(int(letter), left, encoder)
    if letter == "b":
        return [encoder.string(left.pop(0))] if left and isinstance(left[0], str) else _numbers(16, left, encoder, True)
    if not left:
        raise ValueError("is missing")
    if letter in "FIS":
        return [encoder.array(_array(letter, left))]
    values = flat(left.pop(0))
    if len(values) != 1:
        raise ValueError(f"one value is needed, not {len(values)}")
    value = values[0]
    if letter == "h" and str(value).isdigit():
        value = int(value)  # The handles of RISpec 3.2 are numbers.
    if isinstance(value, str):
        if letter in "fi":
            raise ValueError(f'a number is needed, not "{value}"')
        return [encoder.string(value)]
    if letter == "s":
        raise ValueError(f"a string is needed, not {value}")
    if letter == "i" and value != int(value):
        raise ValueError(f"an integer is needed, not {value}")
    return [encoder.number(int(value) if letter in "ih" else value)]


def _array(letter: str, left: list[Any]) -> Any:
    """Takes one sequence, or all values if they are bare, as in MotionBegin(0, 1)."""
    bare = [left.pop(0)]
    while isinstance(bare[0], (int, float)) and left and isinstance(left[0], (int, float)):
        bare.append(left.pop(0))
    values = flat(bare[0] if len(bare) == 1 else bare)
    if len(values) and are_strings(values) != (letter == "S"):
        raise ValueError("strings are needed, not numbers" if letter == "S" else "numbers are needed, not strings")
    if letter != "I":
        return values
    if hasattr(values, "dtype"):
        whole = values.astype("i8")
        if not (whole == values).all():
            raise ValueError("integers are needed")
        return whole
    if set(map(type, values)) <= {int}:
        return values
    if any(v != int(v) for v in values):
        raise ValueError("integers are needed")
    return [int(v) for v in values]


def _numbers(count: int, left: list[Any], encoder: Encoder, bracketed: bool = False) -> list[bytes]:
    """Returns numbers in brackets if the caller gave them as one list, or if `bracketed`."""
    values: list[Any] = []
    bracketed = bracketed or (bool(left) and not isinstance(left[0], (int, float, str)) and len(flat(left[0])) == count > 1)
    while len(values) < count:
        if not left:
            raise ValueError(f"number {len(values) + 1} of {count} is missing")
        part = flat(left.pop(0))
        if len(part) and are_strings(part):
            raise ValueError(f'{count} numbers are needed, not "{part[0]}"')
        values += part.tolist() if hasattr(part, "tolist") else part
    if len(values) > count:
        raise ValueError(f"{count} numbers are needed, not {len(values)}")
    return [encoder.array(values)] if bracketed else [encoder.number(v) for v in values]
