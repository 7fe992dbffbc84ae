// Private to the hider: boxes around the micropolygons of a grid that moves or is out of focus, around 2 x 2 of them, 4
// x 4 and so on. Each is given for one time and one point of the lens, so that it stays as small as its micropolygons,
// however far they are blurred.
#pragma once
#include "reyes/hide.h"

namespace tomales {

/// A box around micropolygons between two motion keys. At fraction t of the way between the keys, seen through lens
/// shift l (SampleBuffer::lensX, lensY), its centre is at
///   (x, y) + t * (xStep, yStep) + l * (d + t * dStep - Camera::focusKey()).
/// Let (a, b) lead from there to any point of the micropolygons. Then |a + slant.x * b| <= xReach and
/// |b + slant.y * a| <= yReach, where the slant is that of the segment.
struct BlurBox {
  float x, y, d;              ///< Centre at the first key. The depth keys are used if RasterGrid::defocused.
  float xStep, yStep, dStep;  ///< Motion from the first key to the second.
  float xReach, yReach;       ///< Half sizes, with a margin for rounding (docs/decisions/0012).
};

struct BlurBounds {
  struct Segment {
    float dMin;  ///< Nearest depth key at either end.
    vec2 slant;  ///< Boxes follow the lines of the grid (docs/decisions/0108).
  };
  struct Level {
    int columns, rows;
    size_t first;  ///< Index among the boxes of a segment; box (i, j) is first + j * columns + i.
  };
  std::vector<Level> levels;  ///< levels[0] has one micropolygon in each box; the last level is one box.
  size_t boxesPerSegment = 0;
  std::vector<Segment> segments;  ///< One between each two motion keys; a still grid has one.
  PooledVector<BlurBox> boxes;

  const BlurBox& box(int segment, const Level& level, int i, int j) const {
    return boxes[static_cast<size_t>(segment) * boxesPerSegment + level.first +
                 static_cast<size_t>(j * level.columns + i)];
  }
};

/// pool: provides the memory of the boxes; may be null.
std::shared_ptr<const BlurBounds> boundBlur(const RasterGrid& raster, const Camera& camera, Pool* pool);

}  // namespace tomales
