// A model as a scene in RIB. Threads: plain function.
#pragma once
#include <assimp/scene.h>

#include "reyes/base/log.h"
#include "reyes/bindings/assimp/mtl.h"
#include "reyes/bindings/assimp/settings.h"

namespace tomales::model {

/// Writes the scene and its parts. Parts of the model that are left out are reported. `materials`: those of the files
/// that an .obj names. Throws WriteError.
void writeScene(const aiScene& scene, const Settings& settings, const MtlMaterials& materials, Log& log);

}  // namespace tomales::model
