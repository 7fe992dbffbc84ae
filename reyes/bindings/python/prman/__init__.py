"""The module that scripts for RenderMan import, over Tomales: `import prman; ri = prman.Ri()`."""
from tomales.ri import Ri, RiError
from tomales.tokens import *  # noqa: F403  RI_NAME
from tomales.program import Cleanup, Init

RI = Ri
__all__ = ["Cleanup", "Init", "RI", "Ri", "RiError"]
