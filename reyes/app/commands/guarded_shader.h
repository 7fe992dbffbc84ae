// A shader whose arrays are watched while it runs: `tomales shadetest --check`.
// Threads: one shader and one thread at a time.
#pragma once
#include <set>
#include <string>

#include "reyes/shader_api.h"

namespace tomales {

/// Returns a library that has the shader under its own name, and replaces the library of an earlier call. Each batch is
/// shaded twice: first a copy with guarded arrays and some inactive points, where faults are noted, and then the batch
/// itself.
const TmShaderLibrary* guardedLibrary(const TmShader& shader);

/// Returns the faults of the shader of the last guardedLibrary(). Each completes a sentence that begins with its name.
const std::set<std::string>& guardedFaults();
void noteFault(const std::string& fault);

}  // namespace tomales
