// The names of Option (RISpec 3.2 section 4.1), one row each: their types, and what they do.
#pragma once
#include <span>
#include <string_view>

#include "reyes/rib/graphics_state.h"

namespace tomales::rib {

struct NamedOption {
  std::string_view name;  ///< "category:name"
  const char* type;       ///< The type of a value without a declared type, as in Declare.
  bool (*set)(GraphicsState&, const Request&, const Param&);  ///< As setNamedOption().
};

std::span<const NamedOption> namedOptions();

/// Sets the option `name`, "category:name", which Options::user has already. Returns false if it has no effect, or not
/// with this value.
bool setNamedOption(GraphicsState& state, const Request& request, const std::string& name, const Param& value);

}  // namespace tomales::rib
