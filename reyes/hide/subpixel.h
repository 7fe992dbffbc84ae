// Private to the hider: conventions of raster space that projection, patterns and rasteriser share.
#pragma once

namespace tomales {

constexpr float kSubpixels = 1024;  ///< Lattice points along the edge of a pixel, for vertices and samples.
/// Greatest distance by which a straight border may lie outside of vertices that are snapped to the lattice.
constexpr float kLineReach_px = 1 / kSubpixels;
/// A number far below the difference of two values of an edge function, so that `value > -kTiny` means `value >= 0`.
/// Vectors can select between this number and 0, and threads that flush denormals do not lose it.
constexpr float kTiny = 1e-30f;

/// Returns the nearest lattice point. It relies on the spacing of floats between 2^13 and 2^14. The lattice is coarser
/// beyond 4096 px.
inline float snapToSubpixel(float x) { return (x + 12288.0f) - 12288.0f; }

}  // namespace tomales
