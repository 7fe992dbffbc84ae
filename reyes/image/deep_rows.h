// Private to reyes/image: deep pixels.
#pragma once
#include <span>

#include "reyes/image/weights.h"

namespace tomales {

/// One layer of some samples of one pixel.
struct Layer {
  uint64_t samples;
  uint16_t word;
  int group;  ///< Index in Scene::groups.
  float z;
  vec3 color, coverage;  ///< Multiplied by the share of light that passes the layers before.
};

/// The layers of the pixels of some rows; those of pixel i are [first[i], first[i + 1]).
struct LayeredRows {
  PixelRect rect;
  std::vector<Layer> layers;
  std::vector<size_t> first{0};

  std::span<const Layer> at(const ivec2& p) const {
    const size_t i =
        static_cast<size_t>(p.y - rect.y0) * static_cast<size_t>(rect.width()) + static_cast<size_t>(p.x - rect.x0);
    return {layers.data() + first[i], first[i + 1] - first[i]};
  }
};
/// Returns the layers of rows [y0, y1), as far as the frame has samples.
LayeredRows layersOf(const DeepFrame& frame, const Options& options, int y0, int y1);

/// Returns the PixelFilter of the options; a box of one pixel replaces a filter with negative lobes.
PixelFilter positiveFilter(const Options& options);

/// Returns deep samples R G B A Z ZBack (AR AG AB Z ZBack) for every pixel of some rows of the crop window. Flattened
/// by "over" they give the filtered pixel. The opacity in front of any depth is right but for merging, which moves
/// depths by up to the share `depth` of their distance, or changes opacity by up to `opacity`. A box of one pixel
/// replaces a filter with negative lobes, because transmitted light cannot grow.
DeepRows deepRows(const DeepFrame& frame, const Options& options, const SampleOffsets& samples, const DeepMerge& merge,
                  int y0, int y1);

}  // namespace tomales
