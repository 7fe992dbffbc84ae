// `tomales info` and `tomales compare`: what is in a file, and how far apart two pictures are.
#pragma once
#include <string>

namespace tomales {

/// Prints to standard output, as JSON or as text; returns the exit code.
int infoCommand(const std::string& file, bool json);
int compareCommand(const std::string& test, const std::string& reference, const std::string& differenceFile, bool json);

}  // namespace tomales
