#include "raytrace/hit_list.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace tomales {
namespace {

constexpr float kOffset = 1.0f;

PolygonHit at(float t, bool leaving, uint32_t quad = 0) { return {t, 0, quad, 0, 0, leaving}; }

/// The t of the effective origin and of the answer; 99 for none.
struct Answer {
  float origin, next;
  bool operator==(const Answer&) const = default;
};

Answer answer(HitList list, const RayStart& start = {kOffset}) {
  sortAlongRay(list);
  const int origin = effectiveOrigin(list, start), next = nextHit(list, origin, start);
  const auto t = [&](int i) { return i < 0 ? 99.0f : list[static_cast<size_t>(i)].t; };
  return {t(origin), t(next)};
}

TEST(HitList, EmptyListMovesNothing) { EXPECT_EQ(answer({}), (Answer{99, 99})); }

TEST(HitList, AHitAfterTheOriginBecomesTheOrigin) { EXPECT_EQ(answer({at(0.3f, true)}), (Answer{0.3f, 99})); }

TEST(HitList, AHitBeforeTheOriginBecomesTheOrigin) {
  EXPECT_EQ(answer({at(-0.3f, true), at(0.5f, false)}), (Answer{-0.3f, 0.5f}));
}

TEST(HitList, EveryOrderOfRecordingGivesTheSameAnswer) {
  HitList list{at(-0.9f, false, 1), at(-0.2f, true, 2), at(0.1f, false, 3), at(0.4f, true, 4)};
  const auto lessByQuad = [](const PolygonHit& a, const PolygonHit& b) { return a.quad < b.quad; };
  int orders = 0;
  do {
    EXPECT_EQ(answer(list), (Answer{0.1f, 0.4f}));
    ++orders;
  } while (std::next_permutation(list.begin(), list.end(), lessByQuad));
  EXPECT_EQ(orders, 24);
}

TEST(HitList, AnEdgeSharedByTwoPolygonsIsOneSurface) {
  EXPECT_EQ(answer({at(0.1f, true, 1), at(0.1f, true, 2), at(0.10001f, true, 3), at(0.6f, false, 4)}),
            (Answer{0.1f, 0.6f}));
}

TEST(HitList, TheOtherSideOfAThinSheetIsAnotherSurfaceHoweverThin) {
  EXPECT_EQ(answer({at(0.0f, false, 1), at(1e-4f, true, 2)}), (Answer{0.0f, 1e-4f}));
}

TEST(HitList, ASecondSheetCloserThanTheOffsetIsTheAnswer) {
  EXPECT_EQ(answer({at(0.0f, false, 1), at(0.1f, false, 2)}), (Answer{0.0f, 0.1f}));
}

TEST(HitList, AtACreaseTheRayLeavesBothWalls) { EXPECT_EQ(answer({at(1e-6f, true, 1), at(-1e-6f, true, 2)}).next, 99); }

TEST(HitList, AtACreaseTheRayMayLeaveOneWallIntoTheOther) {
  const RayStart start{kOffset, 1e-6f, -1};
  for (const float noise : {-5e-7f, 0.0f, 5e-7f})
    EXPECT_EQ(answer({at(noise, false, 1), at(0, true, 2), at(3, true, 3)}, start), (Answer{0, noise})) << noise;
}

TEST(HitList, TheOtherFaceOfASheetIsNoOtherSurface) {
  const auto polygon = [](float t, bool leaving, const vec3& normal) {
    PolygonHit hit = at(t, leaving);
    hit.normal = normal;
    return hit;
  };
  const RayStart start{kOffset, 1e-6f, 0}, slanted{kOffset, 1e-6f, 0, normalizeOr(vec3(1, 0, 0.01f), {})};
  const PolygonHit front = polygon(0, true, {0, 0, 2}), back = polygon(5e-7f, false, {0, 0, -3}),
                   far = polygon(2e-6f, false, {0, 0, -3}), wall = polygon(5e-7f, false, {0, 1, 0});
  EXPECT_EQ(answer({front, back, at(3, false)}, start), (Answer{0, 3}));
  EXPECT_EQ(answer({front, wall, at(3, false)}, start), (Answer{0, 5e-7f})) << "a wall at a crease";
  EXPECT_EQ(answer({front, far, at(3, false)}, start), (Answer{0, 2e-6f})) << "the other side of a thin wall";
  const PolygonHit nearFront = polygon(0.1f, true, {0, 0, 2}), nearBack = polygon(0.1f, false, {0, 0, -3});
  EXPECT_EQ(answer({nearFront, nearBack}, start), (Answer{0.1f, 0.1f})) << "a wall beside a point of something curved";
  EXPECT_EQ(answer({front, polygon(5e-5f, false, {0, 0, -3}), at(3, false)}, slanted), (Answer{0, 3}));
  EXPECT_FALSE(isCrowded({front, back}, 0, start));
  EXPECT_TRUE(isCrowded({front, far}, 0, start));
}

TEST(HitList, AtACreaseTheRayLeavesItsOwnGroup) {
  // The walls of a room whose normals point outwards: the ray goes against them all.
  const HitList list{{0, 4, 1, 0, 0, true}, {-5e-7f, 5, 2, 0, 0, false}};
  EXPECT_EQ(answer(list, {kOffset, 1e-6f, 5}), (Answer{-5e-7f, 0}));
}

TEST(HitList, HitsBeyondTheOffsetNeverBecomeTheOrigin) {
  EXPECT_EQ(answer({at(1.02f, false), at(-1.02f, true)}), (Answer{99, 1.02f}));
}

TEST(HitList, WithoutAnOriginHitsBeforeTheRayDoNotCount) { EXPECT_EQ(answer({at(-1.03f, false)}), (Answer{99, 99})); }

TEST(HitList, OfTwoHitsEquallyFarTheEarlierIsTheOrigin) {
  EXPECT_EQ(answer({at(0.5f, false), at(-0.5f, true)}), (Answer{-0.5f, 0.5f}));
}

TEST(HitList, HundredsOfHitsAreAllKept) {
  HitList list;
  for (int i = 500; i > 0; --i)
    list.push_back(at(static_cast<float>(i) * 0.002f, i % 2 == 0, static_cast<uint32_t>(i)));
  EXPECT_EQ(answer(list), (Answer{0.002f, 0.004f}));
}

}  // namespace
TEST(HitList, IsCrowdedWhereASecondSurfaceLiesWithinTheOffset) {
  const auto hit = [](float t, bool leaving) {
    PolygonHit h;
    h.t = t;
    h.leaving = leaving;
    return h;
  };
  const RayStart start{1, 1e-6f, -1};
  EXPECT_FALSE(isCrowded({hit(0.2f, true)}, 0, start));
  EXPECT_FALSE(isCrowded({hit(0.2f, true), hit(0.21f, true)}, 0, start)) << "an edge of two polygons";
  EXPECT_TRUE(isCrowded({hit(-0.5f, false), hit(0.2f, true)}, 1, start)) << "the other side of a thin wall";
  EXPECT_FALSE(isCrowded({hit(0.2f, true), hit(1.01f, false)}, 0, start))
      << "recorded for the sake of pairs, but beyond";
  EXPECT_FALSE(isCrowded({hit(0.2f, true)}, -1, start));
}

}  // namespace tomales
