#include "gi/frame/ray_start.h"

#include "reyes/base/random_streams.h"
#include "reyes/base/rng.h"

namespace tomales {

float rayTime(const RayScene& rays, const ShadePoints& points, int i, int number, int count, uint32_t seed) {
  const float own = points.channel(kTime)[i];
  if (own >= 0) return own;
  if (!rays.samplesTime(points.group())) return 0;
  const SampleName name = points.name(i);
  const uint32_t index = name.sequence * static_cast<uint32_t>(count) + static_cast<uint32_t>(number);
  return sobol1(index, hashCombine(name.key, randomStream("time"), seed));
}

void startRay(const RayScene& rays, const ShadePoints& points, int i, float time, Ray& ray) {
  const vec3 end = ray.origin + ray.tMax * ray.direction;
  ray.time = time;
  if (time > 0 && !points.inAir()) ray.origin = rays.placeAt(points.group(), ray.origin, points.get3(kDriftX, i), time);
  if (time > 0 && ray.tMax < kRiInfinity) {
    ray.tMax = glm::length(end - ray.origin);
    ray.direction = normalizeOr(end - ray.origin, ray.direction);
  }
  // The tessellation level of the hit follows from the area that the point itself stands for; the texture filter there
  // does not.
  Ray wide = ray;
  wide.radius = std::max(ray.radius, std::sqrt(points.channel(kArea)[i] / kPi));
  rays.prepareOrigin(points.group(), ray.origin, points.edgeLength(i), wide);
  if (points.inAir()) wide.offset = wide.bias = 0;
  wide.radius = ray.radius;
  ray = wide;
}

}  // namespace tomales
