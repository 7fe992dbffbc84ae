// Private to the hider: lists of samples, and the stack that they live on.
#pragma once
#include "reyes/base/simd.h"

namespace tomales {

/// Arrays that a vector may write to beyond `count`. All are `stride` apart, so that a few registers can address the
/// arrays of four lists.
struct SampleList {
  enum Array : size_t {
    kX,
    kY,
    kLane,  ///< Index in SampleBuffer.
    kT,     ///< Fraction between two motion keys.
    kLensX,
    kLensY,
    kArrays
  };
  uint32_t* first;
  size_t stride;
  size_t count = 0;

  uint32_t* array(Array a) const { return first + a * stride; }
};

class SampleListStack {
 public:
  /// Returns the thread's stack, which keeps its memory from grid to grid. It has room for `depth` lists of at most
  /// `most` samples.
  static SampleListStack& ofThread(size_t depth, size_t most) {
    static thread_local SampleListStack stack;
    const size_t size = depth * SampleList::kArrays * strideOf(most);
    if (stack.memory_.size() < size) stack.memory_.resize(size);
    return stack;
  }

  SampleList push(size_t most) {
    const SampleList list{memory_.data() + used_, strideOf(most)};
    used_ += SampleList::kArrays * list.stride;
    return list;
  }
  /// Removes the last `lists` lists of this size.
  void pop(size_t most, size_t lists = 1) { used_ -= lists * SampleList::kArrays * strideOf(most); }

 private:
  static size_t strideOf(size_t most) {
    return most + 2 * static_cast<size_t>(kLanes) - most % static_cast<size_t>(kLanes);
  }

  UnsetVector<uint32_t> memory_;  ///< Little of it is touched, because lists soon get short.
  size_t used_ = 0;
};

}  // namespace tomales
