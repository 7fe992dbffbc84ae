// The arithmetic of compiled shaders: one function for each kernel instruction, over blocks of points. Every CPU gives
// the same bits, since the code has no contraction and calls no C library function whose bits differ between machines;
// it has its own polynomials. Threads: kernels keep no state.
#pragma once
#include <cstdint>

#include "reyes/rsl/ops.h"

namespace tomales::compiler {

/// The number of points of a block. A register of one value for the whole batch holds it kBlock times.
constexpr int kBlock = 16;

/// A register as a kernel sees it: component c of point b * kBlock + k is data[c * component + b * block + k].
struct Lanes {
  float* data = nullptr;
  int32_t block = 0;      ///< kBlock, or 0 if all blocks are the same.
  int32_t component = 0;  ///< 0 if one number stands for every component.
};

/// Reads the inputs `in` of the signature and writes `out`, for `blocks` blocks. If the instruction is componentwise,
/// `out` may be the memory of an input; otherwise they must not overlap. A componentwise kernel computes one component:
/// the machine calls it for each. Component 4 * row + column of a matrix is the number in that row and column. An index
/// that is NaN counts as 0. Noise and functions built of arithmetic alone have the bits of reyes/shader's functions of
/// one point; transcendental functions are within 0.54 ulp (kernels/transcendental.h).
using Kernel = void (*)(int blocks, const Lanes& out, const Lanes* in);

/// Returns null where the table (ops.h) leaves the instruction to the machine.
Kernel kernelOf(Op op);

}  // namespace tomales::compiler
