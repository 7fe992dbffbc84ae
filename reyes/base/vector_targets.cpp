// The two functions that Highway's dispatch needs from its library. They are here because that library calibrates a
// timer when it is loaded, which takes 5 ms of every run (docs/decisions/0011).
#include <hwy/targets.h>

namespace hwy {
namespace {

int64_t targetsOfCpu() {
  int64_t targets = HWY_STATIC_TARGET | HWY_EMU128;
#if HWY_ARCH_X86 && defined(__GNUC__)
  // Features that every processor with the named ones has, such as f16c, are not tested, because Clang has no names for
  // them.
  __builtin_cpu_init();
  const bool sse4 =
      __builtin_cpu_supports("sse4.2") && __builtin_cpu_supports("aes") && __builtin_cpu_supports("pclmul");
  const bool avx2 = sse4 && __builtin_cpu_supports("avx2") && __builtin_cpu_supports("bmi") &&
                    __builtin_cpu_supports("bmi2") && __builtin_cpu_supports("fma");
  const bool avx3 = avx2 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
                    __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw");
  targets |= (sse4 ? HWY_SSE4 : 0) | (avx2 ? HWY_AVX2 : 0) | (avx3 ? HWY_AVX3 : 0);
#endif
  return targets;
}

}  // namespace

int64_t SupportedTargets() {
  static const int64_t targets = targetsOfCpu();
  return targets;
}

ChosenTarget& GetChosenTarget() {
  static ChosenTarget chosen;
  return chosen;
}

}  // namespace hwy
