#include "gi/bright_spots.h"

#include <algorithm>
#include <span>

namespace tomales {
namespace {

constexpr size_t kMostSpots = 64, kMostHits = 1 << 15;
constexpr size_t kLeastHits = 4;   ///< Of a spot: one hit may be a mirror's, or chance.
constexpr size_t kHitsToSplit = 16;
constexpr float kMargin = 1.6f;  ///< Hits do not reach the border of what they hit.
constexpr float kNearest = 3;      ///< Radii: the rays of the hemisphere find what is nearer.
constexpr float kRounding = 1e-3f;
constexpr float kFlat = 0.02f;     ///< Radii, and one less the length of the mean normal: what is flatter is a disk.

/// Hits close to each other.
struct Cluster {
  std::span<BrightHit> hits;
  Bound3 bound;
  vec3 mean{0}, normal{0}, variance{0};  ///< variance: sums of squares around the mean

  explicit Cluster(std::span<BrightHit> members) : hits(members) {
    const float count = static_cast<float>(std::max<size_t>(hits.size(), 1));
    for (const BrightHit& h : hits) bound.extend(h.position), mean += h.position / count, normal += h.normal / count;
    for (const BrightHit& h : hits) variance += (h.position - mean) * (h.position - mean);
  }
  int widestAxis() const {
    return variance.x >= variance.y && variance.x >= variance.z ? 0 : variance.y >= variance.z ? 1 : 2;
  }
  float spread() const { return hits.size() < kHitsToSplit ? 0.0f : variance[widestAxis()]; }
  size_t splitAtMean() {
    const int axis = widestAxis();
    const auto middle = std::stable_partition(hits.begin(), hits.end(), [&](const BrightHit& h) { return h.position[axis] < mean[axis]; });
    return static_cast<size_t>(middle - hits.begin());
  }
  BrightSpots::Spot spot() const {
    float radiance = 0;
    for (const BrightHit& h : hits) radiance += h.radiance / static_cast<float>(hits.size());
    const float radius = 0.5f * kMargin * glm::length(bound.size()), agreement = glm::length(normal);
    const vec3 n = agreement > 1 - kFlat ? normal / agreement : vec3(0);
    const bool flat = n != vec3(0) && std::all_of(hits.begin(), hits.end(), [&](const BrightHit& h) { return std::abs(dot(h.position - mean, n)) < kFlat * radius; });
    if (!flat) return {bound.center(), radius, radiance, vec3(0)};
    return {bound.center() - dot(bound.center() - mean, n) * n, radius, radiance, n};
  }
};

}  // namespace

void BrightSpots::learn(const std::vector<BrightFind>& finds) {
  for (const BrightFind& find : finds) {
    irradiance_ += find.irradiance, ++records_;
    const size_t room = kMostHits - hits_.size();
    hits_.insert(hits_.end(), find.hits.begin(), find.hits.begin() + static_cast<ptrdiff_t>(std::min(room, find.hits.size())));
  }
  std::vector<BrightHit> hits = hits_;
  std::vector<Cluster> clusters{Cluster(hits)};
  while (clusters.size() < kMostSpots) {
    const auto widest = std::max_element(clusters.begin(), clusters.end(), [](const Cluster& a, const Cluster& b) { return a.spread() < b.spread(); });
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
    const bool disk = s.normal != vec3(0);
    const float turned = disk ? std::max(0.0f, -dot(axis, s.normal)) : 1.0f;
    const float covered = turned * sine * sine * std::min(1.0f, dot(axis, normal) + sine), share = s.radiance * covered;
    if (share <= 0) continue;
    irradiance_ += share, coverage_ += covered;
    const float versine = sine * sine / (1 + std::sqrt(1 - sine * sine)), radius2 = s.radius * s.radius;
    targets_.push_back({path, axis, s.normal, radius2, versine, irradiance_, share / (disk ? kPi * radius2 : 2 * kPi * versine)});
  }
  for (Target& t : targets_) t.upTo /= irradiance_, t.density /= irradiance_;
}

vec3 SpotAim::direction(float choice, const vec2& xi) const {
  const auto found = std::find_if(targets_.begin(), targets_.end() - 1, [&](const Target& t) { return choice < t.upTo; });
  const bool disk = found->normal != vec3(0);
  const vec3 middle = disk ? found->normal : found->axis;
  const float versine = xi.x * found->versine, phi = 2 * kPi * xi.y;
  const float r = disk ? std::sqrt(xi.x * found->radius2) : std::sqrt(versine * (2 - versine));
  vec3 tangent, bitangent;
  orthonormalBasis(middle, tangent, bitangent);
  const vec3 across = r * std::cos(phi) * tangent + r * std::sin(phi) * bitangent;
  return normalizeOr(across + (disk ? found->path : (1 - versine) * middle), found->axis);
}

float SpotAim::density(const vec3& direction) const {
  float sum = 0;
  for (const Target& t : targets_) {
    if (t.normal == vec3(0)) {
      const vec3 chord = direction - t.axis;  // cosines of small angles have no digits left
      if (dot(chord, chord) <= (2 + kRounding) * t.versine) sum += t.density;
      continue;
    }
    const float cosine = -dot(direction, t.normal), distance = -dot(t.path, t.normal) / cosine;
    const vec3 off = distance * direction - t.path;
    if (cosine > 0 && dot(off, off) <= (1 + kRounding) * t.radius2) sum += t.density * distance * distance / cosine;
  }
  return sum;
}

}  // namespace tomales
