// Private to reyes/rib: what a shape is made of, as a number.
#pragma once
#include "reyes/rib/graphics_state.h"

namespace tomales::rib {

/// The same for requests that say the same, wherever they are written.
uint64_t contentsOf(const std::vector<const Request*>& keys, const std::vector<float>& times, const Scope& scope);

}  // namespace tomales::rib
