// `tomales shadetest`: runs one shader over a grid, without a scene.
#pragma once
#include <array>
#include <string>
#include <vector>

namespace tomales {

struct ShadetestCommand {
  std::string shader;                   ///< A name, or a plugin or .sl file, whose first shader is used.
  std::vector<std::string> parameters;  ///< NAME=VALUE, where a value is numbers between commas, or a text.
  std::vector<std::string> folders;     ///< Folders of #include.
  std::string shaderFolders;            ///< Folders of trusted plugins besides the working folder, between colons.
  bool watch = false;                   ///< Run again whenever the .sl file, or one that it includes, has changed.
  std::array<int, 2> grid{64, 64};      ///< Points along u and v.
  std::string output;                   ///< Picture of Ci; empty for none.
  bool check = false;  ///< Check instead that the shader, or each one of the file, does what it declares.
};

/// Prints the time for each point and the result. With `check` it prints instead where a shader does not do what it
/// declares; such a fault gives exit code 3.
int shadetestCommand(const ShadetestCommand& command);

}  // namespace tomales
