#include "reyes/base/block_vector.h"

#include <gtest/gtest.h>

namespace tomales {
namespace {

TEST(BlockVector, KeepsItsElementsInOrderAndWhereTheyAre) {
  BlockVector<int> v;
  EXPECT_TRUE(v.empty());
  v.push_back(0);
  const int* first = &v[0];
  for (int i = 1; i < 5000; ++i) v.push_back(i);
  EXPECT_EQ(&v[0], first);
  EXPECT_EQ(v.size(), 5000u);
  EXPECT_EQ(v.back(), 4999);
  int expected = 0;
  for (const int i : v) EXPECT_EQ(i, expected++);
  EXPECT_EQ(expected, 5000);
}

}  // namespace
}  // namespace tomales
