// `tomales compile`: checks shaders in the RenderMan Shading Language, and shows what the compiler makes of them.
#pragma once
#include <string>
#include <vector>

#include "reyes/rsl.h"

namespace tomales {

struct CompileCommand {
  std::vector<std::string> files;
  std::vector<std::string> folders;      ///< -I
  std::vector<std::string> definitions;  ///< -D NAME or NAME=VALUE
  std::string dump;                      ///< A stage of RslFile::dump(); empty: none.
  bool quiet = false;                    ///< No warnings.
};

RslSettings rslSettings(const std::vector<std::string>& folders, const std::vector<std::string>& definitions);

/// Messages go to standard error. The exit code is kUnreadable if a file has errors, kIncomplete if one calls functions
/// that nobody has.
int compileCommand(const CompileCommand& command);

}  // namespace tomales
