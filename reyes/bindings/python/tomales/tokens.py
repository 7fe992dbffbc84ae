"""Names and constants of the RenderMan Interface (RISpec 3.2, appendix A), as attributes of Ri and as RI_NAME here."""
from __future__ import annotations

#: The value of each constant is its name in small letters.
_SMALL = """
    framebuffer file rgb rgba rgbz rgbaz perspective orthographic hidden paint raytrace constant smooth flatness fov
    ambientlight pointlight distantlight spotlight intensity lightcolor from to coneangle conedeltaangle
    beamdistribution matte metal plastic shinymetal paintedplastic roughness texturename specularcolor depthcue fog
    bumpy mindistance maxdistance background distance amplitude raster screen camera current world object shader eye
    inside outside lh rh bilinear bicubic loop linear cubic primitive intersection union difference periodic
    nonperiodic clamp black ignore print abort handler origin identifier name comment structure verbatim width
    constantwidth hole crease corner interpolateboundary facevaryinginterpolateboundary gaussian box triangle sinc
    coordinatesystem shadinggroup sphere archive texture procedural stochastic""".split()

_OTHER: dict[str, str] = {
    **{name: name for name in ("P", "Pz", "Pw", "N", "Np", "Ng", "Cs", "Os", "Ci", "Oi", "Ka", "Kd", "Ks", "Kr")},
    "A": "a", "Z": "z", "AZ": "az", "S": "s", "T": "t", "ST": "st", "U": "u", "V": "v", "NDC": "NDC",
    "HANDLEID": "__handleid", "RENDER": "__render",
    "CATMULLCLARK": "catmull-clark", "CATMULLROM": "catmull-rom", "INTERPBOUNDARY": "interpolateboundary",
    "BezierBasis": "bezier", "BSplineBasis": "b-spline", "CatmullRomBasis": "catmull-rom", "HermiteBasis": "hermite",
    "PowerBasis": "power",
    "BoxFilter": "box", "TriangleFilter": "triangle", "CatmullRomFilter": "catmull-rom", "GaussianFilter": "gaussian",
    "SincFilter": "sinc", "MitchellFilter": "mitchell", "BlackmanHarrisFilter": "blackman-harris",
    "LanczosFilter": "lanczos", "BesselFilter": "bessel", "DiskFilter": "disk",
    "SeparableCatmullRomFilter": "separable-catmull-rom",
    "ErrorIgnore": "ignore", "ErrorPrint": "print", "ErrorAbort": "abort",
    "ProcDelayedReadArchive": "DelayedReadArchive", "ProcRunProgram": "RunProgram", "ProcDynamicLoad": "DynamicLoad",
    "Proc2DelayedReadArchive": "DelayedReadArchive2", "Proc2RunProgram": "RunProgram2",
    "Proc2DynamicLoad": "DynamicLoad2", "SimpleBound": "SimpleBound", "DSOBound": "DSOBound",
    #: The interface of RenderMan that these calls follow. Scripts ask for it to choose among spellings.
    "PRMAN_VERSION_STR": "24.0",
}  # fmt: skip

_NUMBERS: dict[str, float] = {
    "TRUE": 1, "FALSE": 0, "INFINITY": 1.0e38, "EPSILON": 1.0e-10,
    "BEZIERSTEP": 3, "BSPLINESTEP": 1, "CATMULLROMSTEP": 1, "HERMITESTEP": 2, "POWERSTEP": 4,
}  # fmt: skip


def _constant(name: str) -> str:
    """Returns the usual spelling. It is all in capitals, except for constants that are functions in C."""
    return name if name.endswith(("Basis", "Filter", "Bound")) or name.startswith(("Error", "Proc")) else name.upper()


TOKENS: dict[str, str | float | None] = {
    **{name.upper(): name for name in _SMALL},
    **{_constant(name): value for name, value in _OTHER.items()},
    **_NUMBERS,
    "NULL": None,
}

globals().update({f"RI_{name}": value for name, value in TOKENS.items()})
