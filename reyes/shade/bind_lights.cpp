// Finds, once for each light, everything that the renderer knows about it, from the capabilities of its shader and from
// its parameters with a role. Nothing else reads a light's parameters.
#include <fmt/format.h>

#include <sstream>

#include "reyes/base/deep_stack.h"
#include "reyes/rsl_host.h"
#include "reyes/shade/binder.h"
#include "reyes/shade/roles.h"
#include "reyes/shader_registry.h"

namespace tomales {
namespace {

constexpr const char* kIndirect = "indirect";  ///< The category of indirect lights, beside their own.

constexpr int kColours = 3;         ///< An indirect light has a sample for each.
constexpr int kMostRays = 1 << 16;  ///< The limit for one irradiance sample.

/// Returns the value of a light's parameter that is a count.
int countOf(const BoundShader& light, TmRole role, int fallback, int least, int most, Log& log) {
  const float asked = light.number(role, static_cast<float>(fallback));
  const float inRange = std::isnan(asked) ? static_cast<float>(fallback) : asked;
  const auto used = static_cast<int>(std::clamp(inRange, static_cast<float>(least), static_cast<float>(most)));
  if (!(asked >= static_cast<float>(least) && asked <= static_cast<float>(most)))
    log.report(Severity::Warning, "light-value", light.where,
               fmt::format("{}: {} {} is out of range; {} is used", light.user, light.find(role)->name, asked, used));
  return used;
}

void warnOfValue(const BoundShader& light, TmRole role, const std::string& value, const std::string& consequence,
                 Log& log) {
  log.report(Severity::Warning, "light-value", light.where,
             fmt::format("{}: {} \"{}\" is not supported; {}", light.user, light.find(role)->name, value, consequence));
}

ErrorFunction errorFunctionOf(const BoundShader& light, ErrorFunction fallback, Log& log) {
  const std::string name = light.text(TM_ROLE_ERROR_FUNCTION, infoOf(fallback).name);
  const auto found = errorFunctionNamed(name);
  if (!found)
    warnOfValue(light, TM_ROLE_ERROR_FUNCTION, name, fmt::format("\"{}\" is used", infoOf(fallback).name), log);
  return found.value_or(fallback);
}

const GiMethod* methodOf(const BoundShader& light, const GiMethod* fallback, Log& log) {
  const std::string name = light.text(TM_ROLE_HIT_RADIANCE, fallback->radiance);
  if (const GiMethod* found = giMethodOfRadiance(name)) return found;
  warnOfValue(light, TM_ROLE_HIT_RADIANCE, name, "gather rays run the shaders", log);
  return fallback;
}

IndirectQuery queryOf(const BoundShader& light, int samplesInstead, Log& log) {
  IndirectQuery q;
  q.samples = samplesInstead > 0 ? samplesInstead : countOf(light, TM_ROLE_SAMPLES, q.samples, 1, kMostRays, log);
  q.maxError = light.number(TM_ROLE_MAX_ERROR, q.maxError);
  q.maxDistance = light.number(TM_ROLE_MAX_DISTANCE, q.maxDistance);
  q.errorFunction = errorFunctionOf(light, q.errorFunction, log);
  q.subset = light.text(TM_ROLE_SUBSET, q.subset);
  q.bounces = countOf(light, TM_ROLE_BOUNCES, q.bounces, 0, kMostBounces, log);
  return q;
}

IndirectRequest requestOf(const BoundShader& light, const IndirectQuery& query, Log& log) {
  IndirectRequest out;
  out.method = methodOf(light, out.method, log);
  out.atlas = light.text(TM_ROLE_ATLAS, "");
  if (const RoleValue* bounces = light.find(TM_ROLE_BOUNCES); bounces && bounces->given) out.bounces = query.bounces;
  return out;
}

/// Finds by "lighting" whether it lights what the camera sees, and what gather rays see.
void setLighting(BoundLight& light, Log& log) {
  const std::string lighting = light.bound->text(TM_ROLE_LIGHTING, "both");
  light.direct = lighting != "indirect";
  light.indirect = lighting != "direct";
  if (lighting != "both" && light.direct && light.indirect)
    log.report(Severity::Warning, "light-lighting", light.bound->where,
               fmt::format("{}: lighting \"{}\" is not one of \"both\", \"direct\" and \"indirect\"; \"both\" is used",
                           light.bound->user, lighting));
}

/// Turns shadow rays off if the shader reads a shadow map that can be read.
void setShadows(BoundLight& light, const ShadowMaps& maps, Log& log) {
  const BoundShader& bound = *light.bound;
  light.shadowVariance = std::max(0.0f, bound.number(TM_ROLE_SHADOW_VARIANCE, 0));
  for (const RoleValue& map : bound.roleValues) {
    if (map.role != TM_ROLE_SHADOW_MAP || map.text.empty()) continue;
    const bool traced = map.text == "raytrace";
    if (!traced && !map.declared)
      log.report(Severity::Warning, "light-shadow-map", bound.where,
                 fmt::format("{}: its shader declares no shadow map \"{}\"; shadows are traced instead", bound.user,
                             map.name));
    const bool mapped = !traced && map.declared && maps.find(map.text, bound.where, bound.user);
    light.shadows = light.shadows || !mapped;
  }
}

/// Returns true if the role is set for all points. (A shader with an output of that role sets it point by point.)
bool isSetEverywhere(const BoundShader& light, TmRole role) {
  return light.output(role) < 0 && light.number(role, 0) != 0;
}

/// Warns if the request is AreaLightSource and the shader has no TM_LIGHT_AREA, or the reverse.
void warnOfArea(const BoundLight& light, const LightCall& call, bool hasGeometry, Log& log) {
  const auto warn = [&](const char* code, Severity severity, const std::string& problem) {
    log.report(severity, code, call.shader.where, light.bound->user + ": " + problem);
  };
  if (call.area && !light.can(TM_LIGHT_AREA))
    warn("light-area", Severity::Warning,
         fmt::format("\"{}\" is not an area light; it shines without its geometry", call.shader.name));
  if (!call.area && light.can(TM_LIGHT_AREA))
    warn("light-area", Severity::Missing,
         fmt::format("\"{}\" needs AreaLightSource and geometry; it casts no light", call.shader.name));
  if (call.area && light.can(TM_LIGHT_AREA) && !hasGeometry)
    warn("light-no-geometry", Severity::Warning, "no geometry follows the AreaLightSource; it casts no light");
}

}  // namespace

std::shared_ptr<Sky> Binder::sky(const BoundShader& light) {
  const std::string picture = light.text(TM_ROLE_SKY_MAP, ""), space = light.text(TM_ROLE_SKY_SPACE, "world");
  if (space != "world" && space != "shader")
    log_.report(Severity::Warning, "light-mapspace", light.where,
                fmt::format("{}: {} \"{}\" is neither \"world\" nor \"shader\"; world is used", light.user,
                            light.find(TM_ROLE_SKY_SPACE)->name, space));
  const mat4& currentFromSky = space == "shader" ? light.currentFromShader : cameraFromWorld_;
  auto sky = picture.empty()
                 ? std::make_shared<Sky>()
                 : std::make_shared<Sky>(textures_, picture, light.where, light.user, skyFromCurrent(currentFromSky));
  Portals portals;
  std::istringstream names(light.text(TM_ROLE_SKY_PORTALS, ""));
  for (std::string name; names >> name;) {
    mat4 currentFromPortal;
    if (!scene_.cameraFromNamed(name, currentFromPortal))
      log_.report(Severity::Warning, "light-portal", light.where,
                  fmt::format("{}: no CoordinateSystem is named \"{}\"; it has no such portal", light.user, name));
    else if (!portals.add(currentFromPortal))
      log_.report(Severity::Warning, "light-portal", light.where,
                  fmt::format("{}: the portal \"{}\" has no area; it is left out", light.user, name));
  }
  sky->setPortals(std::move(portals));
  return sky;
}

Portals foundPortals(const Scene& scene) {
  Portals out;
  for (const mat4& worldFromOpening : scene.worldFromOpenings)
    out.add(scene.cameraFromWorldAtOpen() * worldFromOpening);
  return out;
}

std::unique_ptr<BoundLight> Binder::light(const LightCall& call, int index) {
  BoundShaderPtr bound =
      bind(&call.shader, call.shader.where, fmt::format("light \"{}\"", call.handle), TM_LIGHT, call.area);
  if (!bound) return nullptr;
  auto light = std::make_unique<BoundLight>();
  light->bound = bound;
  light->index = index;
  light->group = bound->text(TM_ROLE_GROUP, call.handle);
  light->category = bound->text(TM_ROLE_CATEGORY, "");
  if (light->can(TM_LIGHT_INDIRECT)) light->category += (light->category.empty() ? "" : ",") + std::string(kIndirect);
  light->nondiffuse = isSetEverywhere(*bound, TM_ROLE_NONDIFFUSE);
  light->nonspecular = isSetEverywhere(*bound, TM_ROLE_NONSPECULAR);
  light->visible = bound->number(TM_ROLE_VISIBLE, 1) != 0;
  light->allRound = shinesAllRound(*bound->shader, bound->values.data());
  setLighting(*light, log_);
  light->shadows = call.castsShadows || light->can(TM_LIGHT_SHADOWED);
  setShadows(*light, shadowMaps_, log_);
  warnOfArea(*light, call, haveGeometry_.contains(call.index), log_);
  if (light->can(TM_LIGHT_SKY)) light->sky = sky(*bound);
  if (light->takesFoundPortals()) light->sky->setPortals(foundPortals(scene_));
  if (light->can(TM_LIGHT_AREA) || light->can(TM_LIGHT_SKY) || light->can(TM_LIGHT_SAMPLED))
    light->samples = countOf(*bound, TM_ROLE_SAMPLES, kDefaultLightSamples, 1, kMostLightSamples, log_);
  if (light->can(TM_INTERPOLATED)) light->maxVariation = light->can(TM_INTERPOLATED_UNASKED) ? 1 : -1;
  if (light->can(TM_OCCLUDED)) light->maxVariation = bound->number(TM_ROLE_MAX_VARIATION, 1);
  if (!light->can(TM_LIGHT_INDIRECT)) return light;
  light->shadows = false;
  light->samples = kColours;
  light->query = queryOf(*bound, scene_.options.indirectSamples, log_);
  light->request = requestOf(*bound, light->query, log_);
  light->filters = bound->find(TM_ROLE_INDIRECT_SOURCE) != nullptr;
  return light;
}

std::unique_ptr<BoundLight> Binder::addedIndirectLight(int index) {
  LightCall call;
  call.shader.name = "indirectlight";
  call.shader.where = scene_.where;
  call.handle = "--gi";
  return light(call, index);
}

namespace {

/// Makes a light that filters an indirect light ask for the same light as its source. Returns false if there is no
/// source.
bool connectFilter(BoundLight& filter, const BoundScene& scene) {
  const std::string source = filter.bound->text(TM_ROLE_INDIRECT_SOURCE, "");
  for (size_t i = scene.lights.size(); i-- > 0;) {
    const BoundLight* light = scene.lights[i].get();
    if (!light || scene.scene.lights[i]->handle != source) continue;
    if (!light->can(TM_LIGHT_INDIRECT) || light->filters) continue;
    filter.query = light->query;
    filter.sourceTint = light->bound->number(TM_ROLE_SCALE, 1) * light->bound->color(TM_ROLE_TINT, vec3(1.0f));
    return true;
  }
  scene.log.report(Severity::Missing, "light-source", filter.bound->where,
                   fmt::format("{}: {} \"{}\" is not the handle of an indirect light; it casts no light",
                               filter.bound->user, filter.bound->find(TM_ROLE_INDIRECT_SOURCE)->name, source));
  return false;
}

}  // namespace

void connectFilters(BoundScene& scene) {
  for (auto& light : scene.lights) {
    if (!light || !light->filters) continue;
    auto filter = std::make_unique<BoundLight>(*light);
    light = connectFilter(*filter, scene) ? std::move(filter) : nullptr;
  }
}

}  // namespace tomales
