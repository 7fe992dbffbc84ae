#include "gi/gather.h"

#include "gi/hemisphere.h"
#include "reyes/base/rng.h"

namespace tomales {

IrradianceRecord gather(const RayScene& scene, const ShadingSystem& shading, const GatherPoint& point,
                        const GatherSettings& settings, Stats& stats) {
  const HemisphereCells cells = hemisphereCells(settings.samples);
  const size_t count = static_cast<size_t>(cells.rings) * static_cast<size_t>(cells.sectors);
  HemisphereSamples samples{cells, {}, {}, point.normal, {}, {}, {}};
  orthonormalBasis(point.normal, samples.tangent, samples.bitangent);

  Ray ray{point.position, point.normal, settings.maxDistance};
  scene.prepareOrigin(point.group, point.position, point.edgeLength, ray);
  std::vector<Ray> rays(count, ray);
  std::vector<Hit> hits(count);
  std::vector<uint32_t> keys(count);
  std::vector<vec3> directions(count), radiance;
  std::vector<float> distances(count);
  int64_t adjusted = 0;
  for (size_t i = 0; i < count; ++i) {
    const int cell = static_cast<int>(i);
    keys[i] = hashCombine(point.key, static_cast<uint32_t>(i), settings.seed);
    const vec2 xi{unitFloat(hash32(keys[i] ^ 0x3c6ef372U)), unitFloat(hash32(keys[i] ^ 0xa54ff53aU))};
    const vec3 local = hemisphereDirection(cells, cell / cells.sectors, cell % cells.sectors, xi);
    directions[i] = local.x * samples.tangent + local.y * samples.bitangent + local.z * point.normal;
    rays[i].direction = directions[i];
    rays[i].offset = slantedOffset(ray.offset, local.z);
    hits[i] = scene.closest(rays[i], kMaskDiffuse);
    distances[i] = hits[i].object < 0 ? kInfinity : std::max(0.0f, hits[i].t);
    adjusted += hits[i].adjusted;
  }
  stats.rays.gather += static_cast<int64_t>(count);
  stats.rays.hitlistAdjusted += adjusted;
  const ShadeContext context{RayKind::Diffuse, 1, settings.seed, 1, false};
  scene.shadeHits(rays, hits, keys, shading, context, radiance);
  for (vec3& L : radiance)
    if (!isFinite(L))
      L = vec3(0.0f);  // one bad shader result would spread over the whole reach of the record

  samples.directions = directions, samples.radiance = radiance, samples.distances = distances;
  IrradianceRecord record = summarize(samples);
  record.position = point.position;
  record.pixelSize = point.pixelSize;
  return record;
}

}  // namespace tomales
