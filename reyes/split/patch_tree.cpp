#include <numeric>

#include "reyes/base/parallel.h"
#include "reyes/split.h"

namespace tomales {
namespace {

/// Bits of x, two apart.
uint32_t spread(uint32_t x) {
  x = (x | (x << 16)) & 0x030000ffU;
  x = (x | (x << 8)) & 0x0300f00fU;
  x = (x | (x << 4)) & 0x030c30c3U;
  return (x | (x << 2)) & 0x09249249U;
}

/// Place on Morton's curve of a point of a box, 10 bits an axis.
uint32_t placeOnCurve(const vec3& p, const Bound3& box) {
  const auto axis = [&](int k) {
    const float size = box.hi[k] - box.lo[k], at = size > 0 ? (p[k] - box.lo[k]) / size : 0;
    return static_cast<uint32_t>(at >= 0 ? std::min(at * 1024, 1023.0f) : 0.0f);  // NaN: 0
  };
  return spread(axis(0)) | spread(axis(1)) << 1 | spread(axis(2)) << 2;
}

}  // namespace

PatchTree::PatchTree(const std::vector<PrimPtr>& shapes, StopFlag stop) : order_(shapes.front()->patchCount()) {
  std::vector<Bound3> ofPatch(order_.size());
  parallelFor(ofPatch.size(), kLeaf, [&](size_t begin, size_t end) {
    for (size_t p = begin; p < end && !(stop && *stop); ++p)
      for (const PrimPtr& shape : shapes) ofPatch[p].extend(shape->bound(static_cast<uint32_t>(p), UvRect{}));
  });
  std::iota(order_.begin(), order_.end(), 0U);
  if (order_.size() > kLeaf) {
    Bound3 all;
    for (const Bound3& b : ofPatch)
      if (isFinite(b.lo) && isFinite(b.hi)) all.extend(b);
    std::vector<std::pair<uint32_t, uint32_t>> places(order_.size());
    for (uint32_t p = 0; p < places.size(); ++p) places[p] = {placeOnCurve(ofPatch[p].center(), all), p};
    std::sort(places.begin(), places.end());
    for (size_t k = 0; k < places.size(); ++k) order_[k] = places[k].second;
  }
  std::vector<Bound3> boxes((order_.size() + kLeaf - 1) / kLeaf);
  for (size_t k = 0; k < order_.size(); ++k) boxes[k / kLeaf].extend(ofPatch[order_[k]]);
  levels_.push_back(std::move(boxes));
  while (levels_.back().size() > 1) {
    const std::vector<Bound3>& below = levels_.back();
    std::vector<Bound3> above((below.size() + kFan - 1) / kFan);
    for (size_t i = 0; i < below.size(); ++i) above[i / kFan].extend(below[i]);
    levels_.push_back(std::move(above));
  }
}

}  // namespace tomales
