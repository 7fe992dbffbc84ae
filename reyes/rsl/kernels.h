// The arithmetic of compiled shaders: one function for each kernel instruction, over blocks of points. Every CPU gives
// the same bits: no contraction, no C library function whose bits differ between machines; polynomials of our own.
// Threads: kernels keep no state.
#pragma once
#include <cstdint>

#include "reyes/rsl/ops.h"

namespace tomales::compiler {

/// Points of a block. A register of one value for the whole batch holds it kBlock times.
constexpr int kBlock = 16;

/// A register as a kernel sees it: component c of point b * kBlock + k is data[c * component + b * block + k].
struct Lanes {
  float* data = nullptr;
  int32_t block = 0;      ///< kBlock; 0: the same block for all.
  int32_t component = 0;  ///< 0: one number for every component.
};

/// Reads `in` (as many as the signature says), writes `out` in `blocks` blocks. `out` may be the same memory as an
/// input where the instruction is componentwise, and overlaps none of them elsewhere. A componentwise kernel does one
/// component: the machine calls it for each. Number 4 * row + column of a matrix is its component of that number. An
/// index that is no number counts as 0. Noise and what is built of arithmetic alone have the bits of reyes/shader's
/// functions of one point; transcendental functions are within 0.54 ulp (kernels/transcendental.h).
using Kernel = void (*)(int blocks, const Lanes& out, const Lanes* in);

/// Null where the table (ops.h) says that the machine does it.
Kernel kernelOf(Op op);

}  // namespace tomales::compiler
