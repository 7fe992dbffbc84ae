#include "reyes/grid.h"

#include <cmath>

#include "reyes/base/check.h"

namespace tomales {

void Grid::allocate(int cellsU, int cellsV, int keys, int primvarFloats, Pool* pool) {
  nu = cellsU;
  nv = cellsV;
  keyCount = keys;
  block_ = PooledVector<float>(static_cast<size_t>(stride()) * static_cast<size_t>(keys * 3 + 5 + primvarFloats), 0.0f,
                               pool);
}

namespace {

/// Index steps from a vertex to the neighbours between which differences are taken, and the positions.
struct Differences {
  const float *x, *y, *z;
  int uFrom, uTo, vFrom, vTo;
};

/// The cross product of the differences as a unit vector, and its squared length; a missing direction is (0, 0, -1).
struct Normal {
  float nx, ny, nz, length2;
};
[[gnu::always_inline]] inline Normal normalAt(const Differences& d, int k) {
  const int u0 = k + d.uFrom, u1 = k + d.uTo, v0 = k + d.vFrom, v1 = k + d.vTo;
  const float ux = d.x[u1] - d.x[u0], uy = d.y[u1] - d.y[u0], uz = d.z[u1] - d.z[u0];
  const float vx = d.x[v1] - d.x[v0], vy = d.y[v1] - d.y[v0], vz = d.z[v1] - d.z[v0];
  const float x = uy * vz - vy * uz, y = uz * vx - vz * ux, z = ux * vy - vx * uy;
  const float length2 = x * x + y * y + z * z, length = std::sqrt(length2);
  const bool good = (length2 > 0.0f) & (length2 < kInfinity);
  return {good ? x / length : 0.0f, good ? y / length : 0.0f, good ? z / length : -1.0f, length2};
}

/// Computes the normals of vertices [first, end), which have the same differences. Returns how many have no direction.
TOMALES_HOT int fillNormals(const Differences& differences, int first, int end, float* __restrict nx,
                            float* __restrict ny, float* __restrict nz) {
  const Differences d = differences;
  int missing = 0;
#pragma GCC ivdep
  for (int k = first; k < end; ++k) {
    const Normal n = normalAt(d, k);
    nx[k] = n.nx;
    ny[k] = n.ny;
    nz[k] = n.nz;
    missing += n.length2 == 0;
  }
  return missing;
}

}  // namespace

void calculateNormals(const Grid& g, bool flip, float* nx, float* ny, float* nz) {
  CHECK_EQ(g.pieceCount(), 1);
  const int row = g.nu + 1, last = g.nv * row, count = g.vertexCount();
  const auto around = [&](int i, int j) {
    const int uFrom = i > 0 ? -1 : 0, uTo = i < g.nu ? 1 : 0, vFrom = j > 0 ? -row : 0, vTo = j < g.nv ? row : 0;
    const Differences d{g.P(0, 0), g.P(0, 1), g.P(0, 2), uFrom, uTo, vFrom, vTo};
    return flip ? Differences{d.x, d.y, d.z, vFrom, vTo, uFrom, uTo} : d;
  };
  // All rows between the first and the last are computed at once, as if their ends had neighbours too; the ends are
  // corrected afterwards.
  int missing =
      fillNormals(around(1, 0), 1, row - 1, nx, ny, nz) + fillNormals(around(1, g.nv), last + 1, count - 1, nx, ny, nz);
  if (g.nv > 1) missing += fillNormals(around(g.nu > 1 ? 1 : 0, 1), row, last, nx, ny, nz);
  for (int j = 0; j <= g.nv; ++j)
    for (const int i : {0, g.nu}) missing += fillNormals(around(i, j), j * row + i, j * row + i + 1, nx, ny, nz);
  if (missing == 0) return;

  // A pole has no dP/du of its own: the nearest row inwards that has one is used. A line has none anywhere.
  const auto length2At = [&](int i, int j) { return normalAt(around(i, j), j * row + i).length2; };
  bool any = false;
  for (int k = 0; k < count && !any; ++k) any = length2At(k % row, k / row) != 0;
  for (int k = 0; k < count && any; ++k) {
    const int i = k % row, j = k / row;
    if (length2At(i, j) != 0) continue;
    Normal n{0, 0, -1, 0};
    for (int step = 1; n.length2 == 0 && step <= std::max(g.nu, g.nv); ++step) {
      const int inward_i = std::clamp(i + (i < g.nu / 2 ? 1 : -1) * std::min(step, g.nu / 2), 0, g.nu);
      const int inward_j = std::clamp(j + (j < g.nv / 2 ? 1 : -1) * std::min(step, g.nv / 2), 0, g.nv);
      n = normalAt(around(i, inward_j), inward_j * row + i);
      if (n.length2 == 0) n = normalAt(around(inward_i, inward_j), inward_j * row + inward_i);
    }
    nx[k] = n.nx;
    ny[k] = n.ny;
    nz[k] = n.nz;
  }
}

}  // namespace tomales
