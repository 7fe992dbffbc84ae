// Vectors of samples: our names for what the rasterisers use of Highway, which compiles them for several widths and
// picks one when first called. Include it first in a .cpp that defines HWY_TARGET_INCLUDE. No operation here may be
// fused (MulAdd) and no sum may cross lanes, so that all widths give the same bits.

// Each target costs a compilation. Without these, SSE4, AVX2, AVX-512 and, for older CPUs, plain loops remain.
#ifndef HWY_DISABLED_TARGETS
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_AVX3_DL)
#endif
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "reyes/base/simd.h"

// Highway includes this part once for each target.
#if defined(TOMALES_BASE_VECTOR_H) == defined(HWY_TARGET_TOGGLE)
#ifdef TOMALES_BASE_VECTOR_H
#undef TOMALES_BASE_VECTOR_H
#else
#define TOMALES_BASE_VECTOR_H
#endif

HWY_BEFORE_NAMESPACE();
namespace tomales {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

constexpr hn::CappedTag<float, kLanes> kF;
constexpr hn::RebindToUnsigned<decltype(kF)> kU;
using Floats = hn::Vec<decltype(kF)>;
using Mask = hn::Mask<decltype(kF)>;

HWY_INLINE Floats all(float x) { return hn::Set(kF, x); }
HWY_INLINE Floats load(const float* from) { return hn::LoadU(kF, from); }

/// Bit s of the result is lane s.
HWY_INLINE uint64_t bitsOf(Mask mask) {
  uint64_t bits = 0;
  hn::StoreMaskBits(kF, mask, reinterpret_cast<uint8_t*>(&bits));
  return bits;
}

}  // namespace HWY_NAMESPACE
}  // namespace tomales
HWY_AFTER_NAMESPACE();
#endif
