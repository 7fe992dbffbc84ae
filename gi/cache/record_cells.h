// Private to gi/cache: an octree of the records of a cache that no longer changes. Each leaf lists all
// records that may serve a place in it, so a lookup of one place goes down once. In a RecordTree, which can grow, it
// passes by ten times as many nodes and records. Threads: find() may be called concurrently.
#pragma once
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "gi/cache/octree_box.h"
#include "gi/cache/vicinity.h"

namespace tomales {

class RecordCells {
 public:
  /// Returns the greatest distance at which a record serves places whose pixels have at most this size.
  using ReachOf = std::function<float(const RecordReach&, float pixelSize)>;
  /// Returns the greatest size of pixels that lookups in a box have.
  using MostPixels = std::function<float(const Bound3&)>;

  /// `records` are numbered by their order.
  RecordCells(const Bound3& bound, std::vector<RecordReach> records, const ReachOf& reach, const MostPixels& pixels);

  /// Returns the numbers of all records that may serve a place, in their order, or nothing if the leaf does not hold
  /// for this size of pixels.
  std::optional<std::span<const uint32_t>> find(const vec3& position, float pixelSize) const;
  const RecordReach& operator[](uint32_t record) const { return records_[record]; }
  /// Returns the length of all lists together.
  size_t listed() const { return lists_.size(); }

 private:
  struct Node {
    uint32_t first;    ///< Of a leaf: the place of its list in lists_. Else its first child; the others follow.
    uint32_t count;    ///< The number of records of a leaf, or kInner.
    float mostPixels;  ///< A leaf's list holds up to this size of pixels.
  };

  void divide(uint32_t node, const OctreeBox& box, std::span<const uint32_t> inParent, int depth, const ReachOf& reach,
              const MostPixels& pixels);

  OctreeBox root_;
  std::vector<RecordReach> records_;
  std::vector<Node> nodes_;
  std::vector<uint32_t> lists_;
};

}  // namespace tomales
