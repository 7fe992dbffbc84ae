// The values that conditions and ${name} can ask of the graphics state.
#pragma once
#include <optional>
#include <string>

#include "reyes/state.h"

namespace tomales::rib {

/// `name` is "Option:category:name", "Attribute:category:name" or "Frame"; anything else, with or without "user:", is
/// looked up among user attributes, user options and then everything that Attribute and Option have set by
/// "category:name".
std::optional<std::string> findVariable(const Options& options, const Attributes& attributes, const std::string& name);

}  // namespace tomales::rib
