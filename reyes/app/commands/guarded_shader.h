// A shader whose arrays are watched while it runs: `tomales shadetest --check`.
// Threads: one shader and one thread at a time.
#pragma once
#include <set>
#include <string>

#include "reyes/shader_api.h"

namespace tomales {

/// Returns a library with the shader under its own name, and replaces that of an earlier call. Each run is done twice:
/// on a batch with guarded arrays and some inactive points, where faults are noted, and then as it is asked for.
const TmShaderLibrary* guardedLibrary(const TmShader& shader);

/// Returns the faults of the shader of the last guardedLibrary(), each in words that follow its name.
const std::set<std::string>& guardedFaults();
void noteFault(const std::string& fault);

}  // namespace tomales
