"""Colours and numbers of materials: constants, or pictures over texture coordinates.

A value is an array of linear colours. Its shape is (3,) if it is the same everywhere, else (height, width, 3) with the
top row first. A number is a colour of three equal channels.
"""
from __future__ import annotations

import numpy

Value = numpy.ndarray

_LUMINANCE = numpy.array([0.2126, 0.7152, 0.0722], "f4")  # These are the weights of Rec. 709, by which Blender turns colours into numbers.


def constant(value: object) -> Value:
    """Returns the value of a socket's default: a number, a colour or a vector."""
    if hasattr(value, "__len__"):
        return numpy.array(list(value)[:3], "f4")  # type: ignore[call-overload]
    return numpy.full(3, value, "f4")


def gray(value: Value) -> Value:
    """Returns the number that Blender makes of a colour, in three channels."""
    if is_gray(value):
        return value
    return numpy.repeat((value @ _LUMINANCE)[..., None], 3, -1)


def is_gray(value: Value) -> bool:
    return bool((value[..., 0] == value[..., 1]).all() and (value[..., 0] == value[..., 2]).all())


def is_picture(value: Value) -> bool:
    return value.ndim == 3


def mean(value: Value) -> list[float]:
    return [float(c) for c in value.reshape(-1, 3).mean(0)]


def matched(values: list[Value]) -> list[Value]:
    """Brings all pictures to the resolution of the largest."""
    sizes = [v.shape[:2] for v in values if is_picture(v)]
    if not sizes:
        return values
    height, width = (max(size[axis] for size in sizes) for axis in (0, 1))
    return [resampled(v, height, width) if is_picture(v) else v for v in values]


def resampled(picture: Value, height: int, width: int) -> Value:
    if picture.shape[:2] == (height, width):
        return picture
    v, u = numpy.mgrid[0:height, 0:width]
    return looked_up(picture, (u + 0.5) / width, (v + 0.5) / height)


def looked_up(picture: Value, u: numpy.ndarray, v: numpy.ndarray) -> Value:
    """Interpolates linearly between pixels. The picture repeats, and v runs from the top row down."""
    height, width = picture.shape[:2]
    x, y = u * width - 0.5, v * height - 0.5
    column, row = numpy.floor(x).astype(int), numpy.floor(y).astype(int)
    right, below = (x - column)[..., None].astype("f4"), (y - row)[..., None].astype("f4")
    at = lambda dy, dx: picture[(row + dy) % height, (column + dx) % width]  # noqa: E731
    return (1 - below) * ((1 - right) * at(0, 0) + right * at(0, 1)) + below * ((1 - right) * at(1, 0) + right * at(1, 1))
