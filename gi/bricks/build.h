// Verb: point cloud -> bricks and their octree (Christensen and Batali 2004, section 3.2), with one brick of each level
// in memory at a time (6.1). Two things differ from the paper. A point goes to the voxels that both the box and the
// plane of its disk cross, weighted by its area, so that a voxel holds the mean over the surface in it. And coarse
// voxels keep a layer for every direction, as fine ones do (docs/decisions/0021). The result depends on the order of
// points, not on threads.
#pragma once
#include <functional>

#include "gi/bricks/brick.h"
#include "gi/bricks/point_tiles.h"

namespace tomales {

constexpr uint64_t kPointsInMemory = 1'500'000;
/// Radius of a point's disk over the edge of the square that it stands for. With this factor neighbours meet.
constexpr float kDiskOfSquare = 0.8f;

struct BrickSettings {
  /// Bricks whose 2x2x2 groups of voxels vary less than this, in units of the data, are left out.
  float maxError = 0.002f;
  int maxDepth = 15;  ///< Levels below the root.
  float radiusScale = 1;
  bool ignoreNormals = false;  ///< The points are volume data: each is a sphere.
  float coarseness = 1;        ///< Factor on the width of the finest voxels that the radii require (3.2).
};

struct BuiltBricks {
  BrickTree tree;
  int eliminated = 0;  ///< Bricks left out because their parents hold the same data.
};

/// Passes every brick that is kept to `store`, in the order of the nodes. A cloud without points makes a tree without
/// nodes.
BuiltBricks buildBricks(const PointCloud& cloud, const BrickSettings& settings,
                        const std::function<void(const Brick&)>& store);

/// Does the same from disk, with about `most` points in memory at a time. It is fastest if the file is sorted
/// (writePointFile). Throws FileError.
BuiltBricks buildBricks(const PointTiles& tiles, const BrickSettings& settings,
                        const std::function<void(const Brick&)>& store, uint64_t most = kPointsInMemory);

}  // namespace tomales
