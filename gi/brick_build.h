// Verb: point cloud -> bricks and their octree (irradiance-atlas 3.2), with one brick of each level in memory at a time
// (6.1). What differs from the paper: a point is its disk's box, cut by its plane, and weighs by its area, so that a
// voxel holds the mean over the surface in it; and coarse voxels too keep a layer for every direction
// (docs/decisions/0021-brick-layers.md). Deterministic: depends on the order of points, not on threads.
#pragma once
#include <functional>

#include "gi/brick.h"
#include "gi/point_tiles.h"

namespace tomales {

constexpr uint64_t kPointsInMemory = 1'500'000;

struct BrickSettings {
  float maxError = 0.002f;  ///< Bricks whose 2x2x2 groups of voxels vary less are left out, in units of the data.
  int maxDepth = 15;        ///< Levels below the root.
  float radiusScale = 1;
  bool ignoreNormals = false;  ///< Volume data: every point is a sphere.
  float coarseness = 1;        ///< The finest voxels are so many times as wide as the radii ask (3.2).
};

struct BuiltBricks {
  BrickTree tree;
  int eliminated = 0;  ///< Bricks left out because their parents say the same.
};

/// Hands every brick that is kept to `store`, in the order of the nodes. A cloud without points makes a tree without
/// nodes.
BuiltBricks buildBricks(const PointCloud& cloud, const BrickSettings& settings,
                        const std::function<void(const Brick&)>& store);

/// The same from disk, with about `most` points in memory at a time; best if the file is sorted (writePointFile).
/// Throws FileError.
BuiltBricks buildBricks(const PointTiles& tiles, const BrickSettings& settings,
                        const std::function<void(const Brick&)>& store, uint64_t most = kPointsInMemory);

}  // namespace tomales
