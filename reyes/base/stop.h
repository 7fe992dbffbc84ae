// The wish that work ends soon. Work that takes long looks at it about every tenth of a second. SIGTERM makes the wish
// for the whole process (reyes/app/watch/interrupt.h). Threads: any.
#pragma once
#include <atomic>

namespace tomales {

/// What work looks at. One that was made of nothing never asks for a stop.
class StopToken {
 public:
  StopToken() = default;
  /// Whoever owns the flag sets it to have the work end. It must outlive the token.
  StopToken(const std::atomic<bool>& flag) : flag_(&flag) {}
  StopToken(const std::atomic<bool>&&) = delete;
  /// What was written before the flag was set can be read once this is true.
  bool requested() const { return flag_ && flag_->load(std::memory_order_acquire); }

 private:
  const std::atomic<bool>* flag_ = nullptr;
};

/// The wish that the process ends.
StopToken processStop();
inline bool stopRequested() { return processStop().requested(); }
/// Asks for a stop of the process. With `wanted` false it takes the wish back, as tests do.
void requestStop(bool wanted = true);

/// Thrown by work that leaves nothing of use when it is not finished. It is no std::exception, so that no handler
/// reports it as an error.
struct Stopped {};
inline void throwIfStopped() {
  if (stopRequested()) throw Stopped();
}

}  // namespace tomales
