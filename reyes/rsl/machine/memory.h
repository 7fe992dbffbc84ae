// The memory of the shaders that a thread runs. It is a stack, since shaders that trace rays run others, and does not
// shrink. Each thread has one.
#pragma once
#include <deque>
#include <string>

#include "reyes/base/stack_memory.h"

namespace tomales::compiler {

class Memory {
 public:
  static Memory& ofThread() {
    thread_local Memory memory;
    return memory;
  }
  /// Returns memory on a 64-byte boundary, which may hold any values.
  float* floats(size_t n) { return floats_.floats(n); }
  uint8_t* bytes(size_t n) { return reinterpret_cast<uint8_t*>(floats((n + 3) / 4)); }
  /// Makes n empty texts, and returns the index of the first.
  size_t openTexts(size_t n) {
    const size_t first = openTexts_;
    openTexts_ += n;
    if (texts_.size() < openTexts_) texts_.resize(openTexts_);
    for (size_t k = first; k < openTexts_; ++k) texts_[k].clear();
    return first;
  }
  std::string& text(size_t k) { return texts_[k]; }

  /// A height of the stack; restore() takes back all memory that was handed out after it.
  struct Mark {
    StackMemory::Mark floats;
    size_t texts;
  };
  Mark mark() const { return {floats_.mark(), openTexts_}; }
  void restore(Mark m) {
    floats_.restore(m.floats);
    openTexts_ = m.texts;
  }

 private:
  StackMemory floats_;
  size_t openTexts_ = 0;
  std::deque<std::string> texts_;  // references stay valid
};

/// Gives back, at the end of its life, the memory that was handed out during it.
class Borrowed {
 public:
  explicit Borrowed(Memory& memory) : memory_(memory), mark_(memory.mark()) {}
  ~Borrowed() { memory_.restore(mark_); }
  Borrowed(const Borrowed&) = delete;

 private:
  Memory& memory_;
  const Memory::Mark mark_;
};

}  // namespace tomales::compiler
