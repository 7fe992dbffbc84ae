// Noun: the light that surfaces would still send each other after the last bounce that is followed.
#pragma once
#include "reyes/base/log.h"

namespace tomales {

struct BouncesLeft {
  double share = 0;  ///< Of all reflected light, as if it went on as a geometric series.
  double ratio = 0;  ///< Of the light of a bounce to that of the one before.
};

/// Reports under `code` how much is left after so many bounces, and how many would leave a hundredth. It is a warning
/// unless the user has asked for this number of bounces.
void tellBouncesLeft(const BouncesLeft& left, int bounces, bool isAsked, const char* code, const SourceLoc& where,
                     Log& log);

}  // namespace tomales
