// The wish that the process ends soon, which SIGTERM makes (reyes/app/watch/interrupt.h). Work that takes long asks for
// it about every tenth of a second. Threads: any.
#pragma once
#include <atomic>

namespace tomales {

const std::atomic<bool>& stopFlag();
inline bool stopRequested() { return stopFlag().load(std::memory_order_relaxed); }
/// Asks for a stop. With `wanted` false it takes the wish back, as tests do.
void requestStop(bool wanted = true);

/// Tells whether there is a flag and it is set. Whoever owns it sets it to have work end.
inline bool isSet(const std::atomic<bool>* cancelled) {
  return cancelled && cancelled->load(std::memory_order_relaxed);
}

/// Thrown by work that leaves nothing of use when it is not finished. It is no std::exception, so that no handler
/// reports it as an error.
struct Stopped {};
inline void throwIfStopped() {
  if (stopRequested()) throw Stopped();
}

}  // namespace tomales
