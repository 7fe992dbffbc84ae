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
  std::string dump;                      ///< A stage of RslFile::dump(); empty for none.
  bool quiet = false;                    ///< If true, no warnings are printed.
  /// Folders whose plugins have functions that shaders may call, separated by colons.
  std::string shaderFolders;
};

RslSettings rslSettings(const std::vector<std::string>& folders, const std::vector<std::string>& definitions);

/// Messages go to standard error. Returns exit code kUnreadable if a file has errors, and kIncomplete if one calls
/// functions that do not exist.
int compileCommand(const CompileCommand& command);

}  // namespace tomales
