#include "reyes/app/frame/sky_portals.h"

#include <fmt/format.h>

#include "raytrace/sky_openings.h"
#include "reyes/app/frame/overrides.h"

namespace tomales {
namespace {

/// Ratio of the edges of a portal to those of its opening. A strip of an opening that is left out makes specks, where
/// samples beside it only make noise.
constexpr float kWider = 1.04f;

/// Returns the first light whose sky casts shadows and has no portals, though its shader knows some; null if there is
/// none. The lights are bound without the objects, which is faster, so lamps that need geometry are left out.
std::shared_ptr<const LightCall> skyWithoutPortals(const Scene& scene, ShaderRegistry& shaders, Log& log) {
  Scene lights = scene.withoutObjects();
  std::erase_if(lights.lights, [](const auto& light) { return light->area; });
  lights.options.displays.clear();  // objects write their channels
  Stats stats;
  const ShadingSystem shading(lights, shaders, nullptr, log, stats);
  for (size_t i = 0; i < lights.lights.size(); ++i)
    if (shading.takesFoundPortals(static_cast<int>(i))) return lights.lights[i];
  return nullptr;
}

std::string described(const SkyOpening& opening, const mat4& worldFromCurrent) {
  const vec3 center = transformPoint(worldFromCurrent, opening.center);
  const auto length = [&](const vec3& half) { return 2 * glm::length(transformVector(worldFromCurrent, half)); };
  return fmt::format("{:.3g} x {:.3g} at ({:.3g}, {:.3g}, {:.3g})", length(opening.halfU), length(opening.halfV),
                     center.x, center.y, center.z);
}

}  // namespace

void findSkyPortals(Scene& scene, ShaderRegistry& shaders, const RenderSettings& settings, Log& log) {
  const auto asked = scene.options.user.find("trace:openings");
  if (!hasGeometry(scene) || (asked != scene.options.user.end() && asked->second.number(0) == 0)) return;
  std::erase_if(scene.worldFromNamed, [](const auto& space) { return space.first.starts_with(kSkyOpening); });
  const auto light = skyWithoutPortals(scene, shaders, log);
  if (!light) return;
  scene.open([](const Attributes& a) { return a.visibility.transmission; });
  Stats stats;
  const Camera camera(scene.options);
  const ShadingSystem shading(scene, shaders, nullptr, log, stats);
  const RayScene rays(scene, camera, shading, raySettings(settings, scene.options), stats, log);
  const std::vector<SkyOpening> found = skyOpenings(rays, camera, shading);
  if (found.empty()) return;
  const mat4 worldFromCurrent = glm::inverse(scene.cameraFromWorldAtOpen());
  for (size_t k = 0; k < found.size(); ++k)
    scene.worldFromNamed[kSkyOpening + std::to_string(k + 1)] =
        worldFromCurrent * mat4(vec4(2 * kWider * found[k].halfU, 0), vec4(2 * kWider * found[k].halfV, 0),
                                vec4(found[k].normal(), 0), vec4(found[k].center, 1));
  const std::string others = found.size() > 1 ? fmt::format(" and {} more", found.size() - 1) : "";
  log.report(Severity::Note, "light-openings", light->shader.where,
             fmt::format("light \"{}\": rays have found an opening of {}{}; most of the sky's samples go there (Option "
                         "\"trace\" \"openings\" 0 looks for none)",
                         light->handle, described(found[0], worldFromCurrent), others));
}

}  // namespace tomales
