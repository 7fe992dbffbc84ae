// Shows how far a frame is: on a terminal a bar with the time left, and what is being done for how long, which moves
// every second; else the lines "R90000  NN%" that render farms read. Threads: members may be called from any.
#pragma once
#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

namespace tomales {

class ProgressMeter {
 public:
  /// `phase` names what is done first, such as "reading". Names of phases must outlive the meter.
  ProgressMeter(bool wanted, const char* phase);
  ~ProgressMeter();
  ProgressMeter(const ProgressMeter&) = delete;

  void begin(const char* phase);
  /// A callback for one stage, whose 0..1 is [begin, end] of the frame.
  std::function<void(float)> stage(float begin, float end);
  void report(float fraction);

 private:
  using Clock = std::chrono::steady_clock;
  void showBar() const;
  void keepMoving();
  const bool wanted_, terminal_;
  const Clock::time_point start_;
  std::mutex mutex_;  ///< It guards what follows.
  const char* phase_;
  Clock::time_point phaseStart_;
  int percent_ = -1;  ///< The one that was shown last, or -1.
  bool done_ = false;
  std::condition_variable wake_;
  std::thread mover_;  ///< It runs on a terminal only.
};

}  // namespace tomales
