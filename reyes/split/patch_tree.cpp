#include <array>
#include <numeric>

#include "reyes/base/morton.h"
#include "reyes/base/parallel.h"
#include "reyes/split.h"

namespace tomales {
namespace {

/// Returns 0, 1, ... sorted by their places, which have 30 bits. It is a stable radix sort, the lowest digit first.
std::vector<uint32_t> inOrderOf(const std::vector<uint32_t>& places) {
  constexpr uint32_t kBits = 10, kDigits = 1U << kBits;
  std::vector<uint32_t> order(places.size()), next(places.size());
  std::iota(order.begin(), order.end(), 0U);
  for (uint32_t shift = 0; shift < 30; shift += kBits) {
    const auto digit = [&](uint32_t p) { return places[p] >> shift & (kDigits - 1); };
    std::array<uint32_t, kDigits + 1> first{};
    for (const uint32_t place : places) ++first[(place >> shift & (kDigits - 1)) + 1];
    std::partial_sum(first.begin(), first.end(), first.begin());
    for (const uint32_t p : order) next[first[digit(p)]++] = p;
    order.swap(next);
  }
  return order;
}

}  // namespace

PatchTree::PatchTree(const std::vector<PrimPtr>& shapes, StopToken stop) : order_(shapes.front()->patchCount()) {
  std::vector<Bound3> ofPatch(order_.size());
  parallelFor(ofPatch.size(), kLeaf, [&](size_t begin, size_t end) {
    for (size_t p = begin; p < end && !stop.requested(); ++p)
      for (const PrimPtr& shape : shapes) ofPatch[p].extend(shape->bound(static_cast<uint32_t>(p), UvRect{}));
  });
  std::iota(order_.begin(), order_.end(), 0U);
  if (order_.size() > kLeaf) {
    Bound3 all;
    for (const Bound3& b : ofPatch)
      if (isFinite(b.lo) && isFinite(b.hi)) all.extend(b);
    std::vector<uint32_t> places(order_.size());
    for (size_t p = 0; p < places.size(); ++p) places[p] = mortonPlace(ofPatch[p].center(), all);
    order_ = inOrderOf(places);
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
