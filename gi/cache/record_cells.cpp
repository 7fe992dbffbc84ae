#include "gi/cache/record_cells.h"

#include <numeric>

namespace tomales {
namespace {

constexpr uint32_t kInner = ~uint32_t{0};
constexpr size_t kFew = 6;    ///< A list of so few records is not worth dividing.
constexpr int kDeepest = 20;  ///< Bounds the memory where records lie at one place.
/// Bounds the memory where few records of little reach lie among many of great reach.
constexpr size_t kMostPerRecord = 256;
/// Cells are not divided below this share of the least reach of their records: most of these reach all of the cell.
constexpr float kCellOfReach = 0.5f;

float distance2(const vec3& p, const OctreeBox& box) {
  const vec3 off = glm::max(glm::abs(p - box.center) - box.half, vec3(0.0f));
  return dot(off, off);
}

}  // namespace

RecordCells::RecordCells(const Bound3& bound, std::vector<RecordReach> records, const ReachOf& reach,
                         const MostPixels& pixels)
    : root_(OctreeBox::around(bound)), records_(std::move(records)), nodes_(1) {
  std::vector<uint32_t> all(records_.size());
  std::iota(all.begin(), all.end(), 0u);
  divide(0, root_, all, 0, reach, pixels);
}

void RecordCells::divide(uint32_t node, const OctreeBox& box, std::span<const uint32_t> inParent, int depth,
                         const ReachOf& reach, const MostPixels& pixels) {
  const float mostPixels = pixels(box.bound());
  float least = kInfinity;
  std::vector<uint32_t> list;
  for (const uint32_t record : inParent) {
    const float radius = reach(records_[record], mostPixels);
    if (distance2(records_[record].position, box) > radius * radius) continue;
    list.push_back(record);
    least = std::min(least, radius);
  }
  const bool isFull = lists_.size() > kMostPerRecord * records_.size();
  if (list.size() <= kFew || depth == kDeepest || box.half < kCellOfReach * least || isFull) {
    nodes_[node] = {static_cast<uint32_t>(lists_.size()), static_cast<uint32_t>(list.size()), mostPixels};
    lists_.insert(lists_.end(), list.begin(), list.end());
    return;
  }
  const auto first = static_cast<uint32_t>(nodes_.size());
  nodes_[node] = {first, kInner, mostPixels};
  nodes_.resize(nodes_.size() + 8);
  for (unsigned i = 0; i < 8; ++i) divide(first + i, box.child(i), list, depth + 1, reach, pixels);
}

std::optional<std::span<const uint32_t>> RecordCells::find(const vec3& position, float pixelSize) const {
  if (!root_.contains(position)) return std::nullopt;
  OctreeBox box = root_;
  const Node* node = &nodes_[0];
  while (node->count == kInner) {
    const unsigned i = box.childIndex(position);
    box = box.child(i);
    node = &nodes_[node->first + i];
  }
  if (!(pixelSize <= node->mostPixels)) return std::nullopt;
  return std::span(lists_).subspan(node->first, node->count);
}

}  // namespace tomales
