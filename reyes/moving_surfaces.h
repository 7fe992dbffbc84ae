// Surface shaders that assign P: the host runs what of them moves the points as the displacement of an object that has
// none of its own.
#pragma once
#include "reyes/scene.h"

namespace tomales {

class Log;
class ShaderRegistry;

/// Call it before a ShadingSystem is made of the scene; `registry` and `log` live as long as the scene's procedurals.
void displaceByMovingSurfaces(Scene& scene, ShaderRegistry& registry, Log& log);

}  // namespace tomales
