// Times two stages that take turns in each thread.
#pragma once
#include <algorithm>
#include <ctime>

#include "reyes/base/stats.h"

namespace tomales {

class TurnsTimer {
 public:
  TurnsTimer(Stats& stats, const char* first, const char* second) : stats_(stats), first_(first), second_(second) {}
  /// Divides its wall and CPU time between the stages, in the ratio of the CPU times that threads spent on each.
  ~TurnsTimer() {
    const double wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    const double cpu = processCpuSeconds() - cpuStart_;
    const double second = cpu > 0 ? std::min(1e-9 * static_cast<double>(second_ns_) / cpu, 1.0) : 0;
    stats_.addStage(first_, wall * (1 - second), cpu * (1 - second));
    stats_.addStage(second_, wall * second, cpu * second);
  }
  TurnsTimer(const TurnsTimer&) = delete;

  /// A thread's turn at the second stage.
  class Turn {
   public:
    explicit Turn(TurnsTimer& timer) : timer_(timer), start_ns_(threadCpu_ns()) {}
    ~Turn() { timer_.second_ns_ += threadCpu_ns() - start_ns_; }
    Turn(const Turn&) = delete;

   private:
    static int64_t threadCpu_ns() {
      timespec t{};
      clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
      return int64_t{1'000'000'000} * t.tv_sec + t.tv_nsec;
    }
    TurnsTimer& timer_;
    const int64_t start_ns_;
  };

 private:
  Stats& stats_;
  const char *const first_, *const second_;
  const std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  const double cpuStart_ = processCpuSeconds();
  Counter second_ns_{0};
};

}  // namespace tomales
