#include "raytrace/sky_openings.h"

#include <algorithm>
#include <array>
#include <optional>

#include "reyes/base/random_streams.h"
#include "reyes/base/rng.h"
#include "reyes/base/stop.h"

namespace tomales {
namespace {

constexpr int kViews = 16;            ///< Lines of sight along each edge of the picture.
constexpr size_t kFewestPoints = 32;  ///< Fewer say nothing about a room.
/// Numbers of rays of a point that test whether the room is closed, and that find openings.
constexpr uint32_t kFewRays = 16, kRays = 64;
constexpr float kClosed = 0.25f;                ///< A point is shut in if a smaller share of its rays reaches the sky.
constexpr double kMostlyClosed = 0.8;           ///< A room is closed if at least this share of its points is shut in.
constexpr size_t kFewestEscapes = 8;            ///< Rays that reach the sky; fewer find no outline.
constexpr size_t kCandidates = 96, kMost = 16;  ///< Rectangles that are tried, and that are kept.
constexpr int kAround = 8;                      ///< Directions in which an outline is looked for.
constexpr float kFirstStep = 0.01f, kWidest = 1.2f;  ///< Radians from the ray that has found the opening.
constexpr int kHalvings = 8;
/// Growth of rectangles: a strip left out would be noisy, but samples beyond the border are merely lost.
constexpr float kMargin = 1.01f;
constexpr uint32_t kTrials = 64;     ///< Rays that tell how much of a rectangle is open.
constexpr double kOpen = 0.3;        ///< Least open share of a rectangle.
constexpr double kAdds = 0.03;       ///< Least share of all escaped rays that a further rectangle adds.
constexpr double kFinds = 0.6;       ///< Least share of escaped rays that all rectangles have together.
constexpr double kBetter = 2;        ///< Least factor by which rays to rectangles reach the sky more often than others.
constexpr float kSpread = 0.1f;      ///< Spread of the rays: an opening needs no fine geometry.
constexpr int kMostTransparent = 8;  ///< Panes that one ray passes.

struct Place {
  vec3 P, N;  ///< N is on the side from which it was seen.
  int group;
};

struct Escape {
  vec3 origin, direction;
  int group;
};

struct Candidate {
  SkyOpening opening;
  double open = 0;  ///< The share of the rays towards it that reach the sky.
};

class Search {
 public:
  Search(const RayScene& rays, const Camera& camera, const ShadingSystem& shading)
      : rays_(rays), camera_(camera), shading_(shading) {}

  std::vector<SkyOpening> find() {
    look();
    if (places_.size() < kFewestPoints || !isClosed()) return {};
    lookFarther();
    const size_t sent = escape();
    if (escapes_.size() < kFewestEscapes || stopRequested()) return {};
    return chosen(candidates(), static_cast<double>(escapes_.size()) / static_cast<double>(sent));
  }

 private:
  /// Returns the first opaque surface in the way, if there is one.
  std::optional<Place> met(const vec3& origin, const vec3& direction, int group) const {
    Ray ray{origin, direction};
    ray.spread = kSpread;
    if (group >= 0) rays_.prepareOrigin(group, origin, 0, ray);
    for (int pane = 0; pane < kMostTransparent; ++pane) {
      const Hit hit = rays_.closest(ray, kMaskTransmission);
      if (hit.object < 0) return std::nullopt;
      const vec3 P = ray.origin + hit.t * direction;
      const int of = rays_.groupOf(hit);
      if (shading_.group(of).opaque())
        return Place{P, dot(direction, hit.geometricNormal) > 0 ? -hit.geometricNormal : hit.geometricNormal, of};
      ray = Ray{P, direction};
      ray.spread = kSpread;
      rays_.prepareOrigin(of, P, 0, ray);
    }
    return std::nullopt;
  }
  static vec3 around(const Place& from, uint32_t ray, uint32_t name) {
    vec3 tangent, bitangent;
    orthonormalBasis(from.N, tangent, bitangent);
    const vec3 local = cosineHemisphere(sobol2(ray, hashCombine(name, randomStream("open"))));
    return local.x * tangent + local.y * bitangent + local.z * from.N;
  }

  void look() {
    const vec2 size(camera_.xResolution(), camera_.yResolution());
    for (int k = 0; k < kViews * kViews; ++k) {
      vec3 origin, direction;
      camera_.ray((vec2(k % kViews, k / kViews) + 0.5f) / float{kViews} * size, origin, direction);
      if (const auto place = met(origin, direction, -1)) places_.push_back(*place);
    }
  }
  void lookFarther() {
    const size_t seen = places_.size();
    for (size_t i = 0; i < seen; ++i)
      if (const auto place = met(places_[i].P, around(places_[i], 0, static_cast<uint32_t>(i)), places_[i].group))
        places_.push_back(*place);
  }

  bool isClosed() const {
    size_t closed = 0;
    for (size_t i = 0; i < places_.size(); ++i) {
      uint32_t open = 0;
      for (uint32_t k = 0; k < kFewRays; ++k)
        open += !met(places_[i].P, around(places_[i], k, static_cast<uint32_t>(i)), places_[i].group);
      closed += static_cast<float>(open) < kClosed * float{kFewRays};
    }
    return static_cast<double>(closed) >= kMostlyClosed * static_cast<double>(places_.size());
  }

  /// Keeps the places that are shut in: others lie outside, or on the border between two walls. Returns how many rays
  /// they have sent.
  size_t escape() {
    std::vector<Place> shutIn;
    for (size_t i = 0; i < places_.size() && !stopRequested(); ++i) {
      const Place& from = places_[i];
      std::vector<Escape> open;
      for (uint32_t k = 0; k < kRays; ++k)
        if (const vec3 direction = around(from, k, static_cast<uint32_t>(i)); !met(from.P, direction, from.group))
          open.push_back({from.P, direction, from.group});
      if (static_cast<float>(open.size()) >= kClosed * float{kRays}) continue;
      shutIn.push_back(from);
      escapes_.insert(escapes_.end(), open.begin(), open.end());
    }
    places_ = std::move(shutIn);
    return places_.size() * kRays;
  }

  /// Returns where the opening ends, seen by turning the ray towards `side`.
  std::optional<vec3> edge(const Escape& ray, const vec3& side) const {
    const auto turned = [&](float angle) { return std::cos(angle) * ray.direction + std::sin(angle) * side; };
    float open = 0, shut = kFirstStep;
    std::optional<Place> frame;
    while (!(frame = met(ray.origin, turned(shut), ray.group))) {
      open = shut;
      shut *= 2;
      if (shut > kWidest) return std::nullopt;
    }
    for (int k = 0; k < kHalvings; ++k) {
      const float middle = 0.5f * (open + shut);
      if (const auto nearer = met(ray.origin, turned(middle), ray.group)) {
        frame = nearer;
        shut = middle;
      } else
        open = middle;
    }
    return frame->P;
  }

  std::optional<SkyOpening> outline(const Escape& ray) const {
    vec3 x, y;
    orthonormalBasis(ray.direction, x, y);
    std::array<vec3, kAround> edges;
    vec3 middle(0), normal(0);
    for (int k = 0; k < kAround; ++k) {
      const float angle = 2 * kPi * static_cast<float>(k) / kAround;
      const auto at = edge(ray, std::cos(angle) * x + std::sin(angle) * y);
      if (!at) return std::nullopt;
      edges[static_cast<size_t>(k)] = *at;
      middle += *at / float{kAround};
    }
    for (size_t k = 0; k < kAround; ++k) normal += cross(edges[k] - middle, edges[(k + 1) % kAround] - middle);
    if (!(glm::length(normal) > 0)) return std::nullopt;
    return smallestRectangle(edges, middle, glm::normalize(normal));
  }

  /// Two of the eight places lie on one edge of a rectangular opening, so that one of their connections is parallel to
  /// it.
  static std::optional<SkyOpening> smallestRectangle(const std::array<vec3, kAround>& edges, const vec3& middle,
                                                     const vec3& n) {
    std::optional<SkyOpening> best;
    float least = kInfinity;
    for (size_t k = 0; k < kAround; ++k) {
      const vec3 along = edges[(k + 1) % kAround] - edges[k], flat = along - dot(along, n) * n;
      if (!(glm::length(flat) > 0)) continue;
      const vec3 u = glm::normalize(flat), v = cross(n, u);
      vec2 low(kInfinity), high(-kInfinity);
      for (const vec3& e : edges) {
        const vec2 at(dot(e - middle, u), dot(e - middle, v));
        low = glm::min(low, at);
        high = glm::max(high, at);
      }
      const vec2 half = 0.5f * kMargin * (high - low), center = 0.5f * (low + high);
      if (!(half.x * half.y > 0 && half.x * half.y < least)) continue;
      least = half.x * half.y;
      best = SkyOpening{middle + center.x * u + center.y * v, half.x * u, half.y * v};
    }
    return best;
  }

  /// Returns the share of rays from places to the rectangle that reach the sky.
  double openness(const SkyOpening& opening, uint32_t name) const {
    uint32_t sent = 0, open = 0;
    for (uint32_t k = 0; k < kTrials; ++k) {
      const Place& from = places_[hashCombine(name, k, randomStream("from")) % places_.size()];
      const vec2 xi = 2.0f * sobol2(k, hashCombine(name, randomStream("pane"))) - 1.0f;
      const vec3 to = opening.center + xi.x * opening.halfU + xi.y * opening.halfV - from.P;
      if (!(dot(to, from.N) > 0)) continue;
      ++sent;
      open += !met(from.P, glm::normalize(to), from.group);
    }
    return sent ? static_cast<double>(open) / sent : 0;
  }

  std::vector<Candidate> candidates() const {
    std::vector<Candidate> out;
    const size_t stride = (escapes_.size() + kCandidates - 1) / kCandidates;
    for (size_t i = 0; i < escapes_.size(); i += stride)
      if (const auto opening = outline(escapes_[i]))
        out.push_back({*opening, openness(*opening, static_cast<uint32_t>(i))});
    std::erase_if(out, [](const Candidate& c) { return c.open < kOpen; });
    return out;
  }

  /// Takes the rectangle through which most of the rays that are left have gone, again and again.
  std::vector<SkyOpening> chosen(const std::vector<Candidate>& candidates, double seenByChance) const {
    std::vector<SkyOpening> out;
    std::vector<Escape> left = escapes_;
    double open = 0;
    while (out.size() < kMost) {
      const Candidate* best = nullptr;
      double most = kAdds * static_cast<double>(escapes_.size());
      for (const Candidate& c : candidates) {
        const auto crossed =
            std::ranges::count_if(left, [&](const Escape& e) { return c.opening.isCrossed(e.origin, e.direction); });
        if (c.open * static_cast<double>(crossed) <= most) continue;
        most = c.open * static_cast<double>(crossed);
        best = &c;
      }
      if (!best) break;
      std::erase_if(left, [&](const Escape& e) { return best->opening.isCrossed(e.origin, e.direction); });
      out.push_back(best->opening);
      open += best->open;
    }
    const bool finds = static_cast<double>(left.size()) < (1 - kFinds) * static_cast<double>(escapes_.size());
    const bool better = open > kBetter * seenByChance * static_cast<double>(out.size());
    return finds && better ? out : std::vector<SkyOpening>();
  }

  const RayScene& rays_;
  const Camera& camera_;
  const ShadingSystem& shading_;
  std::vector<Place> places_;
  std::vector<Escape> escapes_;
};

}  // namespace

bool SkyOpening::isCrossed(const vec3& origin, const vec3& direction) const {
  const vec3 n = normal();
  const float along = dot(direction, n);
  if (along == 0) return false;
  const float t = dot(center - origin, n) / along;
  if (!(t > 0)) return false;
  const vec3 off = origin + t * direction - center;
  return std::abs(dot(off, halfU)) <= dot(halfU, halfU) && std::abs(dot(off, halfV)) <= dot(halfV, halfV);
}

std::vector<SkyOpening> skyOpenings(const RayScene& rays, const Camera& camera, const ShadingSystem& shading) {
  return Search(rays, camera, shading).find();
}

}  // namespace tomales
