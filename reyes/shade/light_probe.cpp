// Lights as photons and the eye see them: they run alone, not for the shading of an object.
#include <fmt/format.h>

#include "reyes/shade/batch.h"
#include "reyes/shade/system.h"

namespace tomales {

void ShadingSystem::probe(int light, LightProbe& probe) const {
  const BoundShader& shader = *impl_->lights[static_cast<size_t>(light)]->bound;
  const ShadeContext context;
  ArenaLease arena;
  Batch batch(*impl_, impl_->pixels, context, *arena);
  batch.setLit(probe, shader);
  const size_t n = probe.P.size();
  if (!probe.Pl.empty())
    for (size_t i = 0; i < n; ++i) set(batch.tm.L, static_cast<int>(i), probe.Pl[i] - probe.P[i]);
  const bool finished = batch.run(shader, batch.tm);
  if (finished && isMean(*shader.shader))
    meanToRadiance(batch.tm, impl_->services, *impl_->lights[static_cast<size_t>(light)]);
  probe.L.assign(n, vec3(0.0f));
  probe.Cl.assign(n, vec3(0.0f));
  for (size_t i = 0; finished && i < n; ++i) {
    const vec3 L = get(batch.tm.L, static_cast<int>(i)), Cl = get(batch.tm.Cl, static_cast<int>(i));
    if (isFinite(L) && isFinite(Cl)) {
      probe.L[i] = L;
      probe.Cl[i] = glm::max(Cl, vec3(0.0f));
    } else
      probe.finite = false;
  }
}

namespace {

/// Lets the point P of a lamp, with the normal N, light an eye along I.
void add(LightProbe& seen, const vec3& eye, const vec3& I, const vec3& P, const vec3& N) {
  seen.P.push_back(eye);
  seen.N.push_back(normalizeOr(I, I));
  seen.Pl.push_back(P);
  seen.Nl.push_back(normalizeOr(N, N));
}

}  // namespace

void ShadingSystem::areaLightRadiance(const ShadePoints& points, std::vector<vec3>& radiance,
                                      const ShadeContext& context) const {
  radiance.clear();
  const int index = impl_->groups[static_cast<size_t>(points.group())].group->attributes->areaLight;
  if (index < 0 || index >= static_cast<int>(impl_->lights.size())) return;
  const BoundLight* light = impl_->lights[static_cast<size_t>(index)].get();
  if (!light || !light->can(TM_LIGHT_AREA) || !light->visible || !isMeant(*light, context)) return;
  LightProbe seen;
  std::vector<size_t> shining;
  for (int i = 0; i < points.count(); ++i) {
    const vec3 P = points.position(i), I = points.get3(kIx, i), N = points.get3(kNgx, i);
    if (!light->allRound && dot(I, N) >= 0) continue;
    shining.push_back(static_cast<size_t>(i));
    add(seen, P - I, I, P, N);
  }
  radiance.assign(static_cast<size_t>(points.count()), vec3(0.0f));
  if (!shining.empty()) probe(index, seen);
  if (!seen.finite)
    impl_->log.report(Severity::Warning, "light-not-finite", light->bound->where,
                      fmt::format("{}: shader \"{}\" returned NaN or infinity; the lamp is dark there",
                                  light->bound->user, light->bound->shader->name));
  for (size_t k = 0; k < shining.size(); ++k) radiance[shining[k]] = seen.Cl[k];
}

}  // namespace tomales
