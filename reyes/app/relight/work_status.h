// The work in progress, as a page shows it: its name, and the share that is done. Threads: any.
#pragma once
#include <mutex>
#include <string>

namespace tomales {

class WorkStatus {
 public:
  struct Now {
    std::string doing;  ///< Empty for nothing.
    float done = 0;     ///< From 0 to 1.
  };
  void tell(const std::string& doing, float done) {
    const std::lock_guard lock(mutex_);
    now_ = {doing, done};
  }
  void tell(const std::string& doing) {
    const std::lock_guard lock(mutex_);
    now_.doing = doing;
  }
  Now now() const {
    const std::lock_guard lock(mutex_);
    return now_;
  }

 private:
  mutable std::mutex mutex_;
  Now now_;
};

}  // namespace tomales
