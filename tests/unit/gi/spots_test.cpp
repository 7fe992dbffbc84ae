// Bright spots and the directions to them, against closed forms.
#include <gtest/gtest.h>

#include "gi/cache/bright_spots.h"
#include "reyes/base/rng.h"

namespace tomales {
namespace spots {
namespace {

/// Corners of a rectangle around `center` and points near its first corner, so that the mean is not the middle.
BrightFind rectangle(const vec3& center, const vec3& halfU, const vec3& halfV, int more = 4) {
  BrightFind find{3, {}};
  const vec3 normal = glm::normalize(cross(halfU, halfV));
  for (const vec3& corner : {-halfU - halfV, halfU - halfV, -halfU + halfV, halfU + halfV})
    find.hits.push_back({center + corner, 10, normal});
  for (int i = 0; i < more; ++i)
    find.hits.push_back({center - (0.9f - 0.02f * static_cast<float>(i)) * (halfU + halfV), 20, normal});
  return find;
}

BrightSpots spotsOf(const std::vector<BrightFind>& finds) {
  BrightSpots out;
  out.learn(finds);
  return out;
}

float marginOf(size_t hits) { return 1 + 2.8f / std::sqrt(static_cast<float>(hits)); }

TEST(BrightSpots, ARectangleIsAroundItsHitsWithAMargin) {
  const vec3 center(1, 2, 5), halfU(2, 0, 0), halfV(0, 0.6f, 0.8f);
  const BrightSpots spots = spotsOf({rectangle(center, halfU, halfV)});
  ASSERT_EQ(spots.spots().size(), 1u);
  const BrightSpots::Spot& s = spots.spots()[0];
  const float margin = marginOf(8);
  EXPECT_LT(glm::length(s.center - center), 1e-5f);
  EXPECT_LT(glm::length(s.normal - glm::normalize(cross(halfU, halfV))), 1e-5f);
  EXPECT_LT(glm::length(glm::abs(s.halfU) - margin * halfU), 1e-5f);
  EXPECT_LT(glm::length(glm::abs(s.halfV) - margin * halfV), 1e-5f);
  EXPECT_NEAR(s.radius, margin * std::sqrt(5.0f), 1e-5f);
  EXPECT_NEAR(s.found.x, 1 / margin, 1e-5f);
  EXPECT_NEAR(s.found.y, 1 / margin, 1e-5f);
  EXPECT_NEAR(s.radiance, 15, 1e-5f);
  EXPECT_EQ(spots.irradiance(), 3);
  EXPECT_EQ(spotsOf({{1, {}}, {2, {}}, {6, {}}}).irradiance(), 3) << "the mean of all finds";
  EXPECT_EQ(BrightSpots().irradiance(), 0);
}

TEST(BrightSpots, ALineOfHitsIsATwentiethAsWide) {
  const BrightSpots spots = spotsOf({rectangle({0, 0, 5}, {1, 0, 0}, {0, 0.01f, 0})});
  ASSERT_EQ(spots.spots().size(), 1u);
  const BrightSpots::Spot& s = spots.spots()[0];
  EXPECT_NEAR(glm::length(s.halfU), marginOf(8), 1e-4f);
  EXPECT_NEAR(glm::length(s.halfV), 0.05f * marginOf(8), 1e-4f);
  EXPECT_NEAR(s.found.y, 0.01f / (0.05f * marginOf(8)), 1e-4f);
}

TEST(BrightSpots, WhatIsNotFlatIsTheSphereAroundItsHits) {
  BrightFind bent = rectangle({0, 0, 5}, {1, 0, 0}, {0, 1, 0}), deep = bent;
  for (size_t i = 0; i < 4; ++i) bent.hits[i].normal = {1, 0, 0};
  deep.hits[0].position.z += 0.2f;
  for (const BrightFind& find : {bent, deep}) {
    const BrightSpots spots = spotsOf({find});
    ASSERT_EQ(spots.spots().size(), 1u);
    const BrightSpots::Spot& s = spots.spots()[0];
    const float depth = find.hits[0].position.z - 5;
    EXPECT_EQ(s.normal, vec3(0));
    EXPECT_LT(glm::length(s.center - vec3(0, 0, 5 + depth / 2)), 1e-5f);
    EXPECT_NEAR(s.radius, marginOf(8) * std::sqrt(8 + depth * depth) / 2, 1e-5f);
    EXPECT_NEAR(s.found.x, 1 / marginOf(8), 1e-5f);
  }
  deep.hits[0].position.z = 5.01f;  // by less than a fiftieth of the radius
  EXPECT_NE(spotsOf({deep}).spots().at(0).normal, vec3(0));
}

TEST(BrightSpots, TheMeanLightOfAllRecordsIsKnown) {
  BrightSpots spots;
  EXPECT_EQ(spots.irradiance(), 0);
  spots.learn({{1, {}}, {2, {}}});
  spots.learn({{6, {}}});
  EXPECT_FLOAT_EQ(spots.irradiance(), 3);
}

TEST(BrightSpots, NeedFourHitsAndSplitFromSixteenOn) {
  const auto count = [](int hits) {
    BrightFind find = rectangle({0, 0, 5}, {1, 0, 0}, {0, 1, 0}, std::max(0, hits - 4));
    find.hits.resize(static_cast<size_t>(hits));
    return spotsOf({find}).spots().size();
  };
  EXPECT_EQ(count(3), 0u);
  EXPECT_EQ(count(4), 1u);
  EXPECT_EQ(count(15), 1u);
  const auto apart = [](float second) {
    BrightFind find = rectangle({0, 0, 5}, {1, 0, 0}, {0, 1, 0});
    for (const BrightHit& h : rectangle({second, 0, 5}, {1, 0, 0}, {0, 1, 0}).hits) find.hits.push_back(h);
    return spotsOf({find});
  };
  const BrightSpots two = apart(50);
  ASSERT_EQ(two.spots().size(), 2u);
  for (const BrightSpots::Spot& s : two.spots()) EXPECT_NEAR(s.radius, marginOf(8) * std::sqrt(2.0f), 1e-4f);
  // What lies at one place and faces two ways is split by its normals.
  BrightFind corner = rectangle({0, 0, 5}, {1, 0, 0}, {0, 1, 0});
  for (const BrightHit& h : rectangle({0, 0, 5}, {1, 0, 0}, {0, 0, 1}).hits) corner.hits.push_back(h);
  const BrightSpots faces = spotsOf({corner});
  ASSERT_EQ(faces.spots().size(), 2u);
  for (const BrightSpots::Spot& s : faces.spots()) EXPECT_NE(s.normal, vec3(0));
}

TEST(BrightSpots, FacesAreToldApartByTheirNormalsWhateverTheirSize) {
  for (const float size : {0.01f, 1.0f, 100.0f}) {
    BrightFind corner = rectangle(size * vec3(0, 0, 5), {size, 0, 0}, {0, size, 0});
    for (const BrightHit& h : rectangle(size * vec3(0, 0, 5), {size, 0, 0}, {0, 0, size}).hits)
      corner.hits.push_back(h);
    const BrightSpots faces = spotsOf({corner});
    ASSERT_EQ(faces.spots().size(), 2u) << size;
    for (const BrightSpots::Spot& s : faces.spots()) EXPECT_NE(s.normal, vec3(0)) << size;
  }
}

TEST(BrightSpots, WhatIsLearntInTurnIsLearntAtOnce) {
  const BrightFind near = rectangle({0, 0, 5}, {1, 0, 0}, {0, 1, 0}), far = rectangle({50, 0, 5}, {1, 0, 0}, {0, 1, 0});
  BrightSpots turns;
  turns.learn({near});
  turns.learn({far});
  const BrightSpots once = spotsOf({near, far});
  EXPECT_EQ(turns.irradiance(), once.irradiance());
  ASSERT_EQ(turns.spots().size(), once.spots().size());
  for (size_t i = 0; i < once.spots().size(); ++i) {
    EXPECT_EQ(turns.spots()[i].center, once.spots()[i].center);
    EXPECT_EQ(turns.spots()[i].radius, once.spots()[i].radius);
  }
}

TEST(BrightSpots, AreSixtyFourAtMostOfThirtyTwoThousandHits) {
  BrightFind find{1, {}};
  for (uint32_t i = 0; i < 40000; ++i) {
    const vec2 xi = sobol2(i, 5);
    const bool late = i >= 32768;  // these are not kept
    find.hits.push_back({{xi.x, xi.y, late ? 99.0f : 5.0f}, 1, {0, 0, -1}});
  }
  const BrightSpots spots = spotsOf({find});
  EXPECT_EQ(spots.spots().size(), 64u);
  for (const BrightSpots::Spot& s : spots.spots()) EXPECT_LT(s.center.z, 6);
}

TEST(SpotAim, LightIsThatOfASmallSourceAsItLooksFromThePoint) {
  const BrightSpots rectangles = spotsOf({rectangle({0, 0, 40}, {0, 1, 0}, {1, 0, 0})});
  const BrightSpots::Spot& s = rectangles.spots().at(0);
  ASSERT_LT(s.normal.z, 0);
  const float area = 4 * glm::length(s.halfU) * glm::length(s.halfV), sine = s.radius / 40;
  const vec3 tilted = glm::normalize(vec3(1, 0, 1)), side(40, 0, 0);
  const SpotAim ahead(rectangles, {0, 0, 0}, {0, 0, 1}), aslant(rectangles, {0, 0, 0}, tilted),
      beside(rectangles, side, {0, 0, 1});
  EXPECT_NEAR(ahead.coverage(), area / (kPi * 1600), 1e-6f);
  EXPECT_NEAR(ahead.irradiance(), 15 * ahead.coverage(), 1e-5f);
  EXPECT_NEAR(aslant.coverage(), area / (kPi * 1600) * (std::sqrt(0.5f) + sine), 1e-6f);
  EXPECT_NEAR(beside.coverage(),
              area * std::sqrt(0.5f) / (kPi * 3200) * (std::sqrt(0.5f) + s.radius / glm::length(vec2(40))), 1e-6f);
  EXPECT_NEAR(ahead.radiance(0), 15, 1e-4f);
  EXPECT_EQ(SpotAim(rectangles, {0, 0, 50}, {0, 0, -1}).irradiance(), 0) << "it shines to the other side";
  EXPECT_NEAR(ahead.pdf({0, 0, 1}), 1600 / area, 1e-2f);
  const vec3 edge = s.center + 0.999f * s.halfU, beyond = s.center + 1.01f * s.halfU;
  EXPECT_NEAR(ahead.pdf(glm::normalize(edge)), dot(edge, edge) / area * glm::length(edge) / edge.z, 1e-2f);
  EXPECT_EQ(ahead.pdf(glm::normalize(beyond)), 0);
  EXPECT_EQ(ahead.pdf(glm::normalize(s.center + 1.01f * s.halfV)), 0);
  EXPECT_EQ(ahead.pdf({0, 0, -1}), 0);
}

TEST(SpotAim, WhatIsDarkOrBelowTheHorizonIsNoTarget) {
  BrightFind dark = rectangle({0, 0, 40}, {0, 1, 0}, {1, 0, 0});
  const vec3 origin(0), ahead(0, 0, 1);
  EXPECT_EQ(SpotAim(spotsOf({dark}), origin, ahead).targets(), 1u);
  EXPECT_EQ(SpotAim(spotsOf({dark}), origin, -ahead).targets(), 0u);
  for (BrightHit& h : dark.hits) h.radiance = 0;
  EXPECT_EQ(SpotAim(spotsOf({dark}), origin, ahead).targets(), 0u);
}

TEST(SpotAim, ASphereIsAConeOfEvenDirections) {
  BrightFind ball = rectangle({0, 0, 40}, {0, 1, 0}, {1, 0, 0});
  for (size_t i = 0; i < 4; ++i) ball.hits[i].normal = {1, 0, 0};
  const BrightSpots spots = spotsOf({ball});
  const float radius = spots.spots().at(0).radius, sine = radius / 40, cosine = std::sqrt(1 - sine * sine);
  const SpotAim aim(spots, {0, 0, 0}, {0, 0, 1});
  EXPECT_NEAR(aim.coverage(), sine * sine, 1e-6f);
  EXPECT_NEAR(aim.pdf({0, 0, 1}), 1 / (2 * kPi * (1 - cosine)), 0.1f);
  EXPECT_GT(aim.pdf(glm::normalize(vec3(0.99f * sine, 0, cosine))), 0);
  EXPECT_EQ(aim.pdf(glm::normalize(vec3(1.01f * sine, 0, cosine))), 0);
  float within = 0, found = 0;
  for (uint32_t i = 0; i < 4096; ++i) {
    const vec3 d = aim.direction(0.5f, sobol2(i, 3));
    EXPECT_LE(1 - d.z, 1.001f * (1 - cosine));
    EXPECT_GT(aim.pdf(d), 0);
    within += 1 - d.z < 0.5f * (1 - cosine) ? 1.0f / 4096 : 0.0f;
    const vec3 p = aim.probe(0, sobol2(i, 4));
    found = std::max(found, 1 - p.z);
  }
  EXPECT_GT(aim.pdf(aim.direction(0.5f, {0.99999f, 0.3f})), 0) << "its rim is its own, whatever is rounded";
  EXPECT_NEAR(within, 0.5f, 0.01f);
  EXPECT_NEAR(found / (1 - cosine), 1 / (marginOf(8) * marginOf(8)), 0.01f) << "where hits were";
  EXPECT_EQ(SpotAim(spots, {0, 0, 40 - 2.99f * radius}, {0, 0, 1}).targets(), 0u) << "rays find what is so near";
  EXPECT_EQ(SpotAim(spots, {0, 0, 40 - 3.01f * radius}, {0, 0, 1}).targets(), 1u);
}

TEST(SpotAim, DensityIsThatOfBallsAndOfRectanglesTogether) {
  for (const float side : {-1.0f, 1.0f}) {
    BrightFind ball = rectangle({side * 20, 0, 40}, {0, 1, 0}, {1, 0, 0});
    for (size_t i = 0; i < 4; ++i) ball.hits[i].normal = {1, 0, 0};
    const BrightSpots spots = spotsOf({ball, rectangle({-side * 20, 0, 40}, {0, 1, 0}, {1, 0, 0})});
    ASSERT_EQ(spots.spots().size(), 2u);
    const SpotAim aim(spots, {0, 0, 0}, {0, 0, 1});
    EXPECT_GT(aim.pdf(glm::normalize(vec3(20, 0, 40))), 0);
    EXPECT_GT(aim.pdf(glm::normalize(vec3(-20, 0, 40))), 0);
  }
}

TEST(SpotAim, PlacesAndTargetsAreChosenByTheirShares) {
  std::vector<BrightFind> finds;
  for (const vec2& at : {vec2(-20, -20), vec2(20, -20), vec2(-20, 20), vec2(20, 20)})
    finds.push_back(rectangle({at, 40}, {0, 1, 0}, {1, 0, 0}));
  const BrightSpots spots = spotsOf(finds);
  SpotAim aim(spots, {0, 0, 0}, {0, 0, 1});
  ASSERT_EQ(aim.targets(), 4u);
  std::vector<float> shares(4);
  for (size_t t = 0; t < 4; ++t) {
    const vec3 d = aim.probe(t, vec2(0.5f));
    shares[t] = d.x > 0 && d.y > 0 ? 0.5f : d.x < 0 && d.y < 0 ? 1.0f : 0.0f;
  }
  const float before = aim.irradiance(), coverage = aim.coverage();
  aim.dim(shares);
  EXPECT_LT(aim.irradiance(), 0.5f * before);
  EXPECT_LT(aim.coverage(), 0.5f * coverage);
  float right = 0, density = 0, x = 0;
  for (uint32_t i = 0; i < 3000; ++i) {
    const vec3 d = aim.direction((static_cast<float>(i) + 0.5f) / 3000, sobol2(i, 3));
    EXPECT_GT(d.x * d.y, 0) << "nothing is aimed at what is hidden";
    right += d.x > 0 ? 1.0f / 3000 : 0;
    if (d.x < 0) x += d.x / d.z * 40 / 2000;
    density = std::max(density, aim.pdf(d));
  }
  EXPECT_NEAR(right, 1.0f / 3, 0.001f);
  EXPECT_NEAR(x, -20, 0.02f) << "the mean of its places";
  vec2 low(kInfinity), high(-kInfinity);
  for (uint32_t i = 0; i < 1000; ++i)
    for (size_t t = 0; t < 4; ++t)
      if (shares[t] == 1) {
        const vec3 p = aim.probe(t, sobol2(i, 5));
        low = glm::min(low, vec2(p) / p.z * 40.0f);
        high = glm::max(high, vec2(p) / p.z * 40.0f);
      }
  EXPECT_LT(glm::length(low - vec2(-21, -21)), 0.02f) << "probes go where hits were";
  EXPECT_LT(glm::length(high - vec2(-19, -19)), 0.02f);
}

}  // namespace
}  // namespace spots
}  // namespace tomales
