// A request that work ends soon. Long work checks for it about every tenth of a second. SIGTERM makes the request for
// the whole process (reyes/app/watch/interrupt.h). Threads: any.
#pragma once
#include <atomic>

namespace tomales {

/// What work checks. A default-constructed token never asks for a stop.
class StopToken {
 public:
  StopToken() = default;
  /// The owner of the flag sets it to stop the work. The flag must outlive the token.
  StopToken(const std::atomic<bool>& flag) : flag_(&flag) {}
  StopToken(const std::atomic<bool>&&) = delete;
  /// What was written before the flag was set can be read once this is true.
  bool requested() const { return flag_ && flag_->load(std::memory_order_acquire); }

 private:
  const std::atomic<bool>* flag_ = nullptr;
};

/// Returns the token of the whole process.
StopToken processStop();
inline bool stopRequested() { return processStop().requested(); }
/// Asks the process to stop. With `wanted` false it takes the request back, for tests.
void requestStop(bool wanted = true);

/// Thrown by work that leaves nothing of use when it is not finished. It is no std::exception, so that no handler
/// reports it as an error.
struct Stopped {};
inline void throwIfStopped() {
  if (stopRequested()) throw Stopped();
}

}  // namespace tomales
