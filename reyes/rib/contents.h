// Private to reyes/rib: a checksum of the description of a shape.
#pragma once
#include "reyes/rib/graphics_state.h"

namespace tomales::rib {

/// Returns a checksum that is equal for equal requests, wherever they are written.
uint64_t contentsOf(const std::vector<const Request*>& keys, const std::vector<float>& times, const Scope& scope);

}  // namespace tomales::rib
