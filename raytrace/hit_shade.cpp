#include <algorithm>
#include <numeric>

#include "raytrace/ray_scene.h"
#include "reyes/dice.h"

namespace tomales {
namespace {

int primvarFloats(const ShadeGroup& group) {
  return std::accumulate(group.primvars.begin(), group.primvars.end(), 0,
                         [](int sum, const Primvar& p) { return sum + p.width; });
}

/// The light that a ray brings back where its hit is on the indirect diet of Attribute "indirect".
vec3 bled(const vec3& color, const Attributes& a) {
  return glm::mix(vec3(luminance(color)), color, a.indirect.bleeding) * a.indirect.bleedingColor;
}

/// Indices of the hits, those of one shade group together, in the order of the hits inside it.
std::vector<uint32_t> byGroup(const Scene& scene, const std::vector<Hit>& hits, std::vector<int>& group) {
  std::vector<uint32_t> order;
  order.reserve(hits.size());
  group.assign(hits.size(), -1);
  for (size_t i = 0; i < hits.size(); ++i) {
    if (hits[i].object < 0) continue;
    group[i] = scene.objects[static_cast<size_t>(hits[i].object)].group;
    order.push_back(static_cast<uint32_t>(i));
  }
  std::stable_sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) { return group[a] < group[b]; });
  return order;
}

/// A hit later than shutter open is shaded as all else is: the surface stands where it was then, and the ray comes to it as it
/// came to the moved one. Drift is whatever takes it from there to where the ray met it.
void bringToOpen(const Scene& scene, const Ray& ray, const Hit& hit, ShadePoints& points, int i) {
  const ShadeGroup& group = scene.groups[static_cast<size_t>(points.group())];
  const float shutter = lerp(scene.options.shutterOpen, scene.options.shutterClose, ray.time);
  const mat4 openFromNow = glm::inverse(group.currentFromOpen.at(shutter));
  const vec3 I = points.get3(kIx, i);
  points.set3(kIx, i, glm::length(I) * normalizeOr(transformVector(openFromNow, I), I));
  points.set3(kDriftX, i, (transformPoint(openFromNow, points.position(i)) - hit.atOpen) / ray.time);
  points.set3(kPx, i, hit.atOpen);
}

/// Parameters and primitive variables are those of the true surface, place and normals those that the ray
/// met.
void addPoint(const Scene& scene, const Ray& ray, const Hit& hit, SampleName name, ShadePoints& points) {
  const int i = points.add(name);
  evaluatePoint(scene, hit.object, hit.patch, hit.u, hit.v, points, i);
  const vec3 I = ray.direction * hit.t;
  points.set3(kPx, i, ray.origin + I);
  points.set3(kNx, i, hit.normal);
  points.set3(kNgx, i, hit.geometricNormal);
  points.set3(kIx, i, I);
  points.channel(kTime)[i] = ray.time;
  if (ray.time > 0) bringToOpen(scene, ray, hit, points, i);
}

}  // namespace

void RayScene::shadeHits(const std::vector<Ray>& rays, const std::vector<Hit>& hits,
                         const std::vector<SampleName>& names, const ShadingSystem& shading,
                         const ShadeContext& context, std::vector<vec3>& radiance) const {
  const Scene& scene = impl_->scene;
  radiance.assign(hits.size(), vec3(0));
  std::vector<int> groupOf;
  const std::vector<uint32_t> order = byGroup(scene, hits, groupOf);
  const bool diffuse = context.kind == RayKind::Diffuse;
  ShadedPoints shaded;
  for (size_t first = 0, last = 0; first < order.size(); first = last) {
    const int g = groupOf[order[first]];
    while (last < order.size() && groupOf[order[last]] == g) ++last;
    const ShadeGroup& group = scene.groups[static_cast<size_t>(g)];
    ShadePoints points(g, primvarFloats(group));
    points.reserve(static_cast<int>(last - first));
    for (size_t k = first; k < last; ++k) addPoint(scene, rays[order[k]], hits[order[k]], names[order[k]], points);
    shading.shade(points, context, shaded);
    const vec3 emission = diffuse ? vec3(0) : shading.visibleEmission(g);
    for (size_t k = first; k < last; ++k) {
      const uint32_t i = order[k];
      const int p = static_cast<int>(k - first);
      const vec3 color = shaded.color(p);
      const bool front = dot(points.get3(kIx, p), points.get3(kNgx, p)) < 0;
      radiance[i] = diffuse ? bled(color, *group.attributes) : color + (front ? emission : vec3(0));
    }
  }
}

}  // namespace tomales
