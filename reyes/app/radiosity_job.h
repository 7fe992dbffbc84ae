// The radiosity maps of one frame.
#pragma once
#include "gi/services.h"
#include "reyes/app/settings.h"

namespace tomales {

/// Bakes them. With a settings.radiosityFolder each is written there too, as a tiled MIP EXR for each object and side: NAME.exr and
/// NAME.back.exr, by Attribute "identifier" "name". What cannot be written is reported.
std::unique_ptr<const RadiosityMaps> prepareRadiosity(const RayTools& tools, const Camera& camera, const RenderSettings& settings, Stats& stats, Log& log);

}  // namespace tomales
