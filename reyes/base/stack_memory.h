// Memory that is given back in the reverse order of handing it out, for shaders that run other shaders. It does not
// shrink. Threads: plain object.
#pragma once
#include <algorithm>
#include <deque>

#include "reyes/base/simd.h"

namespace tomales {

class StackMemory {
 public:
  /// Returns memory on a 64-byte boundary, which may hold any values.
  float* floats(size_t n) {
    const size_t need = (n + kLanes - 1) / kLanes * kLanes;
    if (block_ == blocks_.size() || used_ + need > blocks_[block_].size()) nextBlock(need);
    float* const p = blocks_[block_].data() + used_;
    used_ += need;
    return p;
  }

  /// A height of the stack; restore() takes back all memory that was handed out after it.
  struct Mark {
    size_t block = 0, used = 0;
  };
  Mark mark() const { return {block_, used_}; }
  void restore(Mark m) {
    block_ = m.block;
    used_ = m.used;
  }

 private:
  void nextBlock(size_t need) {
    if (block_ < blocks_.size()) ++block_;
    if (block_ == blocks_.size()) blocks_.emplace_back();
    // A block that was used for less may be too short; nothing lives in it now.
    if (blocks_[block_].size() < need) blocks_[block_].resize(std::max(need, kLeast));
    used_ = 0;
  }
  static constexpr size_t kLeast = 1 << 16;
  std::deque<UnsetVector<float>> blocks_;
  size_t block_ = 0, used_ = 0;
};

}  // namespace tomales
