#include "gi/gather/contrast_cells.h"

namespace tomales {

std::vector<int> contrastCells(const HemisphereCells& cells, std::span<const vec3> radiance) {
  const int M = cells.rings, N = cells.sectors;
  const auto light = [&](int j, int k) { return luminance(radiance[static_cast<size_t>(j * N + (k + N) % N)]); };
  float mean = 0;
  for (const vec3& L : radiance) mean += luminance(L) / static_cast<float>(radiance.size());
  std::vector<int> out;
  for (int j = 0; j < M; ++j)
    for (int k = 0; k < N; ++k) {
      float least = kInfinity, most = 0;
      for (int ring = std::max(j - 1, 0); ring <= std::min(j + 1, M - 1); ++ring)
        for (int side = -1; side <= 1; ++side) {
          if (ring == j && side == 0) continue;
          least = std::min(least, light(ring, k + side));
          most = std::max(most, light(ring, k + side));
        }
      if (most - least > kContrast * mean) out.push_back(j * N + k);
    }
  return out;
}

}  // namespace tomales
