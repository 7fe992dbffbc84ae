#include "reyes/hide/raster.h"

namespace tomales {

void settleTies(const RasterJob& job, size_t firstLane, uint64_t lanes, uint32_t cell) {
  for (; lanes; lanes &= lanes - 1) {
    uint32_t& owner = job.out.cell[firstLane + static_cast<size_t>(std::countr_zero(lanes))];
    if (job.grids.precedes(cell, owner)) owner = cell;
  }
}

void noteDepthConflict(const RasterJob& job, size_t firstLane, uint64_t lanes, float depthError) {
  constexpr size_t kMost = 1 << 20;  // further conflicts of coincident surfaces add no information
  const int object = job.raster.grid->object;
  for (; lanes && job.out.depthConflicts.size() < kMost; lanes &= lanes - 1) {
    const size_t lane = firstLane + static_cast<size_t>(std::countr_zero(lanes));
    const uint32_t owner = job.out.cell[lane];
    const int other = owner == kNoCell ? object : job.grids.of(owner).grid().object;
    if (other != object)
      job.out.depthConflicts.push_back({static_cast<uint32_t>(lane), std::min(object, other), std::max(object, other),
                                        job.out.depth[lane] - depthError});
  }
}

}  // namespace tomales
