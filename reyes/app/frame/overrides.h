// Changes that the command line makes to a scene that the reader has frozen.
#pragma once
#include "reyes/app/settings.h"
#include "reyes/scene.h"

namespace tomales {

/// Applies format, crop, rates and bucket size, and adds an indirect light where the mode needs one. A frame that
/// writes nothing but maps for later frames keeps its own format and all of its view.
void applyOverrides(Scene& scene, const RenderSettings& settings);

/// Returns settings with the memory for geometry that Option "limits" "geocachememory" and --geometry-cache allow.
RaySettings raySettings(const RenderSettings& settings, const Options& options);

}  // namespace tomales
