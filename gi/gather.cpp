#include "gi/gather.h"

#include "gi/gather_rays.h"
#include "gi/hemisphere.h"
#include "gi/hessian.h"

namespace tomales {
namespace {

/// At `maxerror` 1, in squared pixels: about as many records as the paper's function (docs/gi_measured.md).
constexpr float kHessianTolerance = 4;
constexpr float kContrast = 4;  ///< Between neighbours of a cell, in means of the hemisphere: a small bright source.
constexpr int kMostSplit = 8;
constexpr float kMostAimed = 0.5f;  ///< Rays at bright spots, for each of the hemisphere.
constexpr size_t kLeastAimed = 8;
constexpr size_t kRaysOfProbe = 8;     ///< Of the hemisphere, for each ray that finds out whether a spot can be seen.
constexpr size_t kLeastPerSpot = 4;    ///< Rays of the hemisphere; with fewer, probes would cost too much.
constexpr float kLeastShare = 0.05f;   ///< Of the light of a spot, when its probes have seen none: they are few.
constexpr float kFoundByChance = 160;  ///< Rays of the hemisphere on spots: so many find out without help.
constexpr float kUnhidden = 1.5f;      ///< Times as many before what is hidden is known: no ray finds that out,
constexpr float kHidden = 0.25f;       ///< but where less than this share of what they would send is seen.

const BrightSpots kNoSpots;

/// Kept by each thread from one record to the next.
struct Scratch {
  FirstHits firstHits;
  std::vector<vec3> directions, radiance;    ///< One ray of each cell,
  std::vector<vec3> fineDirections, fine;    ///< more of some cells,
  std::vector<vec3> aimedDirections, aimed;  ///< and those at bright spots.
  std::vector<int> fineCells, aimedCells, raysOfCell;
  std::vector<float> shares;  ///< Of the light of bright spots that arrive.
  std::vector<CellSpread> spread;
  std::vector<float> upright;
};

/// Where light changes fast: cells whose neighbours differ by more than kContrast times the mean. A cell's own ray has
/// no say, so that choosing cells for more rays leaves the estimate unbiased.
std::vector<int> contrastCells(const HemisphereCells& cells, std::span<const vec3> radiance) {
  const int M = cells.rings, N = cells.sectors;
  const auto light = [&](int j, int k) { return luminance(radiance[static_cast<size_t>(j * N + (k + N) % N)]); };
  float mean = 0;
  for (const vec3& L : radiance) mean += luminance(L) / static_cast<float>(radiance.size());
  std::vector<int> out;
  for (int j = 0; j < M; ++j)
    for (int k = 0; k < N; ++k) {
      float least = kInfinity, most = 0;
      for (int ring = std::max(j - 1, 0); ring <= std::min(j + 1, M - 1); ++ring)
        for (int side = -1; side <= 1; ++side) {
          if (ring == j && side == 0) continue;
          least = std::min(least, light(ring, k + side)), most = std::max(most, light(ring, k + side));
        }
      if (most - least > kContrast * mean) out.push_back(j * N + k);
    }
  return out;
}

/// The rays of one record.
class Hemisphere {
 public:
  Hemisphere(const RayScene& scene, const ShadingSystem& shading, const GatherPoint& point,
             const GatherSettings& settings, const KnownLight& known)
      : point_(point),
        cells_(hemisphereCells(settings.samples)),
        count_(static_cast<size_t>(cells_.rings) * static_cast<size_t>(cells_.sectors)),
        key_(hashCombine(point.key, settings.seed)),
        rays_(scene, shading, point, settings, known.hits, count_, key_),
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
    rays_.see(stats, count_, scratch_.radiance, &scratch_.firstHits);
    if (find) tell(*find);
    refine(stats);
    aim(stats);
    weigh();
    return {cells_,
            rays_.tangent(),
            rays_.bitangent(),
            point_.normal,
            scratch_.directions,
            scratch_.radiance,
            scratch_.firstHits.distances,
            scratch_.spread};
  }

  std::vector<float>& upright() { return scratch_.upright; }

 private:
  vec3 inCell(int cell, const vec2& xi) const {
    return hemisphereDirection(cells_, cell / cells_.sectors, cell % cells_.sectors, xi);
  }

  void tell(BrightFind& find) const {
    find = {irradianceSeen(), {}};
    const auto& [distances, normals] = scratch_.firstHits;
    for (size_t i = 0; i < count_; ++i)
      if (const float L = luminance(scratch_.radiance[i]); L > kContrast * find.irradiance && distances[i] < kInfinity)
        find.hits.push_back({point_.position + distances[i] * scratch_.directions[i], L, normals[i]});
  }

  /// Up to half as many rays again, in strata of the cells where light changes fast.
  void refine(Stats& stats) {
    scratch_.raysOfCell.assign(count_, 1);
    scratch_.fineDirections.clear(), scratch_.fineCells.clear();
    const std::vector<int> chosen = contrastCells(cells_, scratch_.radiance);
    if (chosen.empty()) return;
    const int split = std::min(
        kMostSplit, static_cast<int>(std::sqrt(0.5f * static_cast<float>(count_) / static_cast<float>(chosen.size()))));
    if (split < 2) return;
    const int strata = split * split;
    for (const int cell : chosen) {
      scratch_.raysOfCell[static_cast<size_t>(cell)] += strata;
      for (int s = 0; s < strata; ++s) {
        const uint32_t name = hashCombine(key_, rays_.number(), 0x66696e65U);
        const vec2 inside{unitFloat(hash32(name)), unitFloat(hash32(name ^ 0x9e3779b9U))};
        const vec3 local = inCell(cell, (vec2(s / split, s % split) + inside) / static_cast<float>(split));
        scratch_.fineDirections.push_back(
            rays_.add(static_cast<int>(scratch_.fineCells.size()), cell, local, count_ * static_cast<size_t>(strata)));
        scratch_.fineCells.push_back(cell);
      }
    }
    rays_.see(stats, scratch_.fineCells.size(), scratch_.fine);
  }

  /// What arrives of the light of each spot: something may be in between, or it shines elsewhere. These rays count for
  /// no light, so that where to aim does not depend on what counts.
  void probe(Stats& stats) {
    const size_t targets = aim_.targets();
    if (targets == 0 || count_ < kLeastPerSpot * targets) return;
    const size_t probes = std::max<size_t>(1, count_ / (kRaysOfProbe * targets));
    for (size_t i = 0; i < targets * probes; ++i) {
      const vec3 local = rays_.toLocal(aim_.probe(i / probes, sobol2(static_cast<uint32_t>(i), key_ ^ 0x70726f62U)));
      if (local.z > 0) rays_.add(static_cast<int>(i), cellOf(cells_, local), local, 4 * count_);
    }
    rays_.see(stats, targets * probes, scratch_.aimed);
    scratch_.shares.assign(targets, 0);
    for (size_t i = 0; i < scratch_.aimed.size(); ++i)
      scratch_.shares[i / probes] +=
          luminance(scratch_.aimed[i]) / (aim_.radiance(i / probes) * static_cast<float>(probes));
    for (float& share : scratch_.shares) share = std::clamp(share, kLeastShare, 1.0f);
    aim_.dim(scratch_.shares);
  }

  /// More rays the more of the light is expected from the spots. What this hemisphere has seen of them has no
  /// say in it, but for whether to ask what is hidden: three quarters of so much are not missed by chance.
  void aim(Stats& stats) {
    scratch_.aimedDirections.clear(), scratch_.aimedCells.clear();
    const auto byChance = [&] { return aim_.coverage() * static_cast<float>(count_); };
    const bool asks = byChance() < kUnhidden * kFoundByChance || irradianceSeen() < kHidden * aim_.irradiance();
    if (asks && worthAiming() >= kLeastAimed) probe(stats);
    aims_ = byChance() < kFoundByChance ? worthAiming() : 0;
    if (aims_ < kLeastAimed) aims_ = 0;
    for (size_t i = 0; i < aims_; ++i) {
      const float choice =
          (static_cast<float>(i) + sobol1(static_cast<uint32_t>(i), key_ ^ 0x73706f74U)) / static_cast<float>(aims_);
      const vec3 d = aim_.direction(choice, sobol2(static_cast<uint32_t>(i), key_ ^ 0x61696d73U));
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

  /// E/pi by the rays of the hemisphere alone.
  float irradianceSeen() const {
    float sum = 0;
    for (const vec3& L : scratch_.radiance) sum += luminance(L);
    return sum / static_cast<float>(count_);
  }

  /// E/pi but for what is as bright as a spot. Colours may be negative, but no share of rays.
  float dimIrradiance() const {
    float sum = 0;
    for (const vec3& L : scratch_.radiance)
      if (luminance(L) <= kContrast * spots_.irradiance()) sum += std::max(luminance(L), 0.0f);
    return sum / static_cast<float>(count_);
  }

  /// The mean of each cell from all rays that fall into it, by the balance heuristic (Veach and Guibas 1995).
  void weigh() {
    scratch_.spread.assign(count_, {});
    if (scratch_.fineCells.empty() && aims_ == 0) return;
    for (size_t c = 0; c < count_; ++c) {
      scratch_.radiance[c] *= weight(static_cast<int>(c), scratch_.directions[c]);
      scratch_.spread[c].add(luminance(scratch_.radiance[c]));
    }
    for (size_t i = 0; i < scratch_.fineCells.size(); ++i)
      addTo(scratch_.fineCells[i], scratch_.fineDirections[i], scratch_.fine[i]);
    for (size_t i = 0; i < scratch_.aimedCells.size(); ++i)
      addTo(scratch_.aimedCells[i], scratch_.aimedDirections[i], scratch_.aimed[i]);
  }

  void addTo(int cell, const vec3& direction, const vec3& L) {
    const vec3 part = weight(cell, direction) * L;
    scratch_.radiance[static_cast<size_t>(cell)] += part;
    scratch_.spread[static_cast<size_t>(cell)].add(luminance(part));
  }

  /// One over the rays that were to be expected there, on a cell of projected solid angle pi / n.
  float weight(int cell, const vec3& direction) const {
    float rays = static_cast<float>(scratch_.raysOfCell[static_cast<size_t>(cell)]);
    if (aims_ > 0) {
      const float cosine = std::max(dot(direction, point_.normal), 1e-6f);
      rays += static_cast<float>(aims_) * aim_.density(direction) * kPi / (cosine * static_cast<float>(count_));
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

/// Light under a sheet changes over its height, whatever the size of a pixel: a record there reaches as far from its
/// edge and no farther, but for a quarter of a pixel. A tenth of the rays that leave upright are to meet a sheet: a
/// hair is none.
float reachUnderSheet(const HemisphereSamples& samples, float pixelSize, std::vector<float>& upright) {
  constexpr float kUpright = 0.8f;  // cosine
  constexpr size_t kTenth = 10;
  constexpr float kFinestPixels = 0.25f;
  upright.clear();
  for (size_t i = 0; i < samples.directions.size(); ++i)
    if (dot(samples.directions[i], samples.normal) > kUpright) upright.push_back(samples.distances[i]);
  if (upright.empty()) return kInfinity;
  const auto height = upright.begin() + static_cast<ptrdiff_t>(upright.size() / kTenth);
  std::nth_element(upright.begin(), height, upright.end());
  return std::max(*height, kFinestPixels * pixelSize);
}

/// So many times as far off the light may be over the radius that the Hessian gives, which grows by the
/// fourth root of that. The cache, which makes all radii so many times as large, is not to do so to this one
/// as well.
float radiusByHessian(const IrradianceCurvature& curvature, const IrradianceRecord& r, float maxError) {
  return hessianRadius(curvature, luminance(r.E), r.pixelSize, kHessianTolerance * maxError) / maxError;
}

}  // namespace

IrradianceRecord gather(const RayScene& scene, const ShadingSystem& shading, const GatherPoint& point,
                        const GatherSettings& settings, const KnownLight& known, Stats& stats, BrightFind* find) {
  Hemisphere hemisphere(scene, shading, point, settings, known);
  const HemisphereSamples samples = hemisphere.trace(stats, find);
  IrradianceRecord record = summarize(samples);
  record.position = point.position;
  record.pixelSize = point.pixelSize;
  if (!settings.occlusion) record.limit = reachUnderSheet(samples, point.pixelSize, hemisphere.upright());
  if (settings.curvature) {
    const IrradianceCurvature curvature = curvatureOf(samples);
    record.tangent = samples.tangent;
    record.hessian[0] = curvature.xx, record.hessian[1] = curvature.xy, record.hessian[2] = curvature.yy;
    // What is near bends light faster the nearer one comes, so that the curvature of the record's own place holds half
    // way at best.
    if (settings.occlusion)
      record.smoothRadius =
          std::min(variationRadius(curvature, settings.occlusion->maxVariation), 0.5f * record.closest);
    else
      record.smoothRadius = 1 / (1 / radiusByHessian(curvature, record, settings.maxError) + 1 / record.closest);
  }
  return record;
}

}  // namespace tomales
