// `tomales shadetest`: one shader over a grid, without a scene.
#pragma once
#include <array>
#include <string>
#include <vector>

namespace tomales {

struct ShadetestCommand {
  std::string shader;                   ///< A name, or a plugin or .sl file, whose first shader is meant.
  std::vector<std::string> parameters;  ///< NAME=VALUE: numbers between commas, or a text.
  std::vector<std::string> folders;     ///< Of #include.
  bool watch = false;                   ///< Again whenever the .sl, or what it includes, has changed.
  std::array<int, 2> grid{64, 64};      ///< Points along u and v.
  std::string output;                   ///< Picture of Ci; empty: none.
  bool check = false;                   ///< Instead: does the shader, or do all of the file, what they declare?
};

/// Says how long a point takes and what comes out, or (check) what a shader does otherwise than it declares: exit code
/// 3.
int shadetestCommand(const ShadetestCommand& command);

}  // namespace tomales
