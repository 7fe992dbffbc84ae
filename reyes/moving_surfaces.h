// Surface shaders that assign P. The part of such a shader that moves the points is run as the displacement of an
// object that has no displacement shader. Also what displacement shaders compute for surfaces: vertices must have room
// for it before they are diced.
#pragma once
#include "reyes/scene.h"

namespace tomales {

class Log;
class ShaderRegistry;

/// Call it before a ShadingSystem is made of the scene; `registry` and `log` live as long as the scene's procedurals.
void displaceByMovingSurfaces(Scene& scene, ShaderRegistry& registry, Log& log);

}  // namespace tomales
