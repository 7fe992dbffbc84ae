#include "reyes/app/frame/light_sources.h"

#include <fmt/format.h>

#include "reyes/app/frame/atlas_job.h"
#include "reyes/app/frame/radiosity_job.h"

namespace tomales {
namespace {

void setAtlas(GiServices& services, const FrameOfLight& frame) {
  services.setAtlasSource([frame]() -> std::unique_ptr<const IrradianceAtlas> {
    const RayTools* tools = frame.rays();
    if (!tools) return nullptr;
    return prepareAtlas(*tools, frame.settings, frame.progress, frame.kept, frame.stats, frame.log);
  });
}

void setRadiosity(GiServices& services, const FrameOfLight& frame) {
  services.setHitRadianceSource([frame]() -> std::unique_ptr<const HitRadiance> {
    const RayTools* tools = frame.rays();
    if (!tools) return nullptr;
    return prepareRadiosity(*tools, frame.camera, frame.settings, frame.progress, frame.kept, frame.stats, frame.log);
  });
}

/// Opens the maps at once: with this method nothing is gathered, which is when other methods open theirs.
void openMapsOfBaked(GiServices& services, const FrameOfLight& frame) {
  if (!hasGeometry(frame.scene))
    return frame.log.report(Severity::Missing, "baked-folder", {},
                            "--gi baked is for tomales render: shaded without indirect light");
  services.setAtlas(openBaked(frame.scene, frame.shading, frame.settings, frame.log));
}

/// Warns of surfaces that mirror or refract for the eye, and are matte for photons: no photon brings their caustics.
void warnOfMatteMirrors(const FrameOfLight& frame) {
  for (size_t g = 0; g < frame.scene.groups.size(); ++g) {
    const ShadeGroup& group = frame.scene.groups[g];
    if (group.attributes->photon.shadingModel != "matte" || !frame.shading.group(static_cast<int>(g)).tracesRays())
      continue;
    frame.log.report(Severity::Warning, "photons-matte", group.where,
                     fmt::format("{}: its shader traces rays, and photons take it for matte: they bring no light that "
                                 "it mirrors or refracts (Attribute \"photon\" \"shadingmodel\")",
                                 objectName(group)));
  }
}

/// Counts photons at visible points. In the reference these are photons of caustics, if mirrors or glass can make any.
void setPhotons(GiServices& services, const FrameOfLight& frame) {
  if (!countsPhotons(methodOf(frame.settings, frame.shading), frame.scene)) return;
  const bool causticsAlone = methodOf(frame.settings, frame.shading).causticsAlone;
  if (!causticsAlone) warnOfMatteMirrors(frame);
  PhotonPasses passes;
  passes.photons = frame.settings.light.photons;
  passes.noise = frame.settings.light.photonNoise;
  passes.seed = lightSeedOf(frame.settings);
  passes.specularFirstOnly = causticsAlone;
  passes.shrinks = !causticsAlone;
  passes.log = &frame.log;
  passes.tell = [log = &frame.log](int64_t sent, size_t points, double noise) {
    std::string text = fmt::format("{} photons were counted at {} points", sent, points);
    if (noise >= 0) text += fmt::format("; the noise of what they bring is {:.2g} %", 100 * noise);
    log->report(Severity::Info, "photons-counted", {}, text);
  };
  services.setPhotonPasses(std::move(passes));
}

struct Source {
  GiMode mode;
  void (*set)(GiServices& services, const FrameOfLight& frame);
};
constexpr Source kSources[] = {{GiMode::Atlas, setAtlas},
                               {GiMode::Radiosity, setRadiosity},
                               {GiMode::Baked, openMapsOfBaked},
                               {GiMode::Progressive, setPhotons},
                               {GiMode::Reference, setPhotons}};

}  // namespace

const GiMethod& methodOf(const RenderSettings& settings, const ShadingSystem& shading) {
  if (settings.light.gi) return *settings.light.gi;
  const auto request = shading.indirectRequest();
  return request ? *request->method : giMethodOf(GiMode::None);
}

bool countsPhotons(const GiMethod& method, const Scene& scene) {
  const auto isSpecular = [](const ShadeGroup& g) { return isSpecularForPhotons(*g.attributes); };
  return method.countsPhotons &&
         (!method.causticsAlone || std::any_of(scene.groups.begin(), scene.groups.end(), isSpecular));
}

void setLightSources(GiServices& services, const GiMethod& method, const FrameOfLight& frame) {
  for (const Source& source : kSources)
    if (source.mode == method.mode) source.set(services, frame);
}

}  // namespace tomales
