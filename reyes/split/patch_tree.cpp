#include <numeric>

#include "reyes/base/morton.h"
#include "reyes/base/parallel.h"
#include "reyes/split.h"

namespace tomales {
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
    for (uint32_t p = 0; p < places.size(); ++p) places[p] = {mortonPlace(ofPatch[p].center(), all), p};
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
