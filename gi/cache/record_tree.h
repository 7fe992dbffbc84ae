// Private to gi/irradiance_cache: an octree of numbered records. Each lies in the node that matches its radius (Ward et
// al. 1988). The radius within which a record is valid depends on the lookup (Tabellion and Lamorlette 2004, eq. 3) and
// grows with the record's size, so each node knows the size of its largest record.
#pragma once
#include <cstdint>
#include <vector>

#include "reyes/base/block_vector.h"
#include "reyes/base/math.h"

namespace tomales {

class RecordTree {
 public:
  /// `bound` should hold all records; records outside of it still work, only slower.
  explicit RecordTree(const Bound3& bound)
      : root_(bound.empty() ? Box{vec3(0.0f), 0.0f} : Box{bound.center(), 0.5001f * maxComponent(bound.size())}) {
    nodes_.push_back({});
  }

  void insert(uint32_t record, const vec3& position, float size, float radius) {
    if (!root_.contains(position)) return outside_.push_back(record);
    Box box = root_;
    uint32_t node = 0;
    for (int depth = 0;; ++depth) {
      Node& here = nodes_[node];
      here.largest = std::max(here.largest, size);
      if (depth == kMaxDepth || box.half < 2 * radius) return append(here, record);
      const int i = box.childIndex(position);
      box = box.child(i);
      node = descend(node, i);
    }
  }

  /// Calls visit(record), in any order, for at least all records that lie within their reach of `region`. reach(size)
  /// is the validity radius of a record of that size; it may not fall with the size.
  template <class Reach, class Visit>
  void visit(const Bound3& region, const Reach& reach, const Visit& visit) const {
    for (const uint32_t record : outside_) visit(record);
    visitNode(0, root_, region, reach, visit);
  }

 private:
  static constexpr int kMaxDepth = 24;
  static constexpr uint32_t kNone = ~uint32_t{0};

  struct Node {
    float largest = 0;  ///< Size of the largest record of this node and of all below.
    uint32_t child[8] = {kNone, kNone, kNone, kNone, kNone, kNone, kNone, kNone};
    uint32_t first = kNone, last = kNone;  ///< Ends of a linked list through next_.
  };

  struct Box {
    vec3 center;
    float half;

    int childIndex(const vec3& p) const {
      return (p.x >= center.x ? 1 : 0) | (p.y >= center.y ? 2 : 0) | (p.z >= center.z ? 4 : 0);
    }
    Box child(int i) const {
      const float h = half * 0.5f;
      return {center + vec3(i & 1 ? h : -h, i & 2 ? h : -h, i & 4 ? h : -h), h};
    }
    bool contains(const vec3& p) const { return maxComponent(glm::abs(p - center)) <= half; }
    bool touches(const Bound3& b, float radius) const {
      const vec3 outside = glm::max(glm::max(b.lo - (center + vec3(half)), (center - vec3(half)) - b.hi), vec3(0.0f));
      return dot(outside, outside) <= radius * radius;
    }
  };

  void append(Node& node, uint32_t record) {
    while (next_.size() <= record) next_.push_back(kNone);
    (node.first == kNone ? node.first : next_[node.last]) = record;
    node.last = record;
  }

  uint32_t descend(uint32_t node, int i) {
    const uint32_t child = nodes_[node].child[i];
    if (child != kNone) return child;
    const auto added = static_cast<uint32_t>(nodes_.size());
    nodes_[node].child[i] = added;
    nodes_.push_back({});
    return added;
  }

  template <class Reach, class Visit>
  void visitNode(uint32_t node, const Box& box, const Bound3& region, const Reach& reach, const Visit& visit) const {
    const Node& here = nodes_[node];
    if (!box.touches(region, reach(here.largest))) return;
    for (uint32_t record = here.first; record != kNone; record = next_[record]) visit(record);
    for (int i = 0; i < 8; ++i)
      if (here.child[i] != kNone) visitNode(here.child[i], box.child(i), region, reach, visit);
  }

  Box root_;
  BlockVector<Node> nodes_;        ///< Most nodes hold a record or two, so memory counts.
  BlockVector<uint32_t> next_;     ///< The record that follows each one in the list of its node.
  std::vector<uint32_t> outside_;  ///< Records outside of the root box.
};

}  // namespace tomales
