// A coarse picture of a frame before it is shaded, from the nearest point in one pixel of every square.
#pragma once
#include "reyes/base/stop.h"
#include "reyes/frame.h"

namespace tomales {

/// A corner of the lattice, and the point of a reduced tile that it sees.
struct Corner {
  int x, y;
  size_t batch;
  int point;
};
/// Adds to `out` the corners in a tile of a lattice of `stride` pixels through the pixel `origin`, and to `reduced` the
/// points that they see. Several tiles may be reduced to one.
void addCorners(const DeepTile& tile, int stride, const ivec2& origin, DeepTile& reduced, std::vector<Corner>& out);

/// Returns squares of `stride` pixels, R G B A of the crop window, exposed and through the imager, each in the colour
/// of its corner's first point. It shades nothing else: all strides of the gather pass together cost a third of shading
/// the frame. If it is stopped, the missing squares are black.
Image sketch(const DeepFrame& layout, const TileReader& tiles, int stride, const Scene& scene,
             const ShadingSystem& shading, const ShadeContext& context, StopToken stop);

}  // namespace tomales
