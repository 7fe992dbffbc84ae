// Surfaces that rays see at several levels of detail, at all but the coarse level. Patches are cut into tiles; near
// tiles of one level form a chunk, diced when a ray first comes there (docs/decisions/0036-geometry-cache.md). The
// coarse polygons are those of raytrace/tessellate.h. Patches belong here where Attribute "trace" "tessellationmode"
// asks for it. Patches that move, emit, are trimmed or belong to a solid stay out, and so do flat ones without
// displacement, which are exact as they are. Space: current. Threads: const members may be called concurrently.
#pragma once
#include <array>

#include "raytrace/coarse_rate.h"
#include "raytrace/level.h"
#include "reyes/shade.h"

namespace tomales {

/// A rectangle of one patch. All levels have the same rectangles, and neighbours share their edges.
struct PatchTile {
  int object;
  uint32_t patch;
  UvRect rect;
  CoarseRate rate;
};

struct Chunk {
  uint32_t group;
  TessellationLevel level;
  Bound3 bound;  ///< Holds the vertices of all levels, so it may be larger than this level needs.
  std::vector<PatchTile> tiles;
};

/// Lattices of the tiles of a chunk, with rows along u, one after the other.
struct ChunkMesh {
  /// At least 4 readable bytes follow the last element. A tile that is not finite is NaN.
  std::vector<vec3> P;
  std::vector<uint32_t> N;            ///< Normals on the RISpec side, packed as in reyes/base/packed_normal.h.
  std::vector<uint32_t> firstVertex;  ///< Indexed by tile.

  size_t bytes() const {
    return P.capacity() * sizeof(vec3) + (N.capacity() + firstVertex.capacity()) * sizeof(uint32_t);
  }
};

/// Tells whether this patch of the object belongs into chunks.
bool hasLevels(const Object& object, uint32_t patch, bool moves);

class Chunks {
 public:
  /// Makes the chunks of all objects that are not `elsewhere`. All arguments must outlive this. It dices samples of
  /// every level that rays see, to measure deviations.
  Chunks(const Scene& scene, const Camera& camera, const ShadingSystem& shading, const std::vector<bool>& elsewhere,
         Log& log);

  const std::vector<Chunk>& all() const { return chunks_; }
  ChunkMesh dice(size_t chunk) const;
  /// Returns the level at which a ray of this level sees a group. Coarse means that its polygons are not here.
  TessellationLevel levelOf(uint32_t group, TessellationLevel ray) const {
    return full_[group] ? TessellationLevel::Fine : ray;
  }
  bool has(uint32_t group) const { return present_[group]; }
  /// Returns the largest distance between the polygons that a ray of this level sees here and the surface that they
  /// stand for, as far as samples show; 0 if it sees none.
  float deviation(size_t group, TessellationLevel ray) const {
    const TessellationLevel level = levelOf(static_cast<uint32_t>(group), ray);
    return level == TessellationLevel::Coarse ? 0 : deviations_[group][static_cast<size_t>(level)];
  }
  /// Returns the unit normal on the RISpec side at tile parameters u, v.
  vec3 normal(const ChunkMesh& mesh, size_t chunk, uint32_t tile, float u, float v) const;
  int64_t finePolygons() const { return finePolygons_; }

 private:
  struct TiledPatch;
  TiledPatch cutIntoTiles(int object, uint32_t patch, const Camera& camera) const;
  struct Piece;
  void measure(TiledPatch& tiled, Piece& piece) const;
  void pack(const std::vector<TiledPatch>& tiled);

  const Scene& scene_;
  const ShadingSystem& shading_;
  Log& log_;
  std::vector<bool> full_;     ///< Indexed by group: true if rays of all levels see the finest.
  std::vector<bool> present_;  ///< Indexed by group: true if some chunk belongs to it.
  std::vector<Chunk> chunks_;
  std::vector<std::array<float, kLevelsInChunks>> deviations_;
  int64_t finePolygons_ = 0;
};

}  // namespace tomales
