// Private to gi: computes the radiosity by direct light, texel by texel.
#pragma once
#include "gi/radiosity/layout.h"

namespace tomales {

struct RadiosityBake {
  const RayScene& rays;
  const ShadingSystem& shading;
  const RadiositySettings settings;
};

struct BakedTexel {
  vec3 radiance{0.0f};  ///< Mean of the known part.
  float coverage = 0;   ///< Share that is known: not trimmed away.
};

/// Shades the texels of a run in their order. `charts`: those of the run's object and side.
std::vector<BakedTexel> bakeTexels(const RadiosityBake& bake, std::span<const RadiosityChart> charts,
                                   const TexelRun& run);

/// The rectangle of texel t of a chart in (u, v).
struct TexelSquare {
  vec2 corner, size;
};
TexelSquare texelSquare(const RadiosityChart& chart, size_t t);

}  // namespace tomales
