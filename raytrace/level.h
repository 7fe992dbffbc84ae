// How finely a ray sees surfaces that have several levels (docs/decisions/0036-geometry-cache.md).
#pragma once
#include <cstdint>

namespace tomales {

/// Polygons of about one pixel (x sqrt(ShadingRate)), of three, and of raytrace/coarse_rate.h.
enum class Level : uint8_t { Fine, Medium, Coarse };
constexpr int kLevelsInChunks = 2;  ///< The finer ones, made where rays come; coarse polygons are always there.

}  // namespace tomales
