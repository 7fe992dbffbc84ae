#include "reyes/hide/raster.h"

namespace tomales {

void settleTies(const RasterJob& job, size_t firstLane, uint64_t lanes, uint32_t cell) {
  for (; lanes; lanes &= lanes - 1) {
    uint32_t& owner = job.out.cell[firstLane + static_cast<size_t>(std::countr_zero(lanes))];
    if (job.grids.precedes(cell, owner)) owner = cell;
  }
}

}  // namespace tomales
