// Private to gi/cache: an octree of numbered records. Each lies in the node that matches its radius (Ward et
// al. 1988). The radius within which a record is valid depends on the lookup (Tabellion and Lamorlette 2004, eq. 3) and
// grows with the record's size, so each node knows the size of its largest record. A lookup passes by many records that
// do not reach it. So the tree keeps what tells that, and the records themselves, which are ten times as large, stay
// out of the processor's cache.
#pragma once
#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <vector>

#include "gi/cache/octree_box.h"
#include "reyes/base/block_vector.h"
#include "reyes/base/math.h"

namespace tomales {

class RecordTree {
 public:
  /// `bound` should hold all records; records outside of it still work, only slower.
  explicit RecordTree(const Bound3& bound) : root_(OctreeBox::around(bound)) { nodes_.push_back({}); }

  /// Adds the record whose number is the count of those before. `radius` is how far it reaches for places of its own
  /// pixel size.
  void insert(const vec3& position, float size, float radius, float limit) {
    const auto record = static_cast<uint32_t>(entries_.size());
    entries_.push_back({position, size, limit, kNone});
    if (!root_.contains(position)) return outside_.push_back(record);
    OctreeBox box = root_;
    uint32_t node = 0;
    for (int depth = 0; depth < kMaxDepth && box.half >= radius; ++depth) {
      const unsigned i = box.childIndex(position);
      box = box.child(i);
      node = descend(node, i, size);
    }
    append(nodes_[node], record);
  }

  /// Replaces the limit of a record, beyond which it does not reach.
  void limit(uint32_t record, float limit) { entries_[record].limit = limit; }

  /// Calls visit(record), in any order, for all records that lie within their reach of `region`. reach(size) is the
  /// validity radius of a record of that size, and it may not fall with the size. Records reach no farther than
  /// `ofLimit` times their limits.
  template <class Reach, class Visit>
  void visit(const Bound3& region, const Reach& reach, float ofLimit, const Visit& visit) const {
    const auto visitEntry = [&](uint32_t record) {
      const Entry& entry = entries_[record];
      const vec3 off = entry.position - glm::clamp(entry.position, region.lo, region.hi);
      const float radius = std::min(reach(entry.size), ofLimit * entry.limit);
      if (dot(off, off) <= radius * radius) visit(record);
      return entry.next;
    };
    for (const uint32_t record : outside_) visitEntry(record);
    visitNode(0, root_, region, reach, visitEntry);
  }

 private:
  static constexpr int kMaxDepth = 24;
  static constexpr uint32_t kNone = ~uint32_t{0};

  struct Node {
    uint32_t first = kNone, last = kNone;  ///< Ends of a linked list of records.
    uint32_t children = 0;                 ///< A bit for each child that there is.
    uint32_t child[8];
    float largest[8];  ///< Sizes of the largest records of each child and of all below it.
  };

  struct Entry {
    vec3 position;
    float size, limit;
    uint32_t next;  ///< The record that follows in the list of its node.
  };

  void append(Node& node, uint32_t record) {
    (node.first == kNone ? node.first : entries_[node.last].next) = record;
    node.last = record;
  }

  uint32_t descend(uint32_t node, unsigned i, float size) {
    if (nodes_[node].children >> i & 1) {
      nodes_[node].largest[i] = std::max(nodes_[node].largest[i], size);
    } else {
      nodes_[node].children |= 1u << i;
      nodes_[node].largest[i] = size;
      nodes_[node].child[i] = static_cast<uint32_t>(nodes_.size());
      nodes_.push_back({});
    }
    return nodes_[node].child[i];
  }

  /// Returns the squared distances of a region from the halves below and above the center of a box, for each axis.
  static std::array<vec3, 2> distances2(const OctreeBox& box, const Bound3& region) {
    const vec3 half(box.half), none(0.0f);
    const vec3 below = glm::max(glm::max(region.lo - box.center, box.center - half - region.hi), none),
               above = glm::max(glm::max(region.lo - (box.center + half), box.center - region.hi), none);
    return {below * below, above * above};
  }

  template <class Reach, class VisitEntry>
  void visitNode(uint32_t node, const OctreeBox& box, const Bound3& region, const Reach& reach,
                 const VisitEntry& visit) const {
    const Node& here = nodes_[node];
    for (uint32_t record = here.first; record != kNone;) record = visit(record);
    const std::array<vec3, 2> away = distances2(box, region);
    for (uint32_t left = here.children; left != 0; left &= left - 1) {
      const auto i = static_cast<unsigned>(std::countr_zero(left));
      const float distance2 = away[i & 1u].x + away[(i >> 1) & 1u].y + away[i >> 2].z, radius = reach(here.largest[i]);
      if (distance2 <= radius * radius) visitNode(here.child[i], box.child(i), region, reach, visit);
    }
  }

  OctreeBox root_;
  BlockVector<Node> nodes_;  ///< There are nearly as many as records, so memory counts.
  BlockVector<Entry> entries_;
  std::vector<uint32_t> outside_;  ///< Records outside of the root box.
};

}  // namespace tomales
