// Requests that draw nothing because they describe something without extent.
#pragma once
#include "reyes/rib.h"

namespace tomales::rib {

/// Returns the name of the parts that the request lacks ("faces"), or null if it is not empty. Exporters write such
/// requests where an object has vanished, so nothing is missing from the picture.
const char* emptyOf(const Request& r);
/// Tells whether the request is a quadric whose radius, height or sweep is 0.
bool hasNoArea(const Request& r);

/// Interpolates the arguments of a request between two keys. Pre: both have the same number of values.
Request between(Request a, const Request& b, float t);

/// Returns the keys of a motion block with an extent at each, if there is one at any. An object that grows from nothing
/// has no extent at its first key, and so no normals there. Such a key is moved a millionth of the way towards the
/// nearest key at which the object has an extent.
std::vector<Request> grown(std::vector<Request> keys);

}  // namespace tomales::rib
