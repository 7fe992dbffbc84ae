#include "reyes/shade/roles.h"

#include <algorithm>
#include <array>

#include "reyes/shade/parameter_values.h"
#include "reyes/shader_registry.h"

namespace tomales {
namespace {

constexpr RoleInfo kRoles[] = {
    {TM_ROLE_SAMPLES, "samples", TM_FLOAT, TM_LIGHT},
    {TM_ROLE_VISIBLE, "visible", TM_FLOAT, TM_LIGHT},
    {TM_ROLE_SKY_MAP, "skymap", TM_STRING, TM_LIGHT},
    {TM_ROLE_SKY_SPACE, "skyspace", TM_STRING, TM_LIGHT},
    {TM_ROLE_SKY_PORTALS, "skyportals", TM_STRING, TM_LIGHT},
    {TM_ROLE_MAX_ERROR, "maxerror", TM_FLOAT, TM_LIGHT},
    {TM_ROLE_ERROR_FUNCTION, "errorfunction", TM_STRING, TM_LIGHT},
    {TM_ROLE_HIT_RADIANCE, "hitradiance", TM_STRING, TM_LIGHT},
    {TM_ROLE_ATLAS, "atlas", TM_STRING, TM_LIGHT},
    {TM_ROLE_BOUNCES, "bounces", TM_FLOAT, TM_LIGHT},
    {TM_ROLE_MAX_DISTANCE, "maxdistance", TM_FLOAT, TM_LIGHT},
    {TM_ROLE_SUBSET, "subset", TM_STRING, TM_LIGHT},
    {TM_ROLE_INDIRECT_SOURCE, "indirectsource", TM_STRING, TM_LIGHT},
    {TM_ROLE_SCALE, "scale", TM_FLOAT, TM_LIGHT},
    {TM_ROLE_TINT, "tint", TM_COLOR, TM_LIGHT},
    {TM_ROLE_MAX_VARIATION, "maxvariation", TM_FLOAT, TM_LIGHT},
    {TM_ROLE_LIGHTING, "lighting", TM_STRING, TM_LIGHT},
    {TM_ROLE_NONDIFFUSE, "nondiffuse", TM_FLOAT, TM_LIGHT},
    {TM_ROLE_NONSPECULAR, "nonspecular", TM_FLOAT, TM_LIGHT},
    {TM_ROLE_GROUP, "group", TM_STRING, TM_LIGHT},
    {TM_ROLE_CATEGORY, "category", TM_STRING, TM_LIGHT},
    {TM_ROLE_SHADOW_MAP, "shadowmap", TM_STRING, TM_LIGHT},
    {TM_ROLE_SHADOW_VARIANCE, "shadowvariance", TM_FLOAT, TM_LIGHT},
    {TM_ROLE_SCATTERING, "scattering", TM_COLOR, TM_VOLUME},
    {TM_ROLE_ABSORPTION, "absorption", TM_COLOR, TM_VOLUME},
    {TM_ROLE_AREA, "area", TM_FLOAT, TM_LIGHT},
    {TM_ROLE_POSITION, "position", TM_POINT, TM_LIGHT},
};

constexpr TmParamDecl standard(const char* name, TmRole role, TmType type, const char* doc) {
  return {name, type, 1, nullptr, nullptr, doc, role};
}

/// If two names have one role, the first that is given counts.
constexpr TmParamDecl kOfLights[] = {
    standard("lighting", TM_ROLE_LIGHTING, TM_STRING, "both, direct (what the camera sees) or indirect (gather rays)"),
    standard("__nondiffuse", TM_ROLE_NONDIFFUSE, TM_FLOAT, "1: diffuse() leaves it out"),
    standard("__nonspecular", TM_ROLE_NONSPECULAR, TM_FLOAT, "1: specular() leaves it out"),
    standard("__group", TM_ROLE_GROUP, TM_STRING, "name of its group; none: its handle"),
    standard("lightgroup", TM_ROLE_GROUP, TM_STRING, "the same"),
    standard("__category", TM_ROLE_CATEGORY, TM_STRING, "names by commas, for illuminance()"),
    standard("shadowname", TM_ROLE_SHADOW_MAP, TM_STRING, "shadow map, or raytrace"),
    standard("sfpx", TM_ROLE_SHADOW_MAP, TM_STRING, "shadow map towards +x"),
    standard("sfnx", TM_ROLE_SHADOW_MAP, TM_STRING, "towards -x"),
    standard("sfpy", TM_ROLE_SHADOW_MAP, TM_STRING, "towards +y"),
    standard("sfny", TM_ROLE_SHADOW_MAP, TM_STRING, "towards -y"),
    standard("sfpz", TM_ROLE_SHADOW_MAP, TM_STRING, "towards +z"),
    standard("sfnz", TM_ROLE_SHADOW_MAP, TM_STRING, "towards -z"),
    standard("shadowvariance", TM_ROLE_SHADOW_VARIANCE, TM_FLOAT,
             "variance up to which a point traces shadow rays, of the mean share that passes; 0: all are traced"),
};

constexpr TmParamDecl kOfVolumes[] = {
    standard("scattering", TM_ROLE_SCATTERING, TM_COLOR, "for each unit of the world, as photons meet it"),
    standard("absorption", TM_ROLE_ABSORPTION, TM_COLOR, "likewise"),
};

}  // namespace

const RoleInfo* roleInfo(int32_t role) {
  const auto it = std::find_if(std::begin(kRoles), std::end(kRoles), [&](const RoleInfo& r) { return r.role == role; });
  return it == std::end(kRoles) ? nullptr : it;
}

const char* roleName(int32_t role) {
  const RoleInfo* info = roleInfo(role);
  return info ? info->name : nullptr;
}

std::span<const TmParamDecl> standardParams(TmKind kind) {
  if (kind == TM_LIGHT) return kOfLights;
  if (kind == TM_VOLUME) return kOfVolumes;
  return {};
}

TmRole roleOf(const TmShader& shader, const TmParamDecl& decl) {
  if (decl.role != TM_ROLE_NONE) return static_cast<TmRole>(decl.role);
  for (const TmParamDecl& p : standardParams(static_cast<TmKind>(shader.kind)))
    if (std::string_view(p.name) == decl.name && p.type == TM_TYPE_OF(decl.type)) return static_cast<TmRole>(p.role);
  return TM_ROLE_NONE;
}

vec3 factorOf(const TmShader& light, const std::vector<Param>& params) {
  vec3 out(1.0f);
  for (const TmParamDecl& decl : std::span(light.params, static_cast<size_t>(light.paramCount))) {
    if (!isFactor(roleOf(light, decl))) continue;
    const std::vector<float> value = parameterValue(decl, findParam(params, decl.name)).floats;
    out *= decl.role == TM_ROLE_SCALE ? vec3(value[0]) : vec3(value[0], value[1], value[2]);
  }
  return out;
}

}  // namespace tomales
