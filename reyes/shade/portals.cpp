#include "reyes/shade/portals.h"

namespace tomales {
namespace {

/// The largest share of samples that go to portals. The others are drawn from the sky. They are at least a quarter, so
/// no sample weighs more than four times as much as without portals.
constexpr float kShare = 0.75f;

/// Returns the portal's solid angle, estimated at its middle, and at most a hemisphere; 0 behind the horizon.
float weightOf(const Portal& portal, const vec3& P, const vec3& N) {
  const auto& [corner, u, v, normal] = portal;
  const vec3 corners[] = {corner, corner + u, corner + v, corner + u + v};
  float highest = N == vec3(0.0f) ? 1.0f : 0.0f;
  for (const vec3& c : corners) highest = std::max(highest, dot(N, c - P));
  if (!(highest > 0)) return 0;
  const vec3 to = corner + 0.5f * (u + v) - P;
  const float distance = glm::length(to), seen = std::abs(dot(normal, to));
  return seen < 2 * kPi * distance * distance * distance ? seen / (distance * distance * distance) : 2 * kPi;
}

/// Returns the density over solid angle of positions that are uniform on the portal.
float pdfOf(const Portal& portal, const vec3& P, const vec3& L) {
  const auto& [corner, u, v, normal] = portal;
  const vec3 to = corner - P;
  const float along = dot(normal, L), area = glm::length(normal);
  if (along == 0) return 0;
  const float t = dot(normal, to) / along;
  if (!(t > 0)) return 0;
  const vec3 place = t * L - to;
  const float a = dot(cross(place, v), normal) / (area * area), b = dot(cross(u, place), normal) / (area * area);
  if (a < 0 || a > 1 || b < 0 || b > 1) return 0;
  return t * t / std::abs(along);
}

}  // namespace

bool Portals::add(const mat4& currentFromSpace) {
  const auto at = [&](float x, float y) { return vec3(currentFromSpace * vec4(x, y, 0, 1)); };
  const vec3 corner = at(-0.5f, -0.5f), u = at(0.5f, -0.5f) - corner, v = at(-0.5f, 0.5f) - corner,
             normal = cross(u, v);
  if (!(glm::length(normal) > 0) || !isFinite(normal) || !isFinite(corner)) return false;
  portals_.push_back({corner, u, v, normal});
  return true;
}

float Portals::weights(const vec3& P, const vec3& N) const {
  float sum = 0;
  for (const Portal& p : portals_) sum += weightOf(p, P, N);
  return sum;
}

float Portals::share(const vec3& P, const vec3& N) const { return weights(P, N) > 0 ? kShare : 0.0f; }

vec3 Portals::sample(const vec3& P, const vec3& N, vec2 xi) const {
  float left = xi.x * weights(P, N);
  const Portal* chosen = nullptr;
  for (const Portal& p : portals_) {
    const float weight = weightOf(p, P, N);
    if (!(weight > 0)) continue;
    chosen = &p;
    xi.x = std::min(left / weight, 1.0f);
    if (left < weight) break;
    left -= weight;
  }
  return normalizeOr(chosen->corner + xi.x * chosen->u + xi.y * chosen->v - P,
                     normalizeOr(chosen->normal, chosen->normal));
}

float Portals::pdf(const vec3& P, const vec3& N, const vec3& L) const {
  const float sum = weights(P, N);
  if (!(sum > 0)) return 0;
  float pdf = 0;
  for (const Portal& p : portals_)
    if (const float weight = weightOf(p, P, N); weight > 0) pdf += weight * pdfOf(p, P, L);
  return pdf / sum;
}

}  // namespace tomales
