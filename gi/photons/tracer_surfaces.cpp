// The part of PhotonTracer that decides what happens to a photon at a surface.
#include "gi/gather.h"
#include "gi/photons/tracer.h"
#include "reyes/base/rng.h"

namespace tomales {
namespace {

/// The spread of one of about a hundred gather rays. Irradiance is estimated over a wider area than that.
constexpr float kDiffuseSpread = 0.1f;
/// Limit for one path: layers of leaves and smoke end somewhere, faults of geometry may not.
constexpr uint32_t kMostSurfacesPassed = 1000;

/// Reflection or refraction at a smooth dielectric.
vec3 dielectric(const vec3& d, const vec3& towards, bool entering, float index, float xi) {
  const float eta = entering ? 1 / index : index, cosine = -dot(d, towards);
  const float k = 1 - eta * eta * (1 - cosine * cosine);
  const vec3 mirrored = d + 2 * cosine * towards;
  if (k < 0) return mirrored;
  const float inside = std::sqrt(k);
  const float rs = (eta * cosine - inside) / (eta * cosine + inside),
              rp = (cosine - eta * inside) / (cosine + eta * inside);
  return xi < 0.5f * (rs * rs + rp * rp) ? mirrored : eta * d + (eta * cosine - inside) * towards;
}

}  // namespace

/// Light that comes straight from a lamp, or by mirrors, is seen only by objects for which that lamp is switched on.
bool PhotonTracer::landsOn(const Path& path, int group) const {
  return !path.specular || isOnFor(scene_.groups[static_cast<size_t>(group)], path.light);
}

/// Returns false where the path ends.
bool PhotonTracer::interact(Path& path, const Hit& hit, const Answer& answer, const Draw& xi, uint32_t stream,
                            std::vector<StoredPhoton>& out) const {
  const int group = groupOf(hit);
  const PhotonModel model = surfaces_.model(group);
  const uint32_t name = keyOf(path, stream);
  if (model == PhotonModel::Transparent)
    return passThrough(path, hit, scene_.groups[static_cast<size_t>(group)].attributes->color, xi.survival);
  if (!surfaces_.isDiffuse(group))
    return reflectOrRefract(path, hit, xi.survival, sobol1(path.number, hashCombine(name, 2u)));
  // A transparent part stores no light. Example: the card around the picture of a leaf.
  const vec3 transmitted = 1.0f - answer.opacity;
  const float passing = (transmitted.x + transmitted.y + transmitted.z) / 3;
  const bool lands = passing < 1 && landsOn(path, group);
  if (lands && (settings_.direct || path.depth > 0)) {
    const vec3 Ng = hit.geometricNormal;
    out.push_back({hit.atOpen, dot(path.ray.direction, Ng) < 0 ? Ng : -Ng, path.power, group, path.depth, path.bounces,
                   path.specularFirst});
  }
  if (passing > 0 && sobol1(path.number, hashCombine(name, 3u)) < passing)
    return passThrough(path, hit, transmitted / passing, xi.survival);
  return lands && scatter(path, hit, answer.reflected / (1 - passing), xi, hashCombine(name, 2u));
}

/// Passes the surface as if nothing were there, tinted: it counts as no arrival, and makes no caustic.
bool PhotonTracer::passThrough(Path& path, const Hit& hit, const vec3& transmitted, float xi) const {
  if (++path.surfacesPassed > kMostSurfacesPassed || !survive(path, transmitted, xi)) return false;
  leave(path, hit, path.ray.direction);
  return true;
}

bool PhotonTracer::scatter(Path& path, const Hit& hit, const vec3& reflected, const Draw& xi, uint32_t side) const {
  if (++path.depth >= settings_.maxDepth || !countScattering(path) || !survive(path, reflected, xi.survival))
    return false;
  // The hemisphere is that of the polygon. Around the interpolated normal some photons would start into the polygon,
  // and be caught in the body that it bounds.
  const bool through = surfaces_.model(groupOf(hit)) == PhotonModel::Translucent && sobol1(path.number, side) < 0.5f;
  const vec3 axis =
      (dot(path.ray.direction, hit.geometricNormal) < 0) != through ? hit.geometricNormal : -hit.geometricNormal;
  vec3 tangent, bitangent;
  orthonormalBasis(axis, tangent, bitangent);
  const vec3& local = xi.direction;
  leave(path, hit, local.x * tangent + local.y * bitangent + local.z * axis);
  return true;
}

bool PhotonTracer::reflectOrRefract(Path& path, const Hit& hit, float survival, float xi) const {
  const PhotonModel model = surfaces_.model(groupOf(hit));
  const vec3& tint = scene_.groups[static_cast<size_t>(groupOf(hit))].attributes->color;
  if (++path.depth >= settings_.maxDepth || !survive(path, tint, survival)) return false;
  if (path.specular && !path.specularFirst) {
    path.specularFirst = true;
    ++path.bounces;
  }
  const vec3 d = path.ray.direction;
  const bool front = dot(d, hit.geometricNormal) < 0;
  const vec3 N = front ? hit.normal : -hit.normal;
  const vec3 mirrored = d - 2 * dot(d, N) * N;
  const float index = model == PhotonModel::Water ? 1.33f : 1.5f;
  leave(path, hit, normalizeOr(model == PhotonModel::Chrome ? mirrored : dielectric(d, N, front, index, xi), N));
  return true;
}

/// Counts a diffuse surface or a collision. Returns false if no later arrival would count.
bool PhotonTracer::countScattering(Path& path) const {
  path.specular = false;
  return ++path.bounces <= settings_.mostBounces && (path.specularFirst || !settings_.specularFirstOnly);
}

/// Surviving photons keep the power that they came with, so that all stored photons have about the same power.
bool PhotonTracer::survive(Path& path, const vec3& left, float xi) {
  const vec3 power = path.power * left;
  const float survival = std::min(1.0f, maxComponent(power) / maxComponent(path.power));
  if (!(xi < survival)) return false;
  path.power = power / survival;
  return true;
}

/// Sends the photon on in a unit direction.
void PhotonTracer::leave(Path& path, const Hit& hit, const vec3& direction) const {
  Ray& ray = path.ray;
  const vec3& N = hit.normal;
  ray.origin += hit.t * ray.direction;
  ray.direction = direction;
  // The tessellation level of the next hit follows from the ray's width; the texture filter there does not.
  ray.spread = path.specular ? 0.0f : kDiffuseSpread;
  rays_.prepareOrigin(groupOf(hit), ray.origin, 0, ray);
  ray.spread = 0;
  ray.offset = slantedOffset(ray.offset, std::abs(dot(direction, N)));
  path.lift = liftOf(ray, hit.geometricNormal);
}

}  // namespace tomales
