#include "reyes/app/frame/light_sources.h"

#include "reyes/app/frame/atlas_job.h"
#include "reyes/app/frame/radiosity_job.h"

namespace tomales {
namespace {

void setAtlas(GiServices& services, const FrameOfLight& frame) {
  services.setAtlasSource([frame]() -> std::unique_ptr<const IrradianceAtlas> {
    const RayTools* tools = frame.rays();
    if (!tools) return nullptr;
    return prepareAtlas(tools->rays->scene(), *tools->rays, *tools->shading, frame.settings, frame.progress, frame.kept,
                        frame.stats, frame.log);
  });
}

void setRadiosity(GiServices& services, const FrameOfLight& frame) {
  services.setHitRadianceSource([frame]() -> std::unique_ptr<const HitRadiance> {
    const RayTools* tools = frame.rays();
    if (!tools) return nullptr;
    return prepareRadiosity(*tools, frame.camera, frame.settings, frame.progress, frame.kept, frame.stats, frame.log);
  });
}

/// Opens the maps now: points are looked up and never gathered, so no later moment comes to open them.
void openMapsOfBaked(GiServices& services, const FrameOfLight& frame) {
  if (!hasGeometry(frame.scene))
    return frame.log.report(Severity::Missing, "baked-folder", {},
                            "--gi baked is for tomales render: shaded without indirect light");
  services.setAtlas(openBaked(frame.scene, frame.shading, frame.settings, frame.log));
}

struct Source {
  GiMode mode;
  void (*set)(GiServices& services, const FrameOfLight& frame);
};
constexpr Source kSources[] = {
    {GiMode::Atlas, setAtlas}, {GiMode::Radiosity, setRadiosity}, {GiMode::Baked, openMapsOfBaked}};

}  // namespace

const GiMethod& methodOf(const RenderSettings& settings, const ShadingSystem& shading) {
  if (settings.gi) return *settings.gi;
  const auto request = shading.indirectRequest();
  return request ? *request->method : giMethodOf(GiMode::None);
}

void setLightSources(GiServices& services, const GiMethod& method, const FrameOfLight& frame) {
  for (const Source& source : kSources)
    if (source.mode == method.mode) source.set(services, frame);
}

}  // namespace tomales
