#include "gi/gather/layers.h"

#include "gi/gather.h"
#include "reyes/base/random_streams.h"
#include "reyes/base/rng.h"

namespace tomales {

void RayLayers::add(int element, const Ray& ray, SampleName name) {
  rays.push_back(ray);
  names.push_back(name);
  elements.push_back(element);
  transmittance.push_back(vec3(1));
}

int64_t RayLayers::meet(const RayScene& scene, RayMask mask, std::vector<Hit>& hits) const {
  int64_t adjusted = 0;
  hits.clear();
  for (const Ray& ray : rays) {
    hits.push_back(scene.closest(ray, mask));
    adjusted += hits.back().adjusted;
  }
  return adjusted;
}

/// Returns the continuation of the ray behind the hit, started like any ray that leaves a surface.
Ray RayLayers::behind(const RayScene& scene, const Ray& ray, const Hit& hit) {
  Ray on = ray;
  on.origin = ray.origin + hit.t * ray.direction;
  on.surroundings = nullptr;
  on.tMax = ray.tMax - hit.t;
  on.radius += ray.spread * hit.t;
  scene.prepareOrigin(scene.groupOf(hit), on.origin, 0, on);
  on.offset = slantedOffset(on.offset, std::abs(dot(ray.direction, hit.geometricNormal)));
  return on;
}

void RayLayers::keep(size_t to, size_t from, const Ray& ray, const vec3& passes) {
  rays[to] = ray;
  elements[to] = elements[from];
  transmittance[to] = passes;
  names[to] = {hashCombine(names[from].key, randomStream("laye")), names[from].sequence};
}

void RayLayers::resize(size_t count) {
  rays.resize(count);
  names.resize(count);
  elements.resize(count);
  transmittance.resize(count);
}

}  // namespace tomales
