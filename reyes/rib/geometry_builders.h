// Private to reyes/rib: the builders of shapes that are too long for build_geometry.cpp.
#pragma once
#include "reyes/rib/graphics_state.h"

namespace tomales::rib {

/// Tells "periodic" from "nonperiodic". Any other word counts as nonperiodic, and is added to `problems`.
bool isPeriodic(const std::string& wrap, Problems& problems);
PrimPtr nuPatch(const Request& request, const Scope& scope, Problems& problems);
PrimPtr points(const Request& request, const Scope& scope, Problems& problems);
PrimPtr curves(const Request& request, const Scope& scope, Problems& problems);
/// `first` is the shape at the first key of motion, unless this is that shape.
PrimPtr blobby(const Request& request, const Prim* first, const GroundReader& grounds, Problems& problems);
/// Tells whether the request is a Blobby with a ground, which lies elsewhere in object space for each instance.
bool hasGround(const Request& request);
/// Turns Points of type "blobby" into a Blobby; returns nothing for others. Throws PrimError.
std::optional<Request> blobbyOfPoints(const Request& request);
/// Adds keys, with their times, between the keys of a moving Blobby, or of moving Points of that type
/// (docs/decisions/0171).
void addKeysOfBlobby(std::vector<Request>& keys, std::vector<float>& times);
PrimPtr volumeBox(const Request& request, const Scope& scope, Problems& problems);
PrimPtr brickMap(const Request& request, const Scope& scope, Problems& problems);

}  // namespace tomales::rib
