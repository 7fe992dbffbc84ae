#include "reyes/shader_traits.h"

#include "reyes/shade/bound_scene.h"
#include "reyes/shade/extended_lights.h"
#include "reyes/shade/roles.h"

namespace tomales {

bool GroupTraits::opaque() const {
  return group_.group->attributes->opacity == vec3(1.0f) && group_.OsOffset < 0 && keepsOpacity();
}

bool GroupTraits::wantsSteps() const {
  const auto wants = [](const BoundShaderPtr& s) { return s && (s->can(TM_DERIVATIVES) || s->can(TM_NEIGHBOURS)); };
  return wants(group_.surface) || wants(group_.indirectSurface) || wants(group_.atmosphere) || wants(group_.interior) ||
         wants(group_.exterior);
}

bool GroupTraits::keepsOpacity() const { return group_.surface->can(TM_KEEPS_OPACITY); }

bool GroupTraits::tracesRays() const {
  const BoundShader& surface = *group_.surface;
  return surface.can(TM_TRACES) && !surface.can(TM_OCCLUDED) && !surface.can(TM_TRACES_HIGHLIGHTS);
}

// A light with TmOcclusion::maxVariation in a parameter tells it before it runs.
bool GroupTraits::asksHemispheres() const {
  const BoundShader& surface = *group_.surface;
  const bool allowed = group_.group->attributes->irradianceMaxError.value_or(0.0f) > 0;
  return surface.can(TM_OCCLUDED) || surface.can(TM_INTERPOLATED_UNASKED) ||
         (allowed && surface.can(TM_INTERPOLATED)) ||
         std::any_of(scene_.interpolated.begin(), scene_.interpolated.end(), [&](int light) {
           const float most = scene_.light(light).maxVariation;
           return (most < 0 ? allowed : most > 0) && group_.lights().contains(light);
         });
}

const IndirectQuery* GroupTraits::indirectQuery() const { return group_.indirect ? &*group_.indirect : nullptr; }

bool GroupTraits::emits() const { return group_.forDiffuseRays().can(TM_EMITS); }

bool GroupTraits::reflectsEvenly() const {
  const bool varies =
      group_.CsOffset >= 0 || group_.OsOffset >= 0 || !group_.overridesOf(group_.forDiffuseRays()).empty();
  return !varies && group_.forDiffuseRays().can(TM_EVEN);
}

bool GroupTraits::hasVolume(bool inside) const { return group_.volume(inside) != nullptr; }

MediumColors GroupTraits::medium(bool inside) const {
  const BoundShader* volume = group_.volume(inside);
  if (!volume) return {};
  const auto color = [&](TmRole role) {
    const vec3 c = volume->color(role, vec3(0.0f));
    return isFinite(c) ? glm::max(c, vec3(0.0f)) : vec3(0.0f);
  };
  return {color(TM_ROLE_SCATTERING), color(TM_ROLE_ABSORPTION)};
}

LightKind LightTraits::kind() const {
  if (!light_ || !light_->indirect || light_->nondiffuse) return LightKind::None;
  if (light_->can(TM_LIGHT_INDIRECT)) return LightKind::Indirect;
  if (light_->can(TM_LIGHT_AMBIENT)) return LightKind::Ambient;
  if (light_->can(TM_LIGHT_AREA)) return LightKind::Area;
  if (light_->can(TM_LIGHT_SKY)) return LightKind::Sky;
  if (light_->can(TM_LIGHT_SOLAR)) return LightKind::Distant;
  return LightKind::Point;
}

bool LightTraits::shinesAllRound() const { return light_ && light_->allRound; }

const TmShader* LightTraits::shader() const { return light_ ? light_->bound->shader : nullptr; }

vec3 LightTraits::factor(const std::vector<Param>& params) const {
  return light_ ? factorOf(*shader(), params) : vec3(1.0f);
}

std::string LightTraits::group() const {
  return light_ && !light_->can(TM_LIGHT_INDIRECT) ? light_->group : std::string();
}

bool LightTraits::takesFoundPortals() const { return light_ && light_->takesFoundPortals(); }

std::span<const Portal> LightTraits::portals() const { return light_->sky->portals().all(); }

}  // namespace tomales
