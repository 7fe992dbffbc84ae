// What a process must still undo when it ends without a return from main(): files that nobody will finish, child
// processes that nobody will wait for. Threads: any.
#pragma once
#include <functional>
#include <list>

namespace tomales {

/// While this object lives, endAbruptly() calls `undo`, which must not wait for other threads.
class AtAbruptEnd {
 public:
  explicit AtAbruptEnd(std::function<void()> undo);
  ~AtAbruptEnd();
  AtAbruptEnd(const AtAbruptEnd&) = delete;
  AtAbruptEnd& operator=(const AtAbruptEnd&) = delete;

 private:
  std::list<std::function<void()>>::iterator place_;
};

/// Undoes everything, the last first, and ends the process at once. It takes a lock: not for signal handlers.
[[noreturn]] void endAbruptly(int exitCode);

}  // namespace tomales
