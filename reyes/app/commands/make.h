// The Make requests of RIB: files for later frames out of pictures that are there.
#pragma once
#include "reyes/rib.h"

namespace tomales {

/// What cannot be made is reported with the place of the request.
void performMake(const Request& request, Log& log);

}  // namespace tomales
