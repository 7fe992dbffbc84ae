#include "reyes/split/visits.h"

#include <bit>

namespace tomales {
namespace {

/// Limits on the pieces that splitting a patch may visit: a multiple of the number that covers the window once, and a
/// least number for small windows. A ground plane up to its horizon takes about ten times the number that covers the
/// window, because its grids overlap there. Only coordinates beyond the precision or range of floats, which no halving
/// makes small, come near the limit. Patches of one object share what exceeds the least number, because a mesh of many
/// patches would take hours otherwise.
constexpr double kLayersOfObject = 128, kLayersOfPatch = 16;
constexpr double kVisitsOfObject = 1 << 14, kVisitsOfPatch = 1 << 9;
/// The cost of a blurred piece beyond its visit, if it may be seen all over the window: each sample there is tested
/// against it, and all buckets wait for its vertices at every key.
constexpr double kVisitsOfBlur = 32, kKeysOfBlur = 16;
constexpr double kLeastSeen = 0.25;  ///< Share of a coarse piece's width in the picture, and of its height.

}  // namespace

int64_t Visits::ofPatch(uint32_t patches) const {
  const double layers = std::max(kLayersOfObject / patches, kLayersOfPatch),
               least = std::max(kVisitsOfObject / patches, kVisitsOfPatch);
  const double gridsOfWindow = windowArea() / (double{edge_px_} * edge_px_ * gridSize_);
  return static_cast<int64_t>(least + layers * gridsOfWindow);
}

int64_t Visits::ofBlur(const Bound2& raster, size_t keyTimes) const {
  const double keys = 1 + static_cast<double>(keyTimes) / kKeysOfBlur;
  const glm::dvec2 size = sizeInWindow(raster);
  return static_cast<int64_t>(kVisitsOfBlur * keys * (size.x * size.y) / windowArea());
}

/// The result counts its share of grids by area, grids that the window's border may cut, and the halvings that lead to
/// them. Towards a horizon many grids overlap; beside the eye almost nothing of a huge piece is visible.
double Visits::expected(const SubPatch& p) const {
  const int64_t all = grids(p.nu, p.nv);
  const glm::dvec2 size = p.raster.hi - p.raster.lo, seen = sizeInWindow(p.raster);
  const glm::dvec2 gridsAcross = seen / (double{edge_px_} * std::sqrt(gridSize_)) + 1.0;
  const double inView = static_cast<double>(all) * (seen.x / size.x) * (seen.y / size.y);
  return std::min(static_cast<double>(all), inView + gridsAcross.x * gridsAcross.y) +
         static_cast<double>(std::bit_width(static_cast<uint64_t>(all)));
}

bool Visits::isLargelySeen(const Bound2& raster) const {
  const glm::dvec2 size = raster.hi - raster.lo, seen = sizeInWindow(raster);
  return seen.x >= kLeastSeen * size.x && seen.y >= kLeastSeen * size.y;
}

glm::dvec2 Visits::sizeInWindow(const Bound2& raster) const {
  const vec2 lo = glm::max(raster.lo, vec2(window_.x0, window_.y0)),
             hi = glm::min(raster.hi, vec2(window_.x1, window_.y1));
  return glm::max(hi - lo, vec2(0));
}

}  // namespace tomales
