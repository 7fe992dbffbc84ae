// How far geometry may reach, and other limits, from both sides.
#include "rib_test_tools.h"

namespace tomales {
namespace limits {
namespace {

bool isDrawn(const std::string& text) {
  const Reading r(inWorld(text));
  EXPECT_EQ(r.scene().objects.empty(), r.log.count("rib-object-dropped") == 1) << text << r.codes();
  return !r.scene().objects.empty();
}

std::string triangle(const std::string& size) { return "Polygon \"P\" [0 0 0 " + size + " 0 0 0 " + size + " 0]\n"; }

TEST(Reach, OfABillionKilometresIsTheLimit) {
  EXPECT_TRUE(isDrawn("Translate 0 9.9e11 0 " + triangle("1")));
  EXPECT_FALSE(isDrawn("Translate 0 1.01e12 0 " + triangle("1")));
  EXPECT_TRUE(isDrawn("Scale 1e9 1e9 1e9 " + triangle("330")));  // the sum of the axes counts
  EXPECT_FALSE(isDrawn("Scale 1e9 1e9 1e9 " + triangle("340")));
  EXPECT_TRUE(isDrawn("Scale 1e14 1e14 1e14 " + triangle("1e-3")));
  EXPECT_FALSE(isDrawn("Scale 1e14 1e14 1e14 " + triangle("1e-2")));
  EXPECT_FALSE(isDrawn("Scale 1e9 1e9 1e9 Points \"P\" [1 1 1] \"constantwidth\" [400]\n"));
}

TEST(Reach, CountsAtEveryKeyOfAMotion) {
  EXPECT_FALSE(isDrawn("MotionBegin [0 1] Translate 0 0 0 Translate 0 2e12 0 MotionEnd " + triangle("1")));
  EXPECT_FALSE(isDrawn("Scale 1e9 1e9 1e9 MotionBegin [0 1] " + triangle("1") + triangle("400") + "MotionEnd\n"));
}

TEST(Skew, NeedsAnAngleThatLeavesTheAxesApart) {
  const auto told = [](const std::string& skew) {
    return Reading(inWorld("Skew " + skew + kSphere)).log.count("rib-transformation");
  };
  EXPECT_EQ(told("89 0 1 0 1 0 0 "), 0);
  EXPECT_EQ(told("90 0 1 0 1 0 0 "), 1);
  EXPECT_EQ(told("-89 0 1 0 1 0 0 "), 0);
  EXPECT_EQ(told("-90 0 1 0 1 0 0 "), 1);
  EXPECT_EQ(told("30 0 1 0 0 2 0 "), 1);
  EXPECT_EQ(told("30 0 1 0 0 0 0 "), 1);
}

}  // namespace
}  // namespace limits
}  // namespace tomales
