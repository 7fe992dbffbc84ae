#include "reyes/rsl/kernels/angles.h"

namespace tomales::compiler::kernels {

/// Payne and Hanek 1983, "Radian reduction for trigonometric functions": x is a whole number times 2^e. Multiples of
/// four in its product with 2/pi do not matter, so 128 bits of 2/pi suffice, from a place that e determines.
Angle farAngleOf(float x) {
  if (!(std::abs(x) < static_cast<float>(kInfinite))) return {kNone, 0};
  static constexpr uint32_t kTwoOverPi[] = {0,          0xa2f9836e, 0x4e441529, 0xfc2757d1, 0xf534ddc0,
                                            0xdb629599, 0x3c439041, 0xfe5163ab, 0xdebbc561};
  const uint32_t bits = std::bit_cast<uint32_t>(x);
  const uint32_t whole = (bits & 0x7fffff) | 0x800000;
  const int exponent = static_cast<int>(bits >> 23 & 255) - 150;  // -3 to 104, as |x| >= kFar
  unsigned __int128 window = 0;
  for (int k = 0; k < 4; ++k) {
    const int from = 30 + exponent + 32 * k;  // the first bit has weight 2 for a whole number
    const uint64_t pair = uint64_t{kTwoOverPi[from / 32]} << 32 | kTwoOverPi[from / 32 + 1];
    window = window << 32 | static_cast<uint32_t>(pair >> (32 - from % 32));
  }
  const unsigned __int128 product = window * whole;
  const uint64_t quarters = static_cast<uint64_t>((product + (static_cast<unsigned __int128>(1) << 125)) >> 126);
  const double rest =
      kHalfPi * 0x1p-126 *
      static_cast<double>(static_cast<__int128>(product - (static_cast<unsigned __int128>(quarters) << 126)));
  return x < 0 ? Angle{-rest, 0 - quarters} : Angle{rest, quarters};
}

void Angles::takeFar(const float* x) {
  for (int k = 0; k < kBlock; ++k) {
    if (std::abs(x[k]) < kFar) continue;
    const Angle a = farAngleOf(x[k]);
    rest[k] = a.rest;
    quarters[k] = a.quarters;
  }
}

namespace {

template <class Of>
RSL_INLINE void eachAngle(int blocks, const Lanes& out, const Lanes& in, const Of& of) {
  for (int b = 0; b < blocks; ++b) {
    const Angles angles(planeOf(in, b));
    float* result = planeOf(out, b);
    RSL_LANES for (int k = 0; k < kBlock; ++k) result[k] = of(angles[k]);
  }
}

}  // namespace

RSL_KERNEL(Sin) {
  eachAngle(blocks, out, *in, [](Angle a) RSL_INLINED { return sineOf(a); });
}
RSL_KERNEL(Cos) {
  eachAngle(blocks, out, *in, [](Angle a) RSL_INLINED { return cosineOf(a); });
}
RSL_KERNEL(Tan) {
  eachAngle(blocks, out, *in, [](Angle a) RSL_INLINED { return tangentOf(a); });
}
RSL_KERNEL(Exp) {
  each(blocks, out, in, [](float x) RSL_INLINED { return expOf(x); });
}
RSL_KERNEL(Log) {
  each(blocks, out, in, [](float x) RSL_INLINED { return logOf(x); });
}
RSL_KERNEL(Pow) {
  eachByReach(
      blocks, out, in, [](float x, float y) RSL_INLINED { return isPlainPower(x, y); },
      [](float x, float y) RSL_INLINED { return plainPowOf(x, y); },
      [](float x, float y) RSL_INLINED { return powOf(x, y); });
}
RSL_KERNEL(Asin) {
  each(blocks, out, in, [](float x) RSL_INLINED { return asinOf(x); });
}
RSL_KERNEL(Acos) {
  each(blocks, out, in, [](float x) RSL_INLINED { return acosOf(x); });
}
RSL_KERNEL(Atan) {
  each(blocks, out, in, [](float x) RSL_INLINED { return atanOf(x); });
}
RSL_KERNEL(Atan2) {
  each(blocks, out, in, [](float y, float x) RSL_INLINED { return atan2Of(y, x); });
}
RSL_KERNEL(Erf) {
  each(blocks, out, in, [](float x) RSL_INLINED { return erfOf(x); });
}
RSL_KERNEL(Erfc) {
  each(blocks, out, in, [](float x) RSL_INLINED { return erfcOf(x); });
}

}  // namespace tomales::compiler::kernels
