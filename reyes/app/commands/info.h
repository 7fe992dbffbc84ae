// `tomales info` and `tomales compare`: what is in a file, and how far apart two pictures are.
#pragma once
#include <string>

#include "reyes/base/trust.h"

namespace tomales {

struct InfoCommand {
  std::string file;  ///< Or the name of a shader.
  bool json = false;
  Trust trust;
};

/// Prints to standard output, as JSON or as text; returns the exit code.
int infoCommand(const InfoCommand& command);
int compareCommand(const std::string& test, const std::string& reference, const std::string& differenceFile, bool json);

}  // namespace tomales
