#include "reyes/base/block_vector.h"

#include <gtest/gtest.h>

#include "reyes/base/rng.h"
#include "reyes/base/stable_vector.h"

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

TEST(StableVector, IsAVectorWhoseElementsStayWhereTheyAre) {
  // Random steps, each done to a std::vector too.
  StableVector<uint32_t> v;
  std::vector<uint32_t> plain;
  std::vector<const uint32_t*> places;
  const auto expectAlike = [&](const StableVector<uint32_t>& seen) {
    ASSERT_EQ(seen.size(), plain.size());
    EXPECT_EQ(seen.empty(), plain.empty());
    EXPECT_TRUE(std::equal(seen.begin(), seen.end(), plain.begin(), plain.end()));
    EXPECT_THROW(seen.at(plain.size()), std::out_of_range);
    if (plain.empty()) return;
    EXPECT_TRUE(seen.front() == plain.front() && seen.back() == plain.back());
    EXPECT_EQ(seen.at(plain.size() - 1), plain.back());
  };
  for (uint32_t step = 0; step < 400; ++step) {
    const uint32_t what = hashCombine(step, 1) % 20;
    if (what < 16) {
      for (uint32_t i = hashCombine(step, 2) % 40; i > 0; --i) {
        EXPECT_EQ(v.push_back(i), i);
        plain.push_back(i);
        places.push_back(&v.back());
      }
    } else if (what == 16 && step % 3 == 0) {
      v.clear();
      plain.clear();
      places.clear();
    } else if (what == 17 && !plain.empty()) {
      const size_t at = hashCombine(step, 3) % plain.size();
      v[at] = plain[at] = step;
    } else if (what == 18) {
      StableVector<uint32_t> copy = v;
      expectAlike(copy);
      copy.push_back(7);
      copy = copy;  // NOLINT: to oneself
      copy = v;
      expectAlike(copy);
    } else if (what == 19) {
      StableVector<uint32_t> moved = std::move(v);
      expectAlike(moved);
      v = std::move(moved);
    }
    expectAlike(v);
    for (size_t i = 0; i < places.size(); ++i) ASSERT_EQ(&v[i], places[i]);
  }
}

}  // namespace
}  // namespace tomales
