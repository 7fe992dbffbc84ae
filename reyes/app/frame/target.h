// --target-error: finds the settings of light that bring a picture to an error that the user names. Trials in a few
// buckets (trials.h) give the constants of a model (error_model.h).
// docs/decisions/0159
#pragma once
#include "reyes/app/frame/frame_light.h"

namespace tomales {

/// Does what FrameLight::gather() and audit() do, with settings of its own choice. Pre: as for those. The picture is
/// audited at pixels that the trials have not seen, and lit again where the model was wrong. It counts rays and never
/// reads a clock, so the picture is the same bits for any number of threads.
void reachTargetError(FrameLight& light);

/// Returns the seed of the random numbers of trials and audits.
uint32_t seedOfTrials(const RenderSettings& settings);
/// Returns the chosen quality in words, for messages.
std::string wordsFor(const LightQuality& quality);

/// Warns if the error of a picture is larger than was asked, or if the audit cannot tell. `with`: the settings of the
/// picture.
void tellMissed(const AuditReport& report, const QualitySettings& settings, const std::string& with, Log& log);

}  // namespace tomales
