#include "gi/frame/measured_light.h"

#include "gi/frame/gather_places.h"
#include "gi/frame/indirect.h"
#include "gi/frame/state.h"
#include "gi/photons/passes.h"
#include "gi/photons/sources.h"
#include "reyes/base/checksum.h"
#include "reyes/base/parallel.h"
#include "reyes/base/random_streams.h"
#include "reyes/base/rng.h"
#include "reyes/base/stop.h"

namespace tomales {

template <class A>
void fields(A& a, PhotonSums& x) {
  auto& [passes, weights, sums] = x;
  each(a, passes, weights, sums);
}

/// What has been counted, and is kept for a run that resumes.
struct CountedPhotons {
  int64_t sent = 0;  ///< It may exceed the plan, because every light sends at least one photon in each pass.
  PhotonSums sums{};
};

template <class A>
void fields(A& a, CountedPhotons& x) {
  auto& [sent, sums] = x;
  each(a, sent, sums);
}

namespace {

/// A run that is killed loses up to a fifth of its photons, or a 32nd of all of them. The file grows by all sums each
/// time.
bool isWorthKeeping(int64_t fresh, int64_t kept, int64_t all) { return fresh >= std::max(kept / 4, all / 32); }

/// Resumes an earlier run's measurement, if one was kept, and returns how many photons that run has sent.
int64_t resumed(const Checkpoint* kept, PhotonMeasurement& measurement) {
  CountedPhotons out;
  return kept && kept->take(KeptKind::CountedPhotons, 0, out) && measurement.resume(std::move(out.sums)) ? out.sent : 0;
}

/// Counts the passes that the measurement lacks. Returns the number of photons, with those that were `sent` before.
int64_t countPhotons(const PhotonSources& sources, const std::vector<PhotonPass>& all, const PhotonPasses& passes,
                     Checkpoint* kept, const std::function<void(float)>& progress, int64_t sent,
                     PhotonMeasurement& measurement) {
  const size_t resumedAt = measurement.sums().passes;
  int64_t planned = 0, keptPhotons = 0;
  for (size_t i = 0; i < all.size(); ++i) {
    const PhotonPass& pass = all[i];
    planned += pass.photons;
    if (i < resumedAt) {
      keptPhotons = planned;
      continue;
    }
    measurement.beginPass(pass.scale, static_cast<double>(pass.photons) / static_cast<double>(passes.photons));
    sent += sources.pass(hashCombine(passes.seed, randomStream("pass"), static_cast<uint32_t>(i + 1)), pass.photons,
                         [&](std::span<const StoredPhoton> p) { measurement.count(p); });
    measurement.endPass();
    if (progress) progress(static_cast<float>(planned) / static_cast<float>(passes.photons));
    if (pass.endsRound && measurement.noise() >= 0 && measurement.noise() < passes.noise) break;
    if (!kept || !isWorthKeeping(planned - keptPhotons, keptPhotons, passes.photons)) continue;
    kept->keep(KeptKind::CountedPhotons, 0, CountedPhotons{sent, measurement.sums()});
    keptPhotons = planned;
  }
  return sent;
}

MeasurementPoint pointAt(const RayScene& rays, const GatherPlaces& places, const AskedPoints& asked, int i,
                         int bounces) {
  const GatherPoint at = places.at(i);
  // A hair may have the light of its root. Then the area of a pixel at the root stands for that of the micropolygon.
  const bool own = at.position == asked.points.position(i);
  const float area = own ? asked.points.channel(kArea)[i] : at.pixelSize * at.pixelSize;
  Ray leaving{at.position, at.normal};
  rays.prepareOrigin(at.group, at.position, at.edgeLength, leaving);
  const vec3 n = dot(asked.normal(i), at.normal) < 0 ? -at.normal : at.normal;
  return {at.position, n, std::sqrt(std::max(area, 1e-20f) / kPi), leaving.offset, bounces};
}

}  // namespace

uint64_t MeasuredLight::hashOf(const MeasurementPoint& point) { return checksum(std::as_bytes(std::span(&point, 1))); }

void MeasuredLight::note(const MeasurementPoint& point) {
  static_assert(sizeof point == 9 * sizeof(float), "no padding, whose bytes would be names too");
  const std::lock_guard lock(noting_);
  if (index_.emplace(hashOf(point), 0U).second) points_.push_back(point);
}

void MeasuredLight::measure(const RayTools& tools, const PhotonPasses& passes, Checkpoint* kept,
                            const std::function<void(float)>& progress, Stats& stats) {
  // Threads have noted the points in any order.
  std::sort(points_.begin(), points_.end(), [](const auto& a, const auto& b) { return hashOf(a) < hashOf(b); });
  PhotonSettings settings;
  settings.seed = passes.seed;
  settings.direct = false;
  settings.specularFirstOnly = passes.specularFirstOnly;
  settings.mostBounces = 0;
  for (size_t i = 0; i < points_.size(); ++i) {
    index_[hashOf(points_[i])] = static_cast<uint32_t>(i);
    settings.mostBounces = std::max(settings.mostBounces, points_[i].bounces);
  }
  const PhotonSources sources(*tools.rays, *tools.shading, settings, *passes.log);
  const std::vector<PhotonPass> all = photonPasses(passes.photons, passes.shrinks);
  const float largestScale = all.empty() ? 1 : all.front().scale;
  auto measurement = std::make_unique<PhotonMeasurement>(std::move(points_), sources.power(),
                                                         sources.power() > 0 ? tools.rays : nullptr, largestScale);
  const int64_t before = resumed(kept, *measurement);
  const bool hasLight = measurement->size() > 0 && sources.power() > 0;
  const int64_t sent = hasLight ? countPhotons(sources, all, passes, kept, progress, before, *measurement) : 0;
  stats.rays.photon += sent - before;
  stats.photons.emitted += sent - before;
  passes.tell(sent, measurement->size(), measurement->noise());
  measurement_ = std::move(measurement);
}

vec3 MeasuredLight::overPi(const MeasurementPoint& point) const {
  const auto found = index_.find(hashOf(point));
  return found == index_.end() ? vec3(0.0f) : measurement_->overPi(found->second);
}

void measureLight(GiState& state, const DeepFrame& layout, const TileReader& tiles,
                  const std::function<void(float)>& progress, StopToken stop) {
  const RayTools* tools = state.passes ? state.rays() : nullptr;
  if (!tools) return;
  state.measured = std::make_unique<MeasuredLight>();
  ShadeContext context;
  context.seed = state.settings.seed;
  context.direct = false;
  context.purpose = Purpose::Sketch;
  parallelFor(layout.tileCount(), 1, [&](size_t t, size_t) {
    const auto tile = stop.requested() ? nullptr : tiles(t);
    if (!tile) return;
    ShadedPoints out;
    for (const ShadePoints& batch : tile->batches) state.shading.shade(batch, context, out);
  });
  try {
    state.measured->measure(*tools, *state.passes, state.checkpoint, progress, state.stats);
  } catch (const Stopped&) {
    state.measured.reset();
  }
}

bool noteMeasured(const GiState& state, const AskedPoints& asked, int bounces, const ShadeContext& context,
                  const IndirectResult& out) {
  if (!state.measured || !state.measured->isNoting()) return false;
  const RayTools* tools = state.rays();
  const GatherPlaces places(state, asked.points);
  for (int i = 0; i < asked.count(); ++i) {
    if (!asked.active[i]) continue;
    const vec3 n = asked.points.facingNormal(i), dominant[3] = {n, n, n};
    setIndirect(out, i, vec3(0.0f), dominant);
    if (context.diffuseDepth == 0) state.measured->note(pointAt(*tools->rays, places, asked, i, bounces));
  }
  return true;
}

void addMeasured(const GiState& state, const AskedPoints& asked, int bounces, const ShadeContext& context,
                 const IndirectResult& out) {
  const RayTools* tools = state.measured && context.diffuseDepth == 0 ? state.rays() : nullptr;
  if (!tools) return;
  const GatherPlaces places(state, asked.points);
  for (int i = 0; i < asked.count(); ++i) {
    if (!asked.active[i]) continue;
    const vec3 E = state.measured->overPi(pointAt(*tools->rays, places, asked, i, bounces));
    out.E.x[i] += E.x;
    out.E.y[i] += E.y;
    out.E.z[i] += E.z;
  }
}

}  // namespace tomales
