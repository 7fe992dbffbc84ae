// Verb: a picture of a point cloud, to look at: disks in their plane, seen by a camera or from above a corner.
// Nearest in front; no shading.
#pragma once
#include <optional>

#include "gi/point_cloud.h"
#include "reyes/base/chunk_file.h"
#include "reyes/image.h"

namespace tomales {

struct PointPictureSettings {
  int width = 640, height = 480;
  std::string channel;  ///< Of three floats or one; empty: the first. "normal", "radius": those.
  float gain = 0;       ///< Values are multiplied by it; 0: so that their 98th percentile is 0.8.
  /// Raster position and depth of a world-space point; empty: a view of the whole.
  std::function<std::optional<vec3>(const vec3&)> project;
};

/// Linear R G B A. Throws FileError: no such channel.
Image pictureOf(const PointCloud& cloud, const PointPictureSettings& settings);

}  // namespace tomales
