// What transparent micropolygons cover, before it is known what hides it. Private to the hider.
#pragma once
#include <bit>
#include <cstdint>
#include <vector>

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
  std::vector<float> depths;

  void clear() { list.clear(), depths.clear(); }

  /// Samples arrive in order of their lanes.
  void add(uint32_t pixel, uint32_t cell, uint32_t lane, float depth) {
    const bool joins = !list.empty() && list.back().pixel == pixel && list.back().cell == cell && list.back().word == lane / 64;
    if (!joins) list.push_back({pixel, cell, static_cast<uint32_t>(depths.size()), lane / 64, 0});
    list.back().samples |= uint64_t{1} << (lane % 64);
    depths.push_back(depth);
  }
};

}  // namespace tomales
