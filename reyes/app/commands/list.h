// `tomales list`: what is built in.
#pragma once
#include <string>
#include <vector>

namespace tomales {

/// What can be listed.
std::vector<std::string> listedKinds();
/// Pre: `kind` is one of them. Prints to standard output, as JSON or as text; returns the exit code.
int listCommand(const std::string& kind, bool json);

}  // namespace tomales
