// The CPU time of processes that have ended, as getrusage(2) and wait4(2) give it.
#pragma once
#include <sys/time.h>

namespace tomales {

inline double secondsOf(const timeval& t) {
  return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
}

}  // namespace tomales
