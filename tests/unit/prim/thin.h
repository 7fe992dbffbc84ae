// Shared by the tests of curves and of points: wiggling lines, widths, and an eye that they turn to.
#pragma once
#include "tests/unit/prim/support.h"

namespace tomales::test {

inline const vec3 kEye(0.3f, 0.4f, -10);

inline float noise(uint32_t i) { return 2 * unitFloat(hash32(i + 4321)) - 1; }

inline std::vector<float> wiggle(int n) {
  std::vector<float> p;
  for (int i = 0; i < n; ++i)
    for (int axis = 0; axis < 3; ++axis)
      p.push_back((axis == 0 ? i : 0) + noise(static_cast<uint32_t>(3 * i + axis)) * 0.6f);
  return p;
}

inline Param width(Storage storage, std::vector<float> values) {
  return floats(storage == Storage::Constant ? "constantwidth" : "width", storage, ValueType::Float, std::move(values));
}

inline PrimPtr seen(const PrimPtr& prim) { return prim->facing(kEye, {0, 0, 1}, true); }

}  // namespace tomales::test
