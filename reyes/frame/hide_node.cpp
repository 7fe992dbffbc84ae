#include "reyes/frame/hide_node.h"

#include <map>
#include <numeric>

#include "reyes/frame/piece_node.h"

namespace tomales {
namespace {

/// Opened by the first bucket that asks what is in it.
class OpeningNode : public HideNode {
 public:
  OpeningNode(HideContext& context, const Placement& place, const BucketRange& range)
      : HideNode(place, range), context_(context), users_(range.count()) {}

  void visit(size_t bucket, NodeQueue& queue, Hider&) final {
    const std::lock_guard lock(mutex_);
    if (!inside_) {
      inside_ = std::make_unique<NodeList>(open(), range(), context_.buckets);
      for (const size_t done : doneBefore_)
        for (HideNode* node : inside_->in(done)) node->release(done);
      doneBefore_.clear();
    }
    for (HideNode* node : inside_->in(bucket)) queue.push(node);
  }

  void release(size_t bucket) final {
    const std::lock_guard lock(mutex_);
    if (!inside_)
      doneBefore_.push_back(bucket);
    else
      for (HideNode* node : inside_->in(bucket)) node->release(bucket);
    if (--users_ == 0) inside_.reset();
  }

 protected:
  virtual HideNodes open() = 0;
  HideContext& context_;

 private:
  std::mutex mutex_;
  std::unique_ptr<NodeList> inside_;
  std::vector<size_t> doneBefore_;  ///< Buckets that were done before it was opened.
  int users_;
};

/// A box of an object's PatchTree.
class PatchesNode : public OpeningNode {
 public:
  using Tree = std::shared_ptr<const PatchTree>;

  static std::unique_ptr<HideNode> make(HideContext& context, int object, Tree tree, uint32_t level, uint32_t index,
                                        const BucketRange& outer) {
    const Object& o = context.scene.objects[static_cast<size_t>(object)];
    auto place = placeBox(tree->box(level, index), o.cameraFromObject, o.keyTimes, o.displacementBound, context.camera,
                          context.buckets.window(), o.solid < 0);
    if (place && o.solid >= 0) place->zMin = context.zMinOfSolid[static_cast<size_t>(o.solid)];
    const BucketRange range = place ? outer & context.buckets.touched(place->raster) : BucketRange{};
    if (range.empty()) {
      ++context.stats.geometry.culled;
      return nullptr;
    }
    return std::unique_ptr<HideNode>(new PatchesNode(context, *place, range, object, std::move(tree), level, index));
  }

 private:
  PatchesNode(HideContext& context, const Placement& place, const BucketRange& range, int object, Tree tree, uint32_t level,
              uint32_t index)
      : OpeningNode(context, place, range), object_(object), tree_(std::move(tree)), level_(level), index_(index) {}

  HideNodes open() override {
    HideNodes out;
    if (level_ > 0) {
      const uint32_t first = index_ * PatchTree::kFan, last = std::min(first + PatchTree::kFan, tree_->count(level_ - 1));
      for (uint32_t i = first; i < last; ++i)
        if (auto node = make(context_, object_, tree_, level_ - 1, i, range())) out.push_back(std::move(node));
      return out;
    }
    for (SubPatch& piece : splitPatches(context_.scene, object_, tree_->patches(index_), context_.camera,
                                              context_.buckets.window(), context_.stats, context_.log)) {
      if (context_.scene.objects[static_cast<size_t>(object_)].solid >= 0) piece.zMin = zMin();
      const BucketRange touched = range() & context_.buckets.touched(piece.raster);
      if (!touched.empty()) out.push_back(std::make_unique<PieceNode>(context_, piece, touched));
    }
    return out;
  }

  const int object_;
  const Tree tree_;
  const uint32_t level_, index_;
};

}  // namespace

NodeList::NodeList(HideNodes nodes, const BucketRange& range, const BucketGrid& buckets)
    : nodes_(std::move(nodes)), range_(range), buckets_(buckets), end_(static_cast<size_t>(range.count()) + 1) {
  const auto forBuckets = [&](const HideNode& node, const auto& f) {
    const BucketRange& r = node.range();
    for (int row = r.r0; row <= r.r1; ++row)
      for (int column = r.c0; column <= r.c1; ++column)
        f(static_cast<size_t>((row - range_.r0) * range_.columns() + column - range_.c0));
  };
  for (const auto& node : nodes_) forBuckets(*node, [&](size_t list) { ++end_[list + 1]; });
  std::partial_sum(end_.begin(), end_.end(), end_.begin());
  entries_.resize(end_.back());
  // Filling moves each list's end, kept one place early, to where it belongs.
  for (const auto& node : nodes_) forBuckets(*node, [&](size_t list) { entries_[end_[list]++] = node.get(); });
}

HideNodes nodesOfScene(HideContext& context) {
  const std::vector<Object>& objects = context.scene.objects;
  std::map<std::vector<PrimPtr>, std::shared_ptr<const PatchTree>> trees;
  const auto takesPart = [](const Object& o) { return o.attributes->visibility.camera || o.solid >= 0; };
  context.zMinOfSolid.assign(context.scene.solids.size(), kInfinity);
  for (const Object& o : objects) {
    if (!takesPart(o)) continue;
    auto& tree = trees[o.shapes];
    if (!tree) tree = std::make_shared<const PatchTree>(o.shapes);
    if (o.solid < 0) continue;
    float& zMin = context.zMinOfSolid[static_cast<size_t>(o.solid)];
    if (const auto place = placeBox(tree->box(tree->top(), 0), o.cameraFromObject, o.keyTimes, o.displacementBound,
                                    context.camera, context.buckets.window(), false))
      zMin = std::min(zMin, place->zMin);
  }
  HideNodes out;
  for (size_t i = 0; i < objects.size(); ++i) {
    if (!takesPart(objects[i])) continue;
    ++context.stats.geometry.primitives;
    const auto& tree = trees[objects[i].shapes];
    if (auto node = PatchesNode::make(context, static_cast<int>(i), tree, tree->top(), 0, context.buckets.all()))
      out.push_back(std::move(node));
  }
  return out;
}

void keepPeak(Counter& peak, int64_t now) {
  for (int64_t seen = peak; now > seen && !peak.compare_exchange_weak(seen, now);) {
  }
}

}  // namespace tomales
