#include "reyes/base/pool.h"

#include <gtest/gtest.h>

namespace tomales {
namespace {

TEST(Pool, WhatItGivesStandsOnCacheLinesAndDoesNotOverlap) {
  Pool pool(1000);
  std::vector<std::pair<uintptr_t, size_t>> taken;
  for (const size_t size : {1, 64, 65, 900, 5000, 3})
    taken.emplace_back(reinterpret_cast<uintptr_t>(pool.take(size)), size);
  std::sort(taken.begin(), taken.end());
  for (size_t i = 0; i < taken.size(); ++i) {
    EXPECT_EQ(taken[i].first % 64, 0U);
    if (i == 0) continue;
    EXPECT_GE(taken[i].first, taken[i - 1].first + taken[i - 1].second);
  }
  EXPECT_GE(pool.bytes(), 6033U);
}

TEST(Pool, SmallThingsShareABlock) {
  Pool pool(4096);
  pool.take(100);
  const size_t before = pool.bytes();
  for (int i = 0; i < 10; ++i) pool.take(100);
  EXPECT_EQ(pool.bytes(), before);
}

TEST(Pool, WhatKeepsItOutlivesItsOwner) {
  bool freed = false;
  std::shared_ptr<PooledVector<float>> kept;
  {
    std::shared_ptr<Pool> pool(new Pool(256), [&](const Pool* p) {
      delete p;
      freed = true;
    });
    kept = std::allocate_shared<PooledVector<float>>(KeepingPool<PooledVector<float>>(pool), 1000, 2.0f, pool.get());
  }
  EXPECT_FALSE(freed);
  EXPECT_EQ((*kept)[999], 2.0f);
  kept.reset();
  EXPECT_TRUE(freed);
}

}  // namespace
}  // namespace tomales
