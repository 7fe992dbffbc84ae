"""Tomales, a Reyes renderer, from Python.

`Ri` describes scenes, as the module prman does for RenderMan. Functions such as `render` run the renderer. `read`
returns pictures as numpy arrays. docs/python.md in the source tree has examples.
"""
from . import tokens
from .commands import CommandFailed, Result, chart, compare, gather, hide, info, options, photons, render, run, shade
from .pictures import Picture, read
from .program import RendererNotFound
from .ri import Ri, RiError

__all__ = [
    "CommandFailed", "Picture", "RendererNotFound", "Result", "Ri", "RiError", "chart", "compare", "gather", "hide", "info",
    "options", "photons", "read", "render", "run", "shade", "tokens",
]  # fmt: skip
