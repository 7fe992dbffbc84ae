// Trim curves, asked sample by sample: their edge is as smooth as any outline, at any shading rate.
#include "reyes/hide/raster.h"
#include "reyes/hide/resolve.h"

namespace tomales {

void cutAway(const RasterJob& job, uint32_t cell, int x, int y, size_t lane, LaneDepths& hit) {
  const GridTable::Entry& entry = job.grids.of(cell);
  const RasterGrid& raster = job.raster;
  const Grid& g = *raster.grid;
  const int index = static_cast<int>(cell - entry.firstCell);
  const SampleBuffer& samples = job.out;
  const float r = raster.trimReach_px;
  for (size_t s = 0; s < kLanes; ++s) {
    if (hit.d[s] == kInfinity) continue;
    const size_t k = lane + s;
    const vec2 at(static_cast<float>(x) + samples.x[k], static_cast<float>(y) + samples.y[k]);
    const auto keeps = [&](const vec2& point) {
      const SamplePoint sample{point, samples.time[k], {samples.lensX[k], samples.lensY[k]}};
      const vec2 uv = g.onPatch(index, positionOnCell(entry, job.camera, index, sample));
      return raster.trim->keeps(g.patch, uv.x, uv.y);
    };
    // The surfaces on both sides of a trim curve are chords of it: each reaches out by its own error, so that they meet.
    if (!keeps(at) && !keeps(at + vec2(r, 0)) && !keeps(at - vec2(r, 0)) && !keeps(at + vec2(0, r)) &&
        !keeps(at - vec2(0, r)))
      hit.d[s] = kInfinity;
  }
}

}  // namespace tomales
