#include "reyes/shade/system.h"

#include "reyes/shade/batch.h"
#include "reyes/shade/substitute.h"
#include "reyes/shader_registry.h"

namespace tomales {
namespace {

/// Number of points in a sub-batch: their light samples take a few hundred kB, which fit into the second-level cache.
constexpr int kSubBatch = 256;

/// Replaces bad results: all by the substitute if the shader has thrown; otherwise points that are not finite become
/// black.
void repair(Batch& batch, const BoundShader& shader, bool finished) {
  if (finished) return batch.blackOutNonFinite(shader);
  for (int i = 0; i < batch.tm.count; ++i) {
    set(batch.tm.Ci, i, vec3(0.0f));
    set(batch.tm.Oi, i, vec3(0.0f));
  }
  substituteSurface().shade(&batch.tm);
}

}  // namespace

ShadingSystem::ShadingSystem(const Scene& scene, ShaderRegistry& registry, const ShadeServices* services, Log& log,
                             Stats& stats)
    : impl_(new Impl(scene, registry, log, stats)) {
  setServices(services);
}

ShadingSystem::~ShadingSystem() = default;

void ShadingSystem::setServices(const ShadeServices* services) { impl_->services = services; }

void ShadingSystem::runAllLights() { impl_->lightCut = 0; }

void ShadingSystem::setClouds(CloudServices* clouds) { impl_->clouds = clouds; }

void ShadingSystem::silence() { impl_->silent = true; }

void ShadingSystem::bindNewGroups() { impl_->bindNewGroups(); }

void ShadingSystem::takeFoundPortals() { impl_->takeFoundPortals(); }

GroupTraits ShadingSystem::group(int group) const { return {*impl_, impl_->groups[static_cast<size_t>(group)]}; }

LightTraits ShadingSystem::light(int light) const {
  return LightTraits(impl_->lights[static_cast<size_t>(light)].get());
}

void ShadingSystem::shade(const ShadePoints& points, const ShadeContext& context, ShadedPoints& out) const {
  const BoundGroup& group = impl_->groups[static_cast<size_t>(points.group())];
  const BoundShader& shader = context.kind == RayKind::Diffuse ? group.forDiffuseRays() : *group.surface;
  const int count = points.count();
  out.resize(count);
  std::vector<BoundVariable> told;
  if (context.outputs) told = bindOutputs(*context.outputs, shader);
  const std::vector<BoundVariable>& variables = context.variables ? group.variables : told;
  if (!variables.empty()) allocateVariables(variables, count, out);

  const ShaderTimer timer(impl_->stats, shader, count);
  ShadePoints subBatch(points.group(), points.primvarFloats(), points.hasSteps());
  subBatch.reserve(std::min(count, kSubBatch));
  for (int begin = 0; begin < count; begin += kSubBatch) {
    subBatch.assign(points, begin, std::min(begin + kSubBatch, count));
    ArenaLease arena;
    ShadeContext subContext = context;
    subContext.subBatch = begin / kSubBatch;
    Batch batch(*impl_, group, subContext, *arena);
    batch.setPoints(subBatch, shader, out, begin);
    batch.openOutputs(variables, out, begin);
    repair(batch, shader, batch.run(shader, batch.tm));
    batch.closeOutputs(variables, out, begin);
    storeVariables(variables, batch, shader, out, begin);
    impl_->lightNoise.add(batch);
    impl_->lightUse.add(batch);
  }
  impl_->stats.shade.verticesShaded += count;
}

void ShadingSystem::warnOfLightNoise() const {
  impl_->lightNoise.warn(*impl_);
  impl_->lightUse.warn(*impl_);
}

std::optional<IndirectRequest> ShadingSystem::indirectRequest() const {
  std::optional<IndirectRequest> out;
  for (const auto& light : impl_->lights) {
    if (!light || !light->can(TM_LIGHT_INDIRECT) || light->filters) continue;
    const IndirectRequest& said = light->request;
    if (!out) out.emplace();
    if (out->method == IndirectRequest().method) out->method = said.method;
    if (out->atlas.empty()) out->atlas = said.atlas;
    if (!out->bounces) out->bounces = said.bounces;
  }
  return out;
}

int ShadingSystem::mostAreaSamples() const {
  int most = 0;
  for (const auto& light : impl_->lights)
    if (light && light->can(TM_LIGHT_AREA)) most = std::max(most, light->samples);
  return most;
}

bool ShadingSystem::needsRays() const {
  return std::any_of(impl_->lights.begin(), impl_->lights.end(),
                     [](const auto& light) {
                       return light && (light->shadows || light->can(TM_LIGHT_AREA) || light->can(TM_LIGHT_INDIRECT) ||
                                        light->can(TM_TRACES));
                     }) ||
         std::any_of(impl_->groups.begin(), impl_->groups.end(),
                     [](const BoundGroup& g) { return g.surface->can(TM_TRACES) || g.group->attributes->volume; });
}

}  // namespace tomales
