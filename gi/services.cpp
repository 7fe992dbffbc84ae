#include "gi/services.h"

#include <utility>

#include "gi/state.h"

namespace tomales {
struct GiServices::Impl : GiState {};

GiServices::GiServices(const Scene& scene, const Camera& camera, const RayScene& rays,
                       const ShadingSystem& shading, const GiSettings& settings, Stats& stats)
    : GiServices(scene, camera, [tools = RayTools{&rays, &shading}] { return &tools; }, shading, settings, stats) {}

GiServices::GiServices(const Scene& scene, const Camera& camera, RaySource rays, const ShadingSystem& shading,
                       const GiSettings& settings, Stats& stats)
    : impl_(new Impl{{scene, camera, std::move(rays), shading, settings, stats, {}, {}, false}}) {}

GiServices::~GiServices() = default;

void GiServices::gatherPass(const DeepFrame& frame, const std::function<void(float)>& progress,
                            const std::atomic<bool>* cancelled) {
  if (impl_->settings.mode == GiMode::Gather) fillCaches(*impl_, frame, progress, cancelled);
}

const std::vector<PreparedCache>& GiServices::caches() const { return impl_->caches; }
std::vector<PreparedCache> GiServices::takeCaches() { return std::exchange(impl_->caches, {}); }
void GiServices::useCaches(std::vector<PreparedCache> caches) {
  impl_->caches = std::move(caches);
  impl_->cachesGiven = !impl_->caches.empty();
}
void GiServices::useEmitters(EmitterTable emitters) { impl_->emitters.emplace(std::move(emitters)); }

void GiServices::transmission(const ShadePoints& points, const uint8_t* active, TmConstVec3 toward,
                              bool solar, const ShadeContext&, TmVec3 light) const {
  const RayTools* tools = impl_->rays();
  if (!tools) return;
  int64_t traced = 0;
  for (int i = 0; i < points.count(); ++i) {
    const vec3 arriving{light.x[i], light.y[i], light.z[i]}, path{toward.x[i], toward.y[i], toward.z[i]};
    const float length = glm::length(path);
    if (!active[i] || arriving == vec3(0.0f) || !(length > 0)) continue;
    Ray ray{points.position(i), path / length, solar ? kInfinity : length};
    tools->rays->prepareOrigin(points.group(), ray.origin, points.edgeLength(i), ray);
    ray.offset = slantedOffset(ray.offset, std::abs(dot(ray.direction, points.get3(kNgx, i))));
    const vec3 passed = arriving * tools->rays->transmission(ray);
    light.x[i] = passed.x, light.y[i] = passed.y, light.z[i] = passed.z;
    ++traced;
  }
  impl_->stats.rays.transmission += traced;
}

bool GiServices::sampleEmitter(int light, int count, const float* xi0, const float* xi1, TmVec3 P, TmVec3 N,
                               float* area) const {
  if (impl_->emitters) return impl_->emitters->sample(light, count, xi0, xi1, P, N, area);
  const RayTools* tools = impl_->rays();
  return tools && tools->rays->emitters().sample(light, count, xi0, xi1, P, N, area);
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
    if (settings.mode == GiMode::Gather) return interpolateIndirect(*impl_, points, active, N, query, context, out);
    return traceIndirect(*impl_, points, active, N, query, context, bounces, out);
  }
  for (int i = 0; i < points.count(); ++i) {
    const vec3 n = points.facingNormal(i), dominant[3] = {n, n, n};
    if (active[i]) store(out, i, vec3(0.0f), dominant);
  }
}

}  // namespace tomales
