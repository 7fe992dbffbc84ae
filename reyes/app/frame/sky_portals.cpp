#include "reyes/app/frame/sky_portals.h"

#include <fmt/format.h>

#include "raytrace/sky_openings.h"

namespace tomales {
namespace {

/// Ratio of the edges of a portal to those of its opening. A strip of an opening outside of the portal makes specks;
/// samples beside the opening only make noise.
constexpr float kWider = 1.04f;

/// Returns the first light that takes openings; null if there is none.
const LightCall* lightOfOpenings(const Scene& scene, const ShadingSystem& shading) {
  for (size_t i = 0; i < scene.lights.size(); ++i)
    if (shading.light(static_cast<int>(i)).takesFoundPortals()) return scene.lights[i].get();
  return nullptr;
}

std::string described(const SkyOpening& opening, const mat4& worldFromCurrent) {
  const vec3 center = transformPoint(worldFromCurrent, opening.center);
  const auto length = [&](const vec3& half) { return 2 * glm::length(transformVector(worldFromCurrent, half)); };
  return fmt::format("{:.3g} x {:.3g} at ({:.3g}, {:.3g}, {:.3g})", length(opening.halfU), length(opening.halfV),
                     center.x, center.y, center.z);
}

}  // namespace

bool wantsSkyPortals(const Scene& scene, const ShadingSystem& shading) {
  const Param* asked = findParam(scene.options.user, "trace:openings");
  const bool off = asked && asked->number(0) == 0;
  return !off && lightOfOpenings(scene, shading);
}

void findSkyPortals(Scene& scene, const Camera& camera, ShadingSystem& shading, const RayScene& rays, Log& log) {
  if (!wantsSkyPortals(scene, shading)) return;
  scene.worldFromOpenings.clear();
  const std::vector<SkyOpening> found = skyOpenings(rays, camera, shading);
  const mat4 worldFromCurrent = glm::inverse(scene.cameraFromWorldAtOpen());
  for (const SkyOpening& opening : found)
    scene.worldFromOpenings.push_back(worldFromCurrent * mat4(vec4(2 * kWider * opening.halfU, 0),
                                                              vec4(2 * kWider * opening.halfV, 0),
                                                              vec4(opening.normal(), 0), vec4(opening.center, 1)));
  shading.takeFoundPortals();
  if (found.empty()) return;
  const LightCall* light = lightOfOpenings(scene, shading);
  const std::string others = found.size() > 1 ? fmt::format(" and {} more", found.size() - 1) : "";
  log.report(Severity::Note, "light-openings", light->shader.where,
             fmt::format("light \"{}\": rays have found an opening of {}{}; most of the sky's samples go there (Option "
                         "\"trace\" \"openings\" 0 looks for none)",
                         light->handle, described(found[0], worldFromCurrent), others));
}

}  // namespace tomales
