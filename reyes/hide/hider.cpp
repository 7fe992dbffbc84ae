#include "reyes/base/check.h"
#include "reyes/hide/lattice.h"
#include "reyes/hide/raster.h"
#include "reyes/hide/resolve.h"
#include "reyes/hide/solids.h"

namespace tomales {
namespace {

constexpr size_t kManyGrids = 1024;

/// Key times of a grid as fractions of the shutter; none if it is still.
std::vector<float> shutterTimes(const Scene& scene, const Grid& grid) {
  if (grid.keyCount == 1) return {};
  std::vector<float> times = scene.objects[static_cast<size_t>(grid.object)].keyTimes;
  CHECK_EQ(static_cast<int>(times.size()), grid.keyCount);
  const float open = scene.options.shutterOpen, length = scene.options.shutterClose - open;
  for (float& t : times) t = (t - open) / length;
  return times;
}

}  // namespace

struct Hider::Impl {
  const Scene& scene;
  Camera camera;
  SampleBuffer samples;
  GridTable grids;
  size_t enough = kManyGrids;

  /// Grids that no sample sees any more make room, now and then.
  void dropUnseen() {
    if (grids.held() < enough) return;
    grids.keepOnly(samples.seen());
    enough = std::max(kManyGrids, 2 * grids.held());
  }
};

Hider::Hider(const Scene& scene, const Camera& camera, const SamplePattern& pattern, const PixelRect& rect)
    : impl_(new Impl{scene, camera, SampleBuffer(pattern, camera, rect), {}}) {}

Hider::~Hider() = default;

bool Hider::hidden(const Bound2& raster, float zMin) const {
  // Vertices are snapped.
  const vec2 reach(1 / kLattice);
  const SampleBuffer& s = impl_->samples;
  return s.hides(Bound2{raster.lo - reach, raster.hi + reach}, impl_->camera.leastDepthKey(zMin));
}

bool Hider::hidden(const RasterExtent& extent) const { return impl_->samples.hides(extent.bound, extent.dMin); }

void Hider::insert(const std::shared_ptr<const RasterGrid>& raster) {
  SampleBuffer& s = impl_->samples;
  if (hidden(*raster)) return;
  impl_->dropUnseen();
  const GridTable::Entry& entry = impl_->grids.add(raster, shutterTimes(impl_->scene, *raster->grid));
  s.films.beginGrid(), s.crossings.beginGrid();
  const RasterJob job{*raster, impl_->grids, entry.firstCell, entry.keyTimes, impl_->camera, s};
  if (raster->blur) {
    s.showBlur();
    rasterizeBlurred(job);
  } else if (raster->grid->round) {
    rasterizeRound(job);
  } else {
    rasterizeStill(job);
  }
  s.settle(s.touched(raster->bound.lo, raster->bound.hi));
}

DeepTile Hider::resolve() {
  const std::unique_ptr<Impl> spent = std::move(impl_);
  resolveSolids(spent->scene, spent->camera, spent->grids, spent->samples);
  return resolveTile(spent->scene, spent->camera, spent->grids, spent->samples);
}

}  // namespace tomales
