// The pixels of a picture that an audit looks at: some at random, each with all that its samples see.
#pragma once
#include <atomic>

#include "reyes/deep.h"
#include "reyes/shade.h"

namespace tomales {

struct AuditPixel {
  uint32_t order;  ///< Pixels of the least order are taken.
  int x, y;
  DeepTile tile;  ///< The pixel alone.
};

/// Chooses at most `count` pixels of layout.crop that see a surface, and returns them by rows. The choice depends on
/// the seed and on what the pixels see, never on threads or buckets.
std::vector<AuditPixel> chooseAuditPixels(const DeepFrame& layout, const TileReader& tiles, size_t count, uint32_t seed,
                                          const std::atomic<bool>& cancelled);

/// Shades the pixels and returns the mean over the samples of each, before exposure and imager.
std::vector<vec3> shadeAuditPixels(const std::vector<AuditPixel>& pixels, int samplesPerPixel, const Scene& scene,
                                   const ShadingSystem& shading, const ShadeContext& context);

}  // namespace tomales
