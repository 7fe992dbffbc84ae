// `tomales shadetest --check`: does a shader what it declares?
#pragma once
#include <string>
#include <vector>

#include "reyes/shader_api.h"

namespace tomales {

/// What a shader does otherwise than it declares or than reyes/shader_api.h asks, each a part of a sentence that begins
/// with the shader; empty: nothing that a grid can tell. The shader is run in a child process, since it may crash.
/// Threads: one check at a time.
std::vector<std::string> faultsOf(const TmShader& shader);

}  // namespace tomales
