#include "reyes/prim/hole_bridges.h"

#include <gtest/gtest.h>

#include <numeric>

#include "reyes/base/rng.h"

namespace tomales {
namespace {

/// A loop around a place: `count` points at distances from `least` to `most`.
void addLoop(std::vector<Point2>& out, const Point2& center, int count, double least, double most, uint32_t seed) {
  for (int k = 0; k < count; ++k) {
    const double angle = 2 * M_PI * k / count,
                 r = least + (most - least) * double{unitFloat(hashCombine(seed, static_cast<uint32_t>(k)))};
    out.push_back({center.x + r * std::cos(angle), center.y + r * std::sin(angle)});
  }
}

double side(const Point2& a, const Point2& b, const Point2& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}
bool crossEachOther(const Point2& a, const Point2& b, const Point2& c, const Point2& d) {
  return side(a, b, c) * side(a, b, d) < 0 && side(c, d, a) * side(c, d, b) < 0;
}

/// The number of pairs of edges of the walk that cross each other.
int crossings(const std::vector<Point2>& p, const std::vector<uint32_t>& walk) {
  int out = 0;
  const auto at = [&](size_t i) { return p[walk[i % walk.size()]]; };
  for (size_t i = 0; i < walk.size(); ++i)
    for (size_t k = i + 1; k < walk.size(); ++k) out += crossEachOther(at(i), at(i + 1), at(k), at(k + 1));
  return out;
}

double areaOf(const std::vector<Point2>& p, const std::vector<uint32_t>& walk) {
  double area = 0;
  for (size_t i = 0; i < walk.size(); ++i) {
    const Point2 &a = p[walk[i]], &b = p[walk[(i + 1) % walk.size()]];
    area += 0.5 * (a.x * b.y - a.y * b.x);
  }
  return area;
}

const std::vector<int> kStarts = {0, 14, 19, 23};  // an outline and two holes

std::vector<Point2> key(uint32_t seed) {
  std::vector<Point2> out;
  addLoop(out, {0, 0}, 14, 3, 7, seed);
  addLoop(out, {-1.2, 0.2}, 5, 0.3, 0.9, seed + 1);
  addLoop(out, {1.2, -0.2}, 4, 0.3, 0.9, seed + 2);
  return out;
}

TEST(HoleBridges, CrossNothingAtAnyKeyOfAMovingPolygon) {
  for (uint32_t i = 0; i < 300; ++i) {
    const Outlines keys{key(10 * i), key(10 * i + 5)};
    const BridgedOutline bridged = bridgeHoles(keys, kStarts);
    EXPECT_TRUE(bridged.simple) << i;
    EXPECT_EQ(bridged.ignored, 0);
    EXPECT_EQ(bridged.order.size(), 14u + 5 + 4 + 4) << "each bridge has two ends, which occur twice";
    for (const std::vector<Point2>& p : keys) EXPECT_EQ(crossings(p, bridged.order), 0) << i;
  }
}

TEST(HoleBridges, GoRoundHolesTheOtherWaySoThatTheirAreaIsTakenAway) {
  for (uint32_t i = 0; i < 50; ++i) {
    std::vector<Point2> p = key(10 * i);
    std::vector<uint32_t> outline(14), first(5), second(4);
    std::iota(outline.begin(), outline.end(), 0u);
    std::iota(first.begin(), first.end(), 14u);
    std::iota(second.begin(), second.end(), 19u);
    const double area = areaOf(p, outline) - areaOf(p, first) - areaOf(p, second);
    if (i % 2) std::reverse(p.begin() + 14, p.begin() + 19);
    EXPECT_NEAR(areaOf(p, bridgeHoles({p}, kStarts).order), area, 1e-9);
  }
}

TEST(HoleBridges, OfAHoleThatLeavesTheOutlineWhileItMovesAreNotSimple) {
  std::vector<Point2> here, gone;
  for (std::vector<Point2>* p : {&here, &gone}) addLoop(*p, {0, 0}, 8, 5, 5, 1);
  addLoop(here, {0, 0}, 5, 1, 1, 2);
  addLoop(gone, {20, 0}, 5, 1, 1, 2);
  EXPECT_TRUE(bridgeHoles({here}, {0, 8, 13}).simple);
  const BridgedOutline bridged = bridgeHoles({here, gone}, {0, 8, 13});
  EXPECT_FALSE(bridged.simple);
  EXPECT_EQ(bridged.order.size(), 15u);
  EXPECT_EQ(crossings(here, bridged.order), 0) << "the first key is bridged as if it stood alone";
}

TEST(HoleBridges, LeaveOutHolesBesideTheOutlineAndThoseWithoutArea) {
  std::vector<Point2> p;
  addLoop(p, {0, 0}, 8, 5, 5, 1);
  addLoop(p, {20, 0}, 5, 1, 1, 2);
  for (const double x : {0.0, 1.0, 2.0}) p.push_back({x, 0});
  const BridgedOutline bridged = bridgeHoles({p}, {0, 8, 13, 16});
  EXPECT_EQ(bridged.ignored, 1);
  EXPECT_EQ(bridged.order.size(), 8u);
}

}  // namespace
}  // namespace tomales
