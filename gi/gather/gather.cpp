#include "gi/gather.h"

#include "gi/cache/amendments/switches.h"
#include "gi/gather/contrast_cells.h"
#include "gi/gather/hessian.h"
#include "gi/gather/occluders.h"
#include "gi/gather/rays.h"
#include "reyes/base/random_streams.h"

namespace tomales {
namespace {

/// Tolerance of hessianRadius() at `maxerror` 1, in squared pixels. It makes about as many records as the paper's
/// function (docs/measured/irradiance_cache.md).
constexpr float kHessianTolerance = 4;
constexpr int kMostSplit = 8;
constexpr float kMostAimed = 0.5f;  ///< Greatest number of rays at bright spots, for each ray of the hemisphere.
constexpr size_t kLeastAimed = 8;
/// Number of rays of the hemisphere for each probe, a ray that finds out whether a spot can be seen.
constexpr size_t kRaysOfProbe = 8;
/// Least number of rays of the hemisphere for each spot. With fewer, probes would cost too much.
constexpr size_t kLeastPerSpot = 4;
constexpr float kLeastShare = 0.05f;  ///< Share of a spot's light that is assumed when its few probes have seen none.
/// No rays are aimed if the hemisphere alone is expected to send this many rays to the spots.
constexpr float kFoundByChance = 160;
constexpr float kUnhidden = 1.5f;  ///< Below this many times kFoundByChance, probes find out whether spots are hidden.
/// Above it, probes are traced only where less than this share of the spots' light is seen.
constexpr float kHidden = 0.25f;

const BrightSpots kNoSpots;

/// Memory that each thread keeps from one record to the next.
struct Scratch {
  FirstHits firstHits;
  std::vector<vec3> directions;  ///< One ray of each cell.
  SeenLight seen;
  std::vector<vec3> fineDirections;  ///< Further rays of the cells where light changes fast.
  SeenLight fine;
  std::vector<vec3> aimedDirections;  ///< The rays that are aimed at bright spots.
  SeenLight aimed;
  std::vector<int> fineCells, aimedCells, raysOfCell;
  std::vector<float> shares;  ///< The share of each bright spot's light that arrives.
  std::vector<CellSpread> spread;
  std::vector<float> upright;  ///< For radiusUnderOccluder().
};

/// Traces the rays of one record.
class Hemisphere {
 public:
  Hemisphere(const RayScene& scene, const ShadingSystem& shading, const GatherPoint& point,
             const GatherSettings& settings, const KnownLight& known, std::span<const std::string> groups)
      : point_(point),
        cells_(hemisphereCells(settings.samples)),
        count_(static_cast<size_t>(cells_.rings) * static_cast<size_t>(cells_.sectors)),
        key_(hashCombine(point.key, settings.seed)),
        rays_(scene, shading, point, settings, known.hits, groups, count_, key_),
        spots_(known.spots ? *known.spots : kNoSpots),
        aim_(spots_, point.position, point.normal) {}

  HemisphereSamples trace(Stats& stats, BrightFind* find) {
    const CellJitter jitter(cells_, key_);
    scratch_.directions.clear();
    for (size_t i = 0; i < count_; ++i) {
      const int ring = static_cast<int>(i) / cells_.sectors, sector = static_cast<int>(i) % cells_.sectors;
      const vec3 local = inCell(static_cast<int>(i), jitter(ring, sector, static_cast<uint32_t>(i)));
      scratch_.directions.push_back(rays_.add(static_cast<int>(i), static_cast<int>(i), local, count_));
    }
    rays_.see(stats, count_, scratch_.seen, &scratch_.firstHits);
    if (find) tell(*find);
    refine(stats);
    aim(stats);
    weigh();
    return {cells_,
            rays_.tangent(),
            rays_.bitangent(),
            point_.normal,
            scratch_.directions,
            scratch_.seen.all,
            scratch_.firstHits.distances,
            scratch_.spread};
  }
  /// Returns the radiance of each cell that each group of lights brings; after trace().
  const std::vector<std::vector<vec3>>& shares() const { return scratch_.seen.shares; }

  std::vector<float>& upright() { return scratch_.upright; }

 private:
  vec3 inCell(int cell, const vec2& xi) const {
    return hemisphereDirection(cells_, cell / cells_.sectors, cell % cells_.sectors, xi);
  }

  void tell(BrightFind& find) const {
    find = {irradianceSeen(), {}};
    const auto& [distances, normals] = scratch_.firstHits;
    for (size_t i = 0; i < count_; ++i)
      if (const float L = luminance(scratch_.seen.all[i]); L > kContrast * find.irradiance && distances[i] < kInfinity)
        find.hits.push_back({point_.position + distances[i] * scratch_.directions[i], L, normals[i]});
  }

  /// Adds up to half as many rays again, in strata of the cells where light changes fast.
  void refine(Stats& stats) {
    scratch_.raysOfCell.assign(count_, 1);
    scratch_.fineDirections.clear();
    scratch_.fineCells.clear();
    const std::vector<int> chosen = contrastCells(cells_, scratch_.seen.all);
    if (chosen.empty()) return;
    const int split = std::min(
        kMostSplit, static_cast<int>(std::sqrt(0.5f * static_cast<float>(count_) / static_cast<float>(chosen.size()))));
    if (split < 2) return;
    const int strata = split * split;
    for (const int cell : chosen) {
      scratch_.raysOfCell[static_cast<size_t>(cell)] += strata;
      for (int s = 0; s < strata; ++s) {
        const uint32_t name = hashCombine(key_, rays_.number(), randomStream("fine"));
        const vec2 inside{unitFloat(hash32(name)), unitFloat(hash32(name ^ randomStream("second")))};
        const vec3 local = inCell(cell, (vec2(s / split, s % split) + inside) / static_cast<float>(split));
        scratch_.fineDirections.push_back(
            rays_.add(static_cast<int>(scratch_.fineCells.size()), cell, local, count_ * static_cast<size_t>(strata)));
        scratch_.fineCells.push_back(cell);
      }
    }
    rays_.see(stats, scratch_.fineCells.size(), scratch_.fine);
  }

  /// Finds the share of each spot's light that arrives: something may be in between, or the spot shines elsewhere.
  /// These rays do not count for the estimate: if they did, rays aimed by their finds would make it too dark
  /// (docs/decisions/0092).
  void probe(Stats& stats) {
    const size_t targets = aim_.targets();
    if (targets == 0 || count_ < kLeastPerSpot * targets) return;
    const size_t probes = std::max<size_t>(1, count_ / (kRaysOfProbe * targets));
    for (size_t i = 0; i < targets * probes; ++i) {
      const vec3 local =
          rays_.toLocal(aim_.probe(i / probes, sobol2(static_cast<uint32_t>(i), key_ ^ randomStream("prob"))));
      if (local.z > 0) rays_.add(static_cast<int>(i), cellOf(cells_, local), local, 4 * count_);
    }
    rays_.see(stats, targets * probes, scratch_.aimed);
    scratch_.shares.assign(targets, 0);
    for (size_t i = 0; i < scratch_.aimed.all.size(); ++i)
      scratch_.shares[i / probes] +=
          luminance(scratch_.aimed.all[i]) / (aim_.radiance(i / probes) * static_cast<float>(probes));
    for (float& share : scratch_.shares) share = std::clamp(share, kLeastShare, 1.0f);
    aim_.dim(scratch_.shares);
  }

  /// The more light is expected from the spots, the more rays are aimed at them. The rays of this hemisphere have no
  /// say in it, except that they may ask for probes: if they see less than kHidden of the expected light, that is not
  /// chance, and spots are hidden.
  void aim(Stats& stats) {
    scratch_.aimedDirections.clear();
    scratch_.aimedCells.clear();
    const auto byChance = [&] { return aim_.coverage() * static_cast<float>(count_); };
    const bool asks = byChance() < kUnhidden * kFoundByChance || irradianceSeen() < kHidden * aim_.irradiance();
    if (asks && worthAiming() >= kLeastAimed) probe(stats);
    aims_ = byChance() < kFoundByChance ? worthAiming() : 0;
    if (aims_ < kLeastAimed) aims_ = 0;
    for (size_t i = 0; i < aims_; ++i) {
      const float choice = (static_cast<float>(i) + sobol1(static_cast<uint32_t>(i), key_ ^ randomStream("spot"))) /
                           static_cast<float>(aims_);
      const vec3 d = aim_.direction(choice, sobol2(static_cast<uint32_t>(i), key_ ^ randomStream("aims")));
      const vec3 local = rays_.toLocal(d);
      if (local.z <= 0) continue;
      const int cell = cellOf(cells_, local);
      rays_.add(static_cast<int>(scratch_.aimedCells.size()), cell, local, 4 * count_);
      scratch_.aimedCells.push_back(cell);
      scratch_.aimedDirections.push_back(d);
    }
    rays_.see(stats, scratch_.aimedCells.size(), scratch_.aimed);
  }

  size_t worthAiming() const {
    const float spots = aim_.irradiance();
    return spots > 0 && std::isfinite(spots)
               ? static_cast<size_t>(kMostAimed * static_cast<float>(count_) * spots / (spots + dimIrradiance()))
               : 0;
  }

  /// Returns the luminance of E/pi, estimated by the rays of the hemisphere alone.
  float irradianceSeen() const {
    float sum = 0;
    for (const vec3& L : scratch_.seen.all) sum += luminance(L);
    return sum / static_cast<float>(count_);
  }

  /// Returns the luminance of E/pi without light as bright as a spot. Colours may be negative; they count as 0 here.
  float dimIrradiance() const {
    float sum = 0;
    for (const vec3& L : scratch_.seen.all)
      if (luminance(L) <= kContrast * spots_.irradiance()) sum += std::max(luminance(L), 0.0f);
    return sum / static_cast<float>(count_);
  }

  /// Computes the mean of each cell from all rays that fall into it, by the balance heuristic (Veach and Guibas 1995).
  void weigh() {
    scratch_.spread.assign(count_, {});
    if (scratch_.fineCells.empty() && aims_ == 0) return;
    for (size_t c = 0; c < count_; ++c) {
      const float w = weight(static_cast<int>(c), scratch_.directions[c]);
      scratch_.seen.all[c] *= w;
      for (std::vector<vec3>& share : scratch_.seen.shares) share[c] *= w;
      scratch_.spread[c].add(luminance(scratch_.seen.all[c]));
    }
    for (size_t i = 0; i < scratch_.fineCells.size(); ++i)
      addTo(scratch_.fineCells[i], scratch_.fineDirections[i], scratch_.fine, i);
    for (size_t i = 0; i < scratch_.aimedCells.size(); ++i)
      addTo(scratch_.aimedCells[i], scratch_.aimedDirections[i], scratch_.aimed, i);
  }

  void addTo(int cell, const vec3& direction, const SeenLight& light, size_t ray) {
    const float w = weight(cell, direction);
    const auto c = static_cast<size_t>(cell);
    const vec3 part = w * light.all[ray];
    scratch_.seen.all[c] += part;
    for (size_t g = 0; g < light.shares.size(); ++g) scratch_.seen.shares[g][c] += w * light.shares[g][ray];
    scratch_.spread[c].add(luminance(part));
  }

  /// Returns one over the number of rays that are expected around this direction on the area of a cell, whose projected
  /// solid angle is pi / n.
  float weight(int cell, const vec3& direction) const {
    float rays = static_cast<float>(scratch_.raysOfCell[static_cast<size_t>(cell)]);
    if (aims_ > 0) {
      const float cosine = std::max(dot(direction, point_.normal), 1e-6f);
      rays += static_cast<float>(aims_) * aim_.pdf(direction) * kPi / (cosine * static_cast<float>(count_));
    }
    return 1 / rays;
  }

  static Scratch& scratchOfThread() {
    thread_local Scratch scratch;
    return scratch;
  }

  const GatherPoint& point_;
  const HemisphereCells cells_;
  const size_t count_;
  const uint32_t key_;
  GatherRays rays_;
  const BrightSpots& spots_;
  SpotAim aim_;
  size_t aims_ = 0;
  Scratch& scratch_ = scratchOfThread();
};

/// Returns the radius over which the light may be off by `maxError` times the tolerance. The radius of the Hessian
/// grows by the fourth root of that. The cache multiplies all radii by `maxError` later, which is divided out here.
float radiusByHessian(const IrradianceCurvature& curvature, const IrradianceRecord& r, float maxError) {
  return hessianRadius(curvature, luminance(r.light.E), r.pixelSize, kHessianTolerance * maxError) / maxError;
}

void setHessian(const IrradianceCurvature& curvature, IrradianceExpansion& light) {
  light.hessian[0] = curvature.xx;
  light.hessian[1] = curvature.xy;
  light.hessian[2] = curvature.yy;
}

/// `seen`: the hemisphere, with the radiance that the lights of the share bring.
IrradianceExpansion shareOf(const HemisphereSamples& seen, bool curved) {
  IrradianceExpansion out = summarize(seen).light;
  if (curved) setHessian(curvatureOf(seen), out);
  return out;
}

}  // namespace

IrradianceRecord gather(const RayScene& scene, const ShadingSystem& shading, const GatherPoint& point,
                        const GatherSettings& settings, const KnownLight& known, Stats& stats, BrightFind* find,
                        std::span<const std::string> groups) {
  Hemisphere hemisphere(scene, shading, point, settings, known, groups);
  const HemisphereSamples samples = hemisphere.trace(stats, find);
  IrradianceRecord record = summarize(samples);
  record.position = point.position;
  record.pixelSize = point.pixelSize;
  if (!settings.isOcclusion() && isOn(Amendment::Occluders))
    record.limit = radiusUnderOccluder(samples, point.pixelSize, hemisphere.upright());
  for (const std::vector<vec3>& seen : hemisphere.shares()) {
    HemisphereSamples share = samples;
    share.radiance = seen;
    record.shares.push_back(shareOf(share, settings.curvature));
  }
  if (settings.curvature) {
    const IrradianceCurvature curvature = curvatureOf(samples);
    record.tangent = samples.tangent;
    setHessian(curvature, record.light);
    // Light changes faster near an occluder, so the curvature at the record holds for half of the distance at best.
    if (settings.isOcclusion())
      record.smoothRadius = std::min(variationRadius(curvature, settings.asked->maxVariation), 0.5f * record.closest);
    else
      record.smoothRadius = 1 / (1 / radiusByHessian(curvature, record, settings.maxError) + 1 / record.closest);
  }
  return record;
}

}  // namespace tomales
