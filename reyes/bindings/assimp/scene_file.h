// A model as a scene in RIB. Threads: plain function.
#pragma once
#include <assimp/scene.h>

#include "reyes/base/log.h"
#include "reyes/bindings/assimp/settings.h"

namespace tomales::model {

/// Writes the scene and its parts. Parts of the model that are left out are reported. Throws WriteError.
void writeScene(const aiScene& scene, const Settings& settings, Log& log);

}  // namespace tomales::model
