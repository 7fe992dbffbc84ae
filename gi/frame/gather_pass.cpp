#include <algorithm>
#include <chrono>
#include <mutex>
#include <numeric>
#include <optional>
#include <unordered_set>

#include "gi/cache/amendments/switches.h"
#include "gi/frame/cache_keys.h"
#include "gi/frame/frame_caches.h"
#include "gi/frame/gather_pass.h"
#include "gi/frame/gather_tile.h"
#include "gi/frame/record_fields.h"
#include "gi/frame/record_slices.h"
#include "gi/gather/occluders.h"
#include "reyes/base/parallel.h"
#include "reyes/base/process.h"
#include "reyes/base/rng.h"
#include "reyes/base/stop.h"

namespace tomales {
namespace {

constexpr int kPilotPhases = 3;  // Bright spots are learnt from the records of these phases.
// Records of this many rays or more all have the same directions. Their errors are then a smooth function of the place,
// and no greater than with different directions (docs/decisions/0095).
constexpr int kManyRays = 512;
// Pilot records, which look for bright spots, have this many times fewer rays, with directions of their own.
constexpr int kRaysPerPilotRay = 4;

/// Returns the stride of the lattice that this phase completes; 0: it completes none.
int strideAfter(int phase) { return phase < kLatticePhases && phase % 2 == 0 ? 16 >> phase / 2 : 0; }

struct Site {
  GatherPoint point;
  size_t cache;
  int x, y;  ///< The pixel that sees it.
};

template <class A>
void fields(A& a, Site& x) {
  auto& [point, cache, pixelX, pixelY] = x;
  each(a, point, cache, pixelX, pixelY);
}

class GatherPass {
 public:
  GatherPass(GiState& state, const DeepFrame& layout, const TileReader& tiles)
      : state_(state),
        layout_(layout),
        tiles_(tiles),
        slices_(state.checkpoint, KeptKind::GatherRecords),
        caches_(state) {}

  void run(const std::function<void(float)>& progress, StopToken stop, const std::function<void(int stride)>& covered) {
    progress_ = &progress;
    stop_ = stop;
    if (!prepareCaches() || !(tools_ = gatherTools(state_))) return;
    for (phase_ = 0; phase_ < kGatherPhases && !stop_.requested(); ++phase_) {
      std::vector<Site> sites = uncovered();
      if (phase_ == 0) prepareBounces(sites);
      gatherSites(std::move(sites));
      returnFreeMemory();  // tiles are unpacked between allocations that stay
      const int stride = strideAfter(phase_);
      if (covered && stride > 1 && !stop_.requested()) covered(stride);
    }
    if (!stop_.requested()) caches_.rememberFrame();
  }

 private:
  const GatherSettings& gatherOf(size_t cache) const { return state_.caches[cache].key.gather; }
  bool isLight(size_t cache) const { return !gatherOf(cache).isOcclusion(); }
  bool isIndirect(size_t cache) const { return !gatherOf(cache).asked; }

  // Returns false if there is nothing to gather.
  bool prepareCaches() {
    if (!caches_.prepare(layout_, tiles_, stop_)) return false;
    sites_.resize(state_.caches.size());
    std::vector<uint8_t> gathers;
    for (const std::vector<size_t>& caches : caches_.ofGroups()) gathers.push_back(!caches.empty());
    gatherTiles_.emplace(state_, tiles_, layout_.tileCount(), std::move(gathers));
    return true;
  }

  bool isAnew(const Site& s) const { return state_.anew && state_.anew->contains(s.x, s.y); }

  /// The indirect lights that the groups of this frame ask.
  struct AskedLights {
    int bounces = 1;                       ///< The most that one of them follows.
    const IndirectQuery* first = nullptr;  ///< The query of the first group that asks.
  };
  AskedLights askedLights() const {
    AskedLights out;
    for (size_t g = 0; g < caches_.ofGroups().size(); ++g)
      for (const size_t c : caches_.ofGroups()[g])
        if (isIndirect(c)) {
          const IndirectQuery* own = state_.shading.group(static_cast<int>(g)).indirectQuery();
          if (!out.first) out.first = own;
          out.bounces = std::max(out.bounces, bouncesFor(state_, *own));
        }
    return out;
  }

  // Every gather point may look the bounce caches up. So the records there have as many rays, and as long ones, as any
  // cache asks for, whichever pixel comes first. Pre: some cache is of an indirect light.
  GatherSettings gatherOfBounces(const IndirectQuery& query) const {
    size_t first = 0;
    while (!isIndirect(first)) ++first;
    GatherSettings out = gatherOf(first);
    out.subset = query.subset;  // not that of the first group's attributes: each record has its own object's
    for (size_t c = first; c < state_.caches.size(); ++c) {
      if (!isIndirect(c)) continue;
      out.samples = std::max(out.samples, gatherOf(c).samples);
      out.maxDistance = std::max(out.maxDistance, gatherOf(c).maxDistance);
    }
    return out;
  }

  void prepareBounces(const std::vector<Site>& sites) {
    const AskedLights asked = askedLights();
    std::vector<GatherPoint> points;
    for (const Site& s : sites)
      if (isIndirect(s.cache)) points.push_back(s.point);
    if (asked.bounces == 1 || points.empty()) return;
    const auto start = std::chrono::steady_clock::now();
    const double raysBefore = state_.stats.lightRays();
    state_.learnt->bounces.fill(*tools_, state_.camera, points, gatherOfBounces(*asked.first), asked.bounces,
                                {state_.stats, stop_, state_.checkpoint, state_.groups});
    state_.bounceCost = {state_.stats.lightRays() - raysBefore,
                         std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count()};
  }

  // Returns the points of this phase that no earlier record serves, in the order of pixels, whatever the buckets are. A
  // point that several pixels or buckets see counts where it comes first.
  std::vector<Site> uncovered() {
    std::vector<Site> sites;
    if (takeSites(sites)) return sites;
    std::mutex merging;
    parallelFor(layout_.tileCount(), 1, [&](size_t t, size_t) {
      const auto tile = stop_.requested() ? nullptr : gatherTiles_->read(t);
      if (!tile) return;
      std::vector<Site> here;
      collectTile(*tile, here);
      const std::lock_guard lock(merging);
      sites.insert(sites.end(), here.begin(), here.end());
    });
    std::stable_sort(sites.begin(), sites.end(),
                     [](const Site& a, const Site& b) { return a.y != b.y ? a.y < b.y : a.x < b.x; });
    std::erase_if(sites, [&](const Site& s) { return !sites_[s.cache].insert(keyOf(s)).second; });
    if (state_.checkpoint && !stop_.requested())
      state_.checkpoint->keep(KeptKind::GatherSites, static_cast<size_t>(phase_), sites);
    return sites;
  }

  static uint64_t keyOf(const Site& s) { return static_cast<uint64_t>(s.point.group) << 32 | s.point.key; }

  // Takes over what an interrupted run has found.
  bool takeSites(std::vector<Site>& sites) {
    const auto fits = [&](const Site& s) {
      return s.cache < sites_.size() && static_cast<size_t>(s.point.group) < caches_.ofGroups().size();
    };
    if (!state_.checkpoint || !state_.checkpoint->take(KeptKind::GatherSites, static_cast<size_t>(phase_), sites))
      return false;
    if (!std::ranges::all_of(sites, fits)) {
      sites.clear();
      return false;
    }
    for (const Site& s : sites) sites_[s.cache].insert(keyOf(s));
    return true;
  }

  void collectTile(const GatherTile& tile, std::vector<Site>& out) const {
    std::vector<std::vector<Site>> asked(state_.caches.size());
    tile.forPoints(state_.camera, phase_, [&](const GatherPoint& p, int x, int y) {
      for (const size_t c : caches_.ofGroups()[static_cast<size_t>(p.group)]) asked[c].push_back({p, c, x, y});
    });
    for (size_t c = 0; c < asked.size(); ++c) keepUncovered(c, asked[c], out);
  }

  void keepUncovered(size_t cache, const std::vector<Site>& asked, std::vector<Site>& out) const {
    std::vector<IrradiancePlace> places;
    for (const Site& s : asked) places.push_back({s.point.position, s.point.normal, s.point.normal, s.point.pixelSize});
    std::vector<IrradianceEstimate> known(places.size());
    state_.caches[cache].cache.lookup(places, known.data());
    OccluderSearch occluders(*tools_->rays, state_.caches[cache].key.gather);
    const bool isNew = caches_.isNew(cache);
    const float minWeight = state_.caches[cache].key.cache.minWeight;
    for (size_t i = 0; i < asked.size(); ++i) {
      const IrradianceEstimate& k = known[i];
      if (k.weight < minWeight || (k.inconsistent && (isNew || isAnew(asked[i]))) ||
          (isLight(cache) && isOn(Amendment::Occluders) && !k.hasRecord &&
           occluders.isUnderOccluder(asked[i].point, k.closest, k.occluderHeight)))
        out.push_back(asked[i]);
    }
    state_.stats.rays.gather += occluders.raysTraced();
  }

  // Makes the records of a phase, and inserts them when all have been made. Records of early phases look for bright
  // spots, and the pilots among them are made again once these are known.
  void gatherSites(std::vector<Site> sites) {
    if (sites.empty()) return report(1);
    std::vector<size_t> all(sites.size());
    std::iota(all.begin(), all.end(), size_t{0});
    std::vector<IrradianceRecord> records(sites.size());
    std::vector<BrightFind> finds;
    size_t done = gatherRecords(sites, all, records, phase_ < kPilotPhases ? &finds : nullptr,
                                [this](float share) { report(share); });
    if (learnFrom(finds, sites)) done = std::min(done, gatherRecords(sites, pilotsAmong(sites), records, nullptr, {}));
    for (size_t i = 0; i < done; ++i) state_.caches[sites[i].cache].cache.insert(records[i]);
    state_.stats.irradianceCache.samples += static_cast<int64_t>(done);
    report(1);
  }

  /// Learns bright spots from what light records have found. Returns false if there are none. finds: one for each site,
  /// or none.
  bool learnFrom(std::vector<BrightFind>& finds, const std::vector<Site>& sites) {
    size_t lights = 0;
    for (size_t i = 0; i < finds.size(); ++i)
      if (isLight(sites[i].cache)) std::swap(finds[lights++], finds[i]);
    finds.resize(lights);
    if (!finds.empty()) state_.learnt->spots.learn(finds);
    return !finds.empty();
  }

  bool sharesRays(size_t cache) const { return state_.caches[cache].key.gather.samples >= kManyRays; }
  /// Returns the sites whose records come from the search for bright spots. These records could not aim at the spots,
  /// and are to be replaced.
  std::vector<size_t> pilotsAmong(const std::vector<Site>& sites) const {
    const bool areAll = phase_ == 0 && !state_.learnt->spots.spots().empty();
    std::vector<size_t> out;
    for (size_t i = 0; i < sites.size(); ++i)
      if (isLight(sites[i].cache) && (areAll || sharesRays(sites[i].cache))) out.push_back(i);
    return out;
  }

  /// Gathers at some of the sites, which `at` numbers in rising order, and sets their `records`. Returns the number n
  /// such that the sites before the n-th have their records: all, unless the pass was stopped. finds: null, or set to
  /// what each record has found.
  size_t gatherRecords(const std::vector<Site>& sites, const std::vector<size_t>& at,
                       std::vector<IrradianceRecord>& records, std::vector<BrightFind>* finds,
                       const std::function<void(float)>& progress) {
    std::vector<GatherPoint> points;
    for (const size_t i : at) points.push_back(sites[i].point);
    const auto gatherAt = [&](size_t k, BrightFind* find) {
      const Site& site = sites[at[k]];
      return recordAt(site, isLight(site.cache) ? find : nullptr);
    };
    RecordSlice made;
    const size_t done = slices_.make(points, {finds != nullptr, gatherAt, stop_, progress}, made);
    for (size_t k = 0; k < at.size(); ++k) records[at[k]] = made.records[k];
    if (finds) *finds = std::move(made.finds);
    return done < at.size() ? at[done] : sites.size();
  }

  IrradianceRecord recordAt(const Site& site, BrightFind* find) const {
    GatherSettings settings = state_.caches[site.cache].key.gather;
    GatherPoint point = site.point;
    // Bright spots are searched with other rays than those of the final records: a spot that all of these miss would be
    // missed for good.
    if (sharesRays(site.cache) && find) settings.samples /= kRaysPerPilotRay;
    if (sharesRays(site.cache) && !find) point.key = 0;
    IrradianceRecord record = gather(*tools_->rays, *tools_->shading, point, settings, knownLightFor(state_, settings),
                                     state_.stats, find, shareGroupsFor(state_, settings));
    record.unseenDisplacement = tools_->rays->unseenDisplacement(site.point.group);
    return record;
  }

  void report(float fractionOfPhase) const {
    if (*progress_) (*progress_)((static_cast<float>(phase_) + fractionOfPhase) / kGatherPhases);
  }

  GiState& state_;
  const DeepFrame& layout_;
  const TileReader& tiles_;
  RecordSlices slices_;
  const RayTools* tools_ = nullptr;
  FrameCaches caches_;
  std::optional<GatherTiles> gatherTiles_;
  std::vector<std::unordered_set<uint64_t>> sites_;  ///< The sites of each cache that have a record.
  const std::function<void(float)>* progress_ = nullptr;
  StopToken stop_;
  int phase_ = 0;
};

}  // namespace

void fillCaches(GiState& state, const DeepFrame& layout, const TileReader& tiles,
                const std::function<void(float)>& progress, StopToken stop,
                const std::function<void(int stride)>& covered) {
  GatherPass(state, layout, tiles).run(progress, stop, covered);
}

}  // namespace tomales
