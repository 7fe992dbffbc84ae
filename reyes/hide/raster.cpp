#include "reyes/hide/raster.h"

namespace tomales {

bool turnedAway(const RasterJob& job, int a) {
  const Grid& g = *job.raster.grid;
  const int row = g.nu + 1;
  const vec3 n = g.normal(a) + g.normal(a + 1) + g.normal(a + row) + g.normal(a + row + 1);
  const vec3 p = g.position(0, a) + g.position(0, a + 1) + g.position(0, a + row) + g.position(0, a + row + 1);
  return job.camera.perspective() ? dot(n, p) > 0 : n.z > 0;
}

void settleTies(const RasterJob& job, size_t firstLane, uint64_t lanes, uint32_t cell) {
  for (; lanes; lanes &= lanes - 1) {
    uint32_t& owner = job.out.cell[firstLane + static_cast<size_t>(std::countr_zero(lanes))];
    if (job.grids.precedes(cell, owner)) owner = cell;
  }
}

}  // namespace tomales
