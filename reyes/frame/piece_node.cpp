#include "reyes/frame/piece_node.h"

#include <fmt/format.h>

#include "reyes/dice.h"

namespace tomales {

void PieceNode::visit(size_t, NodeQueue&, Hider& hider) {
  if (const auto grid = acquire()) hider.insert(grid);
}

std::shared_ptr<const RasterGrid> PieceNode::acquire() {
  const std::lock_guard lock(mutex_);
  if (!made_) grid_ = makeGrid();
  made_ = true;
  return grid_;
}

void PieceNode::release(size_t) {
  const std::lock_guard lock(mutex_);
  if (--users_ == 0) grid_.reset();
}

std::shared_ptr<const RasterGrid> PieceNode::makeGrid() const {
  const Object& o = context_.scene.objects[static_cast<size_t>(piece_.object)];
  auto grid = std::make_shared<Grid>(
      dice(context_.scene, piece_.object, piece_.patch, piece_.rect, piece_.nu, piece_.nv, static_cast<int>(o.keyTimes.size())));
  context_.shading.displace(*grid);
  Stats& stats = context_.stats;
  ++stats.geometry.gridsDiced;
  stats.geometry.micropolygonsDiced += grid->cellCount();

  if (leaveOutUnseeable(*grid) && !piece_.crossesEye)
    context_.log.report(Severity::Warning, "grid-behind-eye", o.where,
                        fmt::format("{}: displaced vertices are not finite or lie behind the eye; the micropolygons there are "
                                    "left out (is displacementbound too small?)",
                                    objectName(o)));
  // Midpoints need what lies behind what is opaque.
  const bool hides = context_.shading.opaque(o.group) && context_.scene.options.depthFilter != DepthFilter::Midpoint;
  auto raster = project(std::move(grid), context_.scene, context_.camera, hides, zMin());
  const auto bytes = static_cast<int64_t>(raster->grid->bytes());
  keepPeak(stats.memoryBytes.grids, context_.liveGrids_bytes += bytes);
  // Hiders keep grids longer than nodes do.
  return {raster.get(), [raster, bytes, &live = context_.liveGrids_bytes](const RasterGrid*) { live -= bytes; }};
}

bool PieceNode::leaveOutUnseeable(Grid& g) const {
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

}  // namespace tomales
