#include "reyes/app/exit_code.h"

namespace tomales {

ExitCode exitCodeOf(const Log& log) {
  switch (log.worst()) {
    case Severity::Output:
      return kUnwritable;
    case Severity::Error:
      return kUnreadable;
    case Severity::Missing:
      return kIncomplete;
    default:
      return kDone;
  }
}

}  // namespace tomales
