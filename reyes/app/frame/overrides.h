// Changes that the command line makes to a scene that the reader has frozen.
#pragma once
#include "reyes/app/settings.h"
#include "reyes/scene.h"

namespace tomales {

/// Applies format, crop, rates, buckets and output; asks for an indirect light where the mode wants one.
void applyOverrides(Scene& scene, const RenderSettings& settings);

/// Leaves out, with a message, Displays that would write over an earlier one's file, and windows beside files.
void dropDisplays(Options& options, const PluginTrust& trust, Log& log);

/// Returns settings with the memory for geometry that Option "limits" "geocachememory" and --geometry-cache allow.
RaySettings raySettings(const RenderSettings& settings, const Options& options);

}  // namespace tomales
