#include "reyes/frame/hide_node.h"

#include <map>
#include <numeric>
#include <set>

#include "reyes/base/stop.h"
#include "reyes/frame/piece_node.h"
#include "reyes/frame/procedural_bound.h"
#include "reyes/scattered.h"

namespace tomales {
namespace {

/// A node of at most kSmall_px, with kDense patches per pixel or more, is opened by every bucket separately. If buckets
/// shared its contents, far more of them than can be seen would wait for the next row of buckets.
constexpr float kDense = 4, kSmall_px = 32;
/// A box of particles of this level or below opens into all their pieces at once, so that each bucket has enough pieces
/// to fill grids; the pieces of a single leaf are scattered over several buckets. This applies only to a middle number
/// of particles per pixel: fewer are large, and more hide each other, so not all need to be opened.
constexpr uint32_t kLevelOfParticles = 2;
constexpr float kFewParticles = 1.0f / 64, kManyParticles = 1;

/// The way in which a node is opened. Shared: once, by the first bucket that needs its contents. Transient: by each
/// bucket separately. AtOnce: as Transient, but its contents bypass the queue, where pieces of many small adjacent
/// objects would wait for each other.
enum class Opening : uint8_t { Shared, Transient, AtOnce };

/// Returns a box in the space of an object or procedural, with its motion.
template <class Body>
MovingBox movingBox(const Body& body, const Bound3& box) {
  return {box, body.cameraFromObject, body.keyTimes, body.displacementBound};
}

/// Tells whether all of an object is visited, even hidden parts: the visible surface of a solid depends on all its
/// pieces.
bool isVisitedWhole(const Object& o) { return o.solid >= 0 || !o.attributes->cull.hidden; }

class OpeningNode : public HideNode {
 public:
  OpeningNode(HideContext& context, const Placement& place, const BucketRange& range, Opening opening)
      : HideNode(place, range), context_(context), opening_(opening), users_(range.count()) {}

  void visit(size_t bucket, NodeQueue& queue, Hider& hider) final {
    if (opening_ != Opening::Shared) {
      for (auto& node : open(context_.buckets.only(bucket)))
        if (opening_ == Opening::Transient)
          queue.push(std::shared_ptr<HideNode>(std::move(node)));
        else if (!hider.hidden(node->raster(), node->zMin()))
          node->visit(bucket, queue, hider);
      return;
    }
    const std::lock_guard lock(mutex_);
    if (!inside_) {
      inside_ = std::make_unique<NodeList>(open(range()), range(), context_.buckets);
      for (const size_t done : doneBefore_)
        for (HideNode* node : inside_->in(done)) node->release(done);
      doneBefore_.clear();
    }
    for (HideNode* node : inside_->in(bucket)) queue.push(node);
  }

  void release(size_t bucket) final {
    if (opening_ != Opening::Shared) return;
    const std::lock_guard lock(mutex_);
    if (!inside_)
      doneBefore_.push_back(bucket);
    else
      for (HideNode* node : inside_->in(bucket)) node->release(bucket);
    if (--users_ > 0) return;
    const bool opened = inside_ != nullptr;
    inside_.reset();
    if (opened) close();
  }

 protected:
  /// Called when the last bucket is done with the contents from open().
  virtual void close() {}
  /// Returns the contents that touch the given buckets.
  virtual HideNodes open(const BucketRange& within) = 0;
  HideContext& context_;

 private:
  const Opening opening_;
  std::mutex mutex_;
  std::unique_ptr<NodeList> inside_;
  std::vector<size_t> doneBefore_;  ///< Buckets that were done before it was opened.
  int users_;
};

/// Makes nodes for the pieces that touch the buckets. zMin: the nearest z of their node.
HideNodes nodesOfPieces(HideContext& context, std::vector<SubPatch> pieces, float zMin, const BucketRange& within);

/// A piece of very many grids.
class CoarseNode : public OpeningNode {
 public:
  CoarseNode(HideContext& context, const SubPatch& piece, const BucketRange& range)
      : OpeningNode(context, {piece.raster, piece.zMin}, range,
                    range.count() == 1 ? Opening::Transient : Opening::Shared),
        piece_(piece) {}

 private:
  HideNodes open(const BucketRange& within) override {
    return nodesOfPieces(context_, splitPiece(context_.splitting(), piece_), zMin(), within);
  }

  const SubPatch piece_;
};

HideNodes nodesOfPieces(HideContext& context, std::vector<SubPatch> pieces, float zMin, const BucketRange& within) {
  for (SubPatch& piece : pieces)
    if (isVisitedWhole(context.scene.objects[static_cast<size_t>(piece.object)])) piece.zMin = zMin;
  const auto coarse = std::stable_partition(pieces.begin(), pieces.end(), [](const SubPatch& p) { return !p.coarse; });
  HideNodes out = pieceNodes(context, {pieces.begin(), coarse}, within);
  for (auto piece = coarse; piece != pieces.end(); ++piece) {
    const BucketRange touched = within & context.buckets.touched(piece->raster);
    if (!touched.empty()) out.push_back(std::make_unique<CoarseNode>(context, *piece, touched));
  }
  return out;
}

/// A box of an object's PatchTree.
class PatchesNode : public OpeningNode {
 public:
  using Tree = std::shared_ptr<const PatchTree>;

  /// nearest: the z of all pieces of an object that is visited whole, so that none is skipped before all are hidden. It
  /// is the nearest z of the object's solid, or -infinity, which nothing hides, if unseen micropolygons are kept.
  static std::unique_ptr<HideNode> make(HideContext& context, int object, Tree tree, uint32_t level, uint32_t index,
                                        const BucketRange& outer, float nearest) {
    const Object& o = context.scene.objects[static_cast<size_t>(object)];
    auto place = placeBox(movingBox(o, tree->box(level, index)), context.camera, context.buckets.window(),
                          o.solid < 0 ? Clipping::On : Clipping::Off);
    if (place && isVisitedWhole(o)) place->zMin = nearest;
    const BucketRange range = place ? outer & context.buckets.touched(place->raster) : BucketRange{};
    if (range.empty()) {
      ++context.stats.geometry.culled;
      return nullptr;
    }
    return std::unique_ptr<HideNode>(new PatchesNode(context, *place, range, object, std::move(tree), level, index));
  }

 private:
  PatchesNode(HideContext& context, const Placement& place, const BucketRange& range, int object, Tree tree,
              uint32_t level, uint32_t index)
      : OpeningNode(context, place, range, openingOf(place.raster, range, *tree, level)),
        object_(object),
        tree_(std::move(tree)),
        level_(level),
        index_(index) {}

  static Opening openingOf(const Bound2& raster, const BucketRange& range, const PatchTree& tree, uint32_t level) {
    if (isDense(raster, tree, level)) return level == 0 ? Opening::AtOnce : Opening::Transient;
    return range.count() == 1 ? Opening::Transient : Opening::Shared;
  }

  static bool isDense(const Bound2& b, const PatchTree& tree, uint32_t level) {
    const vec2 size = b.hi - b.lo;
    return std::max(size.x, size.y) <= kSmall_px && patchesIn(tree, level) >= kDense * size.x * size.y;
  }
  static float patchesIn(const PatchTree& tree, uint32_t level) {
    return static_cast<float>(std::min<size_t>(PatchTree::patchesOfBox(level), tree.patchCount()));
  }
  bool opensAtOnce() const {
    if (level_ == 0) return true;
    const vec2 size = raster().hi - raster().lo;
    const float inPixel = patchesIn(*tree_, level_) / (size.x * size.y);
    return level_ <= kLevelOfParticles && inPixel >= kFewParticles && inPixel <= kManyParticles &&
           dynamic_cast<const Scattered*>(&context_.scene.objects[static_cast<size_t>(object_)].shape());
  }

  HideNodes open(const BucketRange& within) override {
    HideNodes out;
    if (!opensAtOnce()) {
      const uint32_t first = index_ * PatchTree::kFan,
                     last = std::min(first + PatchTree::kFan, tree_->count(level_ - 1));
      for (uint32_t i = first; i < last; ++i)
        if (auto node = make(context_, object_, tree_, level_ - 1, i, within, zMin())) out.push_back(std::move(node));
      return out;
    }
    return nodesOfPieces(context_,
                         splitPatches(context_.splitting(), object_, tree_->patches(level_, index_), Splitting::Lazily),
                         zMin(), within);
  }

  const int object_;
  const Tree tree_;
  const uint32_t level_, index_;
};

/// Makes nodes of the objects that the camera may see, or that cut visible ones; instances share a tree. Pre: `objects`
/// has all parts of each solid.
HideNodes nodesOf(HideContext& context, const std::vector<int>& objects, const BucketRange& within) {
  std::map<std::vector<PrimPtr>, std::shared_ptr<const PatchTree>> trees;
  std::map<int, float> zOfSolid;
  const auto objectAt = [&](int i) -> const Object& { return context.scene.objects[static_cast<size_t>(i)]; };
  std::vector<int> seen;
  for (const int i : objects) {
    const Object& o = objectAt(i);
    if (o.solid < 0 && !o.attributes->visibility.camera) continue;
    seen.push_back(i);
    auto& tree = trees[o.shapes];
    if (!tree) tree = std::make_shared<const PatchTree>(o.shapes, context.stop);
    if (o.solid < 0) continue;
    float& z = zOfSolid.try_emplace(o.solid, kInfinity).first->second;
    if (const auto place =
            placeBox(movingBox(o, tree->box(tree->top(), 0)), context.camera, context.buckets.window(), Clipping::Off))
      z = std::min(z, place->zMin);
  }
  HideNodes out;
  for (const int i : seen) {
    ++context.stats.geometry.primitives;
    const Object& o = objectAt(i);
    const auto& tree = trees[o.shapes];
    const float z = o.solid >= 0 ? zOfSolid[o.solid] : -kInfinity;
    if (auto node = PatchesNode::make(context, i, tree, tree->top(), 0, within, z)) out.push_back(std::move(node));
  }
  return out;
}

int64_t bytesOf(const std::set<PrimPtr>& shapes) {
  size_t bytes = 0;
  for (const PrimPtr& shape : shapes) bytes += shape->bytes();
  return static_cast<int64_t>(bytes);
}

class ProceduralNode : public OpeningNode {
 public:
  static std::unique_ptr<HideNode> make(HideContext& context, const Procedural& procedural, const BucketRange& outer) {
    const Procedural& p = procedural;
    auto place = placeBox(movingBox(p, p.bound), context.camera, context.buckets.window());
    if (place && !p.attributes->cull.hidden) place->zMin = -kInfinity;
    const BucketRange range = place ? outer & context.buckets.touched(place->raster) : BucketRange{};
    if (range.empty()) return nullptr;
    return std::unique_ptr<HideNode>(new ProceduralNode(context, *place, range, p));
  }

 private:
  ProceduralNode(HideContext& context, const Placement& place, const BucketRange& range, const Procedural& procedural)
      : OpeningNode(context, place, range, Opening::Shared), procedural_(procedural) {}

  HideNodes open(const BucketRange& within) override {
    Expansion inside;
    try {
      inside = context_.scene.expanded(procedural_);
    } catch (const Stopped&) {  // the bucket is given up like all others that are not finished
      return {};
    }
    checkProceduralBound(procedural_, inside, context_.log);
    std::set<PrimPtr> shapes;
    for (const Object& o : inside.objects) shapes.insert(o.shapes.begin(), o.shapes.end());
    bytes_ = bytesOf(shapes);
    keepPeak(context_.stats.memoryBytes.geometry, context_.liveGeometry_bytes += bytes_);
    {
      const std::lock_guard lock(context_.growth);
      const size_t known = context_.scene.groups.size();
      objects_ = context_.scene.add(inside);
      context_.shading.bindNewGroups();
      markSteps(context_.scene, context_.shading, known);
    }
    HideNodes out = nodesOf(context_, objects_, within);
    for (const Procedural& p : inside.procedurals)
      if (auto node = make(context_, p, within)) out.push_back(std::move(node));
    return out;
  }

  void close() override {
    context_.liveGeometry_bytes -= bytes_;
    const std::lock_guard lock(context_.growth);
    for (const int object : objects_) context_.scene.drop(object);
  }

  const Procedural procedural_;
  std::vector<int> objects_;
  int64_t bytes_ = 0;
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
  // Filling moves each list's end, which began one place early, to its final place.
  for (const auto& node : nodes_) forBuckets(*node, [&](size_t list) { entries_[end_[list]++] = node.get(); });
}

HideNodes nodesOfScene(HideContext& context) {
  std::vector<int> objects(context.scene.objects.size());
  std::iota(objects.begin(), objects.end(), 0);
  std::set<PrimPtr> shapes;
  for (const Object& o : context.scene.objects) shapes.insert(o.shapes.begin(), o.shapes.end());
  HideNodes out = nodesOf(context, objects, context.buckets.all());
  keepPeak(context.stats.memoryBytes.geometry, context.liveGeometry_bytes += bytesOf(shapes));
  for (const Procedural& p : context.scene.procedurals)
    if (auto node = ProceduralNode::make(context, p, context.buckets.all())) out.push_back(std::move(node));
  return out;
}

void keepPeak(Counter& peak, int64_t now) {
  for (int64_t seen = peak; now > seen && !peak.compare_exchange_weak(seen, now);) {
  }
}

}  // namespace tomales
