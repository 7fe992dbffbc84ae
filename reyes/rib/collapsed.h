// Requests that draw nothing because what they describe has no extent.
#pragma once
#include "reyes/rib.h"

namespace tomales::rib {

/// Writers leave these where an object has vanished: nothing is missing from the picture.
/// What it has none of ("faces"); null: it has some.
const char* emptyOf(const Request& r);
/// A quadric whose radius, height or sweep is 0.
bool hasNoArea(const Request& r);

/// The keys of a motion block. Those at which an object has no extent, while it has at others, lie a
/// millionth of the way towards the nearest of these: it grows from nothing, and has no normals there.
std::vector<Request> grown(std::vector<Request> keys);

}  // namespace tomales::rib
