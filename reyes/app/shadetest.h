// `tomales shadetest`: one shader over a grid, without a scene.
#pragma once
#include <array>
#include <string>

namespace tomales {

struct ShadetestCommand {
  std::string shader;               ///< A name, or a plugin file whose first shader is meant.
  std::array<int, 2> grid{64, 64};  ///< Points along u and v.
  std::string output;               ///< Picture of Ci; empty: none.
};

/// Says how long a point takes and what comes out.
int shadetestCommand(const ShadetestCommand& command);

}  // namespace tomales
