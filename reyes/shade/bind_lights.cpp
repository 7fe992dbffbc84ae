#include <fmt/format.h>

#include <sstream>

#include "reyes/base/deep_stack.h"
#include "reyes/shade/binder.h"

namespace tomales {

const ParamNames kLightParams{"lighting",   "__nondiffuse", "__nonspecular", "__group",       "lightgroup",
                              "__category", "shadowname",   "sfpx",          "sfnx",          "sfpy",
                              "sfny",       "sfpz",         "sfnz",          "shadowvariance"};

namespace {

/// Names of shadow maps, of shadowpoint one for each direction.
const ParamNames kShadowMaps{"shadowname", "sfpx", "sfnx", "sfpy", "sfny", "sfpz", "sfnz"};

constexpr int kMostRays = 1 << 16;  ///< Of one irradiance sample.

/// A count among the parameters of a light.
int countOf(const BoundShader& light, const char* name, int fallback, int least, int most, Log& log) {
  const float asked = light.number(name, static_cast<float>(fallback));
  const auto used = static_cast<int>(std::clamp(asked, static_cast<float>(least), static_cast<float>(most)));
  if (asked < static_cast<float>(least) || asked > static_cast<float>(most))
    log.report(Severity::Warning, fmt::format("light-{}", name), light.where,
               fmt::format("{}: {} {} is out of range; {} is used", light.user, name, asked, used));
  return used;
}

void warnAboutUnsupported(const BoundShader& light, const IndirectQuery& q, Log& log) {
  const auto warn = [&](const char* name, const std::string& value, const char* consequence) {
    log.report(Severity::Warning, fmt::format("light-{}", name), light.where,
               fmt::format("{}: {} \"{}\" is not supported; {}", light.user, name, value, consequence));
  };
  if (q.errorFunction != "screen" && q.errorFunction != "ward" && q.errorFunction != "hessian" &&
      q.errorFunction != "split" && q.errorFunction != "plain")
    warn("errorfunction", q.errorFunction, "\"screen\" is used");
  if (q.radiance != "shader" && q.radiance != "atlas" && q.radiance != "radiosity")
    warn("radiance", q.radiance, "gather rays run the shaders");
  if (!q.atlas.empty()) warn("atlas", q.atlas, "it is not read");
}

IndirectQuery queryOf(const BoundShader& light, Log& log) {
  IndirectQuery q;
  q.samples = countOf(light, "samples", q.samples, 1, kMostRays, log);
  q.maxError = light.number("maxerror", q.maxError);
  q.maxDistance = light.number("maxdist", q.maxDistance);
  q.errorFunction = light.text("errorfunction", q.errorFunction);
  q.radiance = light.text("radiance", q.radiance);
  q.atlas = light.text("atlas", q.atlas);
  q.subset = light.text("subset", q.subset);
  q.bounces = countOf(light, "bounces", q.bounces, 0, kMostBounces, log);
  warnAboutUnsupported(light, q, log);
  return q;
}

/// kLightParams.
void setHostParams(BoundLight& light, const LightCall& call, const ShadowMaps& maps, Log& log) {
  const ParamList& params = call.shader.params;
  const auto number = [&](const char* name) {
    const Param* p = findParam(params, name);
    return p ? p->number(0) : light.bound->number(name, 0);
  };
  const auto text = [&](std::string_view name) {
    const Param* p = findParam(params, name);
    return p && !p->strings.empty() ? p->strings[0] : std::string();
  };
  const auto warn = [&](const char* code, const std::string& problem, Severity severity = Severity::Warning) {
    log.report(severity, code, call.shader.where, light.bound->user + ": " + problem);
  };
  light.shadowVariance = std::max(0.0f, number("shadowvariance"));
  light.nondiffuse = number("__nondiffuse") != 0, light.nonspecular = number("__nonspecular") != 0;
  light.group = !text("__group").empty()      ? text("__group")
                : !text("lightgroup").empty() ? text("lightgroup")
                                              : call.handle;
  light.category = !text("__category").empty() ? text("__category") : light.bound->text("__category", "");
  const std::string lighting = text("lighting");
  light.direct = lighting != "indirect", light.indirect = lighting != "direct";
  if (!lighting.empty() && lighting != "both" && light.direct && light.indirect)
    warn("light-lighting", fmt::format("lighting \"{}\" is none of both, direct, indirect; both is used", lighting));
  for (const std::string_view name : kShadowMaps) {
    const std::string map = text(name);
    if (map.empty()) continue;
    const bool traced = map == "raytrace";
    if (!traced && !light.bound->find(name))
      warn("light-shadow-map", fmt::format("its shader reads no shadow map \"{}\"; shadows are traced instead", map));
    const bool mapped = !traced && light.bound->find(name) && maps.find(map, call.shader.where, light.bound->user);
    light.shadows = light.shadows || !mapped;
  }
  if (call.area && !light.can(TM_LIGHT_AREA))
    warn("light-area", fmt::format("\"{}\" is not an area light; it shines without its geometry", call.shader.name));
  if (!call.area && light.can(TM_LIGHT_AREA))
    warn("light-area", fmt::format("\"{}\" needs AreaLightSource and geometry; it casts no light", call.shader.name),
         Severity::Missing);
}

bool hasGeometry(const LightCall& call, const Scene& scene) {
  return std::any_of(scene.groups.begin(), scene.groups.end(),
                     [&](const ShadeGroup& g) { return g.attributes->areaLight == call.index; });
}

}  // namespace

std::shared_ptr<const Sky> Binder::sky(const BoundShader& light) {
  const std::string picture = light.text("map", ""), space = light.text("mapspace", "world");
  if (space != "world" && space != "shader")
    log_.report(
        Severity::Warning, "light-mapspace", light.where,
        fmt::format("{}: mapspace \"{}\" is neither \"world\" nor \"shader\"; world is used", light.user, space));
  const mat4& currentFromSky = space == "shader" ? light.currentFromShader : cameraFromWorld_;
  auto sky = picture.empty()
                 ? std::make_shared<Sky>()
                 : std::make_shared<Sky>(textures_, picture, light.where, light.user, skyFromCurrent(currentFromSky));
  Portals portals;
  std::istringstream names(light.text("portals", ""));
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

std::unique_ptr<const BoundLight> Binder::light(const LightCall& call, int index) {
  BoundShaderPtr bound = bind(&call.shader, call.shader.where, fmt::format("light \"{}\"", call.handle), TM_LIGHT);
  if (!bound) return nullptr;
  auto light = std::make_unique<BoundLight>();
  light->bound = bound, light->index = index;
  const bool indirect = light->can(TM_LIGHT_INDIRECT);
  light->shadows = call.castsShadows || light->can(TM_LIGHT_SHADOWED);
  setHostParams(*light, call, shadowMaps_, log_);
  if (call.area && light->can(TM_LIGHT_AREA) && !hasGeometry(call, scene_))
    log_.report(Severity::Warning, "light-no-geometry", call.shader.where,
                bound->user + ": no geometry follows the AreaLightSource; it casts no light");
  light->shadows = light->shadows && !indirect;
  light->visible = bound->number("visible", 1) != 0;
  if (light->can(TM_LIGHT_SKY)) light->sky = sky(*bound);
  if (light->can(TM_LIGHT_AREA) || light->can(TM_LIGHT_SKY) || light->can(TM_LIGHT_SAMPLED))
    light->samples = countOf(*bound, "samples", 16, 1, kMostLightSamples, log_);
  if (indirect) light->samples = 3, light->query = queryOf(*bound, log_);
  return light;
}

namespace {

/// A light that filters an indirect light asks for the same light as its source. False: there is none.
bool connectFilter(BoundLight& filter, const BoundScene& scene) {
  const std::string source = filter.bound->text("source", "");
  for (size_t i = scene.lights.size(); i-- > 0;) {
    const BoundLight* light = scene.lights[i].get();
    if (!light || scene.scene.lights[i]->handle != source) continue;
    if (!light->can(TM_LIGHT_INDIRECT) || light->bound->find("source")) continue;
    filter.query = light->query;
    filter.sourceTint = light->bound->number("intensity", 1) * light->bound->color("lightcolor", vec3(1.0f));
    return true;
  }
  scene.log.report(Severity::Missing, "light-source", filter.bound->where,
                   fmt::format("{}: source \"{}\" is not the handle of an indirect light; it casts no light",
                               filter.bound->user, source));
  return false;
}

}  // namespace

void connectFilters(BoundScene& scene) {
  for (auto& light : scene.lights) {
    if (!light || !light->can(TM_LIGHT_INDIRECT) || !light->bound->find("source")) continue;
    auto filter = std::make_unique<BoundLight>(*light);
    light = connectFilter(*filter, scene) ? std::move(filter) : nullptr;
  }
}

}  // namespace tomales
