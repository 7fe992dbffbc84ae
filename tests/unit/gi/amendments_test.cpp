// What the amendments of gi/cache/amendments do to records, and where records of the Hessian reach.
#include "gi/irradiance_cache.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/unit/gi/cache_records.h"

namespace tomales {
namespace {

TEST(IrradianceCache, ARecordThatIsWrongAtANewOneEndsBeforeIt) {
  IrradianceCache cache(kBox, {});
  cache.insert(recordAt(vec3(0), vec3(1)));
  cache.insert(recordAt({0.05f, 0, 0}, vec3(2)));
  EXPECT_FLOAT_EQ(cache.records()[0].limit, 0.05f);
  EXPECT_FLOAT_EQ(cache.records()[1].limit, 0.05f);
  EXPECT_NEAR(cache.lookup({-0.04f, 0, 0}, kUp, 0.01f).E.x, 1, 1e-5f) << "the new one would still reach here";
  EXPECT_NEAR(cache.lookup({0.051f, 0, 0}, kUp, 0.01f).E.x, 2, 1e-5f);
}

TEST(IrradianceCache, RecordsServeWiderThanTheyCoverButNotBeyondDisagreementsNorWhereLightIsSteep) {
  const auto served = [](const IrradianceCache& cache, float x) {
    const IrradiancePlace place{{x, 0, 0}, kUp, kUp, 0.01f};
    IrradianceEstimate found;
    cache.lookup({&place, 1}, &found, 1.25f);
    return found;
  };
  for (const float change : {0.0f, 0.15f, 0.31f}) {  // over its reach
    IrradianceCache alone(kBox, {});
    IrradianceRecord record = recordAt(vec3(0), vec3(1));
    for (vec3& gradient : record.light.translationGradient) gradient = {10 * change, 0, 0};
    alone.insert(record);
    EXPECT_EQ(alone.lookup({0.1001f, 0, 0}, kUp, 0.01f).weight, 0);
    const float reach = 0.1f * (change > 0.3f ? 1 : change > 0 ? 1 + 0.25f * 0.75f : 1.25f);
    EXPECT_NEAR(served(alone, 0.09f).weight, 1 - 0.09f / reach, 1e-5f);
    EXPECT_NEAR(served(alone, 0.09f).E.x, 1 + 0.9f * change, 1e-5f);
    EXPECT_EQ(served(alone, 1.001f * reach).weight, 0);
  }

  IrradianceCache inconsistent(kBox, {});
  inconsistent.insert(recordAt(vec3(0), vec3(1)));
  inconsistent.insert(recordAt({0.05f, 0, 0}, vec3(2)));
  EXPECT_NEAR(served(inconsistent, 0.051f).E.x, 2, 1e-5f);
}

TEST(IrradianceCache, DisagreementsShortenNoRecordBelowAPixelOverKappa) {
  for (const float kappa : {1.0f, 2.0f}) {
    IrradianceCache cache(kBox, {ErrorFunction::Screen, kappa});
    const float pixel = 0.01f, least = pixel / kappa;
    cache.insert(recordAt(vec3(0), vec3(1), 1, pixel));
    cache.insert(recordAt({0.2f * least, 0, 0}, vec3(1.5f), 1, pixel));
    EXPECT_FLOAT_EQ(cache.records()[0].limit, least);
    EXPECT_NEAR(cache.lookup({-0.5f * least, 0, 0}, kUp, pixel).weight, 0.5f + 0.3f, 1e-4f);
    EXPECT_FALSE(cache.lookup({-0.5f * least, 0, 0}, kUp, pixel).inconsistent)
        << "a third record would lie closer than a pixel";
  }
}

TEST(IrradianceCache, LightIsTornByWallsThinnerThanAPixel) {
  IrradianceCache cache(kBox, {});
  cache.insert(recordAt(vec3(0), vec3(1)));
  cache.insert(recordAt({0.002f, 0, 0}, vec3(0)));
  EXPECT_FLOAT_EQ(cache.records()[0].limit, 0.002f);
  EXPECT_EQ(cache.lookup({0.003f, 0, 0}, kUp, 0.01f).E, vec3(0));
}

TEST(IrradianceCache, WhatIsDarkerThanATenthOfTheMeanDisagreesByNoFractionOfItself) {
  IrradianceCache cache(kBox, {});
  cache.insert(recordAt({0.5f, 0, 0}, vec3(1)));
  cache.insert(recordAt(vec3(0), vec3(1e-4f)));
  cache.insert(recordAt({0.05f, 0, 0}, vec3(2e-4f)));
  EXPECT_EQ(cache.records()[1].limit, kInfinity);
  EXPECT_FALSE(cache.lookup({0.02f, 0, 0}, kUp, 0.01f).inconsistent);
}

TEST(IrradianceCache, NoiseIsNoDisagreement) {
  IrradianceCache cache(kBox, {});
  IrradianceRecord a = recordAt(vec3(0), vec3(1)), b = recordAt({0.05f, 0, 0}, vec3(1.5f));
  a.noise = b.noise = 0.1f;
  cache.insert(a);
  cache.insert(b);
  EXPECT_EQ(cache.records()[0].limit, kInfinity);
  const IrradianceEstimate between = cache.lookup({0.02f, 0, 0}, kUp, 0.01f);
  EXPECT_FALSE(between.inconsistent);
  EXPECT_GT(between.E.x, 1.1f);
}

TEST(IrradianceCache, AFewRecordsThatDisagreeWantAnotherOneAndACrowdOfThemDoesNot) {
  for (const uint32_t count : {10u, 60u}) {
    IrradianceCache cache(kBox, {ErrorFunction::Screen, 1});
    for (uint32_t i = 0; i < count; ++i)  // Every fifth record has found light.
      cache.restore(recordAt(0.02f * randomIn(i, 1) * vec3(1, 1, 0), vec3(i % 5 == 0 ? 1.0f : 0.0f)));
    const IrradianceEstimate seen = cache.lookup(vec3(0), kUp, 0.01f);
    EXPECT_GT(seen.weight, 1);
    EXPECT_EQ(seen.inconsistent, count == 10);
  }
}

TEST(IrradianceCache, TheHessianReachesAsFarAsLightIsSmoothButNotPastWhatItSees) {
  const CacheSettings hessian{ErrorFunction::Hessian, 1, 40};
  IrradianceRecord r = recordAt(vec3(0), vec3(1), 0.5f);
  r.smoothRadius = 0.2f;
  EXPECT_NEAR(weightOfOne(hessian, r, {0.05f, 0, 0}, kUp, 0.01f), 0.75f, 1e-5f);
  r.closest = 0.1f;
  EXPECT_NEAR(weightOfOne(hessian, r, {0.05f, 0, 0}, kUp, 0.01f), 0.5f, 1e-5f);
}

TEST(IrradianceCache, AQuadraticFieldIsReproducedByRecordsThatKnowTheirSecondDerivatives) {
  const auto field = [](const vec3& p) {
    return 2 + 0.3f * p.x + 0.8f * p.x * p.x - 0.6f * p.x * p.y + 0.4f * p.y * p.y;
  };
  IrradianceCache cache(kBox, {ErrorFunction::Hessian, 1, 40});
  for (uint32_t i = 0; i < 200; ++i) {
    const vec3 p = randomIn(i, 4) * vec3(1, 1, 0);
    auto record = recordAt(p, vec3(field(p)), 1, 0.01f);
    for (vec3& g : record.light.translationGradient) g = {0.3f + 1.6f * p.x - 0.6f * p.y, 0.8f * p.y - 0.6f * p.x, 0};
    record.smoothRadius = 0.3f;
    record.tangent = normalizeOr(vec3(1, 2, 0), vec3(0));
    // This is the Hessian of 0.8 xx - 0.6 xy + 0.4 yy, whose axes are (1, 2) and (-2, 1).
    record.light.hessian[0] = vec3(0.48f);
    record.light.hessian[1] = vec3(0.04f);
    record.light.hessian[2] = vec3(1.92f);
    cache.insert(record);
  }
  for (uint32_t i = 0; i < 100; ++i) {
    const vec3 x = randomIn(i, 5) * vec3(1, 1, 0);
    ASSERT_GT(cache.lookup(x, kUp, 0.01f).weight, 0);
    EXPECT_NEAR(cache.lookup(x, kUp, 0.01f).E.y, field(x), 1e-4f);
  }
}

TEST(IrradianceCache, AmongRecordsOnAllSidesGradientsAloneSayHowLightBends) {
  for (const ErrorFunction function : {ErrorFunction::Screen, ErrorFunction::Ward, ErrorFunction::Hessian}) {
    IrradianceCache cache(kBox, {function, 1, 40});
    for (const vec3& p : {vec3(0.1f, 0, 0), vec3(-0.1f, 0, 0)}) {
      auto record = recordAt(p, vec3(1 + 4 * p.x * p.x));
      for (vec3& g : record.light.translationGradient) g = {8 * p.x, 0, 0};
      record.smoothRadius = 0.3f;
      cache.insert(record);
    }
    EXPECT_NEAR(cache.lookup(vec3(0), kUp, 0.01f).E.x, 1, 1e-5f);
  }
}

TEST(IrradianceCache, ASecondDerivativeHoldsAsFarAsItsRecordReaches) {
  // The nearer of two records on one side is beside an edge, where light bends a lot for a short way.
  IrradianceCache cache(kBox, {ErrorFunction::Hessian, 1, 40});
  for (const bool edge : {false, true}) {
    auto r = recordAt({edge ? -0.015f : -0.25f, 0, 0}, vec3(1));
    r.smoothRadius = edge ? 0.02f : 0.3f;
    r.tangent = {1, 0, 0};
    r.light.hessian[0] = vec3(edge ? -200.0f : 0.0f);
    cache.insert(r);
  }
  EXPECT_NEAR(cache.lookup(vec3(0), kUp, 0.01f).E.x, 1, 0.05f);
}

TEST(IrradianceCache, BeyondAShadowsEdgeBendingLightsNoDark) {
  // Light that falls to nothing as a parabola does, and stays there.
  const auto light = [](float x) { return x > 0 ? x * x : 0; };
  for (const ErrorFunction f : {ErrorFunction::Screen, ErrorFunction::Hessian}) {
    IrradianceCache cache(kBox, {f, 1});
    for (const float x : {-0.05f, 0.05f}) {
      IrradianceRecord r = recordAt({x, 0, 0}, vec3(light(x)), 9);
      r.smoothRadius = 0.1f;
      r.tangent = {1, 0, 0};
      for (int c = 0; c < 3; ++c) r.light.translationGradient[c].x = x > 0 ? 2 * x : 0;
      r.light.hessian[0] = vec3(x > 0 ? 2.0f : 0.0f);
      cache.insert(r);
    }
    for (const float x : {-0.04f, -0.02f, 0.0f}) {
      const float lit = (x + 0.05f) / 0.1f;  // the share of the lit record, whose light ends with its reach
      EXPECT_LE(cache.lookup({x, 0, 0}, kUp, 0.01f).E.x, 1.001f * lit * lit * light(0.05f)) << x;
    }
  }
}

TEST(IrradianceCache, NoSecondDerivativeMakesLightNegativeOrMoreThanDoublesIt) {
  for (const float bend : {-1e6f, 1e6f, kInfinity}) {
    auto record = recordAt(vec3(0), vec3(1));
    record.smoothRadius = 0.3f;
    record.tangent = {1, 0, 0};
    record.light.hessian[0] = vec3(bend);
    IrradianceCache cache(kBox, {ErrorFunction::Hessian, 1, 40});
    cache.insert(record);
    const float E = cache.lookup({0.25f, 0, 0}, kUp, 0.01f).E.x;
    EXPECT_GE(E, 0);
    EXPECT_LE(E, 2);
  }
}

TEST(IrradianceCache, TheSplitSphereAsPublishedKnowsNoPixelsAndNoDisagreements) {
  const CacheSettings split{ErrorFunction::Split, 4, kInfinity, 0};
  IrradianceRecord far = recordAt(vec3(0), vec3(1), 9), near = recordAt(vec3(0), vec3(1), 0.01f);
  far.harmonicMean = 2;
  near.harmonicMean = 0.02f;
  for (const float pixelSize : {0.001f, 0.1f}) {
    EXPECT_NEAR(weightOfOne(split, far, {0.25f, 0, 0}, kUp, pixelSize), 1, 1e-5f);
    EXPECT_EQ(weightOfOne(split, near, {0.006f, 0, 0}, kUp, pixelSize), 0);
  }
  IrradianceCache cache(kBox, split);
  cache.insert(recordAt(vec3(0), vec3(1)));
  cache.insert(recordAt({0.05f, 0, 0}, vec3(3)));
  EXPECT_EQ(cache.records()[0].limit, kInfinity);
}

TEST(IrradianceCache, PlainIsScreenAsPublished) {
  const auto bent = [](float x) {
    IrradianceRecord r = recordAt({x, 0, 0}, vec3(1 + 40 * x * x), 9);
    for (vec3& g : r.light.translationGradient) g = {80 * x, 0, 0};
    return r;
  };
  IrradianceCache screen(kBox, {}), plain(kBox, {ErrorFunction::Plain});
  for (auto* cache : {&screen, &plain}) {
    cache->insert(bent(-0.05f));
    cache->insert(bent(0.05f));
  }
  const IrradianceEstimate between = plain.lookup(vec3(0), kUp, 0.01f);
  EXPECT_FLOAT_EQ(between.weight, screen.lookup(vec3(0), kUp, 0.01f).weight);
  EXPECT_NEAR(between.E.x, 0.9f, 1e-5f) << "each record says 1.1 - 0.2; blended to the second order it is 1";

  IrradianceCache torn(kBox, {ErrorFunction::Plain});
  torn.insert(recordAt(vec3(0), vec3(1)));
  torn.insert(recordAt({0.05f, 0, 0}, vec3(3)));
  EXPECT_EQ(torn.records()[0].limit, kInfinity);
  const IrradiancePlace beyond{{-0.11f, 0, 0}, kUp, kUp, 0.01f};
  IrradianceEstimate found;
  torn.lookup({&beyond, 1}, &found, 1.25f);
  EXPECT_EQ(found.weight, 0) << "11 pixels from the first";
}

TEST(IrradianceCache, AnEdgeThatARecordHasMetIsNoSheetOverIt) {
  IrradianceCache cache(kBox, {});
  IrradianceRecord beside = recordAt(vec3(0), vec3(1), 0.01f), inconsistent = recordAt({0.02f, 0, 0}, vec3(1), 0.3f);
  beside.limit = 2;
  inconsistent.limit = 0.02f;
  cache.insert(beside);
  EXPECT_EQ(cache.lookup({0.01f, 0, 0}, kUp, 0.02f).occluderHeight, 2);
  cache.insert(inconsistent);
  EXPECT_EQ(cache.lookup({0.01f, 0, 0}, kUp, 0.02f).occluderHeight, 0.3f);
}

}  // namespace
}  // namespace tomales
