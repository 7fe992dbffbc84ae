// Private to the hider: reads the values of points to shade from the vertices of a grid, and derives others for many
// points at once.
#pragma once
#include "reyes/grid.h"
#include "reyes/points.h"

namespace tomales {

inline float reciprocalLength(float length2) {
  return length2 > 0.0f && length2 < kInfinity ? 1.0f / std::sqrt(length2) : 0.0f;
}

/// Returns the vertex of a cell that has the least u and v.
inline int firstVertex(const Grid& g, int cell) { return cell + cell / g.nu; }

/// Differences at a vertex: central, or one-sided at the border, scaled to one micropolygon.
struct VertexSteps {
  int at, uLo, uHi, vLo, vHi;
  float uScale, vScale;

  VertexSteps(const Grid& g, int vertex) : at(vertex) {
    const int row = g.nu + 1, i = vertex % row, j = vertex / row % (g.nv + 1), first = vertex - j * row - i;
    const int i0 = std::max(i - 1, 0), i1 = std::min(i + 1, g.nu), j0 = std::max(j - 1, 0), j1 = std::min(j + 1, g.nv);
    uLo = first + j * row + i0;
    uHi = first + j * row + i1;
    vLo = first + j0 * row + i;
    vHi = first + j1 * row + i;
    uScale = 1 / static_cast<float>(i1 - i0);
    vScale = 1 / static_cast<float>(j1 - j0);
  }
  float mean(const float* f) const { return f[at]; }
  float uStep(const float* f) const { return uScale * (f[uHi] - f[uLo]); }
  float vStep(const float* f) const { return vScale * (f[vHi] - f[vLo]); }
};

/// Differences along a cell, the mean of both its sides.
struct CellSteps {
  int a, b, c, d;

  CellSteps(const Grid& g, int cell) : a(firstVertex(g, cell)), b(a + 1), c(a + g.nu + 1), d(c + 1) {}
  float mean(const float* f) const { return 0.25f * (f[a] + f[b] + f[c] + f[d]); }
  float uStep(const float* f) const { return 0.5f * ((f[b] - f[a]) + (f[d] - f[c])); }
  float vStep(const float* f) const { return 0.5f * ((f[c] - f[a]) + (f[d] - f[b])); }
};

/// Mean and differences over a cell with corners a b c d.
struct MeanAndSteps {
  float mean, u, v;
  MeanAndSteps(float a, float b, float c, float d)
      : mean(0.25f * (a + b + c + d)), u(0.5f * ((b - a) + (d - c))), v(0.5f * ((c - a) + (d - b))) {}
};

/// Values of kLanes points read from grids; arrays may be written to beyond the end.
struct alignas(64) Gathered {
  using Array = float[2 * kLanes];
  Array P[3], N[3];
  Array uEdge[3], vEdge[3];  ///< Edges of P along u and v, one micropolygon long.
  Array side;                ///< -1 if the side that uEdge x vEdge points to is seen; 1 if the other one is.
  Array u, v, du, dv;

  void readVertex(const Grid& g, int vertex, int i) {
    const VertexSteps steps(g, vertex);
    for (int axis = 0; axis < 3; ++axis) {
      const float* p = g.P(0, axis);
      P[axis][i] = p[vertex];
      uEdge[axis][i] = steps.uStep(p);
      vEdge[axis][i] = steps.vStep(p);
      N[axis][i] = g.N(axis)[vertex];
    }
    u[i] = g.u()[vertex];
    v[i] = g.v()[vertex];
    du[i] = steps.uStep(g.u());
    dv[i] = steps.vStep(g.v());
  }

  /// Reads the centres of `count` cells whose first vertices follow each other from `a` on.
  void readCells(const Grid& g, int a, int count, int i) {
    const int row = g.nu + 1;
    const Sources from{
        {g.P(0, 0) + a, g.P(0, 1) + a, g.P(0, 2) + a}, {g.N(0) + a, g.N(1) + a, g.N(2) + a}, g.u() + a, g.v() + a};
    if (count >= kRun && a + row + 1 + kLanes <= g.stride())
      readBlock(from, row, i);
    else
      for (int k = 0; k < count; ++k) readCell(from, k, row, i);
  }

 private:
  static constexpr int kRun = 4;  ///< Least number of cells for which a vector is worth its cost.
  struct Sources {
    const float *P[3], *N[3], *u, *v;
  };
  static MeanAndSteps over(const float* f, int k, int row) { return {f[k], f[k + 1], f[k + row], f[k + row + 1]}; }

  void readCell(const Sources& from, int k, int row, int i) {
    for (int axis = 0; axis < 3; ++axis) {
      const MeanAndSteps p = over(from.P[axis], k, row);
      P[axis][i + k] = p.mean;
      uEdge[axis][i + k] = p.u;
      vEdge[axis][i + k] = p.v;
      N[axis][i + k] = over(from.N[axis], k, row).mean;
    }
    const MeanAndSteps s = over(from.u, k, row), t = over(from.v, k, row);
    u[i + k] = s.mean;
    du[i + k] = s.u;
    v[i + k] = t.mean;
    dv[i + k] = t.v;
  }

  void readBlock(const Sources& from, int row, int i);
};

/// The fixed channels of kLanes points from `first` on. The caller sets texture coordinates.
struct PointBlock {
  float* channel[kFixedChannels];

  PointBlock(ShadePoints& points, int first) {
    for (int c = 0; c < kFixedChannels; ++c) channel[c] = points.channel(c) + first;
  }
};

/// Derives all other values of kLanes points: unit normals, the directions of u and v, the area of a micropolygon, I.
void derive(const Gathered& g, bool perspective, const PointBlock& out);

}  // namespace tomales
