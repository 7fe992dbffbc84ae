// Measures a rectangle of a patch along lines as the camera sees them, at several times if it moves, and chooses the
// numbers of micropolygons along u and v.
#pragma once
#include <span>

#include "reyes/scene.h"

namespace tomales {

/// The largest values among some lines of a rectangle along u, or along v.
struct LineSize {
  float px = 0, length = 0;  ///< Lengths in raster space and in camera space.
  int least = 1;             ///< Least number of cells: with fewer, a closed line would enclose nothing.
  float bend_px = 0;         ///< Largest second difference of four parts of a line, across it.
};
struct PatchSize {
  LineSize u, v;
  /// Greatest area, at most u.px * v.px, and less if lines cross at a slant. It is computed for the largest part and
  /// applied to all.
  float area_px2 = 0;
  Bound3 probes;  ///< Bound of the points that were measured, in camera space.
  /// Sets every member to the larger of both.
  void extend(const PatchSize& other);
};
PatchSize measure(const Object& object, const Camera& camera, uint32_t patch, const UvRect& rect);
/// Measures each of some whole patches.
std::vector<PatchSize> measureWhole(const Object& object, const Camera& camera, std::span<const uint32_t> patches);

struct Cells {
  int nu, nv;
};
struct CellRules {
  float edge_px = 1;     ///< The root of the area of a cell in raster space.
  float coarsening = 1;  ///< Factor by which blur lets edges grow.
  bool binary = false;   ///< Counts are powers of two.
  bool joins = false;    ///< The edges of the piece meet those of others.
};
/// Chooses the cells of a piece: as few as have the area that the rules ask for, with edges up to half as long again
/// where lines cross at a slant or counts are rounded. There are never fewer than LineSize::least, so that the shape
/// does not collapse, and enough that chords are flat (docs/decisions/0034, 0050).
Cells cells(const PatchSize& size, const CellRules& rules);

}  // namespace tomales
