// What `tomales info` says of a scene: its frames, and which of the files and shaders that it names are there.
#pragma once
#include "reyes/app/commands/shader_info.h"
#include "reyes/base/trust.h"

namespace tomales {

/// Runs no program and loads no plugin that `trust` does not allow.
Json sceneInfo(const std::string& file, const Trust& trust, Log& log);
/// Prints the "needs" of sceneInfo, a line each, and their total.
void printNeeds(const Json& needs);
/// How many of them are missing.
int64_t missingOf(const Json& needs);

}  // namespace tomales
