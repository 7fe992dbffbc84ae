// State that the pages of a shot share: which of them may edit, and whether the shot is prepared.
#pragma once
#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <optional>

#include "reyes/app/relight/edit_state.h"

namespace tomales {

/// The page that edits, by the number that it chose for itself; all others watch. Threads: any.
class Editor {
 public:
  /// Tells whether this page may edit: it does already, it takes over, or nobody does. Page 0 has no number.
  bool admits(uint64_t page, bool takesOver) {
    uint64_t nobody = 0;
    if (takesOver)
      page_ = page;
    else
      page_.compare_exchange_strong(nobody, page);
    return page_ == page;
  }
  /// Lets another page edit. Returns true if this one has edited until now.
  bool leave(uint64_t page) { return page_.compare_exchange_strong(page, 0); }
  uint64_t page() const { return page_; }

 private:
  std::atomic<uint64_t> page_{0};
};

/// Makes requests of pages wait until the shot is prepared. Threads: any.
class Gate {
 public:
  /// Ends the wait. `good`: the shot can be shown; otherwise pass() throws BadRequest.
  void open(bool good) {
    const std::lock_guard lock(mutex_);
    good_ = good;
    changed_.notify_all();
  }
  bool isOpen() const {
    const std::lock_guard lock(mutex_);
    return good_.has_value();
  }
  void pass() const {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return good_.has_value(); });
    if (!*good_) throw BadRequest("the shot cannot be shown: the terminal says why");
  }

 private:
  mutable std::mutex mutex_;
  mutable std::condition_variable changed_;
  std::optional<bool> good_;
};

}  // namespace tomales
