// Private to gi: the light that surfaces would still send each other after the last bounce that is followed. Threads:
// pure.
#pragma once
#include "reyes/base/log.h"

namespace tomales {

struct BouncesLeft {
  int bounces = 0;   ///< Number of bounces that are followed.
  double share = 0;  ///< Share of all reflected light that comes later, if it goes on as a geometric series.
  double ratio = 0;  ///< Light of a bounce over that of the one before; less than 1.
};

/// Continues a series of bounces. `reflected` is their sum and `last` the last of them.
BouncesLeft bouncesLeft(int bounces, double reflected, double last, double ratio);

/// Reports under `code` how much is left, and how many bounces would leave a hundredth. It is a warning unless the user
/// has asked for this number of bounces.
void tellBouncesLeft(const BouncesLeft& left, bool isAsked, const char* code, const SourceLoc& where, Log& log);

}  // namespace tomales
