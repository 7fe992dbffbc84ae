#include "reyes/frame/piece_node.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "reyes/dice.h"

namespace tomales {

namespace {

constexpr int kSmall_cells = 64;  ///< Pieces with fewer share a node,
constexpr int kBlock_buckets = 4;  ///< if they begin in the same square of buckets.

TOMALES_HOT bool allSeeable(const Grid& g, int key, const Camera& camera) {
  const float *x = g.P(key, 0), *y = g.P(key, 1), *z = g.P(key, 2);
  int unseeable = 0;
  for (int v = 0, count = g.vertexCount(); v < count; ++v) unseeable |= !camera.seeable({x[v], y[v], z[v]});
  return unseeable == 0;
}

struct Neighbour {
  int row, column;  ///< Of a square of buckets.
  const SubPatch* piece;
  bool operator<(const Neighbour& o) const { return row != o.row ? row < o.row : column < o.column; }
};

}  // namespace

PieceNode::PieceNode(HideContext& context, std::span<const SubPatch* const> pieces, const Placement& place, const BucketRange& range)
    : HideNode(place, range), context_(context), users_(range.count()) {
  pieces_.reserve(pieces.size());
  for (const SubPatch* piece : pieces) pieces_.push_back({*piece, range & context.buckets.touched(piece->raster)});
}

void PieceNode::visit(size_t bucket, NodeQueue&, Hider& hider) {
  const int column = context_.buckets.column(bucket), row = context_.buckets.row(bucket);
  for (Piece& piece : pieces_) {
    const BucketRange& r = piece.range;
    if (column < r.c0 || column > r.c1 || row < r.r0 || row > r.r1) continue;
    if (pieces_.size() > 1 && hider.hidden(piece.patch.raster, piece.patch.zMin)) continue;
    if (const auto grid = acquire(piece)) hider.insert(grid);
  }
}

std::shared_ptr<const RasterGrid> PieceNode::acquire(Piece& piece) {
  const std::lock_guard lock(mutex_);
  if (!piece.made) piece.grid = makeGrid(piece.patch);
  piece.made = true;
  return piece.grid;
}

void PieceNode::release(size_t) {
  const std::lock_guard lock(mutex_);
  if (--users_ > 0) return;
  pieces_.clear();
  pool_.reset();
}

std::shared_ptr<const RasterGrid> PieceNode::makeGrid(const SubPatch& piece) {
  const Object& o = context_.scene.objects[static_cast<size_t>(piece.object)];
  if (!pool_) pool_ = makePool();
  const size_t before = pool_->bytes();
  auto grid = std::allocate_shared<Grid>(
      KeepingPool<Grid>(pool_),
      dice(context_.scene, piece.object, piece.patch, piece.rect, piece.nu, piece.nv, {o.keyTimes, o.cameraFromObject}, pool_.get()));
  context_.shading.displace(*grid);
  Stats& stats = context_.stats;
  ++stats.geometry.gridsDiced;
  stats.geometry.micropolygonsDiced += grid->cellCount();

  if (leaveOutUnseeable(*grid) && !piece.crossesEye)
    context_.log.report(Severity::Warning, "grid-behind-eye", o.where,
                        fmt::format("{}: displaced vertices are not finite or lie behind the eye; the micropolygons there are "
                                    "left out (is displacementbound too small?)",
                                    objectName(o)));
  // Midpoints need what lies behind what is opaque.
  const bool hides = context_.shading.opaque(o.group) && context_.scene.options.depthFilter != DepthFilter::Midpoint;
  auto raster = project(std::move(grid), context_.scene, context_.camera, hides, piece.zMin, pool_);
  keepPeak(stats.memoryBytes.grids, context_.liveGrids_bytes += static_cast<int64_t>(pool_->bytes() - before));
  return raster;
}

std::shared_ptr<Pool> PieceNode::makePool() const {
  // A vertex takes a dozen floats without motion and primitive variables, and a grid about as much as this without vertices.
  constexpr size_t kVertex_bytes = 48, kGrid_bytes = 768, kMost_bytes = 2048;
  size_t bytes = 0;
  for (const Piece& p : pieces_) bytes += kGrid_bytes + kVertex_bytes * static_cast<size_t>(padded((p.patch.nu + 1) * (p.patch.nv + 1)));
  return {new Pool(std::min(bytes, kMost_bytes)), [&live = context_.liveGrids_bytes](const Pool* pool) {
            live -= static_cast<int64_t>(pool->bytes());
            delete pool;
          }};
}

bool PieceNode::leaveOutUnseeable(Grid& g) const {
  bool all = true;
  for (int key = 0; key < g.keyCount; ++key) all &= allSeeable(g, key, context_.camera);
  if (all) return false;
  const int row = g.nu + 1;
  bool any = false;
  for (int v = 0; v < g.vertexCount(); ++v) {
    bool good = true;
    for (int key = 0; key < g.keyCount; ++key) good &= context_.camera.seeable(g.position(key, v));
    if (good) continue;
    any = true;
    g.kept.resize(static_cast<size_t>(g.cellCount()), Kept::All);
    const int i = v % row, j = v / row;
    for (int cj = std::max(j - 1, 0); cj <= std::min(j, g.nv - 1); ++cj)
      for (int ci = std::max(i - 1, 0); ci <= std::min(i, g.nu - 1); ++ci)
        g.kept[static_cast<size_t>(cj * g.nu + ci)] = Kept::None;
  }
  return any;
}

HideNodes pieceNodes(HideContext& context, std::span<const SubPatch> pieces, const BucketRange& within) {
  HideNodes out;
  std::vector<Neighbour> small;
  for (const SubPatch& piece : pieces) {
    const BucketRange touched = within & context.buckets.touched(piece.raster);
    if (touched.empty()) continue;
    if (piece.nu * piece.nv < kSmall_cells)
      small.push_back({touched.r0 / kBlock_buckets, touched.c0 / kBlock_buckets, &piece});
    else
      out.push_back(std::make_unique<PieceNode>(context, std::array{&piece}, Placement{piece.raster, piece.zMin}, touched));
  }
  std::stable_sort(small.begin(), small.end());
  std::vector<const SubPatch*> together;
  for (auto begin = small.begin(), end = begin; begin != small.end(); begin = end) {
    end = std::upper_bound(begin, small.end(), *begin);
    together.clear();
    Placement place{{}, kInfinity};
    for (const Neighbour& n : std::span(begin, end)) {
      together.push_back(n.piece);
      place.raster.extend(n.piece->raster.lo), place.raster.extend(n.piece->raster.hi);
      place.zMin = std::min(place.zMin, n.piece->zMin);
    }
    std::stable_sort(together.begin(), together.end(), [](const SubPatch* a, const SubPatch* b) { return a->zMin < b->zMin; });
    out.push_back(std::make_unique<PieceNode>(context, together, place, within & context.buckets.touched(place.raster)));
  }
  return out;
}

}  // namespace tomales
