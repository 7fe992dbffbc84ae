// Where hiding comes to its limits, as warnings: what the buckets of a frame were in doubt about. Private to reyes/frame.
// Threads: add() is concurrent. The warnings depend on buckets, not on threads.
#pragma once
#include <mutex>

#include "reyes/base/log.h"
#include "reyes/hide.h"

namespace tomales {

class HideWarnings {
 public:
  void add(const HideDoubts& ofBucket);
  void report(const Scene& scene, Log& log) const;

 private:
  std::mutex mutex_;
  HideDoubts sum_;
};

}  // namespace tomales
