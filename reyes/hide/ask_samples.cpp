// What only a sample can answer: which level of detail it sees, and where a clipping plane cuts.
#include "reyes/hide/raster.h"

namespace tomales {

void askSamples(const RasterJob& job, int x, int y, size_t lane, LaneDepths& hit) {
  const RasterGrid& raster = job.raster;
  const SampleBuffer& samples = job.out;
  for (size_t s = 0; s < kLanes; ++s) {
    if (hit.d[s] == kInfinity) continue;
    const size_t k = lane + s;
    const vec2 at(static_cast<float>(x) + samples.x[k], static_cast<float>(y) + samples.y[k]);
    if (!raster.detail.contains(samples.detail[k]) ||
        (raster.clipped && job.camera.clips(at, {samples.lensX[k], samples.lensY[k]}, hit.d[s])))
      hit.d[s] = kInfinity;
  }
}

}  // namespace tomales
