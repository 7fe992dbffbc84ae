// `tomales denoise`: one picture without noise of two that differ in it alone.
#pragma once
#include <string>

namespace tomales {

struct DenoiseCommand {
  std::string first, second, output;
};

int denoiseCommand(const DenoiseCommand& command);

}  // namespace tomales
