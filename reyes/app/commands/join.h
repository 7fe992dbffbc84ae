// `tomales join`: tiles of one frame to one file.
#pragma once
#include <array>
#include <optional>
#include <string>
#include <vector>

namespace tomales {

struct JoinCommand {
  std::vector<std::string> tiles;
  std::string output;
  std::optional<std::array<float, 4>> crop;  ///< The window of the frame; if not given, all of it.
};
int joinCommand(const JoinCommand& command);

}  // namespace tomales
