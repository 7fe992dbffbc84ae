#include "gi/services.h"

#include <utility>

#include "gi/frame/baked_light.h"
#include "gi/frame/cache_keys.h"
#include "gi/frame/gather_pass.h"
#include "gi/frame/hemisphere_queries.h"
#include "gi/frame/indirect.h"
#include "gi/frame/ray_calls.h"
#include "gi/frame/record_lookup.h"
#include "gi/frame/reference.h"
#include "gi/frame/shadow_rays.h"

namespace tomales {

bool keepsHemispheres(const GiSettings& settings) {
  return settings.mode != GiMode::Reference && settings.maxError != 0;
}

const RayTools* gatherTools(const GiState& state) {
  const RayTools* tools = state.rays();
  if (tools)
    std::call_once(state.sourcesOnce, [&] {
      if (state.atlasSource) state.atlas = state.atlasSource();
      if (state.hitRadianceSource) state.hitRadiance = state.hitRadianceSource();
    });
  return tools;
}

struct GiServices::Impl : GiState {
  /// Returns null if neither a file nor the geometry holds emitters.
  const Emitters* knownEmitters() const {
    if (emitters) return &*emitters;
    const RayTools* tools = rays();
    return tools ? &tools->rays->emitters() : nullptr;
  }
};

GiServices::GiServices(const Scene& scene, const Camera& camera, const RayScene& rays, const ShadingSystem& shading,
                       const GiSettings& settings, Stats& stats)
    : GiServices(
          scene, camera, [tools = RayTools{&rays, &shading}] { return &tools; }, shading, settings, stats) {}

GiServices::GiServices(const Scene& scene, const Camera& camera, RaySource rays, const ShadingSystem& shading,
                       const GiSettings& settings, Stats& stats)
    : impl_(new Impl{{scene, camera, std::move(rays), shading, settings, stats}}) {}

GiServices::~GiServices() = default;

void GiServices::gatherPass(const DeepFrame& layout, const TileReader& tiles,
                            const std::function<void(float)>& progress, StopToken stop,
                            const std::function<void(int stride)>& covered) {
  impl_->bounceCost = {};
  measureLight(*impl_, layout, tiles, progress, stop);
  if (impl_->settings.mode == GiMode::Reference) return;
  const auto show = [&](int stride) {
    impl_->mixAnew();
    covered(stride);
  };
  fillCaches(*impl_, layout, tiles, progress, stop, covered ? show : std::function<void(int)>());
  impl_->mixAnew();
}

void GiServices::startAgain(const GiSettings& settings) {
  impl_->settings = settings;
  impl_->checkpoint = nullptr;
  impl_->caches.clear();
  impl_->redrawn.clear();
  impl_->learnt = std::make_shared<LearntLight>();
  impl_->mixAnew();
}

GiServices::BounceCost GiServices::bounceCost() const { return impl_->bounceCost; }

void GiServices::tellBouncesLeft(Log& log) const {
  const BouncesLeft left = impl_->learnt->bounces.left();
  if (left.share > 0) tomales::tellBouncesLeft(left, true, "gather-bounces", impl_->scene.where, log);
}

void GiServices::useCheckpoint(Checkpoint* kept) { impl_->checkpoint = kept; }

void GiServices::bake(const DeepFrame& layout, const TileReader& tiles, const std::filesystem::path& folder,
                      const MapNames& names, uint64_t world) const {
  bakeLight(*impl_, layout, tiles, folder, names, world);
}

const std::vector<PreparedCache>& GiServices::caches() const { return impl_->caches; }
std::vector<PreparedCache> GiServices::takeCaches() { return std::exchange(impl_->caches, {}); }
void GiServices::useCaches(std::vector<PreparedCache> caches, std::optional<PixelRect> anew) {
  impl_->caches = std::move(caches);
  impl_->anew = anew;
  impl_->cachesGiven = !impl_->caches.empty();
  impl_->mixAnew();
}
std::shared_ptr<LearntLight> GiServices::learnt() const { return impl_->learnt; }
void GiServices::useLearnt(std::shared_ptr<LearntLight> learnt) { impl_->learnt = std::move(learnt); }
void GiServices::keepShares(std::vector<std::string> groups) { impl_->groups = std::move(groups); }
const std::vector<std::string>& GiServices::shareGroups() const { return impl_->groups; }
void GiServices::mixShares(std::vector<vec3> gains, std::vector<vec3> ofNew) {
  impl_->gainsOfNew = std::move(ofNew);
  if (gains == impl_->gains) return;
  impl_->gains = std::move(gains);
  impl_->mixAnew();
}

void GiServices::redrawRecords() {
  impl_->redrawn.clear();
  for (size_t i = 0; i < impl_->caches.size(); ++i)
    impl_->redrawn.push_back(redrawn(impl_->caches[i].cache, mixedLight(*impl_, i)));
}
void GiServices::useEmitters(EmitterTable emitters) { impl_->emitters.emplace(std::move(emitters)); }

void GiServices::transmission(const ShadePoints& points, const uint8_t* active, TmConstVec3 toward,
                              const ShadowRays& rays, const ShadeContext& context, TmVec3 light) const {
  traceShadows(*impl_, points, active, toward, rays, context, light);
}

bool GiServices::tracesFrom(const ShadePoints& points, const RayQuery& query, const ShadeContext& context) const {
  return contextOfHits(*impl_, points, query, context).has_value();
}

void GiServices::trace(const ShadePoints& points, const uint8_t* active, TmConstVec3 P, TmConstVec3 direction,
                       const RayQuery& query, const ShadeContext& context, const RayResult& result) const {
  traceForShader(*impl_, points, active, P, direction, query, context, result);
}

bool GiServices::volumesBefore(const ShadePoints& points, const ShadeContext& context, ShadedPoints& out) const {
  return crossVolumesBefore(*impl_, points, context, out);
}

bool GiServices::sampleEmitter(int light, int count, TmConstVec3 from, const float* xi0, const float* xi1,
                               const EmitterPoints& out) const {
  const Emitters* emitters = impl_->knownEmitters();
  return emitters && emitters->sampleFrom(light, count, from, xi0, xi1, out);
}

bool GiServices::sampleWholeEmitter(int light, int count, TmConstVec3 from, const float* xi0, const float* xi1,
                                    const EmitterPoints& out) const {
  const Emitters* emitters = impl_->knownEmitters();
  return emitters && emitters->sampleWhole(light, count, from, xi0, xi1, out);
}

void GiServices::meetWholeEmitter(int light, int layer, int count, TmConstVec3 from, TmConstVec3 direction,
                                  const EmitterPoints& out) const {
  if (const Emitters* emitters = impl_->knownEmitters())
    return emitters->meetWhole(light, layer, count, from, direction, out);
  std::fill_n(out.pdf, count, 0.0f);
}

void GiServices::meetEmitter(int light, int count, TmConstVec3 from, TmConstVec3 direction,
                             const EmitterPoints& out) const {
  if (const Emitters* emitters = impl_->knownEmitters()) return emitters->meet(light, count, from, direction, out);
  std::fill_n(out.pdf, count, 0.0f);
}

void GiServices::setAtlas(std::unique_ptr<const IrradianceAtlas> atlas) { impl_->atlas = std::move(atlas); }

void GiServices::setAtlasSource(AtlasSource source) { impl_->atlasSource = std::move(source); }

void GiServices::setHitRadianceSource(HitRadianceSource source) { impl_->hitRadianceSource = std::move(source); }

void GiServices::setPhotonPasses(PhotonPasses passes) {
  impl_->passes = std::move(passes);
  if (!impl_->passes->specularFirstOnly) return;
  for (const ShadeGroup& g : impl_->scene.groups)
    impl_->groupsWithCaustics.push_back(isSpecularForPhotons(*g.attributes));
}

void GiServices::reportAtlas(Stats& stats) const {
  if (impl_->atlas) impl_->atlas->report(stats);
  if (impl_->hitRadiance) impl_->hitRadiance->report(stats);
}

void GiServices::storedIrradiance(const ShadePoints& points, const uint8_t* active, TmVec3 E) const {
  std::vector<int> acrossWalls;
  for (int i = 0; i < points.count(); ++i) {
    if (!active[i]) continue;
    const float radius = std::sqrt(points.channel(kArea)[i] / kPi);
    bool across = false;
    set(E, i,
        impl_->atlas
            ? impl_->atlas->irradianceOverPi(points.group(), points.position(i), points.facingNormal(i), radius, across)
            : vec3(0.0f));
    if (across) acrossWalls.push_back(i);
  }
  if (!acrossWalls.empty()) traceToStored(*impl_, points, acrossWalls, E);
}

bool GiServices::interpolatedHemisphere(const ShadePoints& points, const uint8_t* active, TmConstVec3 N,
                                        const HemisphereQuery& query, const ShadeContext& context, TmVec3 out) const {
  return context.auditPaths == 0 && interpolateHemisphere(*impl_, {points, active, N}, query, context, out);
}

float GiServices::emitterReach(int light) const {
  const Emitters* emitters = impl_->knownEmitters();
  return emitters ? emitters->reach(light) : 0.0f;
}

float GiServices::emitterArea(int light) const {
  const Emitters* emitters = impl_->knownEmitters();
  return emitters ? emitters->area(light) : 0.0f;
}

Bound3 GiServices::emitterBound(int light) const {
  const Emitters* emitters = impl_->knownEmitters();
  return emitters ? emitters->bound(light) : Bound3();
}

void GiServices::indirectDiffuse(const ShadePoints& points, const uint8_t* active, TmConstVec3 N,
                                 const IndirectQuery& query, const ShadeContext& context, IndirectResult out) const {
  const bool audit = context.auditPaths > 0, counted = impl_->settings.mode == GiMode::Progressive;
  if (impl_->settings.mode == GiMode::Baked && !audit) return bakedIndirect(*impl_, points, active, out);
  const AskedPoints asked{points, active, N};
  const int bounces = audit ? auditBouncesFor(*impl_, query) : bouncesFor(*impl_, query);
  if (noteMeasured(*impl_, asked, bounces, context, out)) return;
  if (context.diffuseDepth < bounces && (audit || !counted)) {
    const bool cached = interpolatesIndirect(*impl_) && !audit;
    if (cached && context.diffuseDepth > 0) return bounceIndirect(*impl_, asked, query, context, bounces, out);
    if (cached) return interpolateIndirect(*impl_, asked, query, context, out);
    traceIndirect(*impl_, asked, query, context, bounces, out);
    if (!counted) addMeasured(*impl_, asked, bounces, context, out);
    return;
  }
  for (int i = 0; i < points.count(); ++i) {
    const vec3 n = points.facingNormal(i), dominant[3] = {n, n, n};
    if (active[i]) setIndirect(out, i, vec3(0.0f), dominant);
  }
  addMeasured(*impl_, asked, bounces, context, out);
}

bool GiServices::followsLobes(const ShadeContext& context) const {
  return impl_->settings.mode == GiMode::Reference || context.lobes != LobeAudit::Off;
}

void GiServices::indirectAlong(const ShadePoints& points, const uint8_t* active, const LobeDirection& way,
                               const IndirectQuery& query, const ShadeContext& context, TmVec3 out) const {
  ShadeServices::indirectAlong(points, active, way, query, context, out);
  if (context.lobes == LobeAudit::Even) {
    for (int i = 0; i < points.count(); ++i)
      if (active[i]) set(out, i, vec3(1.0f));
    return;
  }
  const int bounces = context.auditPaths > 0 ? auditBouncesFor(*impl_, query) : bouncesFor(*impl_, query);
  if (context.diffuseDepth < bounces && context.purpose != Purpose::Rehearsal)
    traceAlong(*impl_, points, active, way, query, context, bounces, out);
}

}  // namespace tomales
