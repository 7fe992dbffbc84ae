#include "reyes/shade/light_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "reyes/base/rng.h"

namespace tomales {
namespace {

std::vector<TreeLight> lampsIn(int count, float radius) {
  std::vector<TreeLight> out;
  for (int i = 0; i < count; ++i) {
    const auto at = [&](uint32_t k) { return 20 * unitFloat(hashCombine(static_cast<uint32_t>(i), k)) - 10; };
    const vec3 center(at(1), at(2), at(3));
    out.push_back({{center - radius, center + radius}, 0.1f + unitFloat(hashCombine(static_cast<uint32_t>(i), 4U))});
  }
  return out;
}

/// Light that lamps bring and of which the tree knows nothing.
double lightOf(const TreeLight& lamp, uint32_t number) {
  return double{lamp.power} * (1 + std::sin(static_cast<double>(number)));
}

DrawnLight drawn(const LightTree& tree, const LightReceiver& at, const LightCluster& cluster, float xi) {
  DrawnLight out{};
  tree.draw(at, std::span(&cluster, 1), std::span(&xi, 1), std::span(&out, 1));
  return out;
}

TEST(LightTree, LightOverProbabilityOfDrawnLampsHasTheSumOfAllLampsAsItsMean) {
  const std::vector<TreeLight> lamps = lampsIn(500, 0);
  const LightTree tree(lamps);
  double all = 0;
  for (uint32_t i = 0; i < lamps.size(); ++i) all += lightOf(lamps[i], i);
  for (const LightReceiver& at : {LightReceiver{{1, 2, 3}, {0, 0, 1}}, LightReceiver{{30, 0, 0}, vec3(0.0f)}}) {
    std::vector<LightCluster> cut;
    tree.cut(at, 20, 1, cut);
    EXPECT_LE(cut.size(), 20U);
    double sum = 0;
    constexpr int kDraws = 1 << 14;
    for (const LightCluster& c : cut)
      for (int d = 0; d < kDraws; ++d) {
        const auto [lamp, probability] = drawn(tree, at, c, (static_cast<float>(d) + 0.5f) / kDraws);
        EXPECT_NEAR(tree.expected(at, cut, lamp), probability, 1e-5f * probability);
        sum += lightOf(lamps[lamp], lamp) / double{probability} / kDraws;
      }
    EXPECT_NEAR(sum, all, 0.003 * all);
  }
}

TEST(LightTree, TheFirstLampsAreDrawnAsIfThereWereNoOthers) {
  const std::vector<TreeLight> lamps = lampsIn(200, 0.1f);
  const LightTree tree(lamps);
  for (const uint32_t count : {1u, 7u, 130u, 199u, 200u}) {
    const LightReceiver at{{3, 1, 2}, {0, 1, 0}, count};
    std::vector<LightCluster> cut;
    tree.cut(at, 20, 1, cut);
    EXPECT_LE(cut.size(), 20u);
    double expected = 0;
    for (uint32_t lamp = 0; lamp < count; ++lamp) {
      const float n = tree.expected(at, cut, lamp);
      EXPECT_GT(n, 0) << lamp << " of " << count;
      expected += double{n};
    }
    EXPECT_NEAR(expected, static_cast<double>(cut.size()), 1e-4) << "no draw is lost to other lamps";
    for (const LightCluster& cluster : cut)
      for (int k = 0; k < 50; ++k)
        EXPECT_LT(drawn(tree, at, cluster, (static_cast<float>(k) + 0.5f) / 50).light, count);
  }
  std::vector<LightCluster> none{{0, 1}};
  tree.cut({{3, 1, 2}, {0, 1, 0}, 0}, 20, 1, none);
  EXPECT_TRUE(none.empty());
}

TEST(LightTree, ALampThatOutshinesTheOthersIsDrawnForCertainAndHasMoreSamples) {
  std::vector<TreeLight> lamps = lampsIn(200, 0.01f);
  lamps[77].power = 1000;
  const LightTree tree(lamps);
  const LightReceiver at{lamps[77].bound.center() + vec3(0, 0, 1), {0, 0, -1}};
  std::vector<LightCluster> cut;
  tree.cut(at, 32, 16, cut);
  EXPECT_FLOAT_EQ(tree.expected(at, cut, 77), 16);
  int samples = 0;
  for (const LightCluster& c : cut) samples += c.samples;
  EXPECT_LE(samples, 32);
}

TEST(LightTree, ARayMeetsTheLampsOnItsWayAlone) {
  const std::vector<TreeLight> lamps = lampsIn(300, 0.5f);
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

/// The probability with which the root draws lamp 0 of two.
double shareOfFirst(const TreeLight& a, const TreeLight& b, const LightReceiver& at) {
  const LightTree tree({a, b});
  std::vector<LightCluster> cut;
  tree.cut(at, 1, 1, cut);
  EXPECT_EQ(cut.size(), 1U);
  EXPECT_NEAR(tree.expected(at, cut, 0) + tree.expected(at, cut, 1), 1, 1e-6);
  return tree.expected(at, cut, 0);
}

TEST(LightTree, TheImportanceOfALampIsItsLightAtThePoint) {
  const auto lampAt = [](const vec3& P, float power, float half = 0) { return TreeLight{{P - half, P + half}, power}; };
  const vec3 up(0, 0, 1), anywhere(0);
  const TreeLight near = lampAt({0, 0, 2}, 3);
  // Power over squared distance: 3 / 4 against 5 / 9.
  EXPECT_NEAR(shareOfFirst(near, lampAt({3, 0, 0}, 5), {vec3(0), anywhere}), (3.0 / 4) / (3.0 / 4 + 5.0 / 9), 1e-6);
  // The cosine counts for surfaces: 1 against 3/5 at distance 5.
  EXPECT_NEAR(shareOfFirst(near, lampAt({4, 0, 3}, 5), {vec3(0), up}), (3.0 / 4) / (3.0 / 4 + 5 * 0.6 / 25), 1e-6);
  // What is behind keeps a tenth.
  EXPECT_NEAR(shareOfFirst(near, lampAt({0, 0, -3}, 5), {vec3(0), up}), (3.0 / 4) / (3.0 / 4 + 0.1 * 5 / 9), 1e-6);
  // One that a bump may turn the surface to keeps a fiftieth.
  EXPECT_NEAR(shareOfFirst(near, lampAt({4, 0, 0}, 5), {vec3(0), up}), (3.0 / 4) / (3.0 / 4 + 0.02 * 5 / 16), 1e-6);
  // Heights of a lamp with extent vary by a twelfth around 3.
  const double front = 0.5 * (3 + std::sqrt(9 + 2 / 3.14159265 / 12)), seen = front + 0.1 * (front - 3);
  EXPECT_NEAR(shareOfFirst(near, lampAt({4, 0, 3}, 5, 0.5f), {vec3(0), up}), (3.0 / 4) / (3.0 / 4 + 5 * seen / 5 / 25),
              1e-6);
  // Within the lamp the squared distance is its variance along three axes.
  EXPECT_NEAR(shareOfFirst(near, lampAt({0, 0, 0}, 5, 0.5f), {vec3(0), anywhere}), (3.0 / 4) / (3.0 / 4 + 5 / 0.25),
              1e-6);
}

TEST(LightTree, LampsTooDimAndFarToBeToldApartAreDrawnEvenly) {
  const TreeLight dim{{vec3(0), vec3(0)}, 1e-30f}, dimmer{{vec3(1, 0, 0), vec3(1, 0, 0)}, 1e-31f};
  EXPECT_EQ(shareOfFirst(dim, dimmer, {{0, 0, 1e12f}, vec3(0)}), 0.5f);
  EXPECT_NEAR(shareOfFirst(dim, dimmer, {{0, 0, 1e3f}, vec3(0)}), 1 / 1.1, 1e-4);
}

TEST(LightTree, FewDrawnLampsOverAFloorBringItsLightWithinTwoPercent) {
  std::vector<TreeLight> lamps;
  for (uint32_t i = 0; i < 3000; ++i) {
    const auto at = [&](uint32_t k) { return unitFloat(hashCombine(i, k)); };
    const vec3 place(60 * at(1) - 30, 60 * at(2) - 30, 1.5f + 3 * at(3));
    lamps.push_back({{place, place}, 0.3f + at(4)});
  }
  const LightTree tree(lamps);
  double off2 = 0;
  constexpr int kPoints = 300;
  for (uint32_t p = 0; p < kPoints; ++p) {
    const LightReceiver at{{20 * unitFloat(hashCombine(p, 5U)) - 10, 20 * unitFloat(hashCombine(p, 6U)) - 10, 0},
                           {0, 0, 1}};
    const auto light = [&](uint32_t l) {
      const glm::dvec3 to(lamps[l].bound.center() - at.P);
      return double{lamps[l].power} * to.z / std::pow(dot(to, to), 1.5);
    };
    double all = 0, sum = 0;
    for (uint32_t l = 0; l < lamps.size(); ++l) all += light(l);
    std::vector<LightCluster> cut;
    tree.cut(at, 32, 1, cut);
    for (const LightCluster& c : cut) {
      const auto [lamp, probability] = drawn(tree, at, c, unitFloat(hashCombine(p, c.node, 7U)));
      sum += light(lamp) / double{probability};
    }
    off2 += (sum / all - 1) * (sum / all - 1);
  }
  EXPECT_LT(std::sqrt(off2 / kPoints), 0.02);
}

TEST(LightTree, EveryLampIsInOneClusterOfACut) {
  for (const int count : {1, 2, 3, 50, 333}) {
    const std::vector<TreeLight> lamps = lampsIn(count, 0.1f);
    const LightTree tree(lamps);
    for (uint32_t k = 0; k < 40; ++k) {
      const auto at = [&](uint32_t axis) { return 30 * unitFloat(hashCombine(k, axis)) - 15; };
      const LightReceiver point{{at(7), at(8), at(9)}, k % 2 ? glm::normalize(vec3(at(1), at(2), 3)) : vec3(0)};
      const int most = 1 + static_cast<int>(k) % 24, perLamp = 1 << k % 4;
      std::vector<LightCluster> cut{{99, 99}};
      tree.cut(point, most, perLamp, cut);
      int samples = 0;
      for (const LightCluster& c : cut) {
        samples += c.samples;
        EXPECT_LE(c.samples, perLamp);
      }
      EXPECT_LE(samples, most);
      double expected = 0;
      for (uint32_t l = 0; l < lamps.size(); ++l) {
        EXPECT_GT(tree.expected(point, cut, l), 0) << "no lamp is left out";
        expected += double{tree.expected(point, cut, l)};
      }
      EXPECT_NEAR(expected, samples, 1e-3 * samples);
    }
  }
}

TEST(LightTree, LampsThatLieTogetherAreOneCluster) {
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<TreeLight> lamps = lampsIn(40, 0);
    for (size_t i = 0; i < lamps.size(); ++i) {
      vec3 at = 0.2f * lamps[i].bound.center();
      at[axis] += i % 2 ? 15.0f : -15.0f;
      lamps[i] = {{at, at}, 1};
    }
    const LightTree tree(lamps);
    const LightReceiver middle{vec3(0), vec3(0)};
    std::vector<LightCluster> cut;
    tree.cut(middle, 2, 1, cut);
    ASSERT_EQ(cut.size(), 2U);
    for (const LightCluster& c : cut) {
      std::set<uint32_t> members;
      for (int d = 0; d < 2000; ++d)
        members.insert(drawn(tree, middle, c, (static_cast<float>(d) + 0.5f) / 2000).light);
      EXPECT_EQ(members.size(), 20U);
      for (const uint32_t l : members) EXPECT_EQ(l % 2, *members.begin() % 2) << axis;
    }
  }
}

TEST(LightTree, ACutEndsWhereNoClusterBringsMoreThanAHalfPercent) {
  const std::vector<TreeLight> lamps = lampsIn(1000, 0);
  const LightTree tree(lamps);
  const LightReceiver at{{0, 0, 0}, vec3(0)};
  std::vector<LightCluster> cut;
  tree.cut(at, 1000, 1, cut);
  EXPECT_LT(cut.size(), 1000U);
  double all = 0;
  std::vector<double> light(lamps.size());
  for (uint32_t l = 0; l < lamps.size(); ++l) {
    const vec3 to = lamps[l].bound.center();
    all += light[l] = double{lamps[l].power} / double{dot(to, to)};
  }
  int large = 0;
  for (const LightCluster& c : cut) {
    std::set<uint32_t> members;
    for (int d = 0; d < 500; ++d) members.insert(drawn(tree, at, c, (static_cast<float>(d) + 0.5f) / 500).light);
    double sum = 0;
    for (const uint32_t l : members) sum += light[l];
    // The tree knows a cluster by its middle and its radius, so its light is known to a factor.
    EXPECT_TRUE(members.size() == 1 || sum < 0.02 * all) << sum / all;
    large += members.size() > 1;
  }
  EXPECT_GT(large, 50);
}

TEST(LightTree, WithoutLampsNothingIsDrawn) {
  const LightTree tree({});
  std::vector<LightCluster> cut{{0, 1}};
  tree.cut({vec3(0), vec3(0)}, 4, 1, cut);
  EXPECT_TRUE(cut.empty());
}

TEST(LightTree, LampsAtOnePlaceAreDividedToo) {
  const LightTree tree(std::vector<TreeLight>(100, TreeLight{{vec3(1), vec3(1)}, 1}));
  const LightReceiver at{vec3(0), vec3(0)};
  std::vector<LightCluster> cut;
  tree.cut(at, 100, 1, cut);
  EXPECT_EQ(cut.size(), 100U);
}

}  // namespace
}  // namespace tomales
