// The command line's say over a scene that the reader has frozen.
#pragma once
#include "reyes/app/settings.h"
#include "reyes/scene.h"

namespace tomales {

/// Applies format, crop, rates, buckets and output; asks for an indirect light where the mode wants one.
void applyOverrides(Scene& scene, const RenderSettings& settings);

/// Leaves out, with a message, Displays that would write over an earlier one's file, and windows beside files.
void dropDisplays(Options& options, const PluginTrust& trust, Log& log);

/// With the memory for geometry that Option "limits" "geocachememory" and --geometry-cache allow.
RaySettings raySettings(const RenderSettings& settings, const Options& options);

/// What gather rays see by a choice, or by the scene where that says so; none: nothing is gathered, or (Reference,
/// Baked) not in that way.
std::optional<HitRadianceChoice> hitRadianceOf(GiChoice choice, const ShadingSystem& shading);
/// How a choice is carried out for the lights of this scene.
GiMode giModeOf(GiChoice choice, const ShadingSystem& shading);

}  // namespace tomales
