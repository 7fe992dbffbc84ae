// Narrowing the mask of a run, and the loops over it.
#pragma once
#include "reyes/rsl/machine/run.h"

namespace tomales::compiler {

// --- These work on n points (a multiple of kBlock).

/// Sets `on` to 1 where `active` is not 0 among the first `count` points, and to 0 elsewhere. Returns whether any are
/// 1.
bool begin(int n, int count, const uint8_t* active, uint8_t* on);
/// Splits `outer` into `inner`, where `condition` is not 0, and `other`, where it is. `inner` may be `outer`. Returns
/// whether `inner` has any points.
bool narrow(int n, const uint8_t* outer, const float* condition, uint8_t* inner, uint8_t* other, bool& anyOther);
/// Removes the points of `leaving`. Returns whether any remain.
bool remove(int n, const uint8_t* leaving, uint8_t* from);
bool both(int n, const uint8_t* a, const uint8_t* b, uint8_t* out);
void copyWhere(int n, const uint8_t* on, const float* from, float* to);
void fillWhere(int n, const uint8_t* on, float value, float* to);
void negate(int n, const float* from, float* to);

/// A mask within the run's mask, which counts while this object lives. At first it has the same points.
class Narrowed {
 public:
  explicit Narrowed(Run& run, int32_t label = -1)
      : Narrowed(run, run.memory.bytes(static_cast<size_t>(run.padded)), label) {
    std::copy_n(mask_.outer->on, run.padded, mask_.on);
    mask_.any = mask_.outer->any;
    mask_.full = mask_.outer->full;
  }
  /// Narrows to these points, of which there must be some.
  Narrowed(Run& run, uint8_t* on, int32_t label = -1) : run_(run), mask_{on, true, false, run.mask, label} {
    run.mask = &mask_;
  }
  ~Narrowed() { run_.mask = mask_.outer; }
  Narrowed(const Narrowed&) = delete;

 private:
  Run& run_;
  Mask mask_;
};

}  // namespace tomales::compiler
