// What the program returns.
#pragma once
#include "reyes/base/log.h"

namespace tomales {

enum ExitCode { kDone = 0, kUsage = 1, kUnreadable = 2, kIncomplete = 3, kUnwritable = 4 };

/// The exit code that a log stands for.
ExitCode exitCodeOf(const Log& log);

}  // namespace tomales
