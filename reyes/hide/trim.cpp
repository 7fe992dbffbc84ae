// Tests that are made sample by sample, so that edges are smooth at any shading rate: trim curves, clipping planes and
// levels of detail.
#include "reyes/hide/raster.h"
#include "reyes/hide/resolve.h"

namespace tomales {

bool keepsSample(const RasterJob& job, uint32_t cell, size_t lane) {
  const GridTable::Entry& entry = job.grids.of(cell);
  const RasterGrid& raster = job.raster;
  const Grid& g = *raster.grid;
  const int index = static_cast<int>(cell - entry.firstCell);
  if (!raster.detail.contains(job.out.detail(lane))) return false;
  const SamplePoint sample = samplePoint(job.out, lane);
  if (raster.clipped && job.camera.clips(sample.at, sample.lens, depthOnCell(entry, job.camera, index, sample)))
    return false;
  if (!raster.trim) return true;
  const auto keeps = [&](const vec2& offset) {
    SamplePoint moved = sample;
    moved.at += offset;
    const vec2 uv = g.onPatch(index, positionOnCell(entry, job.camera, index, moved));
    return raster.trim->keeps(g.pieces[static_cast<size_t>(g.pieceOfCell(index))].patch, uv.x, uv.y);
  };
  // The surfaces on both sides of a trim curve have chords of it as edges. Each reaches out by its own error, so that
  // they meet.
  const float r = raster.trimReach_px;
  return keeps({0, 0}) || keeps({r, 0}) || keeps({-r, 0}) || keeps({0, r}) || keeps({0, -r});
}

uint64_t keptLanes(const RasterJob& job, uint32_t cell, size_t firstLane, uint64_t lanes) {
  uint64_t kept = 0;
  for (uint64_t left = lanes; left; left &= left - 1)
    if (keepsSample(job, cell, firstLane + static_cast<size_t>(std::countr_zero(left)))) kept |= left & (~left + 1);
  return kept;
}

}  // namespace tomales
