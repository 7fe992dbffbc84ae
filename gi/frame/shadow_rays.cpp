#include "gi/frame/shadow_rays.h"

#include <numeric>

#include "gi/frame/ray_calls.h"
#include "gi/frame/ray_start.h"

namespace tomales {
namespace {

/// The shadow rays of one light have at least this many different times of the shutter, over all its samples.
constexpr int kTimesOfLight = 16;

/// The shadow rays of a batch of points.
struct ShadowBatch {
  std::vector<Ray> rays;
  std::vector<SampleName> names;
  /// A point at which light arrives, and how many of the rays are its own.
  struct Lit {
    int point, times;
  };
  std::vector<Lit> lit;
};

/// The rays keep a pointer to the filter.
ShadowBatch shadowRaysOf(const RayScene& scene, const Scene& own, const ShadePoints& points, const uint8_t* active,
                         TmConstVec3 toward, const ShadowRays& asked, const RayFilter& filter,
                         const ShadeContext& context, TmVec3 light) {
  const ShadeGroup& group = own.groups[static_cast<size_t>(points.group())];
  const bool samplesTime = scene.samplesTime(points.group()) && context.kind == RayKind::Camera;
  ShadowBatch out;
  for (int i = 0; i < points.count(); ++i) {
    const vec3 arriving{light.x[i], light.y[i], light.z[i]}, path{toward.x[i], toward.y[i], toward.z[i]};
    const float length = glm::length(path);
    if (!active[i] || arriving == vec3(0.0f) || !(length > 0)) continue;
    const Ray atOpen{points.position(i), path / length, asked.solar ? kInfinity : length};
    const bool changes = samplesTime && (group.currentFromOpen.moving() || points.get3(kDriftX, i) != vec3(0) ||
                                         scene.mayMeetMotion(atOpen));
    const int times = changes ? std::max(1, kTimesOfLight / asked.samples) : 1;
    out.lit.push_back({i, times});
    for (int k = 0; k < times; ++k) {
      const int strata = asked.samples * times, stratum = asked.sample * times + k;
      Ray ray = atOpen;
      startRay(scene, points, i, rayTime(scene, points, i, stratum, strata, context.seed), ray);
      ray.offset = slantedOffset(ray.offset, std::abs(dot(ray.direction, points.get3(kNgx, i))));
      if (asked.query) setBias(*asked.query, ray);
      ray.filter = filter.passesAll() ? nullptr : &filter;
      out.rays.push_back(ray);
      out.names.push_back(points.name(i));
    }
  }
  return out;
}

}  // namespace

void traceShadows(const GiState& state, const ShadePoints& points, const uint8_t* active, TmConstVec3 toward,
                  const ShadowRays& asked, const ShadeContext& context, TmVec3 light) {
  const RayTools* tools = context.purpose == Purpose::Rehearsal ? nullptr : state.rays();
  if (!tools) return;
  const Attributes& own = *state.scene.groups[static_cast<size_t>(points.group())].attributes;
  RayFilter filter = asked.query ? filterOf(*tools->rays, *asked.query, own) : filterOf(*tools->rays, {}, own);
  if (asked.through >= 0) filter.also = tools->rays->groupsBesideLamp(asked.through);
  const ShadowBatch shadows =
      shadowRaysOf(*tools->rays, state.scene, points, active, toward, asked, filter, context, light);
  int64_t adjusted = 0;
  const std::vector<vec3> transmittance =
      tools->rays->transmission(shadows.rays, shadows.names, *tools->shading, context, adjusted);
  auto first = transmittance.begin();
  for (const auto [i, times] : shadows.lit) {
    const vec3 share = std::accumulate(first, first + times, vec3(0)) / static_cast<float>(times);
    first += times;
    light.x[i] *= share.x;
    light.y[i] *= share.y;
    light.z[i] *= share.z;
  }
  state.stats.rays.transmission += static_cast<int64_t>(shadows.rays.size());
  state.stats.rays.hitlistAdjusted += adjusted;
}

}  // namespace tomales
