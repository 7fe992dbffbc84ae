// A cache of slots that are filled on demand. When together they exceed the budget, the least recently used ones are
// emptied until they are an eighth below it. A value that a caller still holds lives until it is released. Threads:
// any.
#pragma once
#include <algorithm>
#include <atomic>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace tomales {

struct ResidentFigures {
  int64_t lookups = 0, misses = 0, mostBytes = 0;
};

/// T has a member size_t bytes() const.
template <class T>
class ResidentCache {
 public:
  ResidentCache(size_t slots, size_t budget)
      : slots_(slots), budget_(static_cast<int64_t>(std::min(budget, size_t{1} << 62))) {}

  /// Returns the value of slot i. If it is empty, make() makes it, as a shared_ptr<const T>; make() must not ask for
  /// another slot.
  template <class Make>
  std::shared_ptr<const T> get(size_t i, const Make& make) {
    Slot& slot = slots_[i];
    if (auto found = slot.take(clock_.load(std::memory_order_relaxed))) return found;
    Gone gone;  // freed after the lock
    const std::lock_guard building(making_[i % kStripes]);
    if (auto found = slot.take(clock_.load(std::memory_order_relaxed)))
      return found;  // another thread has made it meanwhile
    std::shared_ptr<const T> made = make();
    slot.put(made, clock_++);
    gone = admit(i, made->bytes());
    return made;
  }

  ResidentFigures figures() const {
    const std::lock_guard lock(mutex_);
    ResidentFigures out{0, misses_, mostBytes_};
    for (const Slot& slot : slots_) out.lookups += slot.lookups;
    return out;
  }

 private:
  using Gone = std::vector<std::shared_ptr<const T>>;
  static constexpr size_t kStripes = 64;

  /// A slot has a cache line of its own, because every visit writes to it.
  struct alignas(64) Slot {
    std::shared_ptr<const T> take(int64_t now) {
      const Hold hold(busy);
      if (content) {
        lastUse = now;
        ++lookups;
      }
      return content;
    }
    void put(std::shared_ptr<const T> made, int64_t now) {
      const Hold hold(busy);
      content = std::move(made), lastUse = now, ++lookups;
    }
    std::shared_ptr<const T> clear() {
      const Hold hold(busy);
      return std::exchange(content, nullptr);
    }
    int64_t used() {
      const Hold hold(busy);
      return lastUse;
    }

    struct Hold {
      explicit Hold(std::atomic_flag& f) : flag(f) {
        while (flag.test_and_set(std::memory_order_acquire)) {
        }
      }
      ~Hold() { flag.clear(std::memory_order_release); }
      Hold(const Hold&) = delete;
      std::atomic_flag& flag;
    };
    std::atomic_flag busy;
    std::shared_ptr<const T> content;
    int64_t lastUse = 0, lookups = 0;
  };
  struct Resident {
    size_t slot;
    int64_t bytes;
  };

  /// Adds a slot to the residents, and returns the values that it displaces.
  Gone admit(size_t slot, size_t bytes) {
    Gone gone;
    const std::lock_guard lock(mutex_);
    ++misses_;
    residents_.push_back({slot, static_cast<int64_t>(bytes)});
    bytes_ += residents_.back().bytes;
    if (bytes_ > budget_) {
      std::vector<std::pair<int64_t, Resident>> byAge;  // all but the newest
      for (size_t i = 0; i + 1 < residents_.size(); ++i)
        byAge.emplace_back(slots_[residents_[i].slot].used(), residents_[i]);
      std::sort(byAge.begin(), byAge.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
      residents_ = {residents_.back()};
      for (const auto& [used, r] : byAge) {
        if (bytes_ <= budget_ - budget_ / 8) {
          residents_.push_back(r);
          continue;
        }
        gone.push_back(slots_[r.slot].clear());
        bytes_ -= r.bytes;
      }
    }
    mostBytes_ = std::max(mostBytes_, bytes_);
    return gone;
  }

  std::vector<Slot> slots_;
  std::mutex making_[kStripes];
  const int64_t budget_;
  std::atomic<int64_t> clock_{0};  ///< Number of values made so far: a use after a value was made is younger than that.
  mutable std::mutex mutex_;
  std::vector<Resident> residents_;
  int64_t misses_ = 0, bytes_ = 0, mostBytes_ = 0;
};

}  // namespace tomales
