// Verb: lookups in a brick map (irradiance-atlas 3.3), of which the octree is in memory and bricks come through a cache.
// Space: that of the points it was made from (world). Threads: const members may be called concurrently.
#pragma once
#include <optional>

#include "gi/brick_build.h"
#include "gi/brick_cache.h"
#include "gi/brick_file.h"

namespace tomales {

class BrickMap {
 public:
  /// Throws FileError. The cache must outlive the map.
  BrickMap(const std::string& path, BrickCache& cache) : file_(path), cache_(cache), id_(cache.addMap()) {}

  const BrickFile& file() const { return file_; }
  int width() const { return file_.width(); }  ///< Floats of one lookup.

  /// Data around P on surfaces that face as N does (N zero: whatever they face), averaged over a cube of half width `radius`:
  /// linear between voxels and between levels (3.3). Where the finest voxels there are empty, coarser ones answer. False: there
  /// is nothing near, and `out` (width() floats) is zero. Throws FileError where the file is damaged.
  bool lookup(const vec3& P, const vec3& N, float radius, float* out) const;

 private:
  struct Sum;
  void addLevel(int level, const vec3& P, const vec3& N, float halfWidth, float weight, Sum& sum) const;
  void addVoxel(int level, const glm::ivec3& voxel, const vec3& N, float weight, Sum& sum, int depth) const;
  BrickPtr cached(int32_t node) const;
  const BrickTree& tree() const { return file_.tree(); }

  BrickFile file_;
  BrickCache& cache_;
  uint32_t id_;
};

/// Makes FILE.bkm of a cloud. Throws FileError.
BuiltBricks writeBrickMap(const PointCloud& cloud, const BrickSettings& settings, const std::string& path);

}  // namespace tomales
