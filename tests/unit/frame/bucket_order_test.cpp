#include "reyes/frame/bucket_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <numeric>

namespace tomales {
namespace {

constexpr int kColumns = 7, kRows = 5;

TEST(BucketOrder, VisitsEveryBucketOnceWhateverItsName) {
  std::vector<uint32_t> all(kColumns * kRows);
  std::iota(all.begin(), all.end(), 0u);
  for (const char* name :
       {"horizontal", "vertical", "zigzag-x", "zigzag-y", "spacefill", "spiral", "random", "unknown"}) {
    std::vector<uint32_t> order = bucketOrder(name, kColumns, kRows);
    std::sort(order.begin(), order.end());
    EXPECT_EQ(order, all) << name;
  }
}

TEST(BucketOrder, StartsWhereItsNameSays) {
  EXPECT_EQ(bucketOrder("horizontal", kColumns, kRows)[1], 1u);
  EXPECT_EQ(bucketOrder("vertical", kColumns, kRows)[1], uint32_t{kColumns});
  EXPECT_EQ(bucketOrder("zigzag-x", kColumns, kRows)[kColumns], uint32_t{2 * kColumns - 1});
  EXPECT_EQ(bucketOrder("zigzag-y", kColumns, kRows)[kRows], uint32_t{(kRows - 1) * kColumns + 1});
  EXPECT_EQ(bucketOrder("spiral", kColumns, kRows)[0], uint32_t{2 * kColumns + 3});
}

TEST(BucketOrder, SpacefillGoesFromNeighbourToNeighbour) {
  const std::vector<uint32_t> order = bucketOrder("spacefill", 8, 8);
  for (size_t i = 1; i < order.size(); ++i) {
    const int dx = static_cast<int>(order[i] % 8) - static_cast<int>(order[i - 1] % 8);
    const int dy = static_cast<int>(order[i] / 8) - static_cast<int>(order[i - 1] / 8);
    EXPECT_EQ(std::abs(dx) + std::abs(dy), 1) << i;
  }
}

}  // namespace
}  // namespace tomales
