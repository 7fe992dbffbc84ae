#include "reyes/shade/light_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "reyes/base/rng.h"

namespace tomales {
namespace {

std::vector<TreeLamp> lampsIn(int count, float radius) {
  std::vector<TreeLamp> out;
  for (int i = 0; i < count; ++i) {
    const auto at = [&](uint32_t k) { return 20 * unitFloat(hashCombine(static_cast<uint32_t>(i), k)) - 10; };
    const vec3 center(at(1), at(2), at(3));
    out.push_back({{center - radius, center + radius}, 0.1f + unitFloat(hashCombine(static_cast<uint32_t>(i), 4U))});
  }
  return out;
}

/// Something that lamps bring of which the tree knows nothing.
double lightOf(const TreeLamp& lamp, uint32_t number) {
  return double{lamp.power} * (1 + std::sin(static_cast<double>(number)));
}

TEST(LightTree, LightOverProbabilityOfDrawnLampsHasTheSumOfAllLampsAsItsMean) {
  const std::vector<TreeLamp> lamps = lampsIn(500, 0);
  const LightTree tree(lamps);
  double all = 0;
  for (uint32_t i = 0; i < lamps.size(); ++i) all += lightOf(lamps[i], i);
  for (const LampReceiver& at : {LampReceiver{{1, 2, 3}, {0, 0, 1}}, LampReceiver{{30, 0, 0}, vec3(0.0f)}}) {
    std::vector<LampCluster> cut;
    tree.cut(at, 20, 1, cut);
    EXPECT_LE(cut.size(), 20U);
    double sum = 0;
    constexpr int kDraws = 1 << 14;
    for (const LampCluster& c : cut)
      for (int d = 0; d < kDraws; ++d) {
        float probability = 0;
        const uint32_t lamp = tree.draw(at, c.node, (d + 0.5) / kDraws, probability);
        EXPECT_NEAR(tree.expected(at, cut, lamp), probability, 1e-5f * probability);
        sum += lightOf(lamps[lamp], lamp) / double{probability} / kDraws;
      }
    EXPECT_NEAR(sum, all, 0.003 * all);
  }
}

TEST(LightTree, ALampThatOutshinesTheOthersIsDrawnForCertainAndHasMoreSamples) {
  std::vector<TreeLamp> lamps = lampsIn(200, 0.01f);
  lamps[77].power = 1000;
  const LightTree tree(lamps);
  const LampReceiver at{lamps[77].bound.center() + vec3(0, 0, 1), {0, 0, -1}};
  std::vector<LampCluster> cut;
  tree.cut(at, 32, 16, cut);
  EXPECT_FLOAT_EQ(tree.expected(at, cut, 77), 16);
  int samples = 0;
  for (const LampCluster& c : cut) samples += c.samples;
  EXPECT_LE(samples, 32);
}

TEST(LightTree, ARayMeetsTheLampsOnItsWayAlone) {
  const std::vector<TreeLamp> lamps = lampsIn(300, 0.5f);
  const LightTree tree(lamps);
  for (int r = 0; r < 50; ++r) {
    const vec3 P(0.1f * static_cast<float>(r), 0, 0),
        direction = glm::normalize(vec3(std::sin(static_cast<float>(r)), std::cos(static_cast<float>(r)), 0.3f));
    std::vector<uint32_t> met;
    tree.meet(P, direction, met);
    const std::set<uint32_t> found(met.begin(), met.end());
    EXPECT_EQ(found.size(), met.size());
    for (uint32_t i = 0; i < lamps.size(); ++i) {
      const vec3 to = lamps[i].bound.center() - P;
      const float along = std::max(0.0f, dot(to, direction));
      const float miss = glm::length(to - along * direction);
      EXPECT_TRUE(miss >= 0.5f || found.contains(i));
      EXPECT_TRUE(miss <= 0.501f * std::sqrt(3.0f) || !found.contains(i));
    }
  }
}

TEST(LightTree, LampsAtOnePlaceAreDividedToo) {
  const LightTree tree(std::vector<TreeLamp>(100, TreeLamp{{vec3(1), vec3(1)}, 1}));
  const LampReceiver at{vec3(0), vec3(0)};
  std::vector<LampCluster> cut;
  tree.cut(at, 100, 1, cut);
  EXPECT_EQ(cut.size(), 100U);
}

}  // namespace
}  // namespace tomales
