// Noun: the deep frame buffer. For every bucket, the micropolygons that some sample sees, as points to shade, and the
// fragments of every pixel. Gathering and shading read it as often as they like; no geometry is needed any more.
//
//   DeepFrame 1--* DeepTile 1--* ShadePoints (one batch for each shade group)
//                           1--* DeepPixel 1--* Fragment --> Facet --> shade point(s)
#pragma once
#include <array>
#include <functional>
#include <memory>

#include "reyes/points.h"
#include "reyes/ray_answers.h"
#include "reyes/scene.h"

namespace tomales {

/// One visible micropolygon. With constant shading all four points are the same, shaded at its centre. With smooth
/// shading they are its corners, in the order (0,0) (1,0) (0,1) (1,1) of its own (u,v).
struct Facet {
  int batch;  ///< Index in DeepTile::batches.
  int point[4];
  /// True if Attributes::matte is set: the facet hides what is behind it and leaves no colour and no alpha.
  bool matte = false;
  float edge = 0;  ///< Edge length kept by DeepTile::forgetPoints(); read it by edgeOf().
};

/// The samples of one pixel that see one facet.
struct Fragment {
  uint32_t facet;    ///< Index in DeepTile::facets.
  float z;           ///< Camera-space depth of the nearest of its samples.
  uint64_t samples;  ///< Bit s is set if sample 64 * word + s of the pixel sees the facet.
  uint16_t word = 0;
  uint8_t u = 0, v = 0;  ///< Mean position of its samples on the facet, as setPosition() keeps it; for smooth shading.

  /// Keeps a position on the facet, 0..1 each way, as the 256th part of its side that it is in.
  void setPosition(const vec2& position) {
    const ivec2 part = glm::min(ivec2(256.0f * position), ivec2(255));
    u = static_cast<uint8_t>(part.x);
    v = static_cast<uint8_t>(part.y);
  }
  /// Returns the weights of a facet's four points in the middle of that part. They are exact in floats and sum to 1
  /// exactly, so that a facet that is opaque at all corners is opaque between them.
  std::array<float, 4> cornerWeights() const {
    const vec2 at = (vec2(u, v) + 0.5f) / 256.0f, rest = 1.0f - at;
    return {rest.x * rest.y, at.x * rest.y, rest.x * at.y, at.x * at.y};
  }
};

struct DeepPixel {
  uint32_t first = 0, count = 0;  ///< Range in DeepTile::fragments, nearest first.
};

struct DeepTile {
  PixelRect rect;  ///< Pixels of the padded frame (crop plus filter margin).
  std::vector<ShadePoints> batches;
  std::vector<Facet> facets;
  std::vector<Fragment> fragments;
  std::vector<DeepPixel> pixels;     ///< rect.width() * rect.height(), rows from the top.
  std::vector<ShadedPoints> shaded;  ///< Filled by the shade pass, one for each batch.
  std::vector<RayAnswers> answers;   ///< Answers of an earlier shade pass, one for each batch; or empty.

  const DeepPixel& pixel(int x, int y) const {
    return pixels[static_cast<size_t>((y - rect.y0) * rect.width() + (x - rect.x0))];
  }
  /// Returns the length of the facet's longer edge, in current space.
  float edgeOf(const Facet& facet) const {
    const ShadePoints& batch = batches[static_cast<size_t>(facet.batch)];
    return batch.count() > 0 ? batch.edgeLength(facet.point[0]) : facet.edge;
  }
  size_t bytes() const;
  /// Frees memory that growing reserved beyond need.
  void shrink();
  /// Drops the points of a shaded tile and keeps the rest, which filtering needs.
  void forgetPoints();
};

/// Returns a copy of a shaded tile as forgetPoints() leaves it.
DeepTile withoutPoints(const DeepTile& tile);

/// The most tiles that a frame may have, which 32768 x 32768 pixels in buckets of 8 x 8 reach.
constexpr int64_t kMostTiles = int64_t{1} << 24;

struct DeepFrame {
  PixelRect crop;    ///< Pixels to write.
  PixelRect padded;  ///< Pixels that have samples: crop grown by the filter's reach.
  int bucketWidth = 32, bucketHeight = 32, columns = 0, rows = 0;
  int samplesPerPixel = 1;
  bool complete = true;  ///< False if the frame was interrupted, so that some tiles are empty.
  /// Tiles of some rows of buckets, from the top: all of them, a band that moves down the frame, or none.
  std::vector<DeepTile> tiles;
  int firstRow = 0;  ///< Row of the first of `tiles`.

  /// Tiles are numbered by rows from the top, whether they are in memory or not.
  size_t tileCount() const { return static_cast<size_t>(columns) * static_cast<size_t>(rows); }
  PixelRect rectOf(size_t tile) const;
  int rowOf(int y) const { return (y - padded.y0) / bucketHeight; }
  /// Returns the tile of a pixel of `padded`.
  size_t tileOf(int x, int y) const { return static_cast<size_t>(rowOf(y) * columns + (x - padded.x0) / bucketWidth); }
  /// Keeps rows [first, last) of buckets in memory; tiles that were in memory stay, others are empty.
  void hold(int first, int last);
  void holdAll() { hold(0, rows); }
  DeepTile& tile(size_t index) { return tiles[index - firstHeld()]; }
  const DeepTile& tileAt(int x, int y) const { return tiles[tileOf(x, y) - firstHeld()]; }

 private:
  size_t firstHeld() const { return static_cast<size_t>(firstRow) * static_cast<size_t>(columns); }
};

/// Reads the tiles of a frame, in memory or in a file. It may be called from any thread, and returns null for a tile
/// that has not been hidden.
using TileReader = std::function<std::shared_ptr<const DeepTile>(size_t tile)>;
/// Reads from a frame that holds all tiles; it must outlive the reader.
TileReader readerOf(const DeepFrame& frame);

}  // namespace tomales
