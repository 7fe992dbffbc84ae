// `tomales render` for one frame: runs the stages in one process, within its memory limit.
#pragma once
#include "reyes/app/settings.h"
#include "reyes/base/stats.h"
#include "reyes/scene.h"
#include "reyes/shader_registry.h"

namespace tomales {

/// Renders scene number `world` of the stream, overrides applied, and writes its Displays. Everything that goes wrong
/// is in the log.
void renderFrame(Scene& scene, ShaderRegistry& shaders, int world, const RenderSettings& settings, Stats& stats,
                 Log& log, const std::function<void()>& afterStage);

}  // namespace tomales
