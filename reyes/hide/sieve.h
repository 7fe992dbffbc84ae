// Lists of samples, and the stack that they live on. Private to the hider.
#pragma once
#include "reyes/base/simd.h"

namespace tomales {

/// Arrays that a vector may be written to beyond `count`; all are `stride` apart, so that few registers tell
/// where those of four lists are.
struct SampleList {
  enum Array : size_t {
    kX,
    kY,
    kLane,  ///< In SampleBuffer.
    kT,     ///< Fraction of the way between two motion keys.
    kLensX,
    kLensY,
    kArrays
  };
  uint32_t* first;
  size_t stride;
  size_t count = 0;

  uint32_t* array(Array a) const { return first + a * stride; }
};

class SieveStack {
 public:
  /// Keeps what it has from grid to grid. Before a descent: room for `depth` lists of at most `most` samples.
  static SieveStack& ofThread(size_t depth, size_t most) {
    static thread_local SieveStack stack;
    const size_t size = depth * SampleList::kArrays * strideOf(most);
    if (stack.memory_.size() < size) stack.memory_.resize(size);
    return stack;
  }

  SampleList push(size_t most) {
    const SampleList list{memory_.data() + used_, strideOf(most)};
    used_ += SampleList::kArrays * list.stride;
    return list;
  }
  /// The last `lists` of the same size.
  void pop(size_t most, size_t lists = 1) { used_ -= lists * SampleList::kArrays * strideOf(most); }

 private:
  static size_t strideOf(size_t most) {
    return most + 2 * static_cast<size_t>(kLanes) - most % static_cast<size_t>(kLanes);
  }

  UnsetVector<uint32_t> memory_;  ///< Of which little is touched: lists get short.
  size_t used_ = 0;
};

}  // namespace tomales
