// `tomales shadetest --check`: tests whether a shader does what it declares.
#pragma once
#include <string>
#include <vector>

#include "reyes/shader_api.h"

namespace tomales {

/// Returns the faults of a shader that show on a grid: where it does not do what it declares or what reyes/shader_api.h
/// asks. Each fault completes a sentence that begins with the shader's name. The shader runs in a child process, since
/// it may crash. Threads: one check at a time.
std::vector<std::string> faultsOf(const TmShader& shader);

}  // namespace tomales
