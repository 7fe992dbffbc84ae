// Lights and surfaces as photons see them: asked alone, outside the shading of any object.
#include "reyes/shade/batch.h"
#include "reyes/shade/system.h"

namespace tomales {

bool ShadeServices::interpolatedOcclusion(const ShadePoints&, const uint8_t*, TmConstVec3, const OcclusionQuery&,
                                          const ShadeContext&, float*) const {
  return false;
}

void ShadeServices::storedIrradiance(const ShadePoints& points, const uint8_t* active, TmVec3 E) const {
  for (int i = 0; i < points.count(); ++i)
    if (active[i]) set(E, i, vec3(0.0f));
}

LightKind ShadingSystem::lightKind(int light) const {
  const auto& l = impl_->lights[static_cast<size_t>(light)];
  if (!l || !l->indirect || l->nondiffuse) return LightKind::None;
  if (l->can(TM_LIGHT_INDIRECT)) return LightKind::Indirect;
  if (l->can(TM_LIGHT_AMBIENT)) return LightKind::Ambient;
  if (l->can(TM_LIGHT_AREA)) return LightKind::Area;
  if (l->can(TM_LIGHT_SKY)) return LightKind::Sky;
  if (l->can(TM_LIGHT_SOLAR)) return LightKind::Distant;
  return LightKind::Point;
}

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
  probe.L.assign(n, vec3(0.0f)), probe.Cl.assign(n, vec3(0.0f));
  for (size_t i = 0; finished && i < n; ++i) {
    const vec3 L = get(batch.tm.L, static_cast<int>(i)), Cl = get(batch.tm.Cl, static_cast<int>(i));
    if (isFinite(L) && isFinite(Cl)) probe.L[i] = L, probe.Cl[i] = glm::max(Cl, vec3(0.0f));
  }
}

std::span<const Portal> ShadingSystem::portals(int light) const {
  return impl_->lights[static_cast<size_t>(light)]->sky->portals().all();
}

bool ShadingSystem::emits(int group) const {
  return impl_->groups[static_cast<size_t>(group)].forDiffuseRays().can(TM_EMITS);
}

bool ShadingSystem::reflectsEvenly(int group) const {
  const BoundGroup& g = impl_->groups[static_cast<size_t>(group)];
  const bool varies =
      g.CsOffset >= 0 || g.OsOffset >= 0 || !(g.indirectSurface ? g.indirectOverrides : g.surfaceOverrides).empty();
  return !varies && g.forDiffuseRays().can(TM_EVEN);
}

}  // namespace tomales
