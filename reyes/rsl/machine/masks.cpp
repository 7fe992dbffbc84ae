#include "reyes/rsl/machine/masks.h"

namespace tomales::compiler {

TOMALES_HOT bool begin(int n, int count, const uint8_t* active, uint8_t* on) {
  uint8_t some = 0;
#pragma GCC ivdep
  for (int i = 0; i < count; ++i) {
    on[i] = active[i] != 0;
    some |= on[i];
  }
  std::fill(on + count, on + n, uint8_t{0});
  return some != 0;
}

TOMALES_HOT bool narrow(int n, const uint8_t* outer, const float* condition, uint8_t* inner, uint8_t* other,
                        bool& anyOther) {
  uint8_t some = 0, rest = 0;
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) {
    const uint8_t on = outer[i], holds = condition[i] != 0.0f, in = on & holds, out = on & (holds ^ 1);
    inner[i] = in;
    other[i] = out;
    some |= in;
    rest |= out;
  }
  anyOther = rest != 0;
  return some != 0;
}

TOMALES_HOT bool remove(int n, const uint8_t* leaving, uint8_t* from) {
  uint8_t some = 0;
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) {
    from[i] = from[i] & static_cast<uint8_t>(leaving[i] ^ 1);
    some |= from[i];
  }
  return some != 0;
}

TOMALES_HOT bool both(int n, const uint8_t* a, const uint8_t* b, uint8_t* out) {
  uint8_t some = 0;
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) {
    out[i] = static_cast<uint8_t>(a[i] != 0) & static_cast<uint8_t>(b[i] != 0);
    some |= out[i];
  }
  return some != 0;
}

TOMALES_HOT void copyWhere(int n, const uint8_t* on, const float* from, float* to) {
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) to[i] = on[i] ? from[i] : to[i];
}

TOMALES_HOT void fillWhere(int n, const uint8_t* on, float value, float* to) {
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) to[i] = on[i] ? value : to[i];
}

TOMALES_HOT void negate(int n, const float* from, float* to) {
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) to[i] = -from[i];
}

}  // namespace tomales::compiler
