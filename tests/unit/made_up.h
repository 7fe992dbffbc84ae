// Values that RapidCheck makes up for tests of properties.
#pragma once
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "reyes/base/math.h"

namespace tomales::test {

/// Returns a generator of whole numbers from `lo` to end - 1, all equally likely. rc::gen::inRange() alone makes small
/// ones in the first tries. Where a property fails, RapidCheck looks for the failure nearest to `lo`.
template <class T>
rc::Gen<T> wholeIn(T lo, T end) {
  return rc::gen::resize(rc::kNominalSize, rc::gen::inRange(lo, end));
}
/// Returns the same of numbers between two bounds, which are 4096 steps apart.
inline rc::Gen<float> numberIn(float lo, float hi) {
  return rc::gen::map(wholeIn(0, 4097), [=](int step) { return lo + (hi - lo) * static_cast<float>(step) / 4096; });
}

/// Returns a vector that is made up now, within the body of a property.
inline vec3 madeUpVector(float lo, float hi) {
  const rc::Gen<float> number = numberIn(lo, hi);
  const float x = *number, y = *number, z = *number;
  return {x, y, z};
}

}  // namespace tomales::test
