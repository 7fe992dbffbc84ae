// Reduces the angles of a block for sines and cosines. Angles that are too large for the fast way are reduced one by
// one.
#pragma once
#include "reyes/rsl/kernels/points.h"
#include "reyes/rsl/kernels/transcendental.h"

namespace tomales::compiler::kernels {

struct Angles {
  double rest[kBlock];
  uint64_t quarters[kBlock];

  RSL_INLINE explicit Angles(const float* x) {
    uint32_t far = 0;
    RSL_LANES for (int k = 0; k < kBlock; ++k) {
      const Angle a = angleOf(x[k]);
      rest[k] = a.rest;
      quarters[k] = a.quarters;
      far |= std::abs(x[k]) < kFar ? 0u : 1u;
    }
    if (far) takeFar(x);
  }
  RSL_INLINE Angle operator[](int k) const { return {rest[k], quarters[k]}; }

 private:
  void takeFar(const float* x);
};

}  // namespace tomales::compiler::kernels
