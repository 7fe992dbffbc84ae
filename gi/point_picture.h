// Verb: a picture of a point cloud or a brick map, to look at: disks in their plane, voxels as disks of their width, seen by a
// camera or from above a corner. Nearest in front; no shading.
#pragma once
#include <optional>

#include "gi/brick_map.h"
#include "reyes/image.h"

namespace tomales {

struct PointPictureSettings {
  int width = 640, height = 480;
  std::string channel;      ///< Of three floats or one; empty: the first. "normal", "radius": those.
  float gain = 0;           ///< Values are multiplied by it; 0: so that their 98th percentile is 0.8.
  /// Raster position and depth of a world-space point; empty: a view of the whole.
  std::function<std::optional<vec3>(const vec3&)> project;
};

/// Linear R G B A. Throws FileError: no such channel.
Image pictureOf(const PointCloud& cloud, const PointPictureSettings& settings);

/// The voxels of one level, and of coarser bricks where that level has none; level < 0: the finest.
PointCloud voxelsOf(const BrickMap& map, int level);

}  // namespace tomales
