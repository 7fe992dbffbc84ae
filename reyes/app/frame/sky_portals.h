// Finds the openings through which a sky lights a closed room, and keeps them in the scene, so that a shot and its
// frames have the same ones.
#pragma once
#include "reyes/app/settings.h"
#include "reyes/scene.h"

namespace tomales {

class Log;
class ShaderRegistry;

/// Adds spaces named kSkyOpening and a number. Scenes without geometry keep those that they have. Call it before a
/// ShadingSystem is made of the scene. Opens procedurals if there is a sky that needs openings.
void findSkyPortals(Scene& scene, ShaderRegistry& shaders, const RenderSettings& settings, Log& log);

}  // namespace tomales
