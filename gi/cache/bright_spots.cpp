#include "gi/cache/bright_spots.h"

#include <algorithm>
#include <span>

namespace tomales {
namespace {

constexpr size_t kMostSpots = 64, kMostHits = 1 << 15;
constexpr size_t kLeastHits = 4;  ///< A spot needs this many hits. A single one may be chance, or seen in a mirror.
constexpr size_t kHitsToSplit = 16;
/// Least distance to a spot, in its radii. The rays of the hemisphere find nearer spots.
constexpr float kNearest = 3;
constexpr float kRounding = 1e-3f;
/// A cluster becomes a rectangle if its hits lie this close to a plane, in radii, and its mean normal is this close to
/// unit length.
constexpr float kFlat = 0.02f;
/// How far the hits may end before the border of the bright surface, in mean distances between hits. A smaller value
/// leaves noise, a larger one wastes rays.
constexpr float kGap = 1.4f;
constexpr float kNarrowest = 0.05f;  ///< The shorter edge of a rectangle over its longer one, at least.

/// Hits close to each other whose surfaces face alike.
struct Cluster {
  std::span<BrightHit> hits;
  Bound3 bound;
  vec3 mean{0}, normal{0};
  vec3 variance{0}, turn{0};  ///< Sums of squared differences from the mean positions and the mean normals.

  explicit Cluster(std::span<BrightHit> members) : hits(members) {
    const float count = static_cast<float>(std::max<size_t>(hits.size(), 1));
    for (const BrightHit& h : hits) {
      bound.extend(h.position);
      mean += h.position / count;
      normal += h.normal / count;
    }
    for (const BrightHit& h : hits) {
      variance += (h.position - mean) * (h.position - mean);
      turn += (h.normal - normal) * (h.normal - normal);
    }
    turn *= dot(bound.size(), bound.size());
  }
  float spread() const {
    return hits.size() < kHitsToSplit ? 0.0f : std::max(variance[longestAxis(variance)], turn[longestAxis(turn)]);
  }
  size_t splitAtMean() {
    const bool byPosition = variance[longestAxis(variance)] >= turn[longestAxis(turn)];
    const int axis = byPosition ? longestAxis(variance) : longestAxis(turn);
    const auto middle = std::stable_partition(hits.begin(), hits.end(), [&](const BrightHit& h) {
      return byPosition ? h.position[axis] < mean[axis] : h.normal[axis] < normal[axis];
    });
    return static_cast<size_t>(middle - hits.begin());
  }

  /// The hits end about one distance between hits before the border of the bright surface, and farther before its
  /// corners. The rays of the hemisphere alone find what is left out, with all their noise.
  float margin() const { return 1 + 2 * kGap / std::sqrt(static_cast<float>(hits.size())); }
  BrightSpots::Spot spot() const {
    float radiance = 0;
    for (const BrightHit& h : hits) radiance += h.radiance / static_cast<float>(hits.size());
    const float radius = 0.5f * margin() * glm::length(bound.size()), agreement = glm::length(normal);
    const vec3 n = agreement > 1 - kFlat ? normal / agreement : vec3(0);
    const bool flat = n != vec3(0) && std::all_of(hits.begin(), hits.end(), [&](const BrightHit& h) {
                        return std::abs(dot(h.position - mean, n)) < kFlat * radius;
                      });
    return flat ? rectangle(n, radiance)
                : BrightSpots::Spot{bound.center(), radius, radiance, vec3(0), vec2(1 / margin())};
  }
  BrightSpots::Spot rectangle(const vec3& n, float radiance) const {
    vec3 u(0), v;
    u[longestAxis(bound.size())] = 1;
    u = normalizeOr(u - dot(u, n) * n, {});
    v = cross(n, u);
    vec2 low(kInfinity), high(-kInfinity);
    for (const BrightHit& h : hits) {
      const vec2 at(dot(h.position - mean, u), dot(h.position - mean, v));
      low = glm::min(low, at);
      high = glm::max(high, at);
    }
    const vec2 middle = 0.5f * (low + high), found = 0.5f * margin() * (high - low),
               half = glm::max(found, kNarrowest * vec2(found.y, found.x));
    return {.center = mean + middle.x * u + middle.y * v,
            .radius = glm::length(half),
            .radiance = radiance,
            .normal = n,
            .found = 0.5f * (high - low) / half,
            .halfU = half.x * u,
            .halfV = half.y * v};
  }
};

}  // namespace

void BrightSpots::learn(const std::vector<BrightFind>& finds) {
  for (const BrightFind& find : finds) {
    irradiance_ += find.irradiance;
    ++records_;
    const size_t room = kMostHits - hits_.size();
    hits_.insert(hits_.end(), find.hits.begin(),
                 find.hits.begin() + static_cast<ptrdiff_t>(std::min(room, find.hits.size())));
  }
  std::vector<BrightHit> hits = hits_;
  std::vector<Cluster> clusters{Cluster(hits)};
  while (clusters.size() < kMostSpots) {
    const auto widest = std::max_element(clusters.begin(), clusters.end(),
                                         [](const Cluster& a, const Cluster& b) { return a.spread() < b.spread(); });
    const std::span<BrightHit> members = widest->hits;
    const size_t middle = widest->spread() > 0 ? widest->splitAtMean() : 0;
    if (middle == 0 || middle == members.size()) break;
    *widest = Cluster(members.first(middle));
    clusters.emplace_back(members.subspan(middle));
  }
  spots_.clear();
  for (const Cluster& c : clusters)
    if (c.hits.size() >= kLeastHits && c.bound.size() != vec3(0)) spots_.push_back(c.spot());
}

SpotAim::SpotAim(const BrightSpots& spots, const vec3& position, const vec3& normal) {
  for (const BrightSpots::Spot& s : spots.spots()) {
    const vec3 path = s.center - position;
    const float distance = glm::length(path), sine = s.radius / distance;
    if (!(distance > kNearest * s.radius)) continue;
    const vec3 axis = path / distance;
    const float area = s.normal == vec3(0)
                           ? kPi * s.radius * s.radius
                           : 4 * glm::length(s.halfU) * glm::length(s.halfV) * std::max(0.0f, -dot(axis, s.normal));
    const float covered = area / (kPi * distance * distance) * std::min(1.0f, dot(axis, normal) + sine);
    if (covered <= 0 || s.radiance <= 0) continue;
    targets_.push_back({.path = path,
                        .axis = axis,
                        .normal = s.normal,
                        .u = s.halfU,
                        .v = s.halfV,
                        .found = s.found,
                        .versine = sine * sine / (1 + std::sqrt(1 - sine * sine)),
                        .share = s.radiance * covered,
                        .covered = covered});
  }
  settle();
}

void SpotAim::settle() {
  irradiance_ = coverage_ = 0;
  for (Target& t : targets_) {
    irradiance_ += t.share;
    coverage_ += t.covered;
    t.upTo = irradiance_;
  }
  for (Target& t : targets_) t.pdf = t.share / irradiance_ * t.pdfOfPlace();
}

void SpotAim::dim(const std::vector<float>& shares) {
  for (size_t t = 0; t < targets_.size(); ++t) {
    targets_[t].share *= shares[t];
    targets_[t].covered *= shares[t];
  }
  settle();
}

vec3 SpotAim::Target::toward(const vec2& xi) const {
  if (normal != vec3(0)) return path + (2 * xi.x - 1) * u + (2 * xi.y - 1) * v;
  const float drop = xi.x * versine, phi = 2 * kPi * xi.y, r = std::sqrt(drop * (2 - drop));
  vec3 tangent, bitangent;
  orthonormalBasis(axis, tangent, bitangent);
  return (1 - drop) * axis + r * std::cos(phi) * tangent + r * std::sin(phi) * bitangent;
}

float SpotAim::Target::pdfOfPlace() const {
  return normal == vec3(0) ? 1 / (2 * kPi * versine) : 1 / (4 * glm::length(u) * glm::length(v));
}

vec3 SpotAim::probe(size_t target, const vec2& xi) const {
  const Target& t = targets_[target];
  const vec2 within = t.normal != vec3(0) ? 0.5f + (xi - 0.5f) * t.found : vec2(xi.x * t.found.x * t.found.x, xi.y);
  return normalizeOr(t.toward(within), t.axis);
}

vec3 SpotAim::direction(float choice, const vec2& xi) const {
  const auto found = std::find_if(targets_.begin(), targets_.end() - 1,
                                  [&](const Target& t) { return choice * irradiance_ < t.upTo; });
  return normalizeOr(found->toward(xi), found->axis);
}

float SpotAim::pdf(const vec3& direction) const {
  float sum = 0;
  for (const Target& t : targets_) {
    if (t.normal == vec3(0)) {
      const vec3 chord = direction - t.axis;  // the difference of the cosines of small angles would have no digits left
      if (dot(chord, chord) <= (2 + kRounding) * t.versine) sum += t.pdf;
      continue;
    }
    const float cosine = -dot(direction, t.normal), distance = -dot(t.path, t.normal) / cosine;
    const vec3 off = distance * direction - t.path;
    const bool inside = std::abs(dot(off, t.u)) <= (1 + kRounding) * dot(t.u, t.u) &&
                        std::abs(dot(off, t.v)) <= (1 + kRounding) * dot(t.v, t.v);
    if (cosine > 0 && inside) sum += t.pdf * distance * distance / cosine;
  }
  return sum;
}

}  // namespace tomales
