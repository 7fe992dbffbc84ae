// The samples of a picture that an audit looks at: pixels at random, each by one of its samples, with all that this
// sample sees.
#pragma once
#include <atomic>

#include "reyes/deep.h"
#include "reyes/shade.h"

namespace tomales {

struct AuditSample {
  struct Layer {
    ShadePoints point;  ///< One point.
    bool matte;         ///< The same as Facet::matte.
  };
  uint32_t order;             ///< Samples of the least order are taken.
  int x, y;                   ///< The pixel.
  std::vector<Layer> layers;  ///< What the sample sees, nearest first.
};

/// Chooses at most `count` samples of the pixels of layout.crop that see a surface, in the order of pixels. The choice
/// depends on the seed and on what the pixels see, never on threads or buckets.
std::vector<AuditSample> chooseSamples(const DeepFrame& layout, const TileReader& tiles, size_t count, uint32_t seed,
                                       const std::atomic<bool>& cancelled);

/// Shades the samples and composites the layers of each.
std::vector<vec3> shadeSamples(const std::vector<AuditSample>& samples, const Scene& scene,
                               const ShadingSystem& shading, const ShadeContext& context);

}  // namespace tomales
