// `tomales compare`: the difference of two pictures.
#pragma once
#include <string>

namespace tomales {

/// Prints the figures to standard output, as JSON or as text, and writes a picture of the difference unless
/// `differenceFile` is empty. Returns the exit code.
int compareCommand(const std::string& test, const std::string& reference, const std::string& differenceFile, bool json);

}  // namespace tomales
