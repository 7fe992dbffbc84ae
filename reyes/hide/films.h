// What transparent micropolygons cover, before it is known what hides it. Private to the hider.
#pragma once
#include <bit>
#include <cstdint>
#include <vector>

#include "reyes/base/simd.h"

namespace tomales {

/// The samples of a pixel, up to 64, that one transparent micropolygon covers.
struct Film {
  uint32_t pixel, cell;
  uint32_t firstDepth;  ///< In Films::depths: one depth key a sample, lowest bit first.
  uint32_t word;        ///< Bit s of `samples` is lane 64 * word + s of the pixel.
  uint64_t samples;
};

struct Films {
  std::vector<Film> list;
  std::vector<float> depths;  ///< The first `depthCount` are in use.
  size_t depthCount = 0;

  /// Where the depths of the next samples go; there is room for a vector of them.
  float* next() {
    if (depths.size() < depthCount + kLanes) depths.resize(2 * depths.size() + kLanes);
    return depths.data() + depthCount;
  }
  /// Notes samples, as bits of a word of the pixel, whose depths are at next(). A cell's samples arrive in order.
  void add(uint32_t pixel, uint32_t cell, uint32_t word, uint64_t samples) {
    const bool joins = !list.empty() && list.back().pixel == pixel && list.back().cell == cell && list.back().word == word;
    if (!joins) list.push_back({pixel, cell, static_cast<uint32_t>(depthCount), word, 0});
    list.back().samples |= samples;
    depthCount += static_cast<size_t>(std::popcount(samples));
  }
};

}  // namespace tomales
