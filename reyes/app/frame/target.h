// --target-error and --time-budget: finds the settings of light that bring a picture to an error that the user names,
// or to the least error for the time. Trials in a few buckets (trials.h) give the constants of a model (error_model.h).
// docs/decisions/0159
#pragma once
#include "reyes/app/frame/frame_job.h"

namespace tomales {

/// Does what FrameJob::gather() and audit() do, with settings of its own choice. Pre: as for those. The picture is
/// audited at pixels that the trials have not seen, and lit again where the model was wrong. It counts rays and never
/// reads a clock, so the picture is the same bits for any number of threads.
void reachTargetError(FrameJob& job, const DeepFrame& layout, const TileReader& tiles, const RenderSettings& settings,
                      Stats& stats, Log& log);

/// The same for the time that the frame may take from job.elapsed_s() = 0 to its last row. What is left after gathering
/// goes into light samples.
void useTimeBudget(FrameJob& job, const DeepFrame& layout, const TileReader& tiles, const RenderSettings& settings,
                   Stats& stats, Log& log);

/// Warns where a picture errs more than was asked, or where nobody can tell. `with`: the settings that it has.
void tellMissed(const AuditReport& report, const RenderSettings& settings, const std::string& with, Log& log);

}  // namespace tomales
