// The Make requests of RIB: files for later frames out of pictures that are there.
#pragma once
#include "reyes/rib.h"

namespace tomales {

/// Below `outputRoot`, if it is not empty; pictures are sought there first. What cannot be made is reported with the
/// place of the request.
void performMake(const Request& request, const std::string& outputRoot, Log& log);

}  // namespace tomales
