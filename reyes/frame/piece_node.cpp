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
  if (--users_ == 0) drop();
}

void PieceNode::drop() {
  if (grid_) context_.liveGrids_bytes -= static_cast<int64_t>(grid_->grid->bytes());
  grid_.reset();
}

std::shared_ptr<const RasterGrid> PieceNode::makeGrid() const {
  const Object& o = context_.scene.objects[static_cast<size_t>(piece_.object)];
  auto grid = std::make_shared<Grid>(
      dice(context_.scene, piece_.object, piece_.patch, piece_.rect, piece_.nu, piece_.nv, static_cast<int>(o.keyTimes.size())));
  context_.shading.displace(*grid);
  Stats& stats = context_.stats;
  ++stats.geometry.gridsDiced;
  stats.geometry.micropolygonsDiced += grid->cellCount();

  for (int key = 0; key < grid->keyCount; ++key)
    for (int i = 0; i < grid->vertexCount(); ++i) {
      const vec3 p = grid->position(key, i);
      if (isFinite(p) && !(context_.camera.perspective() && p.z < context_.camera.eyePlane())) continue;
      context_.log.report(Severity::Warning, "grid-behind-eye", o.where,
                          fmt::format("{}: a displaced vertex is not finite or lies behind the eye; that grid is left out (is "
                                      "displacementbound too small?)",
                                      objectName(o)));
      return nullptr;
    }
  // Midpoints need what lies behind what is opaque.
  const bool hides = context_.shading.opaque(o.group) && context_.scene.options.depthFilter != DepthFilter::Midpoint;
  auto raster = project(std::move(grid), context_.scene, context_.camera, hides, zMin());
  keepPeak(stats.memoryBytes.grids, context_.liveGrids_bytes += static_cast<int64_t>(raster->grid->bytes()));
  return raster;
}

}  // namespace tomales
