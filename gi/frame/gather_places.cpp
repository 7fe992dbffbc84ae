#include "gi/frame/gather_places.h"

#include <bit>

#include "gi/frame/ray_start.h"
#include "reyes/base/rng.h"

namespace tomales {
namespace {

uint32_t hashOf(const vec3& v) {
  return hashCombine(std::bit_cast<uint32_t>(v.x), std::bit_cast<uint32_t>(v.y), std::bit_cast<uint32_t>(v.z));
}

/// Returns the same as offsetOf(), but -1 where the width is not 3.
int tripleOf(const std::vector<Primvar>& primvars, std::string_view name) {
  const bool known =
      std::any_of(primvars.begin(), primvars.end(), [&](const Primvar& p) { return p.name == name && p.width == 3; });
  return known ? offsetOf(primvars, name) : -1;
}

}  // namespace

float projectedPixelSize(const Camera& camera, const vec3& P, const vec3& n) {
  constexpr float kLeastCosine = 0.05f;  // grazing views would let one record reach over whole objects
  const float cosine = std::abs(dot(normalizeOr(camera.incident(P), n), n));
  return camera.pixelSize(P) / std::sqrt(std::max(cosine, kLeastCosine));
}

int latticePhase(int x, int y) {
  const int level = std::min(std::countr_zero(static_cast<unsigned>(x | y)), 4);
  if (level == 4) return 0;
  const int half = 1 << level;
  return 1 + 2 * (3 - level) + (x & y & half ? 0 : 1);
}

GatherPlaces::GatherPlaces(const GiState& state, const ShadePoints& points) : state_(state), points_(points) {
  const ShadeGroup& group = state.scene.groups[static_cast<size_t>(points.group())];
  positions_ = tripleOf(group.primvars, "gatherP");
  normals_ = tripleOf(group.primvars, "gatherN");
  // The displacement shader of a group without displacement bound moves no point and only bends normals.
  bumped_ = group.attributes->displacement && group.attributes->displacementBound <= 0;
}

vec3 GatherPlaces::named(int offset, int i) const {
  return {points_.primvar(offset)[i], points_.primvar(offset + 1)[i], points_.primvar(offset + 2)[i]};
}

vec3 GatherPlaces::normal(int i) const {
  if (normals_ >= 0) return normalizeOr(named(normals_, i), points_.facingNormal(i));
  if (!bumped_) return points_.facingNormal(i);
  const vec3 n = points_.get3(kNgx, i);
  return dot(points_.get3(kIx, i), n) > 0 ? -n : n;
}

GatherPoint GatherPlaces::at(int i) const {
  const bool own = positions_ < 0;
  GatherPoint p{points_.group(),
                own ? points_.position(i) : named(positions_, i),
                normal(i),
                points_.key(i),
                0,
                points_.edgeLength(i),
                own ? points_.get3(kDriftX, i) : vec3(0),
                points_.channel(kTime)[i]};
  if (!own) p.key = hashCombine(hashOf(p.position), hashOf(p.normal));
  p.pixelSize = projectedPixelSize(state_.camera, p.position, p.normal);
  return p;
}

IrradiancePlace GatherPlaces::lookupAt(int i, const vec3& normal) const {
  IrradiancePlace p{positions_ < 0 ? points_.position(i) : named(positions_, i), this->normal(i), shading(i, normal),
                    0};
  p.pixelSize = projectedPixelSize(state_.camera, p.position, p.normal);
  return p;
}

void GatherPlaces::startRay(const RayScene& rays, int i, float time, Ray& ray) const {
  ray.origin = points_.position(i);
  tomales::startRay(rays, points_, i, time, ray);
  if (positions_ < 0) return;
  ray.origin = rays.placeAt(points_.group(), named(positions_, i), vec3(0), time);
}

}  // namespace tomales
