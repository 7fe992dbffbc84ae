// Finds the elements of a batch from whose differences derivatives over a surface are computed.
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
  /// Returns the change over one micropolygon. It is not divided by the change of u or v, which may be 0 along d,
  /// because u and v of polygons are x and y.
  float step(int d, const float* x, int i) const {
    return next[d] == 0 ? difference(d, x, i)
                        : difference(d, x, i) * static_cast<float>(next[d]) / static_cast<float>(hi[d][i] - lo[d][i]);
  }
};

/// Centred differences along the lattice of a grid, one-sided at its border.
Stencil stencilOf(const Grid& grid, Arena& arena);

/// A batch with the neighbours of its points, half a micropolygon away on all four sides: n points become 5n, of which
/// side k begins at element (k + 1) n. Values change by half their steps; light, names and time are the point's own.
struct Widened {
  static constexpr int kSides = 4, kWide = 1 + kSides;
  ShadePoints points;
  Stencil stencil;
};
/// The points must have steps. `parallel` is true if neighbours have the same I.
Widened widened(const ShadePoints& points, bool parallel, Arena& arena);

}  // namespace tomales
