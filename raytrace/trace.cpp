#include "raytrace/trace.h"

#include "raytrace/ray_scene.h"

namespace tomales {
namespace {

// A chord that turns the surface by 45 degrees lies at most a tenth of its length inside. Long micropolygons stand at
// silhouettes, where dicing by raster size is coarse in space.
constexpr float kChordShare = 0.1f;
constexpr float kOffsetFactor = 1.5f;  ///< docs/decisions/0006-hit-list-offset.md
constexpr float kOffsetEpsilon =
    1e-5f;                      ///< Of distance and size: rounding, where the coarse surface is exact.
constexpr float kBias = 1e-4f;  ///< The same for rays without a hit list.
constexpr float kFarEnd =
    1e-4f;  ///< Share of a shadow ray that ends before the light, not to meet its surface.

std::vector<uint32_t> masksOf(const Scene& scene) {
  std::vector<uint32_t> masks;
  for (const ShadeGroup& g : scene.groups) {
    const Visibility& v = g.attributes->visibility;
    masks.push_back((v.diffuse ? kMaskDiffuse : 0u) | (v.specular ? kMaskSpecular : 0u) |
                    (v.transmission ? kMaskTransmission : 0u) | (v.photon ? kMaskPhoton : 0u));
  }
  return masks;
}

std::vector<bool> opaqueOf(const Scene& scene) {
  std::vector<bool> opaque;
  for (const ShadeGroup& g : scene.groups)
    opaque.push_back(glm::all(glm::greaterThanEqual(g.attributes->opacity, vec3(1))));
  return opaque;
}

bool traceable(const Ray& ray) {
  return isFinite(ray.origin) && isFinite(ray.direction) && ray.direction != vec3(0) && ray.tMax > 0;
}

/// Positions are off by a few units in the last place of their distance from the eye.
RayStart startOf(const Ray& ray) { return {ray.offset, 4e-7f * glm::length(ray.origin), ray.group}; }

/// Lists for each thread: no allocation once they have grown.
HitList& scratchList() {
  thread_local HitList list;
  return list;
}
HitList& scratchSurfaces() {
  thread_local HitList list;
  return list;
}

}  // namespace

RayScene::Impl::Impl(const Scene& s, const Camera& camera, const ShadingSystem& shading, bool useHitList,
                     Log& log)
    : scene(s),
      hitList(useHitList),
      groups(tessellate(s, camera, shading, log)),
      masks(masksOf(s)),
      opaque(opaqueOf(s)),
      embree(groups, masks, opaque, false, log),
      solids(s, groups, masks, log),
      emitters(s, groups),
      displacementBounds(groups.size(), 0.0f) {
  for (const Object& o : scene.objects)
    if (!o.attributes->trace.displacements) {
      float& bound = displacementBounds[static_cast<size_t>(o.group)];
      bound = std::max(bound, o.displacementBound);
    }
  moves = std::any_of(groups.begin(), groups.end(), [](const CoarseGroup& g) { return !g.laterP.empty(); });
  for (const Object& o : scene.objects)
    if (const int light = o.attributes->areaLight; light >= 0 && !emitters.shines(light))
      log.report(Severity::Warning, "light-no-area", o.where,
                 objectName(o) + ": the geometry of its area light has no area; it casts no light");
  for (const Object& o : scene.objects)
    if (o.solid >= 0 && o.attributes->areaLight >= 0)
      log.report(Severity::Warning, "light-in-solid", o.where,
                 objectName(o) + ": part of a solid and of an area light: it shines from the whole of its surface, also from "
                                 "where the solid takes it away");
}

bool RayScene::Impl::addSolids(const Ray& ray, float window, uint32_t mask, HitList& list, bool found,
                               PolygonHit& beyond) const {
  if (solids.none()) return found;
  HitList& surfaces = scratchSurfaces();
  solids.surfaces(ray, window, mask, surfaces);
  for (const PolygonHit& s : surfaces) {
    if (s.t <= window) {
      list.push_back(s);
      continue;
    }
    if (!found || s.t < beyond.t) beyond = s;
    return true;
  }
  return found;
}

Hit RayScene::Impl::resolve(const PolygonHit& polygon) const {
  const CoarseGroup& g = groups[polygon.group];
  const Quad& q = g.quads[polygon.quad];
  const Lattice& l = g.latticeOf(polygon.quad);
  const vec2 uv = g.patchParameters(polygon.quad, polygon.u, polygon.v);
  const vec3 geometric = g.geometricNormal(polygon.quad);
  const vec3 normal = glm::mix(glm::mix(g.N[q[0]], g.N[q[1]], polygon.u),
                               glm::mix(g.N[q[3]], g.N[q[2]], polygon.u), polygon.v);
  return {polygon.t, l.object, l.patch, uv.x, uv.y, normalizeOr(normal, geometric), geometric, false,
          g.pointOn(polygon.quad, polygon.u, polygon.v)};
}

RayScene::RayScene(const Scene& scene, const Camera& camera, const ShadingSystem& shading, bool hitList,
                   Stats& stats, Log& log)
    : impl_(std::make_unique<Impl>(scene, camera, shading, hitList, log)) {
  size_t polygons = 0, bytes = impl_->embree.bytes() + impl_->solids.bytes();
  for (const CoarseGroup& g : impl_->groups) polygons += g.quads.size(), bytes += g.bytes();
  stats.raytrace.coarsePolygons += static_cast<int64_t>(polygons);
  stats.raytrace.bytes += static_cast<int64_t>(bytes);
}

RayScene::~RayScene() = default;

Hit RayScene::closest(const Ray& ray, RayMask mask) const {
  if (!traceable(ray)) return {};
  PolygonHit hit;
  HitList& list = scratchList();
  if (!(ray.offset > 0)) {
    const bool found = impl_->embree.nearest(ray, mask, hit);
    return impl_->addSolids(ray, std::max(ray.bias, 0.0f), mask, list, found, hit) ? impl_->resolve(hit) : Hit{};
  }
  const float window = recordingWindow(ray.offset);
  const bool beyond =
      impl_->addSolids(ray, window, mask, list, impl_->embree.nearestBeyond(ray, window, mask, list, hit), hit);
  sortAlongRay(list);
  const RayStart start = startOf(ray);
  const int origin = effectiveOrigin(list, start), next = nextHit(list, origin, start);
  if (next >= 0) hit = list[static_cast<size_t>(next)];
  Hit out;
  if (next >= 0 ? hit.t < ray.tMax : beyond) out = impl_->resolve(hit);
  out.adjusted = origin >= 0;
  return out;
}

vec3 RayScene::transmission(const Ray& ray) const {
  if (!traceable(ray)) return vec3(1);
  Ray shortened = ray;
  shortened.tMax *= 1 - kFarEnd;
  HitList& list = scratchList();
  const bool offsetting = ray.offset > 0;
  const float window = offsetting ? recordingWindow(ray.offset) : -1.0f;
  if (impl_->embree.blockedBeyond(shortened, window, kMaskTransmission, list)) return vec3(0);
  if (!impl_->solids.none()) {
    HitList& surfaces = scratchSurfaces();
    impl_->solids.surfaces(shortened, std::max(window, 0.0f), kMaskTransmission, surfaces);
    for (const PolygonHit& s : surfaces) {
      if (!offsetting && s.t <= ray.bias) continue;
      if (s.t > window && impl_->opaque[s.group]) return vec3(0);
      list.push_back(s);
    }
  }
  sortAlongRay(list);
  const RayStart start = startOf(ray);
  const int origin = offsetting ? effectiveOrigin(list, start) : -1, first = nextHit(list, origin, start);
  vec3 clear(1);
  for (size_t i = static_cast<size_t>(first); first >= 0 && i < list.size(); ++i) {
    // An edge shared by two quads counts once; far hits are as far apart as their rounding.
    const bool again =
        i > static_cast<size_t>(first) &&
        sameSurface(list[i - 1], list[i], std::max(mergeDistance(ray.offset), 1e-6f * list[i].t));
    if (!again) clear *= glm::clamp(impl_->clearness(list[i]), 0.0f, 1.0f);
  }
  return clear;
}

void RayScene::prepareOrigin(int group, const vec3& P, float edgeLength, Ray& ray) const {
  const auto g = static_cast<size_t>(group);
  const auto& given = impl_->scene.groups[g].attributes->trace;
  const CoarseGroup& coarse = impl_->groups[g];
  const float scale = glm::length(P) + coarse.size;
  const float automatic =
      kOffsetFactor * (coarse.deviation + impl_->displacementBounds[g] + kChordShare * edgeLength) +
      kOffsetEpsilon * scale;
  ray.group = group;
  ray.offset = impl_->hitList ? std::max(given.offset.value_or(automatic), 0.0f) : 0.0f;
  ray.bias = given.bias.value_or(kBias * scale);
}

bool RayScene::samplesTime(int group) const {
  return impl_->moves && impl_->scene.groups[static_cast<size_t>(group)].attributes->trace.sampleMotion;
}

vec3 RayScene::placeAt(int group, const vec3& atOpen, const vec3& drift, float time) const {
  const ShadeGroup& g = impl_->scene.groups[static_cast<size_t>(group)];
  const vec3 drifted = atOpen + time * drift;
  if (!impl_->moves || time == 0 || !g.currentFromOpen.moving()) return drifted;
  const Options& o = impl_->scene.options;
  return transformPoint(g.currentFromOpen.at(lerp(o.shutterOpen, o.shutterClose, time)), drifted);
}

bool RayScene::sampleEmitter(int light, int count, const float* xi0, const float* xi1, TmVec3 P, TmVec3 N,
                             float* area) const {
  return impl_->emitters.sample(light, count, xi0, xi1, P, N, area);
}

}  // namespace tomales
