// Private to reyes/image: deep pixels.
#pragma once
#include <span>

#include "reyes/image/weights.h"

namespace tomales {

/// One layer of some samples of one pixel.
struct Layer {
  uint64_t samples;
  uint16_t word;
  int group;  ///< In Scene::groups.
  float z;
  vec3 color, coverage;  ///< Times the share of light that passes what lies before.
};

/// Those of the pixels of some rows; of pixel i they are [first[i], first[i + 1]).
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
/// Rows [y0, y1) as far as the frame has samples.
LayeredRows layersOf(const DeepFrame& frame, const Options& options, int y0, int y1);

/// PixelFilter; a box of one pixel instead of one with negative lobes.
PixelFilter positiveFilter(const Options& options);

/// Samples of R G B A Z ZBack (AR AG AB Z ZBack) of every pixel of rows of the crop window. Flattened by "over" they
/// are the filtered pixel; before any depth the opacity is right but for what merging moved: by `depth` of its
/// distance, or by at most `opacity`. A filter with negative lobes is replaced by a box of one pixel: light left behind
/// cannot grow.
DeepRows deepRows(const DeepFrame& frame, const Options& options, const SampleOffsets& samples, const DeepMerge& merge,
                  int y0, int y1);

}  // namespace tomales
