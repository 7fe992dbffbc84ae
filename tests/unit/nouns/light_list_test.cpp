#include "reyes/light_list.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "reyes/base/rng.h"
#include "reyes/state_fields.h"

namespace tomales {
namespace {

std::vector<int> numbers(const LightList& list) { return {list.begin(), list.end()}; }

LightList upTo(int count) {
  LightList out;
  for (int light = 0; light < count; ++light) out.switchOn(light);
  return out;
}

TEST(LightList, IsAVectorThatHoldsEachLightOnce) {
  LightList list;
  std::vector<int> plain;
  for (uint32_t step = 0; step < 5000; ++step) {
    const int light = static_cast<int>(hashCombine(step, 1U) % 12);
    std::erase(plain, light);
    if (hashCombine(step, 2U) % 3 != 0) {
      plain.push_back(light);
      list.switchOn(light);
    } else {
      list.switchOff(light);
    }
    ASSERT_EQ(numbers(list), plain) << step;
    ASSERT_EQ(list.size(), plain.size());
    ASSERT_EQ(list.empty(), plain.empty());
    for (int k = -1; k < 13; ++k)
      ASSERT_EQ(list.contains(k), std::find(plain.begin(), plain.end(), k) != plain.end()) << step;
    LightList again;
    for (const int l : plain) again.switchOn(l);
    ASSERT_EQ(list, again) << "lists of the same lights in the same order are equal, however they came about";
  }
}

TEST(LightList, DiffersByOrder) {
  EXPECT_NE((LightList{0, 1}), (LightList{1, 0}));
  EXPECT_NE((LightList{0, 1}), LightList{0});
  EXPECT_NE((LightList{0, 1} < LightList{1, 0}), (LightList{1, 0} < LightList{0, 1}));
}

TEST(LightList, IsFollowedByThoseThatBeginWithIt) {
  std::vector<LightList> lists;
  for (uint32_t k = 0; k < 300; ++k) {
    LightList list;
    for (uint32_t step = 0; step < hashCombine(k, 3U) % 5; ++step)
      list.switchOn(static_cast<int>(hashCombine(k, step, 4U) % 4));
    lists.push_back(list);
  }
  for (const LightList& a : lists)
    for (const LightList& b : lists) {
      const std::vector<int> x = numbers(a), y = numbers(b);
      const bool begins = x.size() <= y.size() && std::equal(x.begin(), x.end(), y.begin());
      ASSERT_EQ(a.begins(b), begins);
      ASSERT_TRUE(!begins || a <= b);
      for (const LightList& c : lists)
        ASSERT_TRUE(!begins || !(a < c && c < b) || a.begins(c)) << "nothing else comes between";
    }
}

TEST(LightList, KeepsItsOrderAmongOthers) {
  EXPECT_EQ((LightList{7, 8, 2, 3, 4, 0}).among({0, 3, 4, 5, 8}), (LightList{8, 3, 4, 0}));
  EXPECT_EQ((LightList{5, 3, 4}).among({3, 5}), (LightList{5, 3}));
  EXPECT_TRUE((LightList{1, 2}).among({0, 3}).empty());
  EXPECT_TRUE(LightList().among({0, 3}).empty());
}

TEST(LightList, TakesNoMoreRoomForMoreLightsInARow) {
  EXPECT_EQ(pack(upTo(10000)).size(), pack(upTo(1)).size());
  LightList gap = upTo(10000);
  gap.switchOff(5000);
  EXPECT_EQ(pack(gap).size(), pack(LightList{0, 2}).size());
  gap.switchOn(5000);
  gap.switchOff(5000);
  EXPECT_EQ(pack(gap).size(), pack(LightList{0, 2}).size());
}

TEST(LightList, ComesBackFromAFile) {
  const LightList list{4, 5, 6, 1, 9};
  LightList back;
  ASSERT_TRUE(unpack(pack(list), back));
  EXPECT_EQ(back, list);
}

}  // namespace
}  // namespace tomales
