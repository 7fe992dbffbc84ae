#include "reyes/base/rng.h"

#include <gtest/gtest.h>

namespace tomales {
namespace {

TEST(Rng, ManyNumbersAtOnceAreThoseOneByOne) {
  std::vector<uint32_t> index, seed;
  for (uint32_t i = 0; i < 100; ++i) {
    index.push_back(i * 0x01000193U);
    seed.push_back(hash32(i / 3));
  }
  std::vector<vec2> pairs(index.size());
  std::vector<float> singles(index.size());
  sobol2(index, seed, pairs);
  sobol1(index, seed, singles);
  for (size_t i = 0; i < index.size(); ++i) {
    EXPECT_EQ(pairs[i], sobol2(index[i], seed[i]));
    EXPECT_EQ(singles[i], sobol1(index[i], seed[i]));
  }
}

}  // namespace
}  // namespace tomales
