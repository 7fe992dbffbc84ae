// `tomales denoise`: makes a picture without noise from two pictures that differ in their noise alone.
#pragma once
#include <string>

namespace tomales {

struct DenoiseCommand {
  std::string first, second, output;
};

int denoiseCommand(const DenoiseCommand& command);

}  // namespace tomales
