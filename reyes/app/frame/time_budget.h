// --time-budget: finds the settings of light that bring the least error for a time, as target.h does for an error.
// docs/decisions/0181
#pragma once
#include "reyes/app/frame/frame_light.h"

namespace tomales {

/// Does what FrameLight::gather() does, with settings of its own choice, so that the frame takes the time that the
/// command line names from FrameJob::elapsed_s() = 0 to its last row. The whole frame is gathered in rounds, each of
/// which says what the next one may cost; what is left after the last goes into light samples.
void useTimeBudget(FrameLight& light);

}  // namespace tomales
