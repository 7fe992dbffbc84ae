#include "reyes/base/packed_normal.h"

#include <gtest/gtest.h>

#include "reyes/base/rng.h"
#include "tests/unit/directions.h"

namespace tomales::test {
namespace {

TEST(PackedNormal, IsOffByLittle) {
  for (uint32_t i = 0; i < 10000; ++i) {
    const vec3 n = anyDirection(i);
    EXPECT_LT(glm::length(unpackNormal(packNormal(n)) - n), 7e-5f);
  }
  for (const vec3& axis : {vec3(1, 0, 0), vec3(0, -1, 0), vec3(0, 0, 1), vec3(0, 0, -1)})
    EXPECT_LT(glm::length(unpackNormal(packNormal(axis)) - axis), 1e-6f);
}

TEST(PackedNormal, OfNothingIsNothing) {
  for (const vec3& none : {vec3(0.0f), vec3(NAN, 0, 1), vec3(INFINITY, 0, 0)})
    EXPECT_EQ(unpackNormal(packNormal(none)), vec3(0.0f));
}

}  // namespace
}  // namespace tomales::test
