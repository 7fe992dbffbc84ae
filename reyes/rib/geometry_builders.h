// Private to build_geometry.cpp: builders of single requests that it names.
#pragma once
#include "reyes/rib/graphics_state.h"

namespace tomales::rib {

/// Tells "periodic" from "nonperiodic"; anything else counts as nonperiodic, which is a problem.
bool isPeriodic(const std::string& wrap, Problems& problems);
PrimPtr nuPatch(const Request& request, const Scope& scope, Problems& problems);
PrimPtr points(const Request& request, const Scope& scope, Problems& problems);
PrimPtr curves(const Request& request, const Scope& scope, Problems& problems);
/// `first` is the shape at the first key of motion, unless this is that shape.
PrimPtr blobby(const Request& request, const Prim* first, const GroundReader& grounds, Problems& problems);
/// Turns Points of type "blobby" into a Blobby; returns nothing for others. Throws PrimError.
std::optional<Request> blobbyOfPoints(const Request& request);
/// Adds keys, with their times, between those of a Blobby, or of Points of that type, whose leaves move
/// (docs/decisions/0171).
void addKeysOfBlobby(std::vector<Request>& keys, std::vector<float>& times);
PrimPtr volumeBox(const Request& request, const Scope& scope, Problems& problems);
PrimPtr brickMap(const Request& request, const Scope& scope, Problems& problems);

}  // namespace tomales::rib
