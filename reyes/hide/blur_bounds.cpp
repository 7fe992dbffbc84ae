#include "reyes/hide/blur_bounds.h"

#include <array>

#include "reyes/base/check.h"

namespace tomales {
namespace {

constexpr float kMargin_px = 1.0f / 64;
constexpr float kRounding = 0x1p-20f;  ///< Of the largest coordinate: some units in the last place.

/// Raster x, y and depth key: least and greatest at the two keys of a segment.
struct Extent {
  vec3 lo[2]{vec3(kInfinity), vec3(kInfinity)}, hi[2]{vec3(-kInfinity), vec3(-kInfinity)};

  void extend(int key, const vec3& p) { lo[key] = glm::min(lo[key], p), hi[key] = glm::max(hi[key], p); }
  void extend(const Extent& e) {
    for (int key = 0; key < 2; ++key) lo[key] = glm::min(lo[key], e.lo[key]), hi[key] = glm::max(hi[key], e.hi[key]);
  }
};

BlurBox boxOf(const Extent& e, const vec2& lens) {
  const vec3 center[2] = {0.5f * (e.lo[0] + e.hi[0]), 0.5f * (e.lo[1] + e.hi[1])};
  // Linear motion keeps every vertex within the box whose sides move linearly; the larger half size serves all times.
  const vec3 reach = glm::max(e.hi[0] - center[0], e.hi[1] - center[1]);
  const vec3 most = glm::max(glm::max(glm::abs(e.lo[0]), glm::abs(e.hi[0])), glm::max(glm::abs(e.lo[1]), glm::abs(e.hi[1])));
  const vec2 margin = kMargin_px + kRounding * (vec2(most) + glm::abs(lens) * most.z);
  const vec2 wide = vec2(reach) + glm::abs(lens) * reach.z + margin;
  const vec3 step = center[1] - center[0];
  return {center[0].x, center[0].y, center[0].z, step.x, step.y, step.z, wide.x, wide.y, std::min(e.lo[0].z, e.lo[1].z)};
}

std::vector<BlurBounds::Level> levelsOf(const Grid& g) {
  std::vector<BlurBounds::Level> levels{{g.nu, g.nv, 0}};
  while (levels.back().columns > 1 || levels.back().rows > 1) {
    const BlurBounds::Level& l = levels.back();
    levels.push_back({(l.columns + 1) / 2, (l.rows + 1) / 2, l.first + static_cast<size_t>(l.columns * l.rows)});
  }
  return levels;
}

}  // namespace

std::shared_ptr<const BlurBounds> boundBlur(const RasterGrid& r, const Camera& camera) {
  const Grid& g = *r.grid;
  CHECK_EQ(g.pieceCount(), 1);
  const int row = g.nu + 1, segments = std::max(1, g.keyCount - 1);
  auto bounds = std::make_shared<BlurBounds>();
  bounds->levels = levelsOf(g);
  bounds->boxesPerSegment = bounds->levels.back().first + 1;
  bounds->boxes.reserve(bounds->boxesPerSegment * static_cast<size_t>(segments));
  std::vector<Extent> extents;
  for (int segment = 0; segment < segments; ++segment) {
    extents.assign(bounds->boxesPerSegment, {});
    for (int cell = 0; cell < g.cellCount(); ++cell) {
      const int a = cell / g.nu * row + cell % g.nu;
      for (int k = 0; k < 2; ++k)
        for (const int corner : {a, a + 1, a + row, a + row + 1}) {
          const size_t v = static_cast<size_t>(std::min(segment + k, g.keyCount - 1) * g.stride() + corner);
          extents[static_cast<size_t>(cell)].extend(k, {r.x[v], r.y[v], r.d[v]});
        }
    }
    for (size_t l = 1; l < bounds->levels.size(); ++l) {
      const BlurBounds::Level &fine = bounds->levels[l - 1], &coarse = bounds->levels[l];
      for (int j = 0; j < fine.rows; ++j)
        for (int i = 0; i < fine.columns; ++i)
          extents[coarse.first + static_cast<size_t>(j / 2 * coarse.columns + i / 2)].extend(
              extents[fine.first + static_cast<size_t>(j * fine.columns + i)]);
    }
    for (const Extent& e : extents) bounds->boxes.push_back(boxOf(e, camera.lens()));
  }
  return bounds;
}

}  // namespace tomales
