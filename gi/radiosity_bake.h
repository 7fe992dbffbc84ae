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

/// Charts of an object's patches, of which nothing is known yet.
std::vector<RadiosityChart> layOutCharts(const Scene& scene, const Camera& camera, int object, float texels);
/// Shades some of their texels, one side of them.
void bakeTexels(const RadiosityBake& bake, int object, bool back, std::span<RadiosityChart> charts, const TexelRun& run);

}  // namespace tomales
