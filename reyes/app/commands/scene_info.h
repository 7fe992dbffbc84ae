// The part of `tomales info` for scenes: their frames, and which of the files and shaders that they name exist.
#pragma once
#include "reyes/app/commands/shader_info.h"
#include "reyes/base/trust.h"

namespace tomales {

/// It runs no program and loads no plugin that `trust` does not allow.
Json sceneInfo(const std::string& file, const Trust& trust, Log& log);
/// Prints the "needs" of sceneInfo, one on each line, and their total.
void printNeeds(const Json& needs);
/// Returns how many of them are missing.
int64_t missingOf(const Json& needs);

}  // namespace tomales
