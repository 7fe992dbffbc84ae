// The command line's say over a scene that the reader has frozen.
#pragma once
#include "reyes/app/settings.h"
#include "reyes/scene.h"

namespace tomales {

/// Applies format, crop, rates, buckets and output; adds an `indirectlight` where the mode wants one and the
/// scene has none.
void applyOverrides(Scene& scene, const RenderSettings& settings);

/// Leaves out, with a message, Displays that would write over an earlier one's file, and windows beside files.
void dropDisplays(Options& options, Log& log);

bool hasIndirectLight(const Scene& scene);

/// With the memory for geometry that Option "limits" "geocachememory" and --geometry-cache allow.
RaySettings raySettings(const RenderSettings& settings, const Options& options);

/// How a choice is carried out for this scene.
GiMode giModeOf(GiChoice choice, const Scene& scene);

}  // namespace tomales
