// How values change over a surface, from a shader's point of view: which elements of a batch to take differences of.
#pragma once
#include "reyes/points.h"
#include "reyes/shade/arena.h"

namespace tomales {

struct Grid;

/// Along direction d (0: u, 1: v) of the lattice x changes from x[lo[d][i]] to x[hi[d][i]] around element i. Null
/// arrays: a batch without neighbours.
struct Stencil {
  const int32_t *lo[2] = {nullptr, nullptr}, *hi[2] = {nullptr, nullptr};
  int32_t next[2] = {0,
                     0};  ///< From an element to that behind one micropolygon; 0: lo and hi are one micropolygon apart.
  explicit operator bool() const { return lo[0] != nullptr; }
  float difference(int d, const float* x, int i) const { return x[hi[d][i]] - x[lo[d][i]]; }
  /// The change over one micropolygon. Never by u or v, which need not change along d: those of polygons are x and y.
  float step(int d, const float* x, int i) const {
    return next[d] == 0 ? difference(d, x, i)
                        : difference(d, x, i) * static_cast<float>(next[d]) / static_cast<float>(hi[d][i] - lo[d][i]);
  }
};

/// Centred differences along the lattice of a grid, one-sided at its border.
Stencil stencilOf(const Grid& grid, Arena& arena);

/// A batch and, half a micropolygon away on all four sides, the neighbours of its points: n points become 5n, those of
/// side k from element (k + 1) n on. Values change by half their steps; light, names and time stay those of the point.
struct Widened {
  static constexpr int kSides = 4, kWide = 1 + kSides;
  ShadePoints points;
  Stencil stencil;
};
/// Pre: points.hasSteps(). `parallel`: I is the same for neighbours.
Widened widened(const ShadePoints& points, bool parallel, Arena& arena);

}  // namespace tomales
