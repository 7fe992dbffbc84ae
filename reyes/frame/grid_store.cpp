#include "reyes/frame/grid_store.h"

#include <fmt/format.h>

#include "reyes/dice.h"

namespace tomales {

GridStore::GridStore(std::vector<SubPatch> pieces, const Scene& scene, const Camera& camera, const ShadingSystem& shading,
                     Stats& stats, Log& log)
    : pieces_(std::move(pieces)), slots_(pieces_.size()), scene_(scene), camera_(camera), shading_(shading), stats_(stats),
      log_(log) {}

std::shared_ptr<const RasterGrid> GridStore::make(const SubPatch& piece) {
  const Object& o = scene_.objects[static_cast<size_t>(piece.object)];
  auto grid = std::make_shared<Grid>(
      dice(scene_, piece.object, piece.patch, piece.rect, piece.nu, piece.nv, static_cast<int>(o.keyTimes.size())));
  shading_.displace(*grid);
  ++stats_.geometry.gridsDiced;
  stats_.geometry.micropolygonsDiced += grid->cellCount();

  for (int key = 0; key < grid->keyCount; ++key)
    for (int i = 0; i < grid->vertexCount(); ++i) {
      const vec3 p = grid->position(key, i);
      if (isFinite(p) && !(camera_.perspective() && p.z < camera_.nearClip())) continue;
      log_.report(Severity::Warning, "grid-behind-eye", o.where,
                  fmt::format("{}: a displaced vertex is not finite or lies behind the eye; that grid is left out (is "
                              "displacementbound too small?)",
                              objectName(o)));
      return nullptr;
    }
  auto raster = project(std::move(grid), scene_, camera_, shading_.opaque(o.group));
  keepPeak(live_bytes_ += static_cast<int64_t>(raster->grid->bytes()));
  return raster;
}

void GridStore::keepPeak(int64_t bytes) {
  Counter& peak = stats_.memoryBytes.grids;
  for (int64_t seen = peak; bytes > seen && !peak.compare_exchange_weak(seen, bytes);) {
  }
}

std::shared_ptr<const RasterGrid> GridStore::acquire(uint32_t i) {
  Slot& slot = slots_[i];
  const std::lock_guard lock(slot.mutex);
  if (!slot.made) {
    slot.grid = make(pieces_[i]);
    slot.made = true;
  }
  return slot.grid;
}

void GridStore::release(uint32_t i) {
  Slot& slot = slots_[i];
  const std::lock_guard lock(slot.mutex);
  if (--slot.users > 0 || !slot.grid) return;
  live_bytes_ -= static_cast<int64_t>(slot.grid->grid->bytes());
  slot.grid.reset();
}

}  // namespace tomales
