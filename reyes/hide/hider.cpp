#include <tuple>

#include "reyes/base/check.h"
#include "reyes/hide/raster.h"
#include "reyes/hide/resolve.h"
#include "reyes/hide/solids.h"
#include "reyes/hide/subpixel.h"
#include "reyes/hide/unseen.h"

namespace tomales {
namespace {

constexpr size_t kManyGrids = 1024;

/// Key times of a grid as fractions of the shutter; empty if it is still.
std::vector<float> shutterTimes(const Scene& scene, const Grid& grid) {
  if (grid.keyCount == 1) return {};
  std::vector<float> times = scene.objects[static_cast<size_t>(grid.object)].keyTimes;
  CHECK_EQ(static_cast<int>(times.size()), grid.keyCount);
  const float open = scene.options.shutterOpen, length = scene.options.shutterClose - open;
  for (float& t : times) t = (t - open) / length;
  return times;
}

const Attributes& attributesOf(const Scene& scene, const Grid& grid) {
  return *scene.objects[static_cast<size_t>(grid.object)].attributes;
}

/// Returns TransparentLayer::object for a grid's layers.
int joinedObject(const RasterGrid& raster) {
  return raster.reaching.empty() || raster.blur || raster.inSolid ? -1 : raster.grid->object;
}

/// Counts the depth conflicts whose winner is still visible.
void countSamePlaces(SampleBuffer& samples, const GridTable& grids, int samplesPerPixel, HideDiagnostics& diagnostics) {
  constexpr int kShare = 4;
  const auto width = static_cast<uint32_t>(samples.lanes);
  std::vector<DepthConflict>& depthConflicts = samples.depthConflicts;
  std::erase_if(depthConflicts, [&](const DepthConflict& c) {
    const int seen = grids.of(samples.cell[c.lane]).grid().object;
    return (seen != c.first && seen != c.second) || samples.depth[c.lane] < c.least;
  });
  // Conflicts of a pixel and two objects are sorted together, each sample once.
  const auto keyOf = [width](const DepthConflict& c) { return std::tuple(c.lane / width, c.first, c.second); };
  std::sort(depthConflicts.begin(), depthConflicts.end(), [&](const DepthConflict& a, const DepthConflict& b) {
    return std::pair(keyOf(a), a.lane) < std::pair(keyOf(b), b.lane);
  });
  depthConflicts.erase(std::unique(depthConflicts.begin(), depthConflicts.end()), depthConflicts.end());
  for (auto at = depthConflicts.begin(); at != depthConflicts.end();) {
    const auto end =
        std::find_if(at, depthConflicts.end(), [&](const DepthConflict& c) { return keyOf(c) != keyOf(*at); });
    if (kShare * (end - at) >= samplesPerPixel) ++diagnostics.samePlaces[{at->first, at->second}];
    at = end;
  }
}

}  // namespace

struct Hider::Impl {
  const Scene& scene;
  Camera camera;
  SampleBuffer samples;
  int samplesPerPixel;
  GridTable grids{};
  size_t enough = kManyGrids;
  std::vector<uint32_t> unseen{};  ///< Cells that are shaded whether or not a sample sees them.

  /// Frees grids that no sample sees any more, from time to time.
  void dropUnseen() {
    if (grids.held() < enough) return;
    std::vector<uint32_t> wanted = samples.seen();
    wanted.insert(wanted.end(), unseen.begin(), unseen.end());
    std::sort(wanted.begin(), wanted.end());
    grids.keepOnly(wanted);
    enough = std::max(kManyGrids, 2 * grids.held());
  }
};

Hider::Hider(const Scene& scene, const Camera& camera, const SamplePattern& pattern, const PixelRect& rect)
    : impl_(new Impl{scene, camera, SampleBuffer(pattern, camera, rect), pattern.count()}) {}

Hider::~Hider() = default;

bool Hider::hidden(const Bound2& raster, float zMin) const {
  // The lattice moves vertices by at most this.
  const vec2 reach(1 / kSubpixels);
  const SampleBuffer& s = impl_->samples;
  return s.hides(Bound2{raster.lo - reach, raster.hi + reach}, impl_->camera.leastDepthKey(zMin));
}

bool Hider::hidden(const RasterExtent& extent) const { return impl_->samples.hides(extent.bound, extent.dMin); }

void Hider::insert(const std::shared_ptr<const RasterGrid>& raster) {
  SampleBuffer& s = impl_->samples;
  if (hidden(*raster)) return;
  impl_->dropUnseen();
  const GridTable::Entry& entry = impl_->grids.add(raster, shutterTimes(impl_->scene, *raster->grid));
  if (raster->keepsUnseen)
    addUnseen(entry, attributesOf(impl_->scene, *raster->grid).cull.backfacing, s.rect, impl_->unseen);
  s.layers.beginGrid(joinedObject(*raster));
  s.crossings.beginGrid();
  const RasterJob job{*raster, impl_->grids, entry.firstCell, entry.keyTimes, impl_->camera, s};
  if (raster->blur) {
    s.addTimesAndLens();
    rasterizeBlurred(job);
  } else if (raster->grid->round) {
    rasterizeRound(job);
  } else {
    rasterizeStill(job);
  }
  s.settle(s.touched(raster->bound.lo, raster->bound.hi));
}

DeepTile Hider::resolve(HideDiagnostics* diagnostics) {
  const std::unique_ptr<Impl> spent = std::move(impl_);
  resolveSolids(spent->scene, spent->camera, spent->grids, spent->samples);
  if (diagnostics) countSamePlaces(spent->samples, spent->grids, spent->samplesPerPixel, *diagnostics);
  std::sort(spent->unseen.begin(), spent->unseen.end(),
            [&](uint32_t a, uint32_t b) { return spent->grids.precedes(a, b); });
  return resolveTile(spent->scene, spent->camera, spent->grids, spent->samples, spent->unseen, diagnostics);
}

}  // namespace tomales
