// Lights and surfaces as photons see them, and lamps as the eye does: they run alone, not for the shading of an object.
#include <fmt/format.h>

#include "reyes/rsl_host.h"
#include "reyes/shade/batch.h"
#include "reyes/shade/roles.h"
#include "reyes/shade/system.h"

namespace tomales {

bool ShadeServices::interpolatedHemisphere(const ShadePoints&, const uint8_t*, TmConstVec3, const HemisphereQuery&,
                                           const ShadeContext&, TmVec3) const {
  return false;
}

void ShadeServices::indirectAlong(const ShadePoints& points, const uint8_t* active, const LobeDirection&,
                                  const IndirectQuery&, const ShadeContext&, TmVec3 out) const {
  for (int i = 0; i < points.count(); ++i)
    if (active[i]) set(out, i, vec3(0.0f));
}

bool ShadeServices::volumesBefore(const ShadePoints&, const ShadeContext&, ShadedPoints&) const { return false; }

void ShadeServices::storedIrradiance(const ShadePoints& points, const uint8_t* active, TmVec3 E) const {
  for (int i = 0; i < points.count(); ++i)
    if (active[i]) set(E, i, vec3(0.0f));
}

std::string ShadingSystem::lightGroup(int light) const {
  const auto& l = impl_->lights[static_cast<size_t>(light)];
  return l && !l->can(TM_LIGHT_INDIRECT) ? l->group : std::string();
}

const TmShader* ShadingSystem::lightShader(int light) const {
  const auto& l = impl_->lights[static_cast<size_t>(light)];
  return l ? l->bound->shader : nullptr;
}

vec3 ShadingSystem::lightFactor(int light, const std::vector<Param>& params) const {
  const TmShader* shader = lightShader(light);
  return shader ? factorOf(*shader, params) : vec3(1.0f);
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
  if (finished && isMean(*shader.shader)) meanToRadiance(batch.tm, impl_->services, light);
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

void ShadingSystem::areaLightRadiance(const ShadePoints& points, std::vector<vec3>& radiance,
                                      const ShadeContext& context) const {
  radiance.clear();
  const int index = impl_->groups[static_cast<size_t>(points.group())].group->attributes->areaLight;
  if (index < 0 || index >= static_cast<int>(impl_->lights.size())) return;
  const BoundLight* light = impl_->lights[static_cast<size_t>(index)].get();
  if (!light || !light->can(TM_LIGHT_AREA) || !light->visible || !isMeant(*light, context)) return;
  LightProbe seen;
  std::vector<size_t> front;
  for (int i = 0; i < points.count(); ++i) {
    const vec3 P = points.position(i), I = points.get3(kIx, i), N = points.get3(kNgx, i);
    if (dot(I, N) >= 0) continue;
    front.push_back(static_cast<size_t>(i));
    seen.P.push_back(P - I);
    seen.N.push_back(normalizeOr(I, I));
    seen.Pl.push_back(P);
    seen.Nl.push_back(normalizeOr(N, N));
  }
  radiance.assign(static_cast<size_t>(points.count()), vec3(0.0f));
  if (!front.empty()) probe(index, seen);
  if (!seen.finite)
    impl_->log.report(Severity::Warning, "light-not-finite", light->bound->where,
                      fmt::format("{}: shader \"{}\" returned NaN or infinity; the lamp is dark there",
                                  light->bound->user, light->bound->shader->name));
  for (size_t k = 0; k < front.size(); ++k) radiance[front[k]] = seen.Cl[k];
}

bool ShadingSystem::takesFoundPortals(int light) const {
  const BoundLight* l = impl_->lights[static_cast<size_t>(light)].get();
  return l && l->takesFoundPortals();
}

std::span<const Portal> ShadingSystem::portals(int light) const {
  return impl_->lights[static_cast<size_t>(light)]->sky->portals().all();
}

MediumColors ShadingSystem::medium(int group, bool inside) const {
  const BoundGroup& g = impl_->groups[static_cast<size_t>(group)];
  const BoundShader* volume = (inside ? g.interior : g.exterior).get();
  if (!volume) return {};
  const auto color = [&](TmRole role) {
    const vec3 c = volume->color(role, vec3(0.0f));
    return isFinite(c) ? glm::max(c, vec3(0.0f)) : vec3(0.0f);
  };
  return {color(TM_ROLE_SCATTERING), color(TM_ROLE_ABSORPTION)};
}

bool ShadingSystem::surfaceEmits(int group) const {
  return impl_->groups[static_cast<size_t>(group)].forDiffuseRays().can(TM_EMITS);
}

bool ShadingSystem::reflectsEvenly(int group) const {
  const BoundGroup& g = impl_->groups[static_cast<size_t>(group)];
  const bool varies =
      g.CsOffset >= 0 || g.OsOffset >= 0 || !(g.indirectSurface ? g.indirectOverrides : g.surfaceOverrides).empty();
  return !varies && g.forDiffuseRays().can(TM_EVEN);
}

}  // namespace tomales
