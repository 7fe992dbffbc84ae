// How many micropolygons a rectangle of a patch takes along u and v, from lines measured on it as the camera
// sees them, at several times if it moves.
#pragma once
#include <span>

#include "reyes/scene.h"

namespace tomales {

/// The longest of some lines of a rectangle along u, or along v.
struct LineSize {
  float px = 0, length = 0;  ///< In raster space, and in camera space.
  int least = 1;             ///< Cells without which a line that bends round would enclose nothing.
  float bend_px = 0;         ///< Largest second difference of four stretches of a line, across it.
};
struct PatchSize {
  LineSize u, v;
  float area_px2 = 0;  ///< u.px * v.px or less, as the lines cross at a slant: of the largest part, for all.
  Bound3 probes;       ///< Around the points that were measured, in camera space.
  /// What is larger of either.
  void extend(const PatchSize& other);
};
PatchSize measure(const Object& object, const Camera& camera, uint32_t patch, const UvRect& rect);
/// Of each of some patches as a whole.
std::vector<PatchSize> measureWhole(const Object& object, const Camera& camera, std::span<const uint32_t> patches);

struct Cells {
  int nu, nv;
};
/// Cells of a piece: as few as have the area edge_px^2 in raster space, with edges up to half as long again where lines
/// cross at a slant or counts are rounded; fewer where blur lets edges grow by `coarsening`, but never so few, `least`,
/// that the shape collapses, and so many that chords are flat (docs/decisions/0034, 0050). Binary: powers of two.
/// joins: its edges meet others.
Cells cells(const PatchSize& size, float edge_px, float coarsening, bool binary, bool joins);

}  // namespace tomales
