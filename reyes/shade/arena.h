// Scratch memory of one batch: aligned arrays that are all released at once. The thread keeps the memory for its next
// batch.
#pragma once
#include <memory>
#include <vector>

#include "reyes/base/stack_memory.h"
#include "reyes/shader_api.h"

namespace tomales {

class Arena {
 public:
  /// Returns n floats, all zero, on a 64-byte boundary.
  float* floats(int n) {
    const auto size = static_cast<size_t>(padded(n));
    float* const p = memory_.floats(size);
    std::fill_n(p, size, 0.0f);
    return p;
  }
  TmVec3 vec3(int n) {
    float* x = floats(n);
    float* y = floats(n);
    return {x, y, floats(n)};
  }
  uint8_t* bytes(int n) { return reinterpret_cast<uint8_t*>(floats((n + 3) / 4)); }
  void clear() { memory_.restore({}); }

  using Mark = StackMemory::Mark;
  Mark mark() const { return memory_.mark(); }
  void restore(Mark m) { memory_.restore(m); }

 private:
  StackMemory memory_;
};

/// Lends an Arena of this thread while this object lives. Shading nests (a gather ray shades its hit), so a thread has
/// several.
class ArenaLease {
 public:
  ArenaLease() {
    if (spare().empty()) spare().push_back(std::make_unique<Arena>());
    arena_ = std::move(spare().back());
    spare().pop_back();
  }
  ~ArenaLease() {
    arena_->clear();
    spare().push_back(std::move(arena_));
  }
  ArenaLease(const ArenaLease&) = delete;
  Arena& operator*() { return *arena_; }

 private:
  static std::vector<std::unique_ptr<Arena>>& spare() {
    thread_local std::vector<std::unique_ptr<Arena>> arenas;
    return arenas;
  }
  std::unique_ptr<Arena> arena_;
};

}  // namespace tomales
