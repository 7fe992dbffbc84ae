// Boxes around the micropolygons of a grid that moves or is out of focus, around 2 x 2 of them, 4 x 4 and so
// on: each is told by where it is at one time, seen through one point of the lens, so that it stays as small
// as its micropolygons are, however far they are blurred. Private to the hider.
#pragma once
#include "reyes/hide.h"

namespace tomales {

/// At fraction t between two motion keys, through lens shift l (SampleBuffer::lensX, lensY), all of it lies
/// round center + t * step, moved by l * (d + t * dStep - Camera::focusKey()): x + slant.x * y and y +
/// slant.y * x of what is between them are within `reach`.
struct BlurBox {
  float x, y, d;              ///< Centre at the first key. Depth keys count if RasterGrid::defocused.
  float xStep, yStep, dStep;  ///< Way to its place at the second.
  float xReach, yReach;       ///< With a margin for rounding (docs/decisions/0012).
};

struct BlurBounds {
  struct Segment {
    float dMin;  ///< The nearest depth key at either end.
    vec2 slant;  ///< Boxes lie along the lines of the grid (docs/decisions/0108).
  };
  struct Level {
    int columns, rows;
    size_t first;  ///< In the boxes of a segment; box (i, j) is first + j * columns + i.
  };
  std::vector<Level> levels;  ///< levels[0]: one micropolygon a box; the last: one box.
  size_t boxesPerSegment = 0;
  std::vector<Segment> segments;  ///< Between two motion keys; a still grid has one.
  PooledVector<BlurBox> boxes;

  const BlurBox& box(int segment, const Level& level, int i, int j) const {
    return boxes[static_cast<size_t>(segment) * boxesPerSegment + level.first +
                 static_cast<size_t>(j * level.columns + i)];
  }
};

/// pool: where they are kept; may be null.
std::shared_ptr<const BlurBounds> boundBlur(const RasterGrid& raster, const Camera& camera, Pool* pool);

}  // namespace tomales
