#include "gi/irradiance_cache.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/unit/gi/cache_records.h"

namespace tomales {
namespace {

TEST(IrradianceCache, FindsNothingWhereItHasNoRecords) {
  IrradianceCache cache(kBox, {});
  EXPECT_EQ(cache.lookup({0, 0, 0}, kUp, 0.01f).weight, 0);
  cache.insert(recordAt({0, 0, 0}, vec3(1)));
  EXPECT_EQ(cache.lookup({0.5f, 0, 0}, kUp, 0.01f).weight, 0);
}

TEST(IrradianceCache, ScreenWeightsAreThoseOfEquations2To5) {
  const CacheSettings one{ErrorFunction::Screen, 1};
  // R_i / 2 = 0.05 lies between 1.5 and 10 pixels of 0.01.
  EXPECT_NEAR(weightOfOne(one, recordAt(vec3(0), vec3(1), 0.1f), {0.02f, 0, 0}, kUp, 0.01f), 1 - 0.02f / 0.05f, 1e-5f);
  // R+ = 10 pixels, measured at the lookup, limits a far record.
  EXPECT_NEAR(weightOfOne(one, recordAt(vec3(0), vec3(1), 9), {0.02f, 0, 0}, kUp, 0.01f), 0.8f, 1e-5f);
  EXPECT_NEAR(weightOfOne(one, recordAt(vec3(0), vec3(1), 9), {0.02f, 0, 0}, kUp, 0.004f), 0.5f, 1e-5f);
  // R- = 1.5 pixels supports a record in a corner.
  EXPECT_NEAR(weightOfOne(one, recordAt(vec3(0), vec3(1), 1e-4f), {0.003f, 0, 0}, kUp, 0.01f), 0.8f, 1e-5f);
  // alpha+ = 10 degrees: the normal term is sin(a/2) / sin(5 degrees).
  const float expected = 1 - std::sin(2 * kPi / 180) / std::sin(5 * kPi / 180);
  EXPECT_NEAR(weightOfOne(one, recordAt(vec3(0), vec3(1)), vec3(0), tilted(4), 0.01f), expected, 1e-3f);
  EXPECT_EQ(weightOfOne(one, recordAt(vec3(0), vec3(1)), vec3(0), tilted(10.1f), 0.01f), 0);
  // The larger of both terms counts, times kappa.
  EXPECT_NEAR(weightOfOne(one, recordAt(vec3(0), vec3(1), 9), {0.09f, 0, 0}, tilted(4), 0.01f), 0.1f, 1e-4f);
  EXPECT_NEAR(weightOfOne({ErrorFunction::Screen, 2}, recordAt(vec3(0), vec3(1), 9), {0.02f, 0, 0}, kUp, 0.01f), 0.6f,
              1e-5f);
}

TEST(IrradianceCache, MaxPixelsReplacesTheTenOfEquation3) {
  const CacheSettings four{ErrorFunction::Screen, 1, 4};
  EXPECT_NEAR(weightOfOne(four, recordAt(vec3(0), vec3(1), 9), {0.02f, 0, 0}, kUp, 0.01f), 0.5f, 1e-5f);
}

TEST(IrradianceCache, AnInfiniteKappaReusesNothing) {
  EXPECT_EQ(weightOfOne({ErrorFunction::Screen, kInfinity}, recordAt(vec3(0), vec3(1)), vec3(0), kUp, 0.01f), 0);
}

TEST(IrradianceCache, WardWeightIsTheInverseOfTheSplitSphereError) {
  const CacheSettings ward{ErrorFunction::Ward, 1};
  const auto record = recordAt(vec3(0), vec3(1), 0.08f);
  const float error = 0.02f / 0.08f + std::sqrt(1 - std::cos(20 * kPi / 180));
  EXPECT_NEAR(weightOfOne(ward, record, {0, 0.02f, 0}, tilted(20), 0.01f), 1 / error - 1, 1e-3f);
  EXPECT_EQ(weightOfOne(ward, record, {0, 0.079f, 0}, tilted(20), 0.01f), 0);
}

TEST(IrradianceCache, ARecordInFrontOfThePointIsNotUsedAndOneBesideItIs) {
  for (const auto function : {ErrorFunction::Screen, ErrorFunction::Ward}) {
    const auto record = recordAt(vec3(0), vec3(1));
    EXPECT_EQ(weightOfOne({function, 1}, record, {0, 0, -0.03f}, kUp, 0.01f), 0);
    EXPECT_GT(weightOfOne({function, 1}, record, {0, 0, 0.03f}, kUp, 0.01f), 0);
    EXPECT_GT(weightOfOne({function, 1}, record, {0.03f, 0, 0}, kUp, 0.01f), 0);
  }
}

TEST(IrradianceCache, ASheetThinnerThanAPixelHidesItsBackFromTheRecordsOfItsFront) {
  for (const auto function : {ErrorFunction::Screen, ErrorFunction::Ward, ErrorFunction::Hessian}) {
    auto record = recordAt(vec3(0), vec3(1), 2);  // the underside of a lamp, of which nothing is near
    record.smoothRadius = 1;
    const CacheSettings wide{function, 1, 10};  // reaches 10 pixels of 0.04
    EXPECT_EQ(weightOfOne(wide, record, {0.1f, 0, -0.02f}, kUp, 0.04f), 0) << "the ceiling half a pixel behind it";
    EXPECT_GT(weightOfOne(wide, record, {0.1f, 0, -0.001f}, kUp, 0.04f), 0) << "rounding, and bumps far below a pixel";
  }
}

TEST(IrradianceCache, BumpsThatRaysDoNotSeeLieBehindNoRecord) {
  for (const auto function : {ErrorFunction::Screen, ErrorFunction::Ward, ErrorFunction::Hessian}) {
    auto record = recordAt(vec3(0), vec3(1), 2);
    record.smoothRadius = 1;
    record.unseenDisplacement = 0.06f;
    const CacheSettings wide{function, 1, 10};
    const float even = weightOfOne(wide, record, {0.1f, 0, 0}, kUp, 0.04f),
                low = weightOfOne(wide, record, {0.1f, 0, -0.02f}, kUp, 0.04f);
    EXPECT_GT(low, 0.6f * even);
    EXPECT_LT(low, even);
    EXPECT_EQ(weightOfOne(wide, record, {0.1f, 0, -0.061f}, kUp, 0.04f), 0)
        << "what lies farther behind is another surface";
  }
}

TEST(IrradianceCache, TheFloorOfTheRadiusDoesNotSpanASlotOfParallelSides) {
  for (const auto function : {ErrorFunction::Screen, ErrorFunction::Ward, ErrorFunction::Hessian}) {
    auto record = recordAt(vec3(0), vec3(1), 0.02f);  // of the ceiling, 2 cm over a lamp
    record.smoothRadius = 0.02f;
    record.limit = 0.02f;  // as gather() makes it
    EXPECT_EQ(weightOfOne({function, 1}, record, {0.01f, 0, 0.02f}, kUp, 0.04f), 0) << "the lamp";
    EXPECT_GT(weightOfOne({function, 1}, record, {0.01f, 0, 0.005f}, kUp, 0.04f), 0) << "a bump of the ceiling";
  }
}

TEST(IrradianceCache, ARecordOnWhatItSeesServesItsOwnPlace) {
  EXPECT_GT(weightOfOne({ErrorFunction::Screen, 1}, recordAt(vec3(0), vec3(1), 0), vec3(0), kUp, 0.04f), 0);
}

TEST(IrradianceCache, ASphereIsBehindNoneOfItsOwnRecords) {
  IrradianceRecord record = recordAt({0, 0, 1}, vec3(1), kInfinity);
  for (float degrees = 1; degrees < 10; ++degrees) {
    const vec3 n = tilted(degrees);
    const float weight = weightOfOne({ErrorFunction::Screen, 1}, record, n, n, 0.1f);
    EXPECT_NEAR(weight, 1 - std::sin(degrees * kPi / 360) / std::sin(kPi / 36), 1e-3f) << degrees;
  }
}

TEST(IrradianceCache, AConstantFieldIsReproduced) {
  for (const auto function : {ErrorFunction::Screen, ErrorFunction::Ward}) {
    IrradianceCache cache(kBox, {function, 1});
    for (uint32_t i = 0; i < 300; ++i) {
      const vec3 p = randomIn(i, 1) * vec3(1, 1, 0);
      cache.insert(recordAt(p, {0.5f, 0.25f, 2}, 1 + randomIn(i, 2).x, 0.05f));
    }
    int found = 0;
    for (uint32_t i = 0; i < 200; ++i) {
      const auto estimate = cache.lookup(randomIn(i, 3) * vec3(1, 1, 0), kUp, 0.05f);
      if (estimate.weight == 0) continue;
      ++found;
      EXPECT_NEAR(estimate.E.x, 0.5f, 1e-6f);
      EXPECT_NEAR(estimate.E.z, 2, 1e-5f);
      EXPECT_NEAR(estimate.dominant[1].z, 1, 1e-6f);
    }
    EXPECT_GT(found, 150);
  }
}

TEST(IrradianceCache, ALinearFieldWithExactGradientsIsReproduced) {
  const vec3 slope{0.3f, -0.2f, 0};
  const auto field = [&](const vec3& p) { return 2 + dot(slope, p); };
  IrradianceCache cache(kBox, {});
  for (uint32_t i = 0; i < 200; ++i) {
    const vec3 p = randomIn(i, 4) * vec3(1, 1, 0);
    auto record = recordAt(p, vec3(field(p)), 1, 0.03f);
    for (vec3& g : record.light.translationGradient) g = slope;
    cache.insert(record);
  }
  for (uint32_t i = 0; i < 100; ++i) {
    const vec3 x = randomIn(i, 5) * vec3(1, 1, 0);
    const auto estimate = cache.lookup(x, kUp, 0.03f);
    if (estimate.weight > 0) {
      EXPECT_NEAR(estimate.E.y, field(x), 1e-5f);
    }
  }
}

TEST(IrradianceCache, TheRotationGradientTurnsWithTheNormal) {
  auto record = recordAt(vec3(0), vec3(1));
  record.light.rotationGradient[0] = {0, 0.5f, 0};
  IrradianceCache cache(kBox, {});
  cache.insert(record);
  const vec3 n = tilted(5);
  EXPECT_NEAR(cache.lookup(vec3(0), n, 0.01f).E.x, 1 + 0.5f * n.x, 1e-6f);
  EXPECT_NEAR(cache.lookup(vec3(0), n, 0.01f).E.y, 1, 1e-6f);
}

TEST(IrradianceCache, NoGradientMakesLightNegativeOrMoreThanDoublesIt) {
  auto record = recordAt(vec3(0), {1, 0, 1}, 1, 0.01f);
  for (vec3& g : record.light.translationGradient) g = {1e6f, 0, 0};
  record.light.translationGradient[2] = {kInfinity, 0, 0};
  IrradianceCache cache(kBox, {});
  cache.insert(record);
  for (float x = -0.09f; x < 0.1f; x += 0.01f) {
    const vec3 E = cache.lookup({x, 0, 0}, kUp, 0.01f).E;
    EXPECT_GE(E.x, 0);
    EXPECT_LE(E.x, 2);
    EXPECT_EQ(E.y, 0);
    EXPECT_EQ(E.z, 1);
  }
}

// The tree must find the records that have a weight. Each record has a cache of its own here, which tells its weight.
TEST(IrradianceCache, TheOctreeFindsEveryUsableRecordInsideAndOutsideItsBound) {
  for (const auto function : {ErrorFunction::Screen, ErrorFunction::Ward}) {
    const CacheSettings settings{function, 1};
    IrradianceCache cache({vec3(-0.5f), vec3(0.5f)}, settings);
    std::vector<IrradianceRecord> records;
    for (uint32_t i = 0; i < 150; ++i) {
      const float closest = std::pow(10.0f, 2 * randomIn(i, 6).x - 1);
      const float pixelSize = 0.02f * (1.5f + randomIn(i, 7).x);
      records.push_back(recordAt(randomIn(i, 8) * vec3(1, 1, 0.01f), vec3(1), closest, pixelSize));
      cache.insert(records.back());
    }
    for (uint32_t i = 0; i < 40; ++i) {
      const vec3 x = randomIn(i, 9) * vec3(1, 1, 0.01f);
      const float pixelSize = 0.02f * (1.5f + randomIn(i, 10).x);
      float expected = 0;
      for (const auto& r : records) expected += weightOfOne(settings, r, x, kUp, pixelSize);
      EXPECT_NEAR(cache.lookup(x, kUp, pixelSize).weight, expected, 1e-4f * (1 + expected));
    }
  }
}

TEST(IrradianceCache, TheShapeOfTheTreeLeavesNoTraceInALookup) {
  IrradianceCache tight(kBox, {}), loose({vec3(-20), vec3(9)}, {}), flat(Bound3{}, {});
  for (uint32_t i = 0; i < 500; ++i) {
    const auto record = recordAt(randomIn(i, 11) * vec3(1, 1, 0), glm::abs(randomIn(i, 12)), 0.5f, 0.02f);
    for (auto* cache : {&tight, &loose, &flat}) cache->insert(record);
  }
  for (uint32_t i = 0; i < 100; ++i) {
    const vec3 x = randomIn(i, 13) * vec3(1, 1, 0);
    const vec3 E = tight.lookup(x, kUp, 0.02f).E;
    EXPECT_EQ(E, loose.lookup(x, kUp, 0.02f).E);
    EXPECT_EQ(E, flat.lookup(x, kUp, 0.02f).E);
  }
}

TEST(IrradianceCache, InterpolationIsContinuousWhereARecordEnds) {
  for (const auto function : {ErrorFunction::Screen, ErrorFunction::Ward}) {
    IrradianceCache cache(kBox, {function, 1});
    cache.insert(recordAt({0, 0, 0}, vec3(1)));
    cache.insert(recordAt({0.08f, 0, 0}, vec3(0)));
    float last = cache.lookup({0, 0, 0}, kUp, 0.01f).E.x;
    for (float x = 0.0002f; x < 0.17f; x += 0.0002f) {
      const float E = cache.lookup({x, 0, 0}, kUp, 0.01f).E.x;
      EXPECT_LT(std::abs(E - last), 0.03f) << x;
      last = E;
    }
  }
}

/// A cache of 3000 records, some of which lie outside of its bound.
IrradianceCache denseCache(ErrorFunction function) {
  const bool ward = function == ErrorFunction::Ward || function == ErrorFunction::Split;
  IrradianceCache cache(kBox, {function, ward ? 4.0f : 1.0f, function == ErrorFunction::Split ? kInfinity : 10.0f,
                               function == ErrorFunction::Split ? 0 : 1.5f});
  for (uint32_t i = 0; i < 3000; ++i) {
    IrradianceRecord r =
        recordAt(1.1f * randomIn(i, 1), vec3(1) + 0.02f * randomIn(i, 2), 0.5f * unitFloat(hashCombine(i, 3)));
    r.normal = glm::normalize(kUp + 0.12f * randomIn(i, 4));
    r.smoothRadius = 0.3f;
    cache.insert(r);
  }
  return cache;
}

/// A walk in small steps, with leaps. Half of the places have large pixels.
std::vector<IrradiancePlace> walk() {
  std::vector<IrradiancePlace> places;
  for (uint32_t i = 0; i < 1500; ++i) {
    const vec3 start = randomIn(i / 100, 5), normal = glm::normalize(kUp + 0.1f * randomIn(i, 7));
    places.push_back({start + 0.03f * randomIn(i, 8), normal, glm::normalize(normal + 0.2f * randomIn(i, 6)),
                      i % 100 < 50 ? 0.03f : 0.1f});
  }
  return places;
}

int expectSameBitsOneAtATime(const IrradianceCache& cache, const std::vector<IrradiancePlace>& places,
                             const std::vector<IrradianceEstimate>& all) {
  int found = 0;
  for (size_t i = 0; i < places.size(); ++i) {
    const IrradiancePlace& p = places[i];
    const IrradianceEstimate one = cache.lookup(p.position, p.normal, p.shadingNormal, p.pixelSize);
    EXPECT_EQ(one.weight, all[i].weight);
    EXPECT_EQ(one.E, all[i].E);
    EXPECT_EQ(one.dominant[1], all[i].dominant[1]);
    EXPECT_EQ(one.inconsistent, all[i].inconsistent);
    found += one.weight > 0;
  }
  return found;
}

TEST(IrradianceCache, ManyLookupsAtOnceHaveTheBitsOfOneAtATimeAndOfAFinishedCache) {
  for (const ErrorFunction function : {ErrorFunction::Screen, ErrorFunction::Ward, ErrorFunction::Hessian,
                                       ErrorFunction::Split, ErrorFunction::Plain}) {
    IrradianceCache cache = denseCache(function);
    const std::vector<IrradiancePlace> places = walk();
    std::vector<IrradianceEstimate> all(places.size());
    cache.lookup(places, all.data());
    EXPECT_GT(expectSameBitsOneAtATime(cache, places, all), 100);
    // The large pixels of the walk are larger than was said, and some places lie outside of the bound.
    cache.finish([](const Bound3& box) { return box.lo.x < 0 ? 0.03f : 0.05f; });
    expectSameBitsOneAtATime(cache, places, all);
  }
}

}  // namespace
}  // namespace tomales
