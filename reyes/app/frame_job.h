// One frame through every stage: rays and global illumination are built if the scene asks for them.
#pragma once
#include "reyes/app/settings.h"
#include "reyes/base/stats.h"
#include "reyes/scene.h"

namespace tomales {

/// Renders a scene that overrides have been applied to, and writes its Displays; its procedurals are opened on the way. Everything
/// that goes wrong is in the log.
void renderFrame(Scene& scene, const RenderSettings& settings, Stats& stats, Log& log,
                 const std::function<void()>& afterStage);

}  // namespace tomales
