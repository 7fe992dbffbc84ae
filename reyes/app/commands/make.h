// The Make requests of RIB, which make files for later frames of existing pictures.
#pragma once
#include "reyes/rib.h"

namespace tomales {

/// Makes the file below `outputRoot`, if that is not empty; pictures are looked for there first. A failure is reported
/// with the place of the request.
void performMake(const Request& request, const std::string& outputRoot, Log& log);

}  // namespace tomales
