// What transparent micropolygons cover, before it is known what hides it. Private to the hider.
#pragma once
#include <algorithm>
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
  float nearest, farthest;  ///< Of the depth keys.
};

/// Grows in memory that its thread keeps from bucket to bucket, up to some size: one bucket of very many layers is no reason to hold as much for
/// the rest of the frame.
struct Films {
  Films() { list.swap(spare().list), depths.swap(spare().depths); }
  ~Films() {
    list.clear();
    if (worthKeeping(list, spare().list)) list.swap(spare().list);
    if (worthKeeping(depths, spare().depths)) depths.swap(spare().depths);
  }
  Films(const Films&) = delete;

  std::vector<Film> list;
  std::vector<float> depths;  ///< The first `depthCount` are in use.
  size_t depthCount = 0;

  /// Where the depths of the next samples go; there is room for a vector of them.
  float* next() {
    if (depths.size() < depthCount + kLanes) depths.resize(2 * depths.size() + kLanes);
    return depths.data() + depthCount;
  }
  /// Notes samples, as bits of a word of the pixel, whose depths are at next(). A cell's samples arrive in order.
  void add(uint32_t pixel, uint32_t cell, uint32_t word, uint64_t samples, float nearest, float farthest) {
    const auto first = static_cast<uint32_t>(depthCount);
    depthCount += static_cast<size_t>(std::popcount(samples));
    if (!list.empty() && list.back().pixel == pixel && list.back().cell == cell && list.back().word == word) {
      Film& film = list.back();
      film.samples |= samples, film.nearest = std::min(film.nearest, nearest), film.farthest = std::max(film.farthest, farthest);
      return;
    }
    // In place: a copy would wait for its parts to be written.
    Film& film = list.emplace_back();
    film.pixel = pixel, film.cell = cell, film.firstDepth = first, film.word = word, film.samples = samples;
    film.nearest = nearest, film.farthest = farthest;
  }

 private:
  static constexpr size_t kMostKept_bytes = size_t{32} << 20;
  template <class T>
  static bool worthKeeping(const std::vector<T>& mine, const std::vector<T>& kept) {
    return mine.capacity() > kept.capacity() && mine.capacity() * sizeof(T) <= kMostKept_bytes;
  }
  struct Spare {
    std::vector<Film> list;
    std::vector<float> depths;
  };
  static Spare& spare() {
    static thread_local Spare ofThread;
    return ofThread;
  }
};

}  // namespace tomales
