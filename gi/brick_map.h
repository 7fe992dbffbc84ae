// Verb: lookups in a brick map (Christensen and Batali 2004, section 3.3). The octree is in memory, and bricks come
// through a cache. Space: that of the points it was made from (world). Threads: const members may be called
// concurrently.
#pragma once
#include <memory>

#include "gi/brick_file.h"
#include "gi/bricks/build.h"
#include "gi/bricks/cache.h"

namespace tomales {

class BrickMap {
 public:
  /// Throws FileError. The cache must outlive the map.
  BrickMap(const std::string& path, BrickCache& cache)
      : file_(std::make_unique<const BrickFile>(path)), cache_(&cache), id_(cache.addMap()) {}
  /// Makes a map of a cloud that is small enough to be held whole; nothing is left out. Throws FileError.
  explicit BrickMap(const PointCloud& cloud);

  const BrickFile& file() const { return *file_; }  ///< Pre: the map was made from a file.
  const std::vector<CloudChannel>& channels() const { return file_ ? file_->channels() : channels_; }
  int width() const { return file_ ? file_->width() : width_; }  ///< Floats that one lookup returns.
  bool knows(int surface) const {
    return surface > 0 && surface <= kMostSurfaces && tree().surfaces[static_cast<size_t>(surface)];
  }

  /// Averages the data in a cube of half width `radius` around P, linearly between voxels and between levels (3.3).
  /// Only data of surfaces that face as N does count; N zero: all. Where the finest voxels are empty, coarser ones
  /// answer. Returns false where there is no data near; `out` (width() floats) is zero then.
  /// `surface`: if the map knows() it, data of other surfaces do not count. `acrossWalls`: if not null, voxels that
  /// hold light from both sides of a wall give way to finer ones, and it becomes true where even the finest hold both.
  /// Throws FileError where the file is damaged.
  bool lookup(const vec3& P, const vec3& N, float radius, float* out, int surface = 0,
              bool* acrossWalls = nullptr) const;

 private:
  struct Sum;
  void addBetween(float level, const vec3& P, const vec3& N, float radius, Sum& sum) const;
  void addLevel(int level, const vec3& P, const vec3& N, float halfWidth, float weight, Sum& sum) const;
  inline void addVoxel(int level, const glm::ivec3& voxel, const vec3& N, float weight, Sum& sum, int depth) const;
  void addLayers(int level, const glm::ivec3& voxel, const vec3& N, float weight, Sum& sum, int depth) const;
  bool addFiner(int level, const glm::ivec3& voxel, const vec3& N, float weight, Sum& sum, int depth) const;
  void find(int level, const glm::ivec3& place, Sum& sum) const;
  BrickPtr cached(int32_t node) const;
  const BrickTree& tree() const { return file_ ? file_->tree() : tree_; }

  std::unique_ptr<const BrickFile> file_;  ///< Null: the members below hold all bricks.
  BrickCache* cache_ = nullptr;
  uint32_t id_ = 0;
  std::vector<CloudChannel> channels_;
  int width_ = 0;
  BrickTree tree_;
  std::vector<BrickPtr> bricks_;
};

/// Makes FILE.bkm of a cloud in memory or on disk. Throws FileError.
BuiltBricks writeBrickMap(const PointTiles& points, const BrickSettings& settings, const std::string& path,
                          const MadeFrom& madeFrom = {});
BuiltBricks writeBrickMap(const PointCloud& cloud, const BrickSettings& settings, const std::string& path,
                          const MadeFrom& madeFrom = {});

}  // namespace tomales
