#include "tests/unit/prim/support.h"

namespace tomales {
namespace {
using namespace test;

/// RISpec's circle, homogeneous.
TrimCurve circle(const vec2& centre, float radius) {
  const float h = std::sqrt(0.5f), x[9] = {1, 1, 0, -1, -1, -1, 0, 1, 1}, y[9] = {0, 1, 1, 1, 0, -1, -1, -1, 0};
  TrimCurve c{{9, 3, {0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4}, 0, 4}, {}};
  for (size_t k = 0; k < 9; ++k) {
    const float w = k % 2 ? h : 1;
    c.controls.emplace_back(w * (centre + radius * vec2(x[k], y[k])), w);
  }
  return c;
}
TrimCurve polyline(const std::vector<vec2>& points) {
  TrimCurve c{{static_cast<int>(points.size()), 2, {0}, 0, static_cast<float>(points.size() - 1)}, {}};
  for (size_t k = 0; k < points.size(); ++k) {
    c.line.knots.push_back(static_cast<float>(k));
    c.controls.emplace_back(points[k], 1);
  }
  c.line.knots.push_back(c.line.max);
  return c;
}

/// The plane z = 0 over knots 10..14 x -2..2, in 2 x 1 patches.
PrimPtr plane(const TrimLoops& trim, Problems& problems) {
  return makeNuPatch({3, 2, {10, 10, 11, 14, 14}, 10, 14}, {2, 2, {-2, -2, 2, 2}, -2, 2}, trim,
                     {positions({10, -2, 0, 11, -2, 0, 14, -2, 0, 10, 2, 0, 11, 2, 0, 14, 2, 0})}, problems);
}
PrimPtr plane(const TrimLoops& trim) {
  Problems problems;
  const PrimPtr prim = plane(trim, problems);
  EXPECT_TRUE(problems.empty()) << problems.front();
  return prim;
}

TEST(TrimCurves, CutAlongTheCircleThatTheyAreInTheKnotsOfTheSurface) {
  const vec2 centre(12, 0.1f);
  const PrimPtr hole = plane({{{circle(centre, 1.5f)}}, false}), disk = plane({{{circle(centre, 1.5f)}}, true});
  int inside = 0;
  for (uint32_t k = 0; k < 20000; ++k) {
    const uint32_t patch = k % 2;
    const float u = unitFloat(hashCombine(k, 1u)), v = unitFloat(hashCombine(k, 2u));
    const float r = glm::distance(vec2(sampleAt(*hole, patch, u, v).p), centre);
    if (std::abs(r - 1.5f) < 2e-5f) continue;  // flattened to 4 / 2^19, and float
    EXPECT_EQ(hole->keeps(patch, u, v), r > 1.5f) << r;
    EXPECT_EQ(disk->keeps(patch, u, v), r < 1.5f) << r;
    inside += r < 1.5f;
  }
  EXPECT_GT(inside, 5000);
}

TEST(TrimCurves, WhatTheySayOfARectangleHoldsForAllItsPoints) {
  const PrimPtr prim =
      plane({{{circle({12, 0}, 1.8f)}, {circle({12, 0}, 1.2f)}, {circle({13.9f, 1.9f}, 0.3f)}}, false});
  int counts[3] = {};
  for (uint32_t k = 0; k < 5000; ++k) {
    const float size = k % 2 ? 0.02f : 0.2f, u = unitFloat(hashCombine(k, 1u)), v = unitFloat(hashCombine(k, 2u));
    const UvRect r{u, u + size, v, v + size};
    const Kept kept = prim->kept(k % 2, r);
    ++counts[static_cast<int>(kept)];
    for (uint32_t i = 0; i < 16 && kept != Kept::Part; ++i)
      EXPECT_EQ(prim->keeps(k % 2, lerp(r.u0, r.u1, unitFloat(hashCombine(k, i, 3u))),
                            lerp(r.v0, r.v1, unitFloat(hashCombine(k, i, 4u)))),
                kept == Kept::All);
  }
  for (int count : counts) EXPECT_GT(count, 300);
}

TEST(TrimCurves, LoopsMayBeMadeOfManyCurvesAndReachBeyondTheSurface) {
  const TrimCurve first = polyline({{9, -1}, {20, -1}, {20, 1}}), second = polyline({{20, 1}, {9, 1}}),
                  third = polyline({{9, 1}, {9, -1}});
  const PrimPtr prim = plane({{{first, second, third}}, false});
  for (float u : {0.0f, 0.3f, 1.0f}) {
    EXPECT_TRUE(prim->keeps(1, u, 0.2f));
    EXPECT_FALSE(prim->keeps(1, u, 0.5f));
    EXPECT_TRUE(prim->keeps(1, u, 0.8f));
  }
}

TEST(TrimCurves, AnOpenLoopIsClosedWithASentence) {
  Problems problems;
  const PrimPtr prim = plane({{{polyline({{11, -1}, {13, -1}, {13, 1}, {11, 1}})}}, false}, problems);
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_NE(problems[0].find("gaps"), std::string::npos);
  EXPECT_FALSE(prim->keeps(1, 0.3f, 0.5f));
}

TEST(TrimCurves, ThatAreNoneLeaveTheSurfaceWholeWithASentence) {
  TrimCurve noKnots = circle({12, 0}, 1), negative = noKnots, falling = noKnots;
  noKnots.line.knots.pop_back();
  negative.controls[3].z = -1;
  falling.line.knots[4] = 0;
  for (const TrimCurve& bad : {noKnots, negative, falling}) {
    Problems problems;
    const PrimPtr prim = plane({{{bad}}, false}, problems);
    ASSERT_EQ(problems.size(), 1u);
    EXPECT_NE(problems[0].find("not trimmed"), std::string::npos);
    EXPECT_EQ(prim->kept(1, {}), Kept::All);
  }
}

TEST(TrimCurves, WithoutExtentCutNothing) {
  const PrimPtr prim = plane({{{polyline({{12, 0}, {12, 0}})}, {}}, false});
  EXPECT_TRUE(prim->keeps(1, 0.33f, 0.5f));
  EXPECT_TRUE(prim->keeps(1, 0.5f, 0.5f));
}

}  // namespace
}  // namespace tomales
