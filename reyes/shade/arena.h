// Scratch memory of one batch: aligned arrays that are all freed at once and kept for the next batch of the
// thread.
#pragma once
#include <algorithm>
#include <memory>

#include "reyes/base/simd.h"
#include "reyes/shader_api.h"

namespace tomales {

class Arena {
 public:
  /// Returns n floats, all zero, on a 64-byte boundary.
  float* floats(int n) {
    const size_t need = static_cast<size_t>(padded(n));
    if (block_ == blocks_.size() || used_ + need > blocks_[block_].size()) nextBlock(need);
    float* p = blocks_[block_].data() + used_;
    used_ += need;
    std::fill_n(p, need, 0.0f);
    return p;
  }
  TmVec3 vec3(int n) {
    float* x = floats(n);
    float* y = floats(n);
    return {x, y, floats(n)};
  }
  uint8_t* bytes(int n) { return reinterpret_cast<uint8_t*>(floats((n + 3) / 4)); }
  void clear() { block_ = used_ = 0; }

  /// A height of the arena; restore() takes back all memory that was handed out after it.
  struct Mark {
    size_t block, used;
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
    // A block of a smaller earlier batch may be too short; nothing lives in it now.
    if (blocks_[block_].size() < need) blocks_[block_].resize(std::max(need, kBlock));
    used_ = 0;
  }
  static constexpr size_t kBlock = 1 << 16;
  std::vector<AlignedVector<float>> blocks_;
  size_t block_ = 0, used_ = 0;
};

/// An Arena of this thread for as long as it lives. Shading nests (a gather ray shades its hit), so a thread
/// has a stack.
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
