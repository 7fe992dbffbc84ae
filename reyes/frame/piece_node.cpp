#include "reyes/frame/piece_node.h"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

#include "reyes/dice.h"
#include "reyes/displacement_outputs.h"

namespace tomales {

namespace {

constexpr int kLeastCellsOfOwnNode = 256;  ///< Pieces with fewer cells share a node if they begin in the same bucket.
constexpr int kMostVerticesOfStack = 512;  ///< Grids of a node are stacked up to about this many vertices.
/// A piece with more vertices is not stacked: too many would be diced for one that is visible.
constexpr int kMostVerticesOfStackedPiece = 64;

TOMALES_HOT bool allSeeable(const Grid& g, int key, const Camera& camera) {
  const float *x = g.P(key, 0), *y = g.P(key, 1), *z = g.P(key, 2);
  int unseeable = 0;
  for (int v = 0, count = g.vertexCount(); v < count; ++v) unseeable |= !camera.seeable({x[v], y[v], z[v]});
  return unseeable == 0;
}

/// Tells whether the piece may share a grid. It may not if a decision for a whole grid would differ for it.
bool canStack(const HideContext& context, const SubPatch& piece) {
  const Object& o = context.scene.objects[static_cast<size_t>(piece.object)];
  return standsStillInFocus(o, context.camera) && !piece.crossesEye &&
         o.shape().kept(piece.patch, piece.rect) == Kept::All;
}

/// Widens a cell from a square with the disk's area to the square around the disk.
void widenToSquares(Grid& g) {
  const float more = 2 / std::sqrt(kPi) - 1;
  for (int axis = 0; axis < 3; ++axis)
    for (int p = 0; p < g.pieceCount(); ++p) {
      float* at = g.P(0, axis) + 4 * p;
      const float middle = 0.25f * (at[0] + at[1] + at[2] + at[3]);
      for (int v = 0; v < 4; ++v) at[v] += more * (at[v] - middle);
    }
}

/// The properties that pieces of a node, or of a grid, must have in common, as numbers.
struct Neighbour {
  uint64_t first, last;  ///< The first and the last bucket that it touches.
  uint64_t shape;        ///< Counts of cells; is it round?
  const SubPatch* piece;

  Neighbour(const BucketRange& touched, const SubPatch& p)
      : first(number(touched.r0, touched.c0)),
        last(number(touched.r1, touched.c1)),
        shape(number(p.nu, 2 * p.nv + p.round)),
        piece(&p) {}
  bool sharesNode(const Neighbour& o) const { return first == o.first && last == o.last; }
  bool sharesGrid(const Neighbour& o) const { return sharesNode(o) && shape == o.shape; }
  bool operator<(const Neighbour& o) const {
    return first != o.first ? first < o.first : last != o.last ? last < o.last : shape < o.shape;
  }

 private:
  static uint64_t number(int a, int b) { return static_cast<uint64_t>(a) << 32 | static_cast<uint32_t>(b); }
};

PieceStack alone(const SubPatch& p) {
  return {p.object, p.nu, p.nv, {{p.patch, p.rect}}, {p.raster, p.zMin}, p.crossesEye, p.round};
}

void extend(Placement& place, const Placement& by) {
  place.raster.extend(by.raster.lo);
  place.raster.extend(by.raster.hi);
  place.zMin = std::min(place.zMin, by.zMin);
}

/// Makes the stacks of neighbours that share a node, nearest first. Pre: neighbours that may share a grid are adjacent.
std::vector<PieceStack> stacksOf(const HideContext& context, std::span<const Neighbour> neighbours) {
  std::vector<PieceStack> out;
  const Neighbour* last = nullptr;
  for (const Neighbour& n : neighbours) {
    const SubPatch& p = *n.piece;
    const int vertices = (p.nu + 1) * (p.nv + 1);
    const auto most = static_cast<size_t>(std::max(1, kMostVerticesOfStack / vertices));
    const bool stacks = vertices <= kMostVerticesOfStackedPiece && canStack(context, p);
    if (last && stacks && n.sharesGrid(*last) && out.back().pieces.size() < most) {
      out.back().pieces.push_back({p.patch, p.rect});
      extend(out.back().place, {p.raster, p.zMin});
    } else {
      out.push_back(alone(p));
    }
    last = stacks ? &n : nullptr;
  }
  std::stable_sort(out.begin(), out.end(),
                   [](const PieceStack& a, const PieceStack& b) { return a.place.zMin < b.place.zMin; });
  return out;
}

}  // namespace

PieceNode::PieceNode(HideContext& context, std::vector<PieceStack> stacks, const Placement& place,
                     const BucketRange& range)
    : HideNode(place, range), context_(context), users_(range.count()) {
  stacks_.reserve(stacks.size());
  for (PieceStack& s : stacks) {
    const BucketRange touched = range & context.buckets.touched(s.place.raster);
    stacks_.emplace_back(std::move(s), touched);
  }
}

void PieceNode::visit(size_t bucket, NodeQueue&, Hider& hider) {
  const int column = context_.buckets.column(bucket), row = context_.buckets.row(bucket);
  for (Stack& stack : stacks_) {
    const BucketRange& r = stack.range;
    if (column < r.c0 || column > r.c1 || row < r.r0 || row > r.r1) continue;
    if (stacks_.size() > 1 && hider.hidden(stack.pieces.place.raster, stack.pieces.place.zMin)) continue;
    // This test does not touch the grid, which may be far away in memory.
    if (stack.made.load(std::memory_order_acquire) && hider.hidden(stack.extent)) continue;
    if (const auto grid = acquire(stack)) hider.insert(grid);
  }
}

std::shared_ptr<const RasterGrid> PieceNode::acquire(Stack& stack) {
  const std::lock_guard lock(mutex_);
  if (!stack.made.load(std::memory_order_relaxed)) {
    stack.grid = makeGrid(stack.pieces);
    stack.extent = *stack.grid;
    stack.wanted = bitsOf(stack.range & context_.buckets.touched(stack.extent.bound));
    stack.made.store(true, std::memory_order_release);
  }
  return stack.grid;
}

void PieceNode::release(size_t bucket) {
  const std::lock_guard lock(mutex_);
  done_ |= bitsOf(context_.buckets.only(bucket)) & ~kFarBuckets;
  for (Stack& stack : stacks_)
    if (!(stack.wanted & ~done_)) stack.grid.reset();
  if (--users_ == 0) stacks_.clear();
}

uint64_t PieceNode::bitsOf(const BucketRange& buckets) const {
  uint64_t bits = 0;
  for (int row = buckets.r0; row <= buckets.r1; ++row)
    for (int column = buckets.c0; column <= buckets.c1; ++column) {
      const int number = (row - range().r0) * range().columns() + column - range().c0;
      bits |= number < 63 ? uint64_t{1} << number : kFarBuckets;
    }
  return bits;
}

std::shared_ptr<const RasterGrid> PieceNode::makeGrid(const PieceStack& stack) {
  const Object& o = context_.scene.objects[static_cast<size_t>(stack.object)];
  const std::shared_ptr<Pool> pool = makePool(stack);
  auto grid =
      std::allocate_shared<Grid>(KeepingPool<Grid>(pool), dice(context_.scene, stack.object, stack.pieces, stack.nu,
                                                               stack.nv, {o.keyTimes, o.cameraFromObject}, pool.get()));
  if ((grid->round = stack.round)) widenToSquares(*grid);
  context_.shading.displace(*grid);
  Stats& stats = context_.stats;
  ++stats.geometry.gridsDiced;
  stats.geometry.micropolygonsDiced += grid->cellCount();

  if (leaveOutUnseeable(*grid) && !stack.crossesEye)
    context_.log.report(
        Severity::Warning, "grid-behind-eye", o.where,
        fmt::format("{}: displaced vertices are not finite or lie behind the eye; the micropolygons there are "
                    "left out (is displacementbound too small?)",
                    objectName(o)));
  auto raster = project(std::move(grid), context_.scene, context_.camera, context_.shading.group(o.group).opaque(),
                        stack.place.zMin, pool);
  keepPeak(stats.memoryBytes.grids, context_.liveGrids_bytes += static_cast<int64_t>(pool->bytes()));
  return raster;
}

std::shared_ptr<Pool> PieceNode::makePool(const PieceStack& stack) const {
  // These are estimates, which decide how much memory the pool asks for at a time. A vertex takes eleven floats. Each
  // motion key after the first takes six more, and the vertex's share of a tree of boxes (reyes/hide/blur_bounds.h), in
  // which each level has a quarter of the boxes of the one below: 4/3 of a box. Primitive variables are added below.
  constexpr size_t kVertex_bytes = 44, kKey_bytes = 72, kGrid_bytes = 1088;
  const Object& o = context_.scene.objects[static_cast<size_t>(stack.object)];
  size_t vertex_bytes = kVertex_bytes + kKey_bytes * (o.keyTimes.size() - 1);
  const int floats = floatsOfPoint(o.shape().primvars()) + displacementFloats(*o.attributes);
  vertex_bytes += static_cast<size_t>(floats) * sizeof(float);
  const auto vertices =
      static_cast<size_t>(padded(static_cast<int>(stack.pieces.size()) * (stack.nu + 1) * (stack.nv + 1)));
  const size_t bytes = kGrid_bytes + vertex_bytes * vertices;
  return {new Pool(bytes), [&live = context_.liveGrids_bytes](const Pool* pool) {
            live -= static_cast<int64_t>(pool->bytes());
            delete pool;
          }};
}

bool PieceNode::leaveOutUnseeable(Grid& g) const {
  bool all = true;
  for (int key = 0; key < g.keyCount; ++key) all &= allSeeable(g, key, context_.camera);
  if (all) return false;
  const int row = g.nu + 1, rows = g.nv + 1;
  bool any = false;
  for (int v = 0; v < g.vertexCount(); ++v) {
    bool good = true;
    for (int key = 0; key < g.keyCount; ++key) good &= context_.camera.seeable(g.position(key, v));
    if (good) continue;
    any = true;
    g.kept.resize(static_cast<size_t>(g.cellNumbers()), Kept::All);
    const int i = v % row, j = v / row % rows, first = v / row - j;
    for (int cj = std::max(j - 1, 0); cj <= std::min(j, g.nv - 1); ++cj)
      for (int ci = std::max(i - 1, 0); ci <= std::min(i, g.nu - 1); ++ci)
        g.kept[static_cast<size_t>((first + cj) * g.nu + ci)] = Kept::None;
  }
  return any;
}

HideNodes pieceNodes(HideContext& context, std::span<const SubPatch> pieces, const BucketRange& within) {
  HideNodes out;
  std::vector<Neighbour> small;
  for (const SubPatch& piece : pieces) {
    const BucketRange touched = within & context.buckets.touched(piece.raster);
    if (touched.empty()) continue;
    if (piece.nu * piece.nv < kLeastCellsOfOwnNode)
      small.emplace_back(touched, piece);
    else
      out.push_back(std::make_unique<PieceNode>(context, std::vector{alone(piece)}, Placement{piece.raster, piece.zMin},
                                                touched));
  }
  std::stable_sort(small.begin(), small.end());
  for (auto begin = small.begin(), end = begin; begin != small.end(); begin = end) {
    end = std::find_if(begin, small.end(), [&](const Neighbour& n) { return !n.sharesNode(*begin); });
    Placement place{{}, kInfinity};
    std::vector<PieceStack> stacks = stacksOf(context, {begin, end});
    for (const PieceStack& s : stacks) extend(place, s.place);
    out.push_back(
        std::make_unique<PieceNode>(context, std::move(stacks), place, within & context.buckets.touched(place.raster)));
  }
  return out;
}

}  // namespace tomales
