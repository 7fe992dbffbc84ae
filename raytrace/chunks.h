// Surfaces that rays see at several levels, at all but the coarse one: tiles of patches, near ones of one level
// together in chunks, which are diced when a ray first comes there (docs/decisions/0036-geometry-cache.md). Coarse
// polygons are those of raytrace/tessellate.h. What stands still, is no light, no part of a solid and not trimmed,
// where Attribute "trace" "tessellationmode" asks for it; flat patches without displacement are exact as they are and
// stay out. Space: current. Threads: const members may be called concurrently.
#pragma once
#include <array>

#include "raytrace/coarse_rate.h"
#include "raytrace/level.h"
#include "reyes/shade.h"

namespace tomales {

/// A rectangle of one patch, cut alike at every level by its neighbours in the patch.
struct Tile {
  int object;
  uint32_t patch;
  UvRect rect;
  CoarseRate rate;
};

struct Chunk {
  uint32_t group;
  Level level;
  Bound3 bound;  ///< No tighter than that of all levels.
  std::vector<Tile> tiles;
};

/// Lattices of the tiles of a chunk, rows along u, one behind the other.
struct ChunkMesh {
  std::vector<vec3> P;      ///< Behind the last lie at least 4 more readable bytes. A tile that is not finite is NaN.
  std::vector<uint32_t> N;  ///< RISpec side; reyes/base/packed_normal.h
  std::vector<uint32_t> firstVertex;  ///< Of each tile.

  size_t bytes() const {
    return P.capacity() * sizeof(vec3) + (N.capacity() + firstVertex.capacity()) * sizeof(uint32_t);
  }
};

/// Does this patch of the object belong into chunks?
bool hasLevels(const Object& object, uint32_t patch, bool moves);

class Chunks {
 public:
  /// Leaves out objects that are `elsewhere`. All must outlive this. Dices some of every level that rays see to learn
  /// how far it is off.
  Chunks(const Scene& scene, const Camera& camera, const ShadingSystem& shading, const std::vector<bool>& elsewhere,
         Log& log);

  const std::vector<Chunk>& all() const { return chunks_; }
  ChunkMesh dice(size_t chunk) const;
  /// The level at which a ray of this level sees a group; coarse: not here.
  Level levelOf(uint32_t group, Level ray) const { return full_[group] ? Level::Fine : ray; }
  bool has(uint32_t group) const { return present_[group]; }
  /// Largest distance between polygons that a ray of this level sees here and what they stand for, as far as a part of
  /// them tells; 0 if it sees none.
  float deviation(size_t group, Level ray) const {
    const Level level = levelOf(static_cast<uint32_t>(group), ray);
    return level == Level::Coarse ? 0 : deviations_[group][static_cast<size_t>(level)];
  }
  /// Unit normal, RISpec side, where tile parameters u, v lead.
  vec3 normal(const ChunkMesh& mesh, size_t chunk, uint32_t tile, float u, float v) const;
  int64_t finePolygons() const { return finePolygons_; }

 private:
  struct Planned;
  Planned plan(int object, uint32_t patch, const Camera& camera) const;
  struct Piece;
  void measure(Planned& planned, Piece& piece) const;
  void pack(const std::vector<Planned>& planned);

  const Scene& scene_;
  const ShadingSystem& shading_;
  Log& log_;
  std::vector<bool> full_;     ///< Of each group: rays of all levels see the finest.
  std::vector<bool> present_;  ///< Of each group: some chunk belongs to it.
  std::vector<Chunk> chunks_;
  std::vector<std::array<float, kLevelsInChunks>> deviations_;
  int64_t finePolygons_ = 0;
};

}  // namespace tomales
