#include "reyes/grid.h"

#include "reyes/base/check.h"

namespace tomales {

void Grid::allocate(int cellsU, int cellsV, int keys, int primvarFloats, Pool* pool) {
  nu = cellsU, nv = cellsV, keyCount = keys;
  block_ = PooledVector<float>(static_cast<size_t>(stride()) * static_cast<size_t>(keys * 3 + 5 + primvarFloats), 0.0f, pool);
}

void calculateNormals(const Grid& g, bool flip, float* nx, float* ny, float* nz) {
  CHECK_EQ(g.pieceCount(), 1);
  const int row = g.nu + 1;
  const auto P = [&](int i, int j) { return g.position(0, j * row + i); };
  const auto differences = [&](int i, int j) {
    const vec3 du = P(std::min(i + 1, g.nu), j) - P(std::max(i - 1, 0), j);
    const vec3 dv = P(i, std::min(j + 1, g.nv)) - P(i, std::max(j - 1, 0));
    return flip ? cross(dv, du) : cross(du, dv);
  };
  bool any = false;
  for (int j = 0; j <= g.nv; ++j)
    for (int i = 0; i <= g.nu; ++i) {
      const vec3 n = differences(i, j);
      const int k = j * row + i;
      nx[k] = n.x, ny[k] = n.y, nz[k] = n.z;
      any |= dot(n, n) != 0.0f;
    }
  for (int j = 0; j <= g.nv; ++j)
    for (int i = 0; i <= g.nu; ++i) {
      const int k = j * row + i;
      vec3 n(nx[k], ny[k], nz[k]);
      // A pole has no dP/du of its own: step inwards until there is one. A line has none anywhere.
      for (int step = 1; any && dot(n, n) == 0.0f && step <= std::max(g.nu, g.nv); ++step) {
        const int inward_i = i + (i < g.nu / 2 ? 1 : -1) * std::min(step, g.nu / 2);
        const int inward_j = j + (j < g.nv / 2 ? 1 : -1) * std::min(step, g.nv / 2);
        n = differences(std::clamp(i, 0, g.nu), std::clamp(inward_j, 0, g.nv));
        if (dot(n, n) == 0.0f) n = differences(std::clamp(inward_i, 0, g.nu), std::clamp(inward_j, 0, g.nv));
      }
      n = normalizeOr(n, vec3(0, 0, -1));
      nx[k] = n.x, ny[k] = n.y, nz[k] = n.z;
    }
}

}  // namespace tomales
