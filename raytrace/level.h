// The fineness at which a ray sees surfaces that have several levels of detail (docs/decisions/0036-geometry-cache.md).
#pragma once
#include <cstdint>

namespace tomales {

/// Polygons of about one pixel (times sqrt(ShadingRate)), of three pixels, and those of raytrace/coarse_rate.h.
enum class TessellationLevel : uint8_t { Fine, Medium, Coarse };
/// The finer levels, which are made where rays come; coarse polygons are always there.
constexpr int kLevelsInChunks = 2;

}  // namespace tomales
