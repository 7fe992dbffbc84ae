// `tomales list`: what is built into the program.
#pragma once
#include <string>
#include <vector>

namespace tomales {

/// Returns the kinds of things that can be listed.
std::vector<std::string> listedKinds();
/// Pre: `kind` is one of listedKinds(). Prints to standard output, as JSON or as text; returns the exit code.
int listCommand(const std::string& kind, bool json);

}  // namespace tomales
