// Noun: a brick map (irradiance-atlas 3): a tiled 3D MIP map of data on surfaces or in volumes, on disk, of which the octree is in
// memory and bricks come through a cache.
// Space: that of the points it was made from (world). Threads: const members may be called concurrently.
#pragma once
#include <optional>
#include <string>

#include "gi/brick_build.h"
#include "gi/brick_cache.h"
#include "reyes/base/chunk_file.h"

namespace tomales {

class BrickMap {
 public:
  /// Throws FileError. The cache must outlive the map.
  BrickMap(const std::string& path, BrickCache& cache);

  const std::vector<CloudChannel>& channels() const { return channels_; }
  int width() const { return width_; }  ///< Floats of one lookup.
  const BrickTree& tree() const { return tree_; }
  const std::string& path() const { return file_.path(); }
  const MadeFrom& madeFrom() const { return madeFrom_; }
  uint64_t fileBytes() const { return file_.fileBytes(); }

  /// Data around P on surfaces that face as N does (N zero: whatever they face), averaged over a cube of half width `radius`:
  /// linear between voxels and between levels (3.3). Where the finest voxels there are empty, coarser ones answer. False: there
  /// is nothing near, and `out` (width() floats) is zero. Throws FileError where the file is damaged.
  bool lookup(const vec3& P, const vec3& N, float radius, float* out) const;

  Brick brick(int32_t node) const;  ///< From the file, past the cache.

 private:
  struct Sum;
  void addLevel(int level, const vec3& P, const vec3& N, float halfWidth, float weight, Sum& sum) const;
  void addVoxel(int level, const glm::ivec3& voxel, const vec3& N, float weight, Sum& sum, int depth) const;
  void find(int level, const glm::ivec3& voxel, Sum& sum) const;
  BrickPtr cached(int32_t node) const;

  ChunkReader file_;
  BrickCache& cache_;
  uint32_t id_;
  std::vector<CloudChannel> channels_;
  int width_ = 0;
  BrickTree tree_;
  MadeFrom madeFrom_;
};

/// Makes FILE.bkm of a cloud. Throws FileError.
BuiltBricks writeBrickMap(const PointCloud& cloud, const BrickSettings& settings, const std::string& path, const MadeFrom& madeFrom = {});

}  // namespace tomales
