// Finds the elements of a batch whose differences tell how values change over a surface.
#pragma once
#include "reyes/points.h"
#include "reyes/shade/arena.h"

namespace tomales {

struct Grid;

/// Along direction d (0: u, 1: v) of the lattice, x changes from x[lo[d][i]] to x[hi[d][i]] around element i. The
/// arrays are null for a batch without neighbours.
struct Stencil {
  const int32_t *lo[2] = {nullptr, nullptr}, *hi[2] = {nullptr, nullptr};
  /// Number of elements from one micropolygon to the next, or 0 if lo and hi are one micropolygon apart.
  int32_t next[2] = {0, 0};
  explicit operator bool() const { return lo[0] != nullptr; }
  float difference(int d, const float* x, int i) const { return x[hi[d][i]] - x[lo[d][i]]; }
  /// Returns the change over one micropolygon. It is not divided by u's or v's, which may be 0 along d: polygons have x
  /// and y.
  float step(int d, const float* x, int i) const {
    return next[d] == 0 ? difference(d, x, i)
                        : difference(d, x, i) * static_cast<float>(next[d]) / static_cast<float>(hi[d][i] - lo[d][i]);
  }
};

/// Centred differences along the lattice of a grid, one-sided at its border.
Stencil stencilOf(const Grid& grid, Arena& arena);

/// A batch with the neighbours of its points, half a micropolygon away on all four sides: n points become 5n, those of
/// side k from element (k + 1) n on. Values change by half their steps; light, names and time stay those of the point.
struct Widened {
  static constexpr int kSides = 4, kWide = 1 + kSides;
  ShadePoints points;
  Stencil stencil;
};
/// The points must have steps. `parallel` is true if neighbours have the same I.
Widened widened(const ShadePoints& points, bool parallel, Arena& arena);

}  // namespace tomales
