// Transmittance of the surfaces between two points.
#include "raytrace/ray_scene.h"

namespace tomales {
namespace {

/// Share of a shadow ray that is cut off before the light, so as not to meet its surface.
constexpr float kFarEnd = 1e-4f;

/// Adds the surfaces of solids to the list. Returns false if one is opaque beyond the window.
bool addSolids(const RayScene::Impl& scene, const Ray& ray, float window, HitList& list) {
  if (scene.solids.none()) return true;
  thread_local HitList surfaces;
  scene.solids.surfaces(ray, std::max(window, 0.0f), kMaskTransmission, surfaces);
  for (const PolygonHit& s : surfaces) {
    if (window < 0 && s.t <= ray.bias) continue;
    if (s.t > window && scene.opaque[s.group]) return false;
    list.push_back(s);
  }
  return true;
}

/// The surfaces that one ray goes through, in order.
struct Layers {
  bool blocked = false, adjusted = false;
  std::vector<PolygonHit> hits;
};

Layers layersOf(const RayScene::Impl& scene, const Ray& ray) {
  thread_local HitList list;
  Ray shortened = ray;
  shortened.tMax *= 1 - kFarEnd;
  const bool offsetting = ray.offset > 0;
  const float window = offsetting ? recordingWindow(ray.offset) : -1.0f;
  Layers out;
  out.blocked = scene.embree.blockedBeyond(shortened, window, kMaskTransmission, list) ||
                !addSolids(scene, shortened, window, list);
  if (out.blocked) return out;
  sortAlongRay(list);
  const RayStart start = startOf(ray);
  const int origin = offsetting ? effectiveOrigin(list, start) : -1, first = nextHit(list, origin, start);
  out.adjusted = origin >= 0;
  for (size_t i = static_cast<size_t>(first); first >= 0 && i < list.size(); ++i) {
    // An edge shared by two quads counts once. For far hits the distance allowed is their rounding error.
    const bool again = i > static_cast<size_t>(first) &&
                       sameSurface(list[i - 1], list[i], std::max(mergeDistance(ray.offset), 1e-6f * list[i].t));
    if (!again) out.hits.push_back(list[i]);
  }
  return out;
}

/// Hits whose opacity is not that of their attributes; their shaders run together.
struct Asked {
  std::vector<size_t> rayOf;
  std::vector<Ray> rays;
  std::vector<Hit> hits;
  std::vector<SampleName> names;
};

}  // namespace

std::vector<vec3> RayScene::transmission(const std::vector<Ray>& rays, const std::vector<SampleName>& names,
                                         const ShadingSystem& shading, const ShadeContext& context,
                                         int64_t& adjusted) const {
  std::vector<vec3> transmitted(rays.size(), vec3(1));
  Asked asked;
  for (size_t r = 0; r < rays.size(); ++r) {
    if (!traceable(rays[r])) continue;
    const Layers layers = layersOf(*impl_, rays[r]);
    if (layers.blocked) transmitted[r] = vec3(0);
    adjusted += layers.adjusted;
    for (const PolygonHit& hit : layers.hits)
      if (impl_->knowsOpacity(hit.group)) transmitted[r] *= glm::clamp(impl_->transmittance(hit), 0.0f, 1.0f);
    if (transmitted[r] != vec3(0) && !impl_->volumes.none())
      transmitted[r] *= impl_->volumes.passed(rays[r], rays[r].tMax, kMaskTransmission);
    if (transmitted[r] == vec3(0)) continue;
    for (const PolygonHit& hit : layers.hits) {
      if (impl_->knowsOpacity(hit.group)) continue;
      asked.rayOf.push_back(r);
      asked.rays.push_back(rays[r]);
      impl_->resolve(rays[r], hit, asked.hits.emplace_back());
      asked.names.push_back(names[r]);
    }
  }
  if (asked.hits.empty()) return transmitted;
  ShadeContext inside = context;
  inside.kind = RayKind::Transmission;
  HitAnswers answers;
  shadeHits(asked.rays, asked.hits, asked.names, shading, inside, HitQuestion(), answers);
  for (size_t k = 0; k < asked.hits.size(); ++k)
    transmitted[asked.rayOf[k]] *= 1.0f - glm::clamp(answers.opacity[k], 0.0f, 1.0f);
  return transmitted;
}

const std::vector<uint8_t>* RayScene::groupsBesideLamp(int light) const {
  const std::lock_guard lock(impl_->subsetsMutex);
  const auto [it, isNew] = impl_->besideLamps.try_emplace(light);
  if (isNew)
    for (const ShadeGroup& g : impl_->scene.groups) it->second.push_back(g.attributes->areaLight != light);
  return &it->second;
}

}  // namespace tomales
