// Shows how far a frame is, pass by pass. A terminal gets a bar of the frame with the time left, and the running pass
// with its own share and time; they move every second. Elsewhere, lines "R90000 NN%", which render farms read, give the
// share of the frame, and lines such as "gathering 40 %" the share of a pass. Threads: members may be called from any.
#pragma once
#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

namespace tomales {

/// Hears the name of the running pass and its share, 0..1, from any thread.
using ProgressWatcher = std::function<void(const char* pass, float share)>;

class ProgressMeter {
 public:
  /// `pass` names what is done first, such as "reading". Names of passes must outlive the meter. `watcher` may be
  /// empty; it hears of passes whether they are shown or not.
  ProgressMeter(bool wanted, const char* pass, ProgressWatcher watcher = {});
  ~ProgressMeter();
  ProgressMeter(const ProgressMeter&) = delete;

  /// Begins a pass whose share nobody knows.
  void begin(const char* pass);
  /// Returns a callback for a pass, whose 0..1 is [begin, end] of the frame. The pass begins with the first call.
  std::function<void(float)> pass(const char* name, float begin, float end);
  /// Tells that the frame is done, and its last pass with it.
  void finish();

 private:
  using Clock = std::chrono::steady_clock;
  void report(const char* pass, float share, float frame);
  void enter(const char* pass);
  void tellPass(float share);
  void tellFrame(float share);
  void showBar() const;
  void keepMoving();
  const bool wanted_, terminal_;
  const ProgressWatcher watcher_;
  const Clock::time_point start_;
  std::mutex mutex_;  ///< It guards what follows.
  const char* pass_;
  Clock::time_point passStart_;
  int passPercent_ = -1;  ///< Percentage of the pass that was shown last, or -1 if nothing is known of the pass.
  int percent_ = -1;      ///< Percentage of the frame that was shown last.
  bool done_ = false;
  std::condition_variable wake_;
  std::thread mover_;  ///< It runs on a terminal only.
};

}  // namespace tomales
