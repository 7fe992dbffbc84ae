#include "gi/frame/bounce_caches.h"

#include <cmath>
#include <mutex>

#include "reyes/base/parallel.h"
#include "reyes/base/random_streams.h"
#include "reyes/base/rng.h"
#include "reyes/camera.h"

namespace tomales {
namespace {

constexpr int kRaysOfPoint = 48;  ///< Rays from each point that look for places where records are needed.
constexpr size_t kMostPoints = 1024, kMostRecords = 1 << 14;
constexpr int kPhases = 8;        ///< Number of phases; each has twice the candidates of the one before.
constexpr int kSearchPhases = 3;  ///< Bright spots are learnt in these first phases, which have few records.
constexpr CacheSettings kCoarse{};
constexpr float kPixelsAcross = 64;  ///< Records are as dense as for a picture of this many pixels across.
constexpr int kSamplesShare = 2, kLeastSamples = 48, kMostSamples = 256;
/// Each further level has half the rays of the one before, but at least these: all levels together cost about as much
/// as the first two.
constexpr int kLeastDeepSamples = 24;
/// Share of the light that two levels together must add; else no further level is filled.
constexpr double kSettled = 0.002;

int phaseOf(uint32_t key) {
  int phase = kPhases - 1;
  for (uint32_t h = hash32(key ^ randomStream("boun")); phase > 0 && (h & 1); h >>= 1) --phase;
  return phase;
}

/// Gives a record of a further level the distances of the first level's record, which has the most rays and knows them
/// best. The record's own gradients are noise. Clamping E at 0 would keep only the bright half of that noise, so the
/// gradients are cleared.
void copyRadii(const IrradianceRecord& first, IrradianceRecord& record) {
  record.closest = first.closest;
  record.harmonicMean = first.harmonicMean;
  record.limit = first.limit;
  std::ranges::fill(record.light.rotationGradient, vec3(0));
  std::ranges::fill(record.light.translationGradient, vec3(0));
  for (IrradianceExpansion& share : record.shares) share = {.E = share.E};
}

}  // namespace

float BounceCaches::pixelSize(const Camera& camera, const vec3& P) const {
  const float across = static_cast<float>(std::max(camera.xResolution(), camera.yResolution()));
  return camera.pixelSize({0, 0, std::max(glm::length(P), leastDistance_)}) * across / kPixelsAcross;
}

IrradianceEstimate BounceCaches::lookup(int bounces, const Camera& camera, const vec3& P, const vec3& normal,
                                        const vec3& shadingNormal, const std::string* lights) const {
  if (bounces < 1 || levels_.empty()) return {};
  const size_t level = std::min(static_cast<size_t>(bounces), levels_.size()) - 1;
  std::span<const IrradianceExpansion> light;
  if (lights) {
    const auto group = std::ranges::find(groups_, *lights);
    if (group == groups_.end()) return {};
    light = alone_[level][static_cast<size_t>(group - groups_.begin())];
  }
  return levels_[level].lookup(P, normal, shadingNormal, pixelSize(camera, P), light);
}

BounceCaches::Levels BounceCaches::levels() const {
  Levels out{levels_.empty() ? Bound3{} : levels_.front().bound(), {}, groups_, leastDistance_};
  for (const IrradianceCache& level : levels_) out.records.emplace_back(level.records().begin(), level.records().end());
  return out;
}

void BounceCaches::restore(const Levels& levels) {
  groups_ = levels.groups;
  leastDistance_ = levels.leastDistance;
  levels_.clear();
  alone_.clear();
  for (const std::vector<IrradianceRecord>& records : levels.records) {
    IrradianceCache& level = levels_.emplace_back(levels.bound, kCoarse);
    for (const IrradianceRecord& r : records) level.restore(r);
    mixLevel();
  }
}

void BounceCaches::finishLevel(const Camera& camera) {
  levels_.back().finish(
      [&](const Bound3& box) { return pixelSize(camera, glm::max(glm::abs(box.lo), glm::abs(box.hi))); });
  mixLevel();
}

// The share of the first group is the light of surfaces that glow by themselves. It is seen whatever lights are on.
void BounceCaches::mixLevel() {
  std::vector<std::vector<IrradianceExpansion>>& of = alone_.emplace_back();
  for (size_t g = 0; g < groups_.size(); ++g) {
    std::vector<vec3> gains(groups_.size(), vec3(0));
    gains[0] = gains[g] = vec3(1);
    of.push_back(levels_.back().mixed(gains));
  }
}

std::vector<GatherPoint> BounceCaches::hitsFrom(const RayScene& rays, const Camera& camera,
                                                const std::vector<GatherPoint>& from, uint32_t name) const {
  const size_t stride = (from.size() + kMostPoints - 1) / kMostPoints,
               used = stride ? (from.size() + stride - 1) / stride : 0;
  std::vector<std::optional<GatherPoint>> found(used * kRaysOfPoint);
  parallelFor(used, 1, [&](size_t begin, size_t end) {
    for (size_t p = begin; p < end; ++p) {
      const GatherPoint& start = from[p * stride];
      vec3 tangent, bitangent;
      orthonormalBasis(start.normal, tangent, bitangent);
      const uint32_t key = hashCombine(start.key, name);
      for (uint32_t k = 0; k < kRaysOfPoint; ++k) {
        const vec3 local = cosineHemisphere(sobol2(k, key));
        Ray ray{start.position, local.x * tangent + local.y * bitangent + local.z * start.normal};
        ray.spread = 1 / std::sqrt(static_cast<float>(kRaysOfPoint));
        rays.prepareOrigin(start.group, start.position, start.edgeLength, ray);
        ray.offset = slantedOffset(ray.offset, local.z);
        const Hit hit = rays.closest(ray, kMaskDiffuse);
        if (hit.object < 0) continue;
        const vec3 P = ray.origin + hit.t * ray.direction,
                   n = dot(ray.direction, hit.geometricNormal) > 0 ? -hit.normal : hit.normal;
        found[p * kRaysOfPoint + k] = GatherPoint{.group = rays.groupOf(hit),
                                                  .position = P,
                                                  .normal = n,
                                                  .key = hashCombine(key, k),
                                                  .pixelSize = pixelSize(camera, P),
                                                  .edgeLength = 0,
                                                  .drift = vec3(0),
                                                  .time = -1};
      }
    }
  });
  std::vector<GatherPoint> out;
  for (const auto& point : found)
    if (point) out.push_back(*point);
  return out;
}

RecordSlice BounceCaches::recordsAt(const RayTools& tools, const std::vector<GatherPoint>& points,
                                    const GatherSettings& settings, const Run& run, bool findsLight) {
  const KnownLight known{.spots = findsLight ? nullptr : &spots_};
  const std::span<const std::string> groups = findsLight ? std::span<const std::string>() : run.groups;
  RecordSlice made;
  slices_.make(points,
               {.findsLight = findsLight,
                .gather =
                    [&](size_t i, BrightFind* find) {
                      return gather(*tools.rays, *tools.shading, points[i], settings, known, run.stats, find, groups);
                    },
                .stop = run.stop},
               made);
  return made;
}

void BounceCaches::insert(IrradianceCache& level, const std::vector<IrradianceRecord>& records) {
  for (const IrradianceRecord& r : records) {
    level.insert(r);
    light_.back() += luminance(r.light.E);
  }
}

void BounceCaches::cover(const RayTools& tools, const std::vector<GatherPoint>& candidates,
                         const GatherSettings& settings, const Run& run) {
  for (int phase = 0; phase < kPhases && points_.size() < kMostRecords && !run.stop.requested(); ++phase) {
    std::vector<uint8_t> open(candidates.size(), 0);
    parallelFor(candidates.size(), 64, [&](size_t begin, size_t end) {
      for (size_t i = begin; i < end; ++i) {
        const GatherPoint& p = candidates[i];
        open[i] =
            phaseOf(p.key) == phase && levels_[0].lookup(p.position, p.normal, p.pixelSize).weight < kCoarse.minWeight;
      }
    });
    std::vector<GatherPoint> fresh;
    for (size_t i = 0; i < candidates.size(); ++i)
      if (open[i] && points_.size() + fresh.size() < kMostRecords) fresh.push_back(candidates[i]);
    if (phase < kSearchPhases) spots_.learn(recordsAt(tools, fresh, settings, run, true).finds);
    insert(levels_[0], recordsAt(tools, fresh, settings, run, false).records);
    points_.insert(points_.end(), fresh.begin(), fresh.end());
  }
}

// Two levels are compared, because a single one may add less than its noise.
bool BounceCaches::settled() const {
  const size_t n = light_.size();
  return n > 2 && light_[n - 1] - light_[n - 3] <= kSettled * light_[n - 1];
}

// The ratio is the mean over all bounces, since a late one may add less than its noise. The frame's records have one
// bounce more than the last level.
BouncesLeft BounceCaches::left() const {
  const size_t n = light_.size();
  if (n < 2 || settled() || !(light_[0] > 0)) return {};
  const double last = std::max(0.0, light_[n - 1] - light_[n - 2]),
               ratio = std::pow(last / light_[0], 1.0 / static_cast<double>(n - 1));
  return bouncesLeft(static_cast<int>(n) + 1, light_[n - 1] + last * ratio, last * ratio, ratio);
}

void BounceCaches::fill(const RayTools& tools, const Camera& camera, const std::vector<GatherPoint>& from,
                        const GatherSettings& gather, int bounces, const Run& run) {
  levels_.clear();
  alone_.clear();
  groups_.assign(run.groups.begin(), run.groups.end());
  light_.assign(1, 0.0);
  points_.clear();
  spots_ = {};
  slices_ = RecordSlices(run.kept, KeptKind::BounceRecords);
  float distance = 0;
  for (const GatherPoint& p : from) distance += glm::length(p.position) / static_cast<float>(from.size());
  leastDistance_ = 0.5f * distance;
  GatherSettings settings = gather;
  settings.samples = std::clamp(gather.samples / kSamplesShare, kLeastSamples, kMostSamples);
  settings.curvature = false;
  settings.indirect = false;
  settings.depth = bounces;
  const std::vector<GatherPoint> seen = hitsFrom(*tools.rays, camera, from, randomStream("hits"));
  Bound3 bound;
  for (const GatherPoint& p : seen) bound.extend(p.position);
  levels_.emplace_back(bound, kCoarse);
  cover(tools, seen, settings, run);
  cover(tools, hitsFrom(*tools.rays, camera, points_, randomStream("more")), settings, run);
  finishLevel(camera);
  settings.indirect = true;
  for (int b = 2; b < bounces && !settled() && !run.stop.requested(); ++b) {
    settings.depth = bounces - b + 1;
    // If every level had the same rays, their error would be multiplied as light is, and not average out.
    settings.seed = hashCombine(gather.seed, static_cast<uint32_t>(b));
    settings.samples = std::max(kLeastDeepSamples, settings.samples / 2);
    IrradianceCache level(bound, kCoarse);
    std::vector<IrradianceRecord> records = recordsAt(tools, points_, settings, run, false).records;
    for (size_t i = 0; i < records.size(); ++i) copyRadii(levels_[0].records()[i], records[i]);
    light_.push_back(0);
    insert(level, records);
    levels_.push_back(std::move(level));
    finishLevel(camera);
  }
}

}  // namespace tomales
