#include "gi/irradiance_cache.h"

#include <utility>

#include "gi/cache/extrapolation.h"
#include "gi/cache/record_tree.h"
#include "reyes/base/simd.h"

namespace tomales {
namespace {

constexpr float kFinestPixels = 1;              // in pixels, at kappa 1: disagreement shortens no radius below this
constexpr float kMaxAngleTerm = 0.0151922470f;  // 1 - cos(alpha+), alpha+ = 10 degrees (eq. 4)
constexpr float kBehindTolerance = 0.1f;        // share of the validity radius
// the same in pixels, at kappa 1: thin surfaces have two sides, however far their records are valid
constexpr float kBehindPixels = 0.45f;
constexpr float kHeight = 0.5f;   // share of the closest distance, above the record's plane
constexpr float kHeightFade = 4;  // the weight fades from three quarters of that height on
// relative difference of extrapolated values, at kappa 1, beyond which light does not change smoothly
constexpr float kDisagreement = 0.1f;
constexpr float kDiscontinuous = 0.5f;  // the same between points that see different surfaces
constexpr float kNoiseMargin = 3;       // in standard errors
constexpr float kDark = 0.1f;  // share of the mean E: darker values are compared with this and not with themselves
// share of E by which it may change over a record's radius; a steeper record serves no wider
constexpr float kSteep = 0.3f;
constexpr size_t kRun = 64;  // greatest number of lookups that share their candidates
// greatest diagonal of the places of a run: incoherent points would share too many candidates
constexpr float kRunPixels = 24;

struct Candidate {
  uint32_t record;
  float weight;
};

/// The records that may serve some of the places of a run, as arrays.
struct Vicinity {
  std::vector<uint32_t> records;
  AlignedVector<float> x, y, z, nx, ny, nz, size, limit, slack;

  void clear() {
    records.clear();
    for (auto* a : {&x, &y, &z, &nx, &ny, &nz, &size, &limit}) a->clear();
  }
  void add(uint32_t record, const IrradianceRecord& r, float recordSize) {
    records.push_back(record);
    x.push_back(r.position.x);
    y.push_back(r.position.y);
    z.push_back(r.position.z);
    nx.push_back(r.normal.x);
    ny.push_back(r.normal.y);
    nz.push_back(r.normal.z);
    size.push_back(recordSize);
    limit.push_back(r.limit);
  }
};

/// Bounds of what a record may serve, before rounding.
struct ValidityBounds {
  float least, most, scale;  ///< The radius is the record's size, clamped between least and most, times scale.
  float cosine;              ///< Least cosine of the angle between normals.
};

/// slack[i] > 0: record i may serve a point at p with normal n.
TOMALES_HOT void findSlack(const Vicinity& v, const vec3& p, const vec3& n, const ValidityBounds& reach, float* slack) {
  const float *x = v.x.data(), *y = v.y.data(), *z = v.z.data(), *nx = v.nx.data(), *ny = v.ny.data(),
              *nz = v.nz.data();
  const float *size = v.size.data(), *limit = v.limit.data();
  const size_t count = v.records.size();
  for (size_t i = 0; i < count; ++i) {
    const float dx = p.x - x[i], dy = p.y - y[i], dz = p.z - z[i];
    const float radius = std::min(reach.scale * std::max(std::min(size[i], reach.most), reach.least), limit[i]);
    const float near = radius * radius - (dx * dx + dy * dy + dz * dz);
    slack[i] = std::min(near, n.x * nx[i] + n.y * ny[i] + n.z * nz[i] - reach.cosine);
  }
}

}  // namespace

struct IrradianceCache::Impl {
  CacheSettings settings;
  Bound3 bound;
  RecordTree tree{bound};
  IrradianceRecords records{};
  double luminanceSum = 0;  // sum over the records' E
  const ErrorFunctionInfo& info = infoOf(settings.errorFunction);

  float size(const IrradianceRecord& r) const {
    if (info.splitSphere) return r.harmonicMean;
    return info.curvature ? std::min(r.smoothRadius, r.closest * settings.kappa) : r.closest * 0.5f;
  }

  // Returns the distance at which the error reaches 1: the denominator of eq. 3 over kappa. Ward's split sphere has the
  // same limits.
  float reach(float recordSize, float pixelSize) const {
    const float radius = std::max(std::min(recordSize, settings.maxPixels * pixelSize), settings.minPixels * pixelSize);
    return radius / settings.kappa;
  }

  void insert(uint32_t index) {
    const IrradianceRecord& r = records[index];
    tree.insert(index, r.position, size(r), reach(size(r), r.pixelSize));
  }

  enum class Disagreement { None, Steep, Discontinuous };

  Disagreement disagreementOf(const vec3& a, const vec3& b, float noise) const {
    if (info.published) return Disagreement::None;
    const float tolerance = info.splitSphere ? 4 * kDisagreement : kDisagreement;  // kappa counts four times there
    const float larger = std::max(luminance(a), luminance(b)),
                off = std::abs(luminance(a) - luminance(b)) - kNoiseMargin * noise;
    const auto dark = static_cast<float>(kDark * luminanceSum / static_cast<double>(records.size()));
    if (!(off > tolerance / settings.kappa * std::max(larger, dark))) return Disagreement::None;
    return off > kDiscontinuous * std::max(larger, dark) ? Disagreement::Discontinuous : Disagreement::Steep;
  }

  // Where light is steep, no record is needed nearer than a pixel: it would be the noise of single pixels, each paid
  // with a hemisphere. Where points see different surfaces, something thinner than that lies between them.
  float least(float pixelSize) const { return kFinestPixels * pixelSize / settings.kappa; }
  float limitBy(Disagreement disagreement, float distance, float pixelSize) const {
    if (disagreement == Disagreement::None) return kInfinity;
    return disagreement == Disagreement::Discontinuous ? distance : std::max(distance, least(pixelSize));
  }

  // Standard error of an extrapolated value: gradients are as noisy as E over the mean distance of the hits.
  static float noiseAt(const IrradianceRecord& r, float distance) { return r.noise * (1 + distance / r.harmonicMean); }

  // The new record knows E at its place, which older records have extrapolated, and they know E at theirs. Where the
  // two disagree, each ends before the other.
  void limitDisagreeing(uint32_t index) {
    IrradianceRecord& fresh = records[index];
    for (const Candidate& candidate : candidatesAt(fresh.position, fresh.normal, fresh.pixelSize)) {
      IrradianceRecord& old = records[candidate.record];
      const float distance = glm::length(fresh.position - old.position), fromOld = noiseAt(old, distance),
                  fromFresh = noiseAt(fresh, distance);
      const Disagreement ofOld =
          disagreementOf(extrapolate(old, fresh.position, fresh.normal), fresh.E, fromOld + fresh.noise);
      const Disagreement ofFresh =
          disagreementOf(extrapolate(fresh, old.position, old.normal), old.E, fromFresh + old.noise);
      old.limit = std::min(old.limit, limitBy(ofOld, distance, old.pixelSize));
      fresh.limit = std::min(fresh.limit, limitBy(ofFresh, distance, fresh.pixelSize));
    }
  }

  // Returns 1 where light does not change over the radius, and 0 where it changes by kSteep of itself: a shadow's edge
  // may lie beyond.
  static float evenness(const IrradianceRecord& r, float radius) {
    const vec3 change = radius * (r.translationGradient[0] + r.translationGradient[1] + r.translationGradient[2]);
    const float most = kSteep * (r.E.x + r.E.y + r.E.z);
    return dot(change, change) < most * most ? 1 - dot(change, change) / (most * most) : 0.0f;
  }

  // The weight falls smoothly to 0 where the record stops being used, so that interpolation has no seams.
  float weight(const IrradianceRecord& r, const vec3& x, const vec3& n, float pixelSize, float wider) const {
    const float covers = reach(size(r), pixelSize);
    const float radius = std::min(covers * (1 + (wider - 1) * evenness(r, covers)), r.limit);
    const vec3 step = x - r.position;
    const float distance2 = dot(step, step);
    if (!(distance2 < radius * radius)) return 0;
    // A point behind the record sees other things than the record did (Ward et al. 1988, section 4), unless
    // it is no farther than bumps that rays do not see.
    const float tolerance =
        std::max(std::min(kBehindTolerance * radius, kBehindPixels * pixelSize / settings.kappa), r.unseenDisplacement);
    const float behind = -0.5f * dot(step, n + r.normal) / tolerance;
    if (behind >= 1) return 0;
    // A point that is as high above the record as the closest hit lies on another surface: R- may be wider than a slot
    // between parallel walls.
    const float above = dot(step, r.normal), highest = kHeight * r.closest;
    if (above > 0 && above >= highest) return 0;
    const float upright = above > 0 ? std::min(1.0f, kHeightFade * (1 - above / highest)) : 1.0f;
    const float front = upright * (1 - std::max(0.0f, behind));
    const float position = std::sqrt(distance2) / radius;
    const float angle = std::sqrt(std::max(0.0f, 1 - dot(n, r.normal)));
    if (!info.splitSphere) {
      const float error = std::max(position, settings.kappa * angle / std::sqrt(kMaxAngleTerm));  // eq. 2
      return front * std::max(0.0f, 1 - error);                                                   // eq. 5
    }
    const float error = position + settings.kappa * angle;
    return front * std::max(0.0f, 1 / std::max(error, 1e-4f) - 1);
  }

  // The candidates are in the order of the records, so that the result does not depend on the shape of the tree.
  std::vector<Candidate> candidatesAt(const vec3& x, const vec3& n, float pixelSize) const {
    std::vector<Candidate> out;
    tree.visit(
        {x, x}, [&](float recordSize) { return reach(recordSize, pixelSize); },
        [&](uint32_t i) {
          if (const float w = weight(records[i], x, n, pixelSize, 1); w > 0) out.push_back({i, w});
        });
    std::sort(out.begin(), out.end(), [](const Candidate& a, const Candidate& b) { return a.record < b.record; });
    return out;
  }

  ValidityBounds boundsAt(float pixelSize, float wider) const {
    constexpr float kRounding = 1e-4f;
    const float angle =
        info.splitSphere ? 1 / (settings.kappa * settings.kappa) : kMaxAngleTerm / (settings.kappa * settings.kappa);
    return {settings.minPixels * pixelSize, settings.maxPixels * pixelSize, wider * (1 + kRounding) / settings.kappa,
            1 - angle - kRounding};
  }

  /// Lookups that lie close together share one walk through the tree.
  void lookup(std::span<const IrradiancePlace> places, IrradianceEstimate* out, float wider,
              std::span<const LightShare> light, Vicinity& near, std::vector<Candidate>& found) const {
    Bound3 region;
    float pixelSize = 0;
    for (const IrradiancePlace& p : places) region.extend(p.position), pixelSize = std::max(pixelSize, p.pixelSize);
    const size_t half = places.size() / 2;
    if (places.size() > kRun || (half > 0 && !(glm::length(region.size()) <= kRunPixels * pixelSize))) {
      lookup(places.first(half), out, wider, light, near, found);
      return lookup(places.subspan(half), out + half, wider, light, near, found);
    }
    near.clear();
    const ValidityBounds farthest = boundsAt(pixelSize, wider);
    const auto reachOf = [&](float recordSize) {
      return farthest.scale * std::max(std::min(recordSize, farthest.most), farthest.least);
    };
    tree.visit(region, reachOf, [&](uint32_t i) {
      const IrradianceRecord& r = records[i];
      const vec3 off = r.position - glm::clamp(r.position, region.lo, region.hi);
      const float radius = std::min(reachOf(size(r)), (1 + 1e-4f) * r.limit);
      if (dot(off, off) <= radius * radius) near.add(i, r, size(r));
    });
    near.slack.resize(near.records.size());
    for (const IrradiancePlace& p : places) {
      findSlack(near, p.position, p.normal, boundsAt(p.pixelSize, wider), near.slack.data());
      found.clear();
      for (size_t k = 0; k < near.records.size(); ++k) {
        if (!(near.slack[k] > 0)) continue;
        const float w = weight(records[near.records[k]], p.position, p.normal, p.pixelSize, wider);
        if (w > 0) found.push_back({near.records[k], w});
      }
      std::sort(found.begin(), found.end(), [](const Candidate& a, const Candidate& b) { return a.record < b.record; });
      *out++ = blend(found, p.position, p.shadingNormal, p.pixelSize, light);
    }
  }

  // Returns the error of the mean of linearly extrapolated records, to the second order, if they agree.
  vec3 secondOrder(const std::vector<Candidate>& candidates, const MeanExtrapolation& mean, float weight,
                   float pixelSize, std::span<const LightShare> light) const {
    if (info.published) return vec3(0.0f);
    const vec3 step = mean.step();
    vec3 out = -0.5f * mean.covariance();
    if (info.curvature)
      for (const Candidate& c : candidates) {
        const IrradianceRecord& r = records[c.record];
        const float far = reach(size(r), pixelSize);
        out += 0.5f * c.weight / weight *
               (light.empty() ? bentBy(r, r, step, far) : bentBy(r, light[c.record], step, far));
      }
    return out;
  }

  IrradianceEstimate blend(const std::vector<Candidate>& candidates, const vec3& x, const vec3& n, float pixelSize,
                           std::span<const LightShare> light) const {
    IrradianceEstimate out{vec3(0.0f), {vec3(0.0f), vec3(0.0f), vec3(0.0f)}};
    float nearest = kInfinity;
    Disagreement worst = Disagreement::None;
    MeanExtrapolation mean(x, n), other(x, n);
    vec3 otherE(0.0f);
    for (const Candidate& candidate : candidates) {
      const IrradianceRecord& r = records[candidate.record];
      const vec3 E = mean.add(r, candidate.weight);
      if (!light.empty()) otherE += candidate.weight * other.addShare(r, light[candidate.record], candidate.weight, E);
      const float distance = glm::length(x - r.position);
      if (&candidate != &candidates.front())
        worst = std::max(worst, disagreementOf(E, out.E / out.weight, 2 * noiseAt(r, distance)));
      nearest = std::min(nearest, distance);
      out.closest = std::min(out.closest, r.closest);
      out.occluderHeight = std::min(out.occluderHeight, std::max(r.closest, r.limit));
      out.hasRecord |= distance == 0;
      out.E += candidate.weight * E;
      for (int c = 0; c < 3; ++c) out.dominant[c] += candidate.weight * r.dominant[c];  // eq. 7
      out.weight += candidate.weight;
    }
    if (out.weight > 0) {
      const auto corrected = [&](const vec3& E, const MeanExtrapolation& m, std::span<const LightShare> of) {
        return E / out.weight + mean.agreement() * secondOrder(candidates, m, out.weight, pixelSize, of);
      };
      out.E = glm::max(vec3(0.0f), corrected(out.E, mean, {}));
      if (!light.empty()) out.E = vec3(glm::greaterThan(out.E, vec3(0.0f))) * corrected(otherE, other, light);
    }
    out.inconsistent = limitBy(worst, nearest, pixelSize) <= nearest;
    for (vec3& d : out.dominant) d = normalizeOr(d, n);
    return out;
  }
};

IrradianceCache::IrradianceCache(const Bound3& bound, const CacheSettings& settings)
    : impl_(new Impl{settings, bound}) {}

IrradianceCache::IrradianceCache(IrradianceCache&&) noexcept = default;
IrradianceCache& IrradianceCache::operator=(IrradianceCache&&) noexcept = default;
IrradianceCache::~IrradianceCache() = default;

void IrradianceCache::insert(const IrradianceRecord& record) {
  Impl& impl = *impl_;
  impl.records.push_back(record);
  impl.luminanceSum += luminance(record.E);
  if (!(impl.settings.kappa < kInfinity)) return;
  limitDerivatives(impl.records.back(), impl.reach(impl.size(record), record.pixelSize));
  impl.limitDisagreeing(static_cast<uint32_t>(impl.records.size() - 1));
  impl.insert(static_cast<uint32_t>(impl.records.size() - 1));
}

void IrradianceCache::restore(const IrradianceRecord& record) {
  impl_->records.push_back(record);
  impl_->luminanceSum += luminance(record.E);
  if (impl_->settings.kappa < kInfinity) impl_->insert(static_cast<uint32_t>(impl_->records.size() - 1));
}

IrradianceEstimate IrradianceCache::lookup(const vec3& x, const vec3& normal, const vec3& shadingNormal,
                                           float pixelSize, std::span<const LightShare> light) const {
  if (!(impl_->settings.kappa < kInfinity)) return impl_->blend({}, x, shadingNormal, pixelSize, light);
  return impl_->blend(impl_->candidatesAt(x, normal, pixelSize), x, shadingNormal, pixelSize, light);
}

void IrradianceCache::lookup(std::span<const IrradiancePlace> places, IrradianceEstimate* out, float wider,
                             std::span<const LightShare> light) const {
  if (places.empty()) return;
  if (impl_->info.published || impl_->info.curvature) wider = 1;
  if (impl_->settings.kappa < kInfinity) {
    thread_local Vicinity near;
    thread_local std::vector<Candidate> found;
    return impl_->lookup(places, out, wider, light, near, found);
  }
  for (const IrradiancePlace& p : places) *out++ = impl_->blend({}, p.position, p.shadingNormal, p.pixelSize, light);
}

std::vector<LightShare> IrradianceCache::mixed(std::span<const vec3> gains) const {
  std::vector<LightShare> out;
  out.reserve(impl_->records.size());
  for (const IrradianceRecord& r : impl_->records) {
    LightShare& sum = out.emplace_back();
    for (size_t g = 0; g < gains.size(); ++g) sum.add(r.shares[g], gains[g]);
  }
  return out;
}

const IrradianceRecords& IrradianceCache::records() const { return impl_->records; }
const Bound3& IrradianceCache::bound() const { return impl_->bound; }

}  // namespace tomales
