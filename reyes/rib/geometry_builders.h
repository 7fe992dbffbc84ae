// Builders of single requests that the table in build_geometry.cpp names. Private to it.
#pragma once
#include "reyes/rib/graphics_state.h"

namespace tomales::rib {

PrimPtr nuPatch(const Request& request, const Scope& scope, Problems& problems);
PrimPtr points(const Request& request, const Scope& scope, Problems& problems);
PrimPtr curves(const Request& request, const Scope& scope, Problems& problems);

}  // namespace tomales::rib
