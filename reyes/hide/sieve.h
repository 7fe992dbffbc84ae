// Lists of samples, and the stack that they live on. Private to the hider.
#pragma once
#include "reyes/base/simd.h"

namespace tomales {

/// Arrays that a vector may be written to beyond `count`.
struct SampleList {
  float *x, *y, *t, *lensX, *lensY;  ///< t: fraction of the way between two motion keys.
  uint32_t* lane;                    ///< In SampleBuffer.
  size_t count = 0;
};

class SieveStack {
 public:
  /// Keeps what it has from grid to grid. Before a descent: room for `depth` lists of at most `most` samples.
  static SieveStack& ofThread(size_t depth, size_t most) {
    static thread_local SieveStack stack;
    const size_t size = depth * sizeOf(most);
    if (stack.lanes_.size() < size) stack.floats_.resize(5 * size), stack.lanes_.resize(size);
    return stack;
  }

  SampleList push(size_t most) {
    const size_t size = sizeOf(most);
    float* f = floats_.data() + 5 * used_;
    const SampleList list{f, f + size, f + 2 * size, f + 3 * size, f + 4 * size, lanes_.data() + used_};
    used_ += size;
    return list;
  }
  void pop(size_t most) { used_ -= sizeOf(most); }

 private:
  static size_t sizeOf(size_t most) { return most + 2 * static_cast<size_t>(kLanes) - most % static_cast<size_t>(kLanes); }

  AlignedVector<float> floats_;
  AlignedVector<uint32_t> lanes_;
  size_t used_ = 0;
};

}  // namespace tomales
