// Shows the progress of a frame: a bar with the time left on a terminal, else the lines "R90000  NN%" that render farms
// read. Threads: any may call `report`.
#pragma once
#include <chrono>
#include <functional>
#include <mutex>
#include <string>

namespace tomales {

class ProgressMeter {
 public:
  explicit ProgressMeter(bool wanted);
  ~ProgressMeter();
  ProgressMeter(const ProgressMeter&) = delete;

  /// Returns a callback for one stage, whose 0..1 is [begin, end] of the frame.
  std::function<void(float)> stage(float begin, float end);
  void report(float fraction);

 private:
  void showBar(int percent) const;
  const bool wanted_, terminal_;
  const std::chrono::steady_clock::time_point start_;
  std::mutex mutex_;
  int shown_ = -1;
};

}  // namespace tomales
