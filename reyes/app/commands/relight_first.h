// `tomales relight` as the command line has it: it takes a RIB too.
#pragma once
#include "reyes/app/relight/relight.h"

namespace tomales {

/// Serves the page of a shot; of a RIB it hides the first frame before.
int relightFirst(RelightCommand command);

}  // namespace tomales
