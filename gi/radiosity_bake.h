// Private to gi: the charts of radiosity maps, texel by texel.
#pragma once
#include <span>

#include "gi/radiosity_maps.h"

namespace tomales {

struct RadiosityBake {
  const RayScene& rays;
  const ShadingSystem& shading;
  const RadiositySettings settings;
};

/// The chart of a patch, without its texels yet.
RadiosityChart chartOf(const Scene& scene, const Camera& camera, int object, uint32_t patch, float texels);
/// Shades some of their texels, one side of them.
void bakeTexels(const RadiosityBake& bake, int object, bool back, std::span<RadiosityChart> charts, const TexelRun& run);

}  // namespace tomales
