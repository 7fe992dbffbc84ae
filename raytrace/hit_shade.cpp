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

/// Hit indices by shade group, in the order of the hits.
std::vector<std::vector<size_t>> byGroup(const Scene& scene, const std::vector<Hit>& hits) {
  std::vector<std::vector<size_t>> out(scene.groups.size());
  for (size_t i = 0; i < hits.size(); ++i)
    if (hits[i].object >= 0)
      out[static_cast<size_t>(scene.objects[static_cast<size_t>(hits[i].object)].group)].push_back(i);
  return out;
}

/// Parameters and primitive variables are those of the true surface, place and normals those that the ray
/// met.
void addPoint(const Scene& scene, const Ray& ray, const Hit& hit, uint32_t key, ShadePoints& points) {
  const int i = points.add(key);
  evaluatePoint(scene, hit.object, hit.patch, hit.u, hit.v, points, i);
  const vec3 I = ray.direction * hit.t;
  points.set3(kPx, i, ray.origin + I);
  points.set3(kNx, i, hit.normal);
  points.set3(kNgx, i, hit.geometricNormal);
  points.set3(kIx, i, I);
}

}  // namespace

void RayScene::shadeHits(const std::vector<Ray>& rays, const std::vector<Hit>& hits,
                         const std::vector<uint32_t>& keys, const ShadingSystem& shading,
                         const ShadeContext& context, std::vector<vec3>& radiance) const {
  const Scene& scene = impl_->scene;
  radiance.assign(hits.size(), vec3(0));
  const auto groups = byGroup(scene, hits);
  const bool diffuse = context.kind == RayKind::Diffuse;
  ShadedPoints shaded;
  for (size_t g = 0; g < groups.size(); ++g) {
    if (groups[g].empty()) continue;
    const ShadeGroup& group = scene.groups[g];
    ShadePoints points(static_cast<int>(g), primvarFloats(group));
    points.reserve(static_cast<int>(groups[g].size()));
    for (const size_t i : groups[g]) addPoint(scene, rays[i], hits[i], keys[i], points);
    shading.shade(points, context, shaded);
    const vec3 emission = diffuse ? vec3(0) : shading.visibleEmission(static_cast<int>(g));
    for (size_t k = 0; k < groups[g].size(); ++k) {
      const size_t i = groups[g][k];
      const vec3 color = shaded.color(static_cast<int>(k));
      const bool front = dot(rays[i].direction, hits[i].geometricNormal) < 0;
      radiance[i] = diffuse ? bled(color, *group.attributes) : color + (front ? emission : vec3(0));
    }
  }
}

}  // namespace tomales
