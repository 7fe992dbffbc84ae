// Builders of single requests that build_geometry.cpp names. Private to it.
#pragma once
#include "reyes/rib/graphics_state.h"

namespace tomales::rib {

/// Of "periodic" and "nonperiodic"; anything else is taken for the second, which is a problem.
bool isPeriodic(const std::string& wrap, Problems& problems);
PrimPtr nuPatch(const Request& request, const Scope& scope, Problems& problems);
PrimPtr points(const Request& request, const Scope& scope, Problems& problems);
PrimPtr curves(const Request& request, const Scope& scope, Problems& problems);
/// `first`: the shape at the first key of motion, if it is not that itself.
PrimPtr blobby(const Request& request, const Prim* first, const GroundReader& grounds, Problems& problems);
/// Points of type "blobby" as the Blobby that they are; others are none. Throws PrimError.
std::optional<Request> blobbyOfPoints(const Request& request);
PrimPtr brickMap(const Request& request, const Scope& scope, Problems& problems);

}  // namespace tomales::rib
