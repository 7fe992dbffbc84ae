#include "gi/services.h"

#include "gi/state.h"
#include "reyes/base/rng.h"

namespace tomales {
namespace {

constexpr int kTimesOfLight = 16;  ///< Least number of times that the shadows of one light see, over all its samples.

}  // namespace

struct GiServices::Impl : GiState {};

GiServices::GiServices(const Scene& scene, const Camera& camera, const RayScene& rays,
                       const ShadingSystem& shading, const GiSettings& settings, Stats& stats)
    : impl_(new Impl{{scene, camera, rays, shading, settings, stats, {}}}) {}

GiServices::~GiServices() = default;

void GiServices::gatherPass(const DeepFrame& frame, const std::function<void(float)>& progress,
                            const std::atomic<bool>* cancelled) {
  if (impl_->settings.mode == GiMode::Gather) fillCaches(*impl_, frame, progress, cancelled);
}

void GiServices::transmission(const ShadePoints& points, const uint8_t* active, TmConstVec3 toward,
                              const ShadowRays& rays, const ShadeContext& context, TmVec3 light) const {
  const RayScene& scene = impl_->rays;
  const int times = scene.samplesTime(points.group()) && context.kind == RayKind::Camera
                        ? std::max(1, kTimesOfLight / rays.samples)
                        : 1;
  int64_t traced = 0;
  for (int i = 0; i < points.count(); ++i) {
    const vec3 arriving{light.x[i], light.y[i], light.z[i]}, path{toward.x[i], toward.y[i], toward.z[i]};
    const float length = glm::length(path);
    if (!active[i] || arriving == vec3(0.0f) || !(length > 0)) continue;
    vec3 passed(0);
    for (int k = 0; k < times; ++k) {
      const int strata = rays.samples * times, stratum = rays.sample * times + k;
      Ray ray{points.position(i), path / length, rays.solar ? kInfinity : length};
      aim(scene, points, i, rayTime(scene, points, i, stratum, strata, context.seed), ray);
      ray.offset = slantedOffset(ray.offset, std::abs(dot(ray.direction, points.get3(kNgx, i))));
      passed += scene.transmission(ray);
    }
    passed *= arriving / static_cast<float>(times);
    light.x[i] = passed.x, light.y[i] = passed.y, light.z[i] = passed.z;
    traced += times;
  }
  impl_->stats.rays.transmission += traced;
}

bool GiServices::sampleEmitter(int light, int count, const float* xi0, const float* xi1, TmVec3 P, TmVec3 N,
                               float* area) const {
  return impl_->rays.sampleEmitter(light, count, xi0, xi1, P, N, area);
}

void GiServices::indirectDiffuse(const ShadePoints& points, const uint8_t* active, TmConstVec3 N,
                                 const IndirectQuery& query, const ShadeContext& context,
                                 IndirectResult out) const {
  const GiSettings& settings = impl_->settings;
  const int asked = settings.bounces > 0 ? settings.bounces : query.bounces;
  const int bounces = settings.mode == GiMode::None     ? 0
                      : settings.mode == GiMode::Gather ? std::min(asked, 1)
                                                        : asked;
  if (context.depth < bounces) {
    if (settings.mode == GiMode::Gather) return interpolateIndirect(*impl_, points, active, N, query, out);
    return traceIndirect(*impl_, points, active, N, query, context, bounces, out);
  }
  for (int i = 0; i < points.count(); ++i) {
    const vec3 n = points.facingNormal(i), dominant[3] = {n, n, n};
    if (active[i]) store(out, i, vec3(0.0f), dominant);
  }
}

}  // namespace tomales
