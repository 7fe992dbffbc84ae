// A model file through Assimp to a scene in RIB. Threads: plain function.
#pragma once
#include "reyes/base/log.h"
#include "reyes/bindings/assimp/settings.h"

namespace tomales::model {

/// Reads settings.model, and writes the scene and its parts. Parts that cannot be read or are left out are reported.
/// Throws WriteError. Assimp may crash, hang or take all memory on damaged files.
void importModel(const Settings& settings, Log& log);

}  // namespace tomales::model
