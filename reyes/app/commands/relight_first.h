// `tomales relight` as the command line offers it: it also takes a RIB.
#pragma once
#include "reyes/app/relight/relight.h"

namespace tomales {

/// Serves the page of a shot. If it is given a RIB, it hides that file's first frame to a shot first.
int relightFirst(RelightCommand command);

}  // namespace tomales
