// `tomales import`: turns models of other programs into RIB.
#pragma once
#include <string>

#include "reyes/bindings/assimp/settings.h"

namespace tomales {

/// `settings.scene` is the file to write; its parts go to a folder beside it. Returns an ExitCode.
int importCommand(model::Settings settings);

}  // namespace tomales
