// Private to gi: what surfaces send back of direct light, texel by texel.
#pragma once
#include "gi/radiosity_layout.h"

namespace tomales {

struct RadiosityBake {
  const RayScene& rays;
  const ShadingSystem& shading;
  const RadiositySettings settings;
};

struct BakedTexel {
  vec3 radiance{0.0f};  ///< The mean of its known part.
  float coverage = 0;   ///< Share that is known: not trimmed away.
};

/// Shades the texels of a run, one after the other. `charts`: of its object and side.
std::vector<BakedTexel> bakeTexels(const RadiosityBake& bake, std::span<const RadiosityChart> charts,
                                   const TexelRun& run);

/// Texel t of a chart as a quadrilateral in (u, v).
struct TexelSquare {
  vec2 corner, size;
};
TexelSquare texelSquare(const RadiosityChart& chart, size_t t);

}  // namespace tomales
