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

/// Sizes of the charts of an object's patches; no texels yet.
std::vector<RadiosityChart> layOutCharts(const Scene& scene, const Camera& camera, int object, float texels);
/// Shades some of them, of patches from `first` on.
void bakeCharts(const RadiosityBake& bake, int object, uint32_t first, bool back, std::span<RadiosityChart> charts);

}  // namespace tomales
