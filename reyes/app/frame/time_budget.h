// --time-budget: finds the settings of light with the least error for a given time, as target.h does for a given error.
// docs/decisions/0181
#pragma once
#include "reyes/app/frame/frame_light.h"

namespace tomales {

/// Does what FrameLight::gather() does, with settings of its own choice, so that the frame takes the time that the
/// command line names from FrameJob::elapsed_s() = 0 to its last row. The whole frame is gathered in rounds, each of
/// which tells what the next one may cost; the time left after the last one goes into light samples.
void useTimeBudget(FrameLight& light);

}  // namespace tomales
