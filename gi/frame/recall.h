// Private to gi: answers that an earlier run has left for a frame that is shaded again (RayAnswers). Space: current.
// Irradiance: E/pi.
#pragma once
#include "gi/frame/record_lookup.h"

namespace tomales {

/// Does the same as lookUp(), but without the cache if context.answers, which must not be null, holds an answer for
/// each place.
BatchLookup recallOrLookUp(const GiState&, const PreparedCache&, const GatherPlaces&, const AskedPoints&,
                           const ShadeContext&);

/// Gathers at a point that no record serves, or takes the recorded answer if `answers` has one.
IndirectAnswer gatherOrRecall(const GiState&, const GatherPoint&, const GatherSettings&, RayAnswers* answers);

}  // namespace tomales
