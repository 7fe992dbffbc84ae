// `tomales shadetest --check`: tests whether a shader does what it declares.
#pragma once
#include <string>
#include <vector>

#include "reyes/shader_api.h"

namespace tomales {

/// Returns what a shader does otherwise than it declares or than reyes/shader_api.h asks, each as part of a sentence
/// that begins with the shader; empty if a grid shows nothing of the kind. The shader runs in a child process, since it
/// may crash. Threads: one check at a time.
std::vector<std::string> faultsOf(const TmShader& shader);

}  // namespace tomales
