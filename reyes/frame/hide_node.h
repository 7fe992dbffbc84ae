// The nodes that a bucket visits from the nearest to the farthest. A node is a procedural, an object, a run of its
// patches, or pieces. The first bucket that does not hide a node opens it into smaller nodes; pieces are diced instead.
// Each node is dropped when the last bucket that its bound touches is done, whether or not that bucket visited it
// (docs/decisions/0008). Threads: visit and release of different buckets are concurrent.
#pragma once
#include <mutex>
#include <queue>
#include <span>

#include "reyes/base/stop.h"
#include "reyes/frame/bucket_grid.h"
#include "reyes/hide.h"
#include "reyes/shade.h"
#include "reyes/split.h"

namespace tomales {

/// Data that all nodes of a frame share; it outlives them.
struct HideContext {
  Scene& scene;
  const Camera& camera;
  ShadingSystem& shading;
  const BucketGrid& buckets;
  Stats& stats;
  Log& log;
  StopToken stop{};
  Counter liveGrids_bytes{0}, liveGeometry_bytes{0};
  std::mutex growth{};  ///< Guards growth of the scene and its shaders.

  SplitContext splitting() const { return {scene, camera, buckets.window(), stats, log, stop}; }
};

/// Sets ShadeGroup::steps for the groups from `first` on.
inline void markSteps(Scene& scene, const ShadingSystem& shading, size_t first) {
  for (size_t i = first; i < scene.groups.size(); ++i)
    scene.groups[i].steps = shading.group(static_cast<int>(i)).wantsSteps();
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

  /// Puts the node's contents into the queue or the hider of a bucket. Pre: the bucket is in range() and does not hide
  /// the node.
  virtual void visit(size_t bucket, NodeQueue& queue, Hider& hider) = 0;
  /// Called once for every bucket in range(), when it is resolved.
  virtual void release(size_t bucket) = 0;

 private:
  Placement place_;
  BucketRange range_;
};
using HideNodes = std::vector<std::unique_ptr<HideNode>>;

/// The nearest node comes first; equal ones come in the order of arrival.
class NodeQueue {
 public:
  /// Pushes a node that is owned elsewhere.
  void push(HideNode* node) { push(std::shared_ptr<HideNode>(std::shared_ptr<void>(), node)); }
  /// Pushes a node that is destroyed after its visit.
  void push(std::shared_ptr<HideNode> node) {
    const float zMin = node->zMin();
    queue_.push({zMin, next_++, std::move(node)});
  }
  /// Returns null if the queue is empty.
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

/// Nodes, with a list for every bucket of a range: the nodes that touch the bucket.
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
  std::vector<HideNode*> entries_;  ///< The lists of all buckets of the range, one after the other.
  std::vector<size_t> end_;         ///< End of each bucket's list, where the next list begins.
};

/// Makes a node for every object and procedural that the camera may see.
HideNodes nodesOfScene(HideContext& context);

/// Raises a peak to the current value if that is larger.
void keepPeak(Counter& peak, int64_t now);

}  // namespace tomales
