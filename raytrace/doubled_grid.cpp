#include "raytrace/doubled_grid.h"

namespace tomales {

bool isFinite(const Grid& grid) {
  for (int key = 0; key < grid.keyCount; ++key)
    for (int i = 0; i < grid.vertexCount(); ++i)
      if (!isFinite(grid.position(key, i))) return false;
  return true;
}

float doubledDeviation(const Grid& g, int key, int i, int j) {
  const int row = g.nu + 1, k = j * row + i;
  const auto P = [&](int di, int dj) { return g.position(key, k + dj * row + di); };
  const vec3 a = P(0, 0), b = P(2, 0), c = P(2, 2), d = P(0, 2);
  const vec3 n = normalizeOr(cross(c - a, d - b), vec3(0));
  const auto off = [&](const vec3& p, const vec3& q, const vec3& middle) {
    return std::abs(dot(middle - 0.5f * (p + q), n));
  };
  return std::max({off(b, d, P(1, 1)), off(a, b, P(1, 0)), off(b, c, P(2, 1)), off(c, d, P(1, 2)), off(d, a, P(0, 1))});
}

float doubledDeviation(const Grid& g, int key) {
  float most = 0;
  for (int j = 0; j < g.nv; j += 2)
    for (int i = 0; i < g.nu; i += 2) most = std::max(most, doubledDeviation(g, key, i, j));
  return most;
}

}  // namespace tomales
