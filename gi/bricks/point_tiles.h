// Private to gi: a cloud on disk as an octree of cubes, so that a cloud larger than memory is processed cube by cube.
// Threads: one.
#pragma once
#include "gi/bricks/brick.h"
#include "gi/point_file.h"

namespace tomales {

/// Returns the cube around a cloud, which brick maps divide.
BrickCube cubeAround(const Bound3& bound);

class PointTiles {
 public:
  static constexpr int kDeepest = 5;  ///< Level of the smallest cubes: 32^3 of them.

  /// Reads the cloud once. Throws FileError.
  explicit PointTiles(const PointFile& file);

  const PointFile& file() const { return file_; }
  const BrickCube& cube() const { return cube_; }
  /// Returns the bound of the cube of some level at `place`, counted in cubes of that level from the low corner.
  /// Neighbours share their border to the bit.
  Bound3 box(int level, const glm::ivec3& place) const;
  uint64_t count(int level, const glm::ivec3& place) const;
  /// Tells whether count() counts this point. Every point lies in one cube of each level.
  bool contains(int level, const glm::ivec3& place, const vec3& P) const {
    return cellOf(P) >> (kDeepest - level) == place;
  }
  double meanOfData() const { return mean_; }
  /// Returns the points that lie within `margin` of the box, or whose scaled radius reaches it, in the order of the
  /// file.
  PointCloud around(const Bound3& box, float margin, float radiusScale = 1) const;

  /// Writes the same points in chunks that are compact in space, whatever the order of the file, so that around() reads
  /// little. Throws FileError.
  void writeCompact(const std::string& path) const;

 private:
  glm::ivec3 cellOf(const vec3& P) const;  ///< Coordinates among the smallest cubes.

  const PointFile& file_;
  BrickCube cube_;
  std::vector<uint32_t> counts_;  ///< Number of points in each of the smallest cubes.
  float largestRadius_ = 0;
  double mean_ = 0;
};

/// Calls `work` with level and place of cubes that together hold the cloud, each with no more than `most` points, in
/// the order of octants.
template <class Work>
void forEachTile(const PointTiles& tiles, uint64_t most, const Work& work, int level = 0,
                 const glm::ivec3& place = glm::ivec3(0)) {
  const uint64_t count = tiles.count(level, place);
  if (count == 0) return;
  if (count <= most || level == PointTiles::kDeepest) return work(level, place);
  for (int octant = 0; octant < 8; ++octant)
    forEachTile(tiles, most, work, level + 1, place * 2 + octantOffset(octant));
}

}  // namespace tomales
