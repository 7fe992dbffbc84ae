// Verb: a picture of a point cloud, to look at: disks in their planes, seen by a camera or from above a corner. The
// nearest disk is in front; nothing is shaded. Space: that of the cloud. Threads: pure.
#pragma once
#include <optional>

#include "gi/point_cloud.h"
#include "reyes/base/chunk_file.h"
#include "reyes/image.h"

namespace tomales {

struct PointPictureSettings {
  int width = 640, height = 480;
  std::string channel;  ///< A channel of three floats or one; empty: the first. "normal" and "radius" show these.
  float gain = 0;       ///< Factor on the values; 0: chosen so that their 98th percentile is 0.8.
  /// Raster position and depth of a world-space point; empty: a view of the whole.
  std::function<std::optional<vec3>(const vec3&)> project;
};

/// Returns linear R G B A. Throws FileError if there is no such channel.
Image pictureOf(const PointCloud& cloud, const PointPictureSettings& settings);

}  // namespace tomales
