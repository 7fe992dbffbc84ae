#include "tests/bench/rsl/loops.h"

// Highway wants this order.
// clang-format off
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tests/bench/rsl/by_hand.cpp"
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_AVX3_DL)
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
#include <hwy/contrib/math/math-inl.h>
// clang-format on

#include <cmath>

#include "reyes/shader/noise.h"
#include "tests/bench/rsl/vector_numbers.h"

HWY_BEFORE_NAMESPACE();
namespace tomales::bench {
namespace HWY_NAMESPACE {

#include "tests/bench/rsl/loops/common.h"
#include "tests/bench/rsl/loops/control.h"
#include "tests/bench/rsl/loops/light.h"
#include "tests/bench/rsl/loops/patterns.h"
#include "tests/bench/rsl/loops/table.h"

std::span<const Loop> loops() { return kLoops; }

void diffuse(const Batch& batch, TmConstVec3 N, TmVec3 out) {
  for (int i = 0; i < kPoints; i += kWidth) store(out, i, Points{batch, i}.lit(load(N, i), 1, 0));
}
void specular(const Batch& batch, TmConstVec3 N, TmConstVec3 V, const float* roughness, TmVec3 out) {
  for (int i = 0; i < kPoints; i += kWidth)
    store(out, i, Points{batch, i}.specular(load(N, i), load(V, i), load(roughness, i)));
}
const Services* services() {
  static constexpr Services all{diffuse, specular};
  return &all;
}

}  // namespace HWY_NAMESPACE
}  // namespace tomales::bench
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tomales::bench {

HWY_EXPORT(loops);
HWY_EXPORT(services);
std::span<const Loop> vectorLoops() { return HWY_DYNAMIC_DISPATCH(loops)(); }
const Services& vectorServices() {
  static const Services* const all = HWY_DYNAMIC_DISPATCH(services)();
  return *all;
}

}  // namespace tomales::bench
#endif
