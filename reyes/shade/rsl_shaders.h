// Finds, compiles and keeps the .sl shaders that a scene names, in the folders where it looks for shaders. Threads:
// any.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "reyes/rsl.h"
#include "reyes/shade/function_plugins.h"

namespace tomales {

/// Returns the name without the extension of a source (.sl) or of a shader that another renderer has compiled (.slo).
std::string withoutShaderEnding(const std::string& name);

/// The result of looking for a name.
struct RslFound {
  const TmShader* shader = nullptr;
  const TmShader* displacement = nullptr;  ///< RslFile::displacementOf()
  std::string file;                        ///< The file that has, or should have, the shader; empty if there is none.
  std::string problem;                     ///< Why there is no shader; empty if there is one, or no file.
  std::string remark;                      ///< A further note for the user.
};

/// `name` is as in RIB: a name of a compiled shader (.slo, .sdr, .slx, ...) stands for the .sl beside it. The file is
/// NAME.sl in the folders, in their order, or else a .sl file there that holds that shader. #include looks there too. A
/// file is compiled once for the process, and again when it or a file that it includes has changed. The shader may call
/// `functions`, which come from plugins.
RslFound findRslShader(const std::string& name, TmKind kind, const std::vector<std::string>& folders,
                       const FunctionsOfFolders& functions);

/// Returns the file and all that it includes, if findRslShader() has compiled it in its present state; otherwise
/// nothing.
std::vector<std::string> filesOfRslFile(const std::string& file);

/// A name, and the folders where it is looked for.
struct RslRequest {
  std::string name;
  std::vector<std::string> folders;
};
/// Compiles, on all threads, the files that findRslShader() will try first for these names, so that it finds them
/// compiled. It reports nothing, so that findRslShader() reports problems in the order of its calls.
void compileRslShaders(const std::vector<RslRequest>& requests, const FunctionsOfFolders& functions);

}  // namespace tomales
