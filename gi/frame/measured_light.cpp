#include "gi/frame/measured_light.h"

#include "gi/frame/gather_places.h"
#include "gi/frame/indirect.h"
#include "gi/frame/state.h"
#include "gi/photons/sources.h"
#include "reyes/base/checksum.h"
#include "reyes/base/parallel.h"
#include "reyes/base/random_streams.h"
#include "reyes/base/rng.h"
#include "reyes/base/stop.h"

namespace tomales {
namespace {

/// Photons of one pass. The fewer there are, the more often radii shrink, and the more often the grid is built.
constexpr int64_t kPhotonsOfPass = 1 << 17;
/// The radius of a disk in the first pass, over that of its micropolygon; and alpha. 2/3 makes noise and bias fall
/// equally fast (Knaus and Zwicker 2011, section 4.3).
constexpr double kFirstScale = 4, kAlpha = 2.0 / 3;

/// The noise is looked at only when the number of passes has doubled. If it were looked at after each pass, it would at
/// some time be low by chance.
bool isTimeToAsk(int64_t passes) { return passes >= 4 && (passes & (passes - 1)) == 0; }

MeasurementPoint pointAt(const RayScene& rays, const GatherPlaces& places, const ShadePoints& points, TmConstVec3 N,
                         int i, int bounces) {
  const GatherPoint at = places.at(i);
  // A hair may have the light of its root. Then the area of a pixel at the root stands for that of the micropolygon.
  const bool own = at.position == points.position(i);
  const float area = own ? points.channel(kArea)[i] : at.pixelSize * at.pixelSize;
  Ray leaving{at.position, at.normal};
  rays.prepareOrigin(at.group, at.position, at.edgeLength, leaving);
  const vec3 n = dot(unitNormal(points, N, i), at.normal) < 0 ? -at.normal : at.normal;
  return {at.position, n, std::sqrt(std::max(area, 1e-20f) / kPi), leaving.offset, bounces};
}

}  // namespace

uint64_t MeasuredLight::hashOf(const MeasurementPoint& point) { return checksum(std::as_bytes(std::span(&point, 1))); }

void MeasuredLight::note(const MeasurementPoint& point) {
  static_assert(sizeof point == 9 * sizeof(float), "no padding, whose bytes would be names too");
  const std::lock_guard lock(noting_);
  if (index_.emplace(hashOf(point), 0U).second) points_.push_back(point);
}

void MeasuredLight::measure(const RayTools& tools, const PhotonPasses& passes,
                            const std::function<void(float)>& progress, Stats& stats) {
  // Threads have noted them in any order.
  std::sort(points_.begin(), points_.end(), [](const auto& a, const auto& b) { return hashOf(a) < hashOf(b); });
  PhotonSettings settings;
  settings.emit = std::min(passes.photons, kPhotonsOfPass);
  settings.seed = passes.seed;
  settings.direct = false;
  settings.specularFirstOnly = passes.specularFirstOnly;
  settings.mostBounces = 0;
  for (size_t i = 0; i < points_.size(); ++i) {
    index_[hashOf(points_[i])] = static_cast<uint32_t>(i);
    settings.mostBounces = std::max(settings.mostBounces, points_[i].bounces);
  }
  const PhotonSources sources(*tools.rays, *tools.shading, settings, *passes.log);
  auto measurement = std::make_unique<PhotonMeasurement>(std::move(points_), sources.power());
  double scale = passes.shrinks ? kFirstScale : 1;
  int64_t sent = 0;
  for (int64_t pass = 1; sent < passes.photons && sources.power() > 0 && measurement->size() > 0; ++pass) {
    measurement->beginPass(static_cast<float>(scale));
    sent += sources.pass(hashCombine(passes.seed, randomStream("pass"), static_cast<uint32_t>(pass)),
                         [&](std::span<const StoredPhoton> photons) { measurement->count(photons); });
    if (passes.shrinks) scale *= std::sqrt((static_cast<double>(pass) + kAlpha) / (static_cast<double>(pass) + 1));
    if (progress) progress(std::min(1.0f, static_cast<float>(sent) / static_cast<float>(passes.photons)));
    if (isTimeToAsk(pass) && measurement->noise() >= 0 && measurement->noise() < passes.noise) break;
  }
  stats.rays.photon += sent;
  stats.photons.emitted += sent;
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
    state.measured->measure(*tools, *state.passes, progress, state.stats);
  } catch (const Stopped&) {
    state.measured.reset();
  }
}

bool noteMeasured(const GiState& state, const ShadePoints& points, const uint8_t* active, TmConstVec3 N, int bounces,
                  const ShadeContext& context, const IndirectResult& out) {
  if (!state.measured || !state.measured->isNoting()) return false;
  const RayTools* tools = state.rays();
  const GatherPlaces places(state, points);
  for (int i = 0; i < points.count(); ++i) {
    if (!active[i]) continue;
    const vec3 n = points.facingNormal(i), dominant[3] = {n, n, n};
    store(out, i, vec3(0.0f), dominant);
    if (context.diffuseDepth == 0) state.measured->note(pointAt(*tools->rays, places, points, N, i, bounces));
  }
  return true;
}

void addMeasured(const GiState& state, const ShadePoints& points, const uint8_t* active, TmConstVec3 N, int bounces,
                 const ShadeContext& context, const IndirectResult& out) {
  const RayTools* tools = state.measured && context.diffuseDepth == 0 ? state.rays() : nullptr;
  if (!tools) return;
  const GatherPlaces places(state, points);
  for (int i = 0; i < points.count(); ++i) {
    if (!active[i]) continue;
    const vec3 E = state.measured->overPi(pointAt(*tools->rays, places, points, N, i, bounces));
    out.E.x[i] += E.x;
    out.E.y[i] += E.y;
    out.E.z[i] += E.z;
  }
}

}  // namespace tomales
