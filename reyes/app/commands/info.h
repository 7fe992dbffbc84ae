// `tomales info`: the contents of a file.
#pragma once
#include <string>

#include "reyes/base/trust.h"

namespace tomales {

struct InfoCommand {
  std::string file;  ///< A file, or the name of a shader.
  bool json = false;
  Trust trust;
};

/// Prints to standard output, as JSON or as text; returns the exit code.
int infoCommand(const InfoCommand& command);

}  // namespace tomales
