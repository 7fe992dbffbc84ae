#include "reyes/app/frame/shared_light.h"

#include "reyes/app/frame/frame_job.h"
#include "reyes/app/frame/frame_shaders.h"
#include "reyes/app/frame/light_sources.h"
#include "reyes/app/frame/radiosity_job.h"
#include "reyes/world_sum.h"

namespace tomales {
namespace {

bool makesMaps(const GiMethod& method) {
  return !method.byPointClouds && (method.mode == GiMode::Atlas || method.mode == GiMode::Radiosity);
}

/// Returns the method of a frame from its lights alone, because the rest of the scene takes longer to open and to bind.
const GiMethod& methodOfLights(const Scene& scene, ShaderRegistry& shaders, const RenderSettings& settings, Log& log) {
  const Scene lights = scene.withoutObjects();
  Stats stats;
  return methodOf(settings, ShadingSystem(lights, shaders, nullptr, log, stats));
}

}  // namespace

void makeSharedLight(Scene& scene, ShaderRegistry& shaders, const RenderSettings& settings,
                     std::optional<AtlasPass> pass, WorkPart part, Stats& stats, Log& log) {
  FrameJob job(scene, shaders, settings, stats, log);
  const GiMethod& method = job.method();
  if (!makesMaps(method) || (pass && method.mode != GiMode::Atlas))
    return log.report(Severity::Warning, "prepare-unused", scene.where,
                      std::string("nothing to prepare: --gi ") + method.name + " makes no such maps");
  if (atlasFolder(settings, job.shading()).empty())
    return log.report(Severity::Error, "prepare-folder", scene.where,
                      "no folder is named for the maps: give --atlas FOLDER");
  job.setShares(0, 2);  // nothing but maps of light is made
  job.prepareRays();
  const RayTools tools = *job.rayTools();
  if (pass)
    makeAtlasPass(*pass, part, tools, settings, job.meter().makingMaps(), stats, log);
  else if (method.mode == GiMode::Atlas)
    prepareAtlas(tools, settings, job.meter().makingMaps(), nullptr, stats, log);
  else
    prepareRadiosity(tools, job.camera(), settings, job.meter().makingMaps(), nullptr, stats, log);
}

std::optional<SharedLight> sharedLightOf(Scene& scene, const RenderSettings& settings, Log& log) {
  if (settings.light.gi && !makesMaps(*settings.light.gi)) return std::nullopt;
  const std::unique_ptr<ShaderRegistry> shaders = frameShaders(settings, log);
  if (!makesMaps(methodOfLights(scene, *shaders, settings, log))) return std::nullopt;
  Stats stats;
  RenderSettings asking = settings;
  const FrameJob job(scene, *shaders, asking, stats, log);
  SharedLight out;
  out.folder = atlasFolder(settings, job.shading());
  if (!out.folder.empty() && isMadeByHand(out.folder)) return std::nullopt;
  out.photons = job.method().mode == GiMode::Atlas;
  out.world = worldSum(scene, out.photons);
  const MapNames names = mapNames(scene, job.shading(), atlasSettings(settings, scene, job.shading()));
  out.maps = out.photons ? names.all() : names.withoutCausticsAndMedia().all();
  return out;
}

std::vector<std::string> filesOfMap(const SharedLight& light, const std::string& folder, const std::string& map) {
  const std::filesystem::path at = folder;
  if (!light.photons)
    return {atlasFile(at / "radiosity", map, ".ptc").string(), atlasFile(at / "radiosity", map, ".bkm").string()};
  return {atlasFile(at / "irradiance", map, ".ptc").string(), atlasFile(at, map, ".bkm").string()};
}

std::string photonsOfMap(const std::string& folder, const std::string& map) {
  return atlasFile(std::filesystem::path(folder) / "photons", map, ".ptc").string();
}

}  // namespace tomales
