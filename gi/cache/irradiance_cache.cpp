#include "gi/irradiance_cache.h"

#include <utility>

#include "gi/cache/amendments/disagreements.h"
#include "gi/cache/amendments/second_order.h"
#include "gi/cache/amendments/slopes.h"
#include "gi/cache/amendments/switches.h"
#include "gi/cache/published.h"
#include "gi/cache/record_cells.h"
#include "gi/cache/record_tree.h"
#include "gi/cache/vicinity.h"

namespace tomales {
namespace {

constexpr size_t kRun = 64;  // Greatest number of lookups that share their candidates.
// Greatest diagonal of the places of a run: incoherent points would share too many candidates.
constexpr float kRunPixels = 24;

// Relative margin of the values that choose candidates. It exceeds their rounding error.
constexpr float kSlack = 1e-4f;

struct Candidate {
  uint32_t record;
  float weight;
};

/// Memory that lookups of one thread use again.
struct Search {
  std::vector<uint32_t> near;
  Vicinity vicinity;
  std::vector<Serving> serving;
  std::vector<Candidate> found;
};

}  // namespace

struct IrradianceCache::Impl {
  CacheSettings settings;
  Bound3 bound;
  RecordTree tree{bound};
  IrradianceRecords records{};
  std::optional<RecordCells> cells{};  ///< Exists once the cache is finished.
  const ErrorFunctionInfo& info = infoOf(settings.errorFunction);
  const Published published = publishedBy(info.equations, settings.kappa);
  Disagreements disagreements{has(Amendment::Disagreements), info.equations, settings.kappa};
  std::vector<vec3> gainsOfMix{};
  std::vector<IrradianceExpansion> mix{};
  const bool correctsMean = has(Amendment::SecondOrder), fadesBehind = has(Amendment::Behind);

  bool has(Amendment amendment) const { return isOn(amendment, info); }
  float unclampedRadius(const IrradianceRecord& r) const {
    return std::visit([&](const auto& equations) { return equations.unclampedRadius(r); }, published);
  }
  float reach(float recordSize, float pixelSize) const { return rangeAt(pixelSize, 1).radiusOf(recordSize); }

  void insertLast() {
    const IrradianceRecord& r = records.back();
    tree.insert(r.position, unclampedRadius(r), reach(unclampedRadius(r), r.pixelSize), r.limit);
  }

  // The new record knows E at its place, to which older records are extrapolated, and the other way round. Where the
  // two values disagree, each record ends before the other.
  void limitLast() {
    IrradianceRecord& fresh = records.back();
    for (const Candidate& candidate : candidatesAt(fresh.position, fresh.normal, fresh.pixelSize)) {
      IrradianceRecord& old = records[candidate.record];
      const float distance = glm::length(fresh.position - old.position),
                  fromOld = Disagreements::noiseAt(old, distance), fromFresh = Disagreements::noiseAt(fresh, distance);
      const Disagreement ofOld =
          disagreements.of(extrapolate(old, fresh.position, fresh.normal), fresh.light.E, fromOld + fresh.noise);
      const Disagreement ofFresh =
          disagreements.of(extrapolate(fresh, old.position, old.normal), old.light.E, fromFresh + old.noise);
      old.limit = std::min(old.limit, disagreements.limit(ofOld, distance, old.pixelSize));
      tree.limit(candidate.record, old.limit);
      fresh.limit = std::min(fresh.limit, disagreements.limit(ofFresh, distance, fresh.pixelSize));
    }
  }

  Range rangeAt(float pixelSize, float wider) const {
    const float least = std::visit([](const auto& equations) { return equations.leastCosine(); }, published);
    return {settings.minPixels * pixelSize,
            settings.maxPixels * pixelSize,
            settings.kappa,
            pixelSize / settings.kappa,
            wider,
            least - kSlack,
            fadesBehind};
  }

  /// Fills search.vicinity with all records that may serve a place in this region. They are in the order of the
  /// records, so that sums do not depend on the shape of the tree.
  void findNear(const Bound3& region, const Range& farthest, Search& search) const {
    const float scale = (1 + kSlack) * farthest.wider;
    const auto reachOf = [&](float recordSize) { return scale * farthest.radiusOf(recordSize); };
    search.near.clear();
    tree.visit(region, reachOf, 1 + kSlack, [&](uint32_t i) { search.near.push_back(i); });
    std::ranges::sort(search.near);
    search.vicinity.assign(search.near, records, [this](const IrradianceRecord& r) { return unclampedRadius(r); });
  }

  /// Replaces search.found by the candidates at a place. Pre: findNear() has been called for a region around it.
  void findAt(const vec3& x, const vec3& n, const Range& range, Search& search) const {
    search.vicinity.find(x, n, range, search.serving);
    weigh(search);
  }

  /// Replaces search.found by the candidates among search.serving. The weight falls smoothly to 0 where the record
  /// stops being used, so that interpolation has no seams.
  void weigh(Search& search) const {
    search.found.clear();
    std::visit(
        [&](const auto& equations) {
          for (const Serving& s : search.serving)
            if (const float w = s.fades * equations.weight(s.position, s.angle); w > 0)
              search.found.push_back({s.record, w});
        },
        published);
  }

  /// Returns the candidates at one place alone.
  const std::vector<Candidate>& candidatesAt(const vec3& x, const vec3& n, float pixelSize) const {
    Search& search = searchOfThread();
    const Range range = rangeAt(pixelSize, 1);
    if (const auto near = cells ? cells->find(x, pixelSize) : std::nullopt) {
      search.serving.clear();
      for (const uint32_t record : *near)
        if (const Serving s = servingOf(record, (*cells)[record], x, n, range); s.fades > 0)
          search.serving.push_back(s);
      weigh(search);
    } else {
      findNear({x, x}, range, search);
      findAt(x, n, range, search);
    }
    return search.found;
  }

  void finish(const std::function<float(const Bound3&)>& mostPixels) {
    std::vector<RecordReach> reaches;
    for (const IrradianceRecord& r : records) reaches.push_back(RecordReach::of(r, unclampedRadius(r)));
    const auto reachOf = [&](const RecordReach& r, float pixelSize) {
      return (1 + kSlack) * std::min(reach(r.size, pixelSize), r.limit);
    };
    cells.emplace(bound, std::move(reaches), reachOf, mostPixels);
  }

  static Search& searchOfThread() {
    thread_local Search search;
    return search;
  }

  /// Lookups that lie close together share one walk through the tree.
  void lookup(std::span<const IrradiancePlace> places, IrradianceEstimate* out, float wider,
              std::span<const IrradianceExpansion> light, Search& search) const {
    Bound3 region;
    float pixelSize = 0;
    for (const IrradiancePlace& p : places) {
      region.extend(p.position);
      pixelSize = std::max(pixelSize, p.pixelSize);
    }
    const size_t half = places.size() / 2;
    if (places.size() > kRun || (half > 0 && !(glm::length(region.size()) <= kRunPixels * pixelSize))) {
      lookup(places.first(half), out, wider, light, search);
      return lookup(places.subspan(half), out + half, wider, light, search);
    }
    findNear(region, rangeAt(pixelSize, wider), search);
    for (const IrradiancePlace& p : places) {
      findAt(p.position, p.normal, rangeAt(p.pixelSize, wider), search);
      *out++ = blend(search.found, p.position, p.shadingNormal, p.pixelSize, light);
    }
  }

  // Returns the error of the mean of linearly extrapolated records, to the second order, if they agree.
  vec3 secondOrder(const std::vector<Candidate>& candidates, const MeanExtrapolation& mean, float weight,
                   float pixelSize, std::span<const IrradianceExpansion> light) const {
    if (!correctsMean) return vec3(0.0f);
    const vec3 step = mean.step();
    vec3 out = -0.5f * mean.covariance();
    if (info.needsCurvature())
      for (const Candidate& c : candidates) {
        const IrradianceRecord& r = records[c.record];
        const float far = reach(unclampedRadius(r), pixelSize);
        out += 0.5f * c.weight / weight * bentBy(r, light.empty() ? r.light : light[c.record], step, far);
      }
    return out;
  }

  IrradianceEstimate blend(const std::vector<Candidate>& candidates, const vec3& x, const vec3& n, float pixelSize,
                           std::span<const IrradianceExpansion> light) const {
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
        worst = std::max(worst, disagreements.of(E, out.E / out.weight, 2 * Disagreements::noiseAt(r, distance)));
      nearest = std::min(nearest, distance);
      out.closest = std::min(out.closest, r.closest);
      out.occluderHeight = std::min(out.occluderHeight, std::max(r.closest, r.limit));
      out.hasRecord |= distance == 0;
      out.E += candidate.weight * E;
      for (int c = 0; c < 3; ++c) out.dominant[c] += candidate.weight * r.dominant[c];  // eq. 7
      out.weight += candidate.weight;
    }
    if (out.weight > 0) {
      const auto corrected = [&](const vec3& E, const MeanExtrapolation& m, std::span<const IrradianceExpansion> of) {
        return E / out.weight + mean.agreement() * secondOrder(candidates, m, out.weight, pixelSize, of);
      };
      out.E = glm::max(vec3(0.0f), corrected(out.E, mean, {}));
      if (!light.empty()) out.E = vec3(glm::greaterThan(out.E, vec3(0.0f))) * corrected(otherE, other, light);
    }
    out.inconsistent = worst != Disagreement::None && candidates.size() < Disagreements::kCrowd &&
                       disagreements.limit(worst, nearest, pixelSize) <= nearest;
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
  impl.disagreements.add(luminance(record.light.E));
  if (!(impl.settings.kappa < kInfinity)) return;
  if (impl.has(Amendment::Slopes))
    limitDerivatives(impl.records.back(), impl.reach(impl.unclampedRadius(record), record.pixelSize));
  impl.limitLast();
  impl.insertLast();
}

void IrradianceCache::restore(const IrradianceRecord& record) {
  impl_->records.push_back(record);
  impl_->disagreements.add(luminance(record.light.E));
  if (impl_->settings.kappa < kInfinity) impl_->insertLast();
}

void IrradianceCache::finish(const std::function<float(const Bound3&)>& mostPixels) {
  if (impl_->settings.kappa < kInfinity) impl_->finish(mostPixels);
}

IrradianceEstimate IrradianceCache::lookup(const vec3& x, const vec3& normal, const vec3& shadingNormal,
                                           float pixelSize, std::span<const IrradianceExpansion> light) const {
  if (!(impl_->settings.kappa < kInfinity)) return impl_->blend({}, x, shadingNormal, pixelSize, light);
  return impl_->blend(impl_->candidatesAt(x, normal, pixelSize), x, shadingNormal, pixelSize, light);
}

void IrradianceCache::lookup(std::span<const IrradiancePlace> places, IrradianceEstimate* out, float wider,
                             std::span<const IrradianceExpansion> light) const {
  if (places.empty()) return;
  if (!impl_->has(Amendment::Reach)) wider = 1;
  if (impl_->settings.kappa < kInfinity) {
    return impl_->lookup(places, out, wider, light, Impl::searchOfThread());
  }
  for (const IrradiancePlace& p : places) *out++ = impl_->blend({}, p.position, p.shadingNormal, p.pixelSize, light);
}

std::vector<IrradianceExpansion> IrradianceCache::mixed(std::span<const vec3> gains) const {
  std::vector<IrradianceExpansion> out;
  out.reserve(impl_->records.size());
  for (const IrradianceRecord& r : impl_->records) {
    IrradianceExpansion& sum = out.emplace_back();
    for (size_t g = 0; g < gains.size(); ++g)
      if (gains[g] != vec3(0.0f)) sum.add(r.shares[g], gains[g]);
  }
  return out;
}

std::span<const IrradianceExpansion> IrradianceCache::cachedMix(std::span<const vec3> gains) const {
  Impl& impl = *impl_;
  if (impl.mix.size() != impl.records.size() || !std::ranges::equal(impl.gainsOfMix, gains)) {
    impl.mix = mixed(gains);
    impl.gainsOfMix.assign(gains.begin(), gains.end());
  }
  return impl.mix;
}

const IrradianceRecords& IrradianceCache::records() const { return impl_->records; }
const Bound3& IrradianceCache::bound() const { return impl_->bound; }

}  // namespace tomales
