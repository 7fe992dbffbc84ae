// The layers of a picture, for browsers: half floats, and which parts of them are newer than what a page has. Threads:
// any.
#pragma once
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <span>

#include "reyes/image.h"

namespace tomales {

/// A block begins with kBlockHeader numbers of 32 bits (little endian): layer, x, y, width, height, version, serial,
/// step. Red, green and blue follow as half floats, row by row, and zeros up to a multiple of four bytes. There is one
/// colour for each square of `step` pixels, cut off at the right and below.
constexpr size_t kBlockHeader = 8;

/// The step of a coarse picture, which has one colour for each square of this many pixels along an edge.
constexpr int kCoarseStep = 16;

class LayerStore {
 public:
  /// window: the pixels of the picture. Blocks count from its first pixel.
  LayerStore(const PixelRect& window, size_t layers);

  /// Sets a part of a layer. `rgb`: the floats of its pixels; values beyond half floats become the nearest half float.
  void put(size_t layer, const PixelRect& part, std::span<const vec3> rgb, uint32_t version);
  /// Sets a coarse picture of a whole layer, by rows. All that was put before is to be forgotten.
  void putCoarse(size_t layer, std::span<const vec3> rgb, uint32_t version);
  void dropCoarse(size_t layer);

  /// Returns all that was set after block number `after`, oldest first, and sets `after` to the last block. A part that
  /// was set several times comes once. If that is more than about `bytes`, each square of several pixels is reduced to
  /// its mean.
  std::string reducedAfter(uint64_t& after, size_t bytes) const;
  /// Returns the same at full size, but no more than about `bytes` of it, none after block `last`, and no coarse
  /// picture.
  std::string blocksAfter(uint64_t& after, size_t bytes, uint64_t last) const;
  uint64_t newest() const;  ///< The number of the last block.
  /// Waits until there is a block after this one, or wake() has been called more than `told` times, but not for long.
  void wait(uint64_t after, uint64_t told) const;
  /// Call this when there is something else to tell.
  void wake() const;
  uint64_t woken() const;  ///< Returns how often wake() has been called.
  /// Returns the colour of a layer at a pixel, by its raster coordinates; black if it has not been put.
  vec3 at(size_t layer, int x, int y) const;
  int64_t bytes() const;

 private:
  struct Block {
    uint32_t layer, version;
    PixelRect part;
    uint64_t serial;
    bool coarse;
  };
  auto firstAfter(uint64_t serial) const { return std::ranges::upper_bound(blocks_, serial, {}, &Block::serial); }
  void append(const Block& block, int step, std::string& out) const;
  void add(size_t layer, const PixelRect& part, uint32_t version, bool coarse);

  const PixelRect window_;
  mutable std::mutex mutex_;
  mutable std::condition_variable changed_;
  std::vector<std::vector<uint16_t>> layers_;  ///< Three numbers for each pixel; empty until the first put().
  std::vector<std::vector<uint16_t>> coarse_;
  std::vector<Block> blocks_;  ///< Sorted by serial number.
  uint64_t serial_ = 0;
  mutable uint64_t woken_ = 0;
};

}  // namespace tomales
