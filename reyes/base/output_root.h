// The folder below which a scene may write: --output-root of the command line (docs/security.md).
#pragma once
#include <string>

namespace tomales {

/// Returns the path of a file that a scene calls `name`: below `root`, where its folder is made. An empty root leaves
/// the name as it is. Throws WriteError if it would lie outside, by "..", an absolute name or a link.
std::string placeBelow(const std::string& root, const std::string& name);

}  // namespace tomales
