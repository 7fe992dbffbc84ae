// What a bucket meets on its way from the nearest to the farthest: geometry that is opened into smaller nodes by the
// first bucket that does not hide it (a procedural, an object, a run of its patches), and pieces, which are diced
// instead. Each is dropped when the last bucket that its bound touches is done, whether or not that bucket ever saw it
// (docs/decisions/0008). Threads: visit and release of different buckets are concurrent.
#pragma once
#include <mutex>
#include <queue>
#include <span>

#include "reyes/frame/bucket_grid.h"
#include "reyes/hide.h"
#include "reyes/shade.h"
#include "reyes/split.h"

namespace tomales {

/// Shared by all nodes of a frame, which it outlives.
struct HideContext {
  Scene& scene;
  const Camera& camera;
  ShadingSystem& shading;
  const BucketGrid& buckets;
  Stats& stats;
  Log& log;
  StopFlag cancelled = nullptr;
  Counter liveGrids_bytes{0}, liveGeometry_bytes{0};
  std::mutex growth{};  ///< Of the scene and its shaders.

  bool isCancelled() const { return cancelled && *cancelled; }
};

/// Notes of groups from `first` on whether their shaders want steps.
inline void markSteps(Scene& scene, const ShadingSystem& shading, size_t first) {
  for (size_t i = first; i < scene.groups.size(); ++i) scene.groups[i].steps = shading.wantsSteps(static_cast<int>(i));
}

class NodeQueue;

class HideNode {
 public:
  HideNode(const Placement& place, const BucketRange& range) : place_(place), range_(range) {}
  virtual ~HideNode() = default;
  HideNode(const HideNode&) = delete;

  const Bound2& raster() const { return place_.raster; }
  float zMin() const { return place_.zMin; }
  const BucketRange& range() const { return range_; }

  /// For a bucket in range() that does not hide it: puts what it is made of into the queue or the hider.
  virtual void visit(size_t bucket, NodeQueue& queue, Hider& hider) = 0;
  /// The bucket is resolved. Once for every bucket in range().
  virtual void release(size_t bucket) = 0;

 private:
  Placement place_;
  BucketRange range_;
};
using HideNodes = std::vector<std::unique_ptr<HideNode>>;

/// Nearest first; among equals, in the order of arrival.
class NodeQueue {
 public:
  /// For nodes that somebody else keeps, and for those that end when they have been visited.
  void push(HideNode* node) { push(std::shared_ptr<HideNode>(std::shared_ptr<void>(), node)); }
  void push(std::shared_ptr<HideNode> node) {
    const float zMin = node->zMin();
    queue_.push({zMin, next_++, std::move(node)});
  }
  /// Null: it is empty.
  std::shared_ptr<HideNode> pop() {
    if (queue_.empty()) return nullptr;
    std::shared_ptr<HideNode> node = queue_.top().node;
    queue_.pop();
    return node;
  }

 private:
  struct Entry {
    float zMin;
    uint32_t order;
    std::shared_ptr<HideNode> node;
    bool operator<(const Entry& o) const { return zMin != o.zMin ? zMin > o.zMin : order > o.order; }
  };
  std::priority_queue<Entry> queue_;
  uint32_t next_ = 0;
};

/// Nodes, and for every bucket of a range those that touch it.
class NodeList {
 public:
  NodeList(HideNodes nodes, const BucketRange& range, const BucketGrid& buckets);
  std::span<HideNode* const> in(size_t bucket) const {
    const size_t list = indexOf(bucket), first = list > 0 ? end_[list - 1] : 0;
    return std::span(entries_).subspan(first, end_[list] - first);
  }

 private:
  size_t indexOf(size_t bucket) const {
    return static_cast<size_t>((buckets_.row(bucket) - range_.r0) * range_.columns() + buckets_.column(bucket) -
                               range_.c0);
  }
  const HideNodes nodes_;
  const BucketRange range_;
  const BucketGrid& buckets_;
  std::vector<HideNode*> entries_;  ///< Of bucket after bucket of the range.
  std::vector<size_t> end_;         ///< Of a bucket's entries; they begin where those of the one before end.
};

/// A node for every object and procedural that the camera may see.
HideNodes nodesOfScene(HideContext& context);

/// The most that was alive at once.
void keepPeak(Counter& peak, int64_t now);

}  // namespace tomales
