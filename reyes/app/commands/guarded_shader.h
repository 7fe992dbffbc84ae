// A shader whose arrays are watched while it runs: `tomales shadetest --check`.
// Threads: one shader and one thread at a time.
#pragma once
#include <set>
#include <string>

#include "reyes/shader_api.h"

namespace tomales {

/// A library with the shader under its own name. Each run is done twice: on a batch with guarded arrays some of whose
/// points are not active, whose faults are noted, and as it is asked for. Replaces the one of an earlier call.
const TmShaderLibrary* guardedLibrary(const TmShader& shader);

/// What the shader of the last guardedLibrary() has done that it must not, each in words that follow its name.
const std::set<std::string>& guardedFaults();
void noteFault(const std::string& fault);

}  // namespace tomales
