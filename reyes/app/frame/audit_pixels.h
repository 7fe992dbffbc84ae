// The pixels that an audit looks at: a random choice, each with everything that its samples see.
#pragma once
#include <span>

#include "reyes/base/stop.h"
#include "reyes/deep.h"
#include "reyes/shade.h"

namespace tomales {

struct AuditPixel {
  uint32_t order;  ///< The pixels with the lowest order are chosen.
  int x, y;
  DeepTile tile;  ///< The pixel alone.
};

/// The mean of the samples of a pixel, before exposure and imager, and the standard error of that mean if the samples
/// are taken as independent (AuditReport::pixelSamples says what that is worth).
struct SampledColor {
  vec3 mean{0.0f}, error{0.0f};
};

/// Chooses at most `count` pixels of layout.crop that see a surface, and returns them by rows. The choice depends on
/// the seed and on what the pixels see, never on threads or buckets.
std::vector<AuditPixel> chooseAuditPixels(const DeepFrame& layout, const TileReader& tiles, size_t count, uint32_t seed,
                                          StopToken stop);

std::vector<SampledColor> shadeAuditPixels(const std::vector<AuditPixel>& pixels, int samplesPerPixel,
                                           const Scene& scene, const ShadingSystem& shading,
                                           const ShadeContext& context);

/// Copies what these pixels of a tile need. The copy's rectangle is `rect`, whose other pixels see nothing.
DeepTile copyPixels(const DeepTile& from, const PixelRect& rect, std::span<const ivec2> pixels);
/// Returns the number of points that shading the tile runs over.
double pointsOf(const DeepTile& tile);
/// Returns the colour of a pixel of a tile that is shaded.
SampledColor colorOf(const DeepTile& tile, const ivec2& pixel, int samplesPerPixel);

}  // namespace tomales
