#include <array>
#include <bit>
#include <unordered_set>

#include "gi/state.h"
#include "reyes/base/parallel.h"
#include "reyes/base/rng.h"

namespace tomales {
namespace {

constexpr int kLastPhases = 8;  // for points beyond the first of each pixel, in the order of a hash
constexpr int kPhases = kLatticePhases + kLastPhases;
constexpr float kEnough = 0.05f;  // sum of weights below which a point gets its own record
constexpr size_t kPointsPerSlice = 256;

struct PointRef {
  int tile, batch, point;
};
using Phases = std::array<std::vector<PointRef>, kPhases>;

struct Site {
  GatherPoint point;
  size_t cache;
};

class GatherPass {
 public:
  GatherPass(GiState& state, const DeepFrame& frame) : state_(state), frame_(frame) {}

  void run(const std::function<void(float)>& progress, const std::atomic<bool>* cancelled) {
    progress_ = &progress, cancelled_ = cancelled;
    prepareCaches();
    if (state_.caches.empty()) return;
    const Phases phases = collect();
    for (phase_ = 0; phase_ < kPhases && !isCancelled(); ++phase_)
      refine(phases[static_cast<size_t>(phase_)]);
  }

 private:
  static constexpr size_t kNoCache = ~size_t{0};

  bool isCancelled() const { return cancelled_ && cancelled_->load(std::memory_order_relaxed); }

  // Groups whose indirect lights ask for the same share a cache. With maxerror 0 nothing could be reused.
  void prepareCaches() {
    cacheOfGroup_.assign(state_.scene.groups.size(), kNoCache);
    const Bound3 bound = frameBound();
    for (size_t g = 0; g < cacheOfGroup_.size(); ++g) {
      const int group = static_cast<int>(g);
      const IndirectQuery* query = state_.shading.indirectQuery(group);
      const Attributes& attributes = *state_.scene.groups[g].attributes;
      if (!query || !attributes.indirect.receive || attributes.matte) continue;
      const GatherPlan plan = planFor(state_, group, *query);
      if (!(plan.cache.kappa < kInfinity)) continue;
      size_t c = 0;
      while (c < state_.caches.size() && !(state_.caches[c].plan == plan)) ++c;
      if (c == state_.caches.size()) state_.caches.push_back({plan, IrradianceCache(bound, plan.cache)});
      cacheOfGroup_[g] = c;
    }
  }

  Bound3 frameBound() const {
    Bound3 bound;
    for (const DeepTile& tile : frame_.tiles)
      for (const ShadePoints& batch : tile.batches)
        for (int i = 0; i < batch.count(); ++i) bound.extend(batch.position(i));
    return bound;
  }

  // In the order of pixels, whatever the buckets are. A point that several pixels or buckets see counts where
  // it comes first.
  Phases collect() const {
    Phases phases;
    for (int y = frame_.padded.y0; y < frame_.padded.y1; ++y)
      for (int x = frame_.padded.x0; x < frame_.padded.x1; ++x) collectPixel(x, y, phases);
    std::unordered_set<uint64_t> seen;
    for (auto& phase : phases)
      std::erase_if(phase, [&](const PointRef& ref) {
        const ShadePoints& batch = batchOf(ref);
        return !seen.insert(static_cast<uint64_t>(batch.group()) << 32 | batch.key(ref.point)).second;
      });
    return phases;
  }

  void collectPixel(int x, int y, Phases& phases) const {
    const DeepTile& tile = frame_.tileAt(x, y);
    if (tile.pixels.empty()) return;  // the frame was interrupted
    const int tileIndex = static_cast<int>(&tile - frame_.tiles.data());
    const DeepPixel& pixel = tile.pixel(x, y);
    bool first = true;
    for (uint32_t f = pixel.first; f < pixel.first + pixel.count; ++f) {
      const Facet& facet = tile.facets[tile.fragments[f].facet];
      const ShadePoints& batch = tile.batches[static_cast<size_t>(facet.batch)];
      if (cacheOfGroup_[static_cast<size_t>(batch.group())] == kNoCache) continue;
      for (int corner = 0; corner < 4; ++corner) {
        const int point = facet.point[corner];
        if (corner > 0 && point == facet.point[0]) continue;
        const int phase = first ? latticePhase(x, y)
                                : kLatticePhases + static_cast<int>(hash32(batch.key(point)) % kLastPhases);
        phases[static_cast<size_t>(phase)].push_back({tileIndex, facet.batch, point});
        first = false;
      }
    }
  }

  const ShadePoints& batchOf(const PointRef& ref) const {
    return frame_.tiles[static_cast<size_t>(ref.tile)].batches[static_cast<size_t>(ref.batch)];
  }

  Site siteOf(const PointRef& ref) const {
    const ShadePoints& batch = batchOf(ref);
    const vec3 position = batch.position(ref.point), normal = batch.facingNormal(ref.point);
    return {{batch.group(), position, normal, batch.key(ref.point), projectedPixelSize(state_.camera, position, normal),
             batch.edgeLength(ref.point), batch.get3(kDriftX, ref.point), batch.channel(kTime)[ref.point]},
            cacheOfGroup_[static_cast<size_t>(batch.group())]};
  }

  // One phase: which points the records of earlier phases leave without, their records, and only then the
  // insertion.
  void refine(const std::vector<PointRef>& points) {
    const std::vector<Site> sites = uncovered(points);
    if (!sites.empty() && !tools_) tools_ = gatherTools(state_);
    if (sites.empty() || !tools_) return report(1);
    std::vector<IrradianceRecord> records(sites.size());
    size_t done = 0;
    for (; done < sites.size() && !isCancelled(); done = std::min(done + kPointsPerSlice, sites.size())) {
      report(static_cast<float>(done) / static_cast<float>(sites.size()));
      const size_t count = std::min(kPointsPerSlice, sites.size() - done);
      parallelFor(count, 1, [&](size_t begin, size_t end) {
        for (size_t i = done + begin; i < done + end; ++i) records[i] = gatherAt(sites[i]);
      });
    }
    for (size_t i = 0; i < done; ++i) state_.caches[sites[i].cache].cache.insert(records[i]);
    state_.stats.irradianceCache.samples += static_cast<int64_t>(done);
    report(1);
  }

  std::vector<Site> uncovered(const std::vector<PointRef>& points) const {
    std::vector<uint8_t> covered(points.size());
    parallelFor(points.size(), kPointsPerSlice, [&](size_t begin, size_t end) {
      for (size_t i = begin; i < end; ++i) {
        const auto [p, cache] = siteOf(points[i]);
        const IrradianceEstimate known = state_.caches[cache].cache.lookup(p.position, p.normal, p.pixelSize);
        covered[i] = known.weight >= kEnough && (!known.disputed || state_.cachesGiven);  // what was given is appended to, not refined
      }
    });
    std::vector<Site> sites;
    for (size_t i = 0; i < points.size(); ++i)
      if (!covered[i]) sites.push_back(siteOf(points[i]));
    return sites;
  }

  IrradianceRecord gatherAt(const Site& site) const {
    return gather(*tools_->rays, *tools_->shading, site.point, state_.caches[site.cache].plan.gather, state_.stats);
  }

  void report(float fractionOfPhase) const {
    if (*progress_) (*progress_)((static_cast<float>(phase_) + fractionOfPhase) / kPhases);
  }

  GiState& state_;
  const DeepFrame& frame_;
  const RayTools* tools_ = nullptr;
  std::vector<size_t> cacheOfGroup_;
  const std::function<void(float)>* progress_ = nullptr;
  const std::atomic<bool>* cancelled_ = nullptr;
  int phase_ = 0;
};

}  // namespace

int latticePhase(int x, int y) {
  const int level = std::min(std::countr_zero(static_cast<unsigned>(x | y)), 4);
  if (level == 4) return 0;
  const int half = 1 << level;
  return 1 + 2 * (3 - level) + (x & y & half ? 0 : 1);
}

void fillCaches(GiState& state, const DeepFrame& frame, const std::function<void(float)>& progress,
                const std::atomic<bool>* cancelled) {
  GatherPass(state, frame).run(progress, cancelled);
}

}  // namespace tomales
