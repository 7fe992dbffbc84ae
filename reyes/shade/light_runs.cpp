#include "reyes/shade/light_runs.h"

#include "reyes/base/rng.h"
#include "reyes/shade/illuminate.h"
#include "reyes/shade/primary.h"

namespace tomales {

bool isOn(const BoundLight& light, const Batch& batch) {
  if (!(batch.context.kind == RayKind::Diffuse ? light.indirect : light.direct)) return false;
  if (!light.can(TM_LIGHT_INDIRECT)) return batch.context.direct || batch.context.kind != RayKind::Camera;
  return batch.context.indirect && batch.group.group->attributes->indirect.receive &&
         !(batch.points && batch.points->inAir());
}

bool applies(const BoundLight& light, const Batch& batch) {
  if (batch.points == nullptr) return false;  // displacement shaders see no light
  return bringsLights(batch.context.illumination) && batch.context.kind != RayKind::Transmission && isOn(light, batch);
}

TmGrid lightGrid(Batch& batch, const BoundLight& light) {
  TmGrid g = *Primary(batch, &batch.tm).grid();
  g.params = light.bound->values.data();
  g.L = batch.arena.vec3(batch.tm.count);
  g.Cl = batch.arena.vec3(batch.tm.count);
  return g;
}

void openOutputs(Batch& batch, const BoundShader& light, std::vector<TmValue>& params) {
  for (size_t i = 0; i < static_cast<size_t>(light.shader->paramCount); ++i) {
    if (!isOutput(light.shader->params[i])) continue;
    const int width = typeOf(light.shader->params[i]) == TM_FLOAT ? 1 : 3;
    for (int k = 0; k < width; ++k) params[i].c[k] = batch.arena.floats(batch.tm.count);
    params[i].step = 1;
  }
}

void darkenNonFinite(Batch& batch, const BoundShader& light, const TmGrid& g) {
  if (allFinite(g.count, view(g.Cl)) && allFinite(g.count, view(g.L))) return;
  for (int i = 0; i < g.count; ++i)
    if (!isFinite(get(g.Cl, i)) || !isFinite(get(g.L, i))) {
      set(g.Cl, i, vec3(0));
      set(g.L, i, vec3(0));
    }
  const BoundShader* caller = std::exchange(batch.running, &light);
  batch.report(Severity::Warning, "shader-not-finite", "returned NaN or infinity; it casts no light there");
  batch.running = caller;
}

vec2 sampleAt(const Batch& batch, const BoundLight& light, int i, int sample, int samples) {
  const SampleName name = batch.points->name(i);
  const uint32_t stream = hashCombine(name.key, static_cast<uint32_t>(light.index), batch.context.seed);
  return sobol2(name.sequence * static_cast<uint32_t>(samples) + static_cast<uint32_t>(sample), stream);
}

int samplesOf(const BoundLight& light, const Batch& batch) {
  if (!hasExtent(light) && !light.can(TM_LIGHT_SAMPLED)) return light.samples;
  const int own = batch.context.lightSamples > 0 ? batch.context.lightSamples : light.samples;
  const int times = light.can(TM_LIGHT_AREA) ? batch.lights.times() : 1;
  return shareOfBranch(std::max(own, std::min(own * times, kMostLightSamples)), 1, batch.context);
}

LightSample sampleOf(Batch& batch, const BoundLight& light, const TmGrid& g, ShadowRays rays, int question) {
  LightSample out{.light = &light,
                  .L = batch.arena.vec3(batch.tm.count),
                  .Cl = g.Cl,
                  .toward = g.L,
                  .rays = rays,
                  .question = question,
                  .far = g.L,
                  .params = g.params,
                  .Pl = g.Pl,
                  .Nl = g.Nl};
  if (const int k = light.bound->output(TM_ROLE_NONDIFFUSE); k >= 0) out.nondiffuse = g.params[k].c[0];
  if (const int k = light.bound->output(TM_ROLE_NONSPECULAR); k >= 0) out.nonspecular = g.params[k].c[0];
  normalizeAll(g.count, view(g.L), out.L);
  return out;
}

}  // namespace tomales
