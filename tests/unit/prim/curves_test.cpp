#include "tests/unit/prim/thin.h"

namespace tomales {
namespace {
using namespace test;

PrimPtr curves(bool cubic, const Basis& basis, const std::vector<int>& counts, bool periodic, ParamList params) {
  Problems problems;
  const PrimPtr prim = makeCurves(cubic, basis, counts, periodic, params, problems);
  EXPECT_TRUE(problems.empty());
  return prim;
}

std::vector<PrimPtr> manyCurves() {
  const auto of = [](int n) { return positions(wiggle(n)); };
  std::vector<float> up;
  for (uint32_t i = 0; i < 18; ++i) up.push_back(i % 3 == 2 ? 1.0f : 0.4f * noise(i + 900));
  const Param normals = floats("N", Storage::Vertex, ValueType::Normal, up);
  return {
      seen(curves(true, bezierBasis(), {7, 4}, false, {of(11), width(Storage::Varying, {.1f, .2f, .3f, .1f, .2f})})),
      seen(curves(true, bsplineBasis(), {6}, true, {of(6), width(Storage::Vertex, {.1f, .2f, .3f, .1f, .2f, .1f})})),
      seen(curves(true, catmullRomBasis(), {6}, false, {of(6), width(Storage::Constant, {.1f})})),
      seen(curves(false, bezierBasis(), {5, 2}, false,
                  {of(7), width(Storage::Varying, {.1f, .2f, .3f, .1f, .2f, .1f, .1f})})),
      seen(curves(false, bezierBasis(), {6}, true, {of(6), width(Storage::Constant, {.2f})})),
      curves(true, bsplineBasis(), {6}, false, {of(6), normals, width(Storage::Constant, {.3f})}),
      curves(true, hermiteBasis(), {6}, false, {of(6)})};
}

TEST(Curves, HaveRISpecsNumberOfSegments) {
  const uint32_t expected[] = {3, 6, 3, 5, 6, 3, 2};
  const std::vector<PrimPtr> all = manyCurves();
  for (size_t k = 0; k < all.size(); ++k) EXPECT_EQ(all[k]->patchCount(), expected[k]) << k;
}

TEST(Curves, DerivativesAgreeWithFiniteDifferences) {
  for (const PrimPtr& prim : manyCurves()) expectDerivativesOfPositions(*prim, 5e-3f);
}

TEST(Curves, BoundsContainTheRibbonAndItIsSoundEverywhere) {
  for (const PrimPtr& prim : manyCurves()) {
    expectBoundsContainTheSurface(*prim, 10000, 15);  // a ribbon may turn to any side
    expectSoundEverywhere(*prim);
  }
}

TEST(Curves, TheMiddleOfTheRibbonIsTheCurve) {
  const std::vector<float> p = wiggle(6);
  const PrimPtr prim = curves(true, bsplineBasis(), {6}, false, {positions(p)});
  for (uint32_t k = 0; k < 1000; ++k) {
    const uint32_t patch = k % 3;
    const float t = unitFloat(hash32(k));
    const double s = 1 - t, t2 = t * t, t3 = t2 * t;
    const double w[4] = {s * s * s / 6, (3 * t3 - 6 * t2 + 4) / 6, (-3 * t3 + 3 * t2 + 3 * t + 1) / 6, t3 / 6};
    glm::dvec3 expected(0);
    for (size_t i = 0; i < 4; ++i)
      for (int axis = 0; axis < 3; ++axis) expected[axis] += w[i] * p[3 * (patch + i) + static_cast<size_t>(axis)];
    EXPECT_LT(glm::length(glm::dvec3(sampleAt(*prim, patch, 0.5f, t).p) - expected), 1e-5);
  }
}

TEST(Curves, RibbonsAreAsWideAsTheySayAndFaceTheEye) {
  const PrimPtr prim = manyCurves()[2];
  for (uint32_t patch = 0; patch < 3; ++patch)
    for (float v : {0.0f, 0.3f, 0.7f, 1.0f}) {
      const Sample s = sampleAt(*prim, patch, 0.5f, v);
      EXPECT_NEAR(glm::length(sampleAt(*prim, patch, 1, v).p - sampleAt(*prim, patch, 0, v).p), 0.1f, 1e-6f);
      EXPECT_NEAR(dot(glm::normalize(s.du), glm::normalize(kEye - s.p)), 0, 1e-5f);
      EXPECT_GT(dot(s.n, kEye - s.p), 0);
    }
}

TEST(Curves, LieAcrossTheirDirectionAlsoAtDoubledEnds) {
  const PrimPtr prim = curves(true, bezierBasis(), {4}, false,
                              {positions({0, 0, 0, 0, 0, 0, 1, 1, 0, 1, 1, 0}), width(Storage::Constant, {.2f})})
                           ->facing({0, 0, -9}, {0, 0, 1}, false);
  for (const float v : {0.0f, 0.5f, 1.0f}) {
    const vec3 across = sampleAt(*prim, 0, 1, v).p - sampleAt(*prim, 0, 0, v).p;
    EXPECT_NEAR(glm::length(across), 0.2f, 1e-6f) << v;
    EXPECT_NEAR(dot(across, vec3(1, 1, 0)), 0, 1e-4f) << v;
  }
}

TEST(Curves, WithoutPerspectiveTheyFaceTheDirection) {
  const PrimPtr prim = curves(false, bezierBasis(), {2}, false, {positions({0, 0, 0, 3, 0, 0})});
  const Sample s = sampleAt(*prim->facing({5, 5, 5}, {0, 1, 0}, false), 0, 0.5f, 0.5f);
  EXPECT_NEAR(glm::normalize(s.n).y, -1, 1e-6f);
}

TEST(Curves, OrientedRibbonsFaceTheirNormalAndNoEye) {
  const PrimPtr prim =
      curves(false, bezierBasis(), {2}, false,
             {positions({0, 0, 0, 3, 0, 0}), floats("N", Storage::Varying, ValueType::Normal, {0, 1, 0, 0, 1, 0})});
  EXPECT_EQ(prim->facing(kEye, {0, 0, 1}, true), nullptr);
  EXPECT_EQ(glm::normalize(sampleAt(*prim, 0, 0.2f, 0.5f).n), vec3(0, 1, 0));
  EXPECT_NEAR(dicedArea(*prim, 1), 3, 1e-6);
}

TEST(Curves, SegmentsMeetAtMitres) {
  const PrimPtr prim = manyCurves()[3];
  for (uint32_t patch = 0; patch < 3; ++patch)
    for (float u : {0.0f, 0.5f, 1.0f})
      EXPECT_LT(glm::length(sampleAt(*prim, patch, u, 1).p - sampleAt(*prim, patch + 1, u, 0).p), 1e-6f);
  EXPECT_EQ(prim->info(0).openEdges, kAllEdges & ~kEdgeV1);
  EXPECT_EQ(prim->info(1).openEdges, kEdgeU0 | kEdgeU1);
  EXPECT_EQ(prim->info(4).openEdges, kAllEdges);
}

TEST(Curves, LinesKeepTheirWidthRoundCorners) {
  const std::vector<vec3> zigzag = {{0, 0, 0}, {1, 2, 0}, {2, 0, 0}, {3, 2, 0}};
  std::vector<float> p;
  for (const vec3& q : zigzag) p.insert(p.end(), {q.x, q.y, q.z});
  const PrimPtr prim = curves(false, bezierBasis(), {4}, false, {positions(p), width(Storage::Constant, {.2f})})
                           ->facing({0, 0, -9}, {0, 0, 1}, false);
  for (uint32_t patch = 0; patch < 3; ++patch)
    for (const float v : {0.0f, 0.3f, 0.7f, 1.0f})
      for (const float u : {0.0f, 1.0f}) {
        const vec3 along = glm::normalize(zigzag[patch + 1] - zigzag[patch]),
                   from = sampleAt(*prim, patch, u, v).p - zigzag[patch];
        EXPECT_NEAR(glm::length(from - along * dot(along, from)), 0.1f, 1e-6f) << patch << " " << u << " " << v;
      }
  EXPECT_GT(glm::length(sampleAt(*prim, 0, 0, 1).p - sampleAt(*prim, 0, 1, 1).p), 0.4f);
}

TEST(Curves, CornersOfLinesReachNoFartherThanThreeWidths) {
  const PrimPtr prim = curves(false, bezierBasis(), {3}, false,
                              {positions({0, 0, 0, 3, 0.1f, 0, 0, 0.2f, 0}), width(Storage::Constant, {.2f})})
                           ->facing({0, 0, -9}, {0, 0, 1}, false);
  EXPECT_NEAR(glm::length(sampleAt(*prim, 0, 0, 1).p - sampleAt(*prim, 0, 1, 1).p), 0.6f, 1e-4f);
}

TEST(Curves, CornersThatTheEyeDoesNotSeeAreNoWider) {
  const PrimPtr prim = curves(false, bezierBasis(), {3}, false,
                              {positions({0, 0, 0, 1, 0, 2, 2, 0, 0}), width(Storage::Constant, {.2f})})
                           ->facing({0, 0, 0}, {0, 0, 1}, false);
  EXPECT_NEAR(glm::length(sampleAt(*prim, 0, 0, 1).p - sampleAt(*prim, 0, 1, 1).p), 0.2f, 1e-6f);
}

TEST(Curves, InterpolateEveryStorageAndRunAlongV) {
  const PrimPtr prim = curves(false, bezierBasis(), {3, 2}, false,
                              {positions(wiggle(5)), floats("k", Storage::Uniform, ValueType::Float, {7, 8}),
                               floats("c", Storage::Varying, ValueType::Float, {0, 1, 3, 5, 7}),
                               floats("e", Storage::Vertex, ValueType::Float, {0, 1, 3, 5, 7})});
  EXPECT_EQ(primvarAt(*prim, 2, 0, 0.5f, 0.5f)[0], 8);
  for (int index : {1, 2}) {
    EXPECT_NEAR(primvarAt(*prim, 1, index, 0.1f, 0.5f)[0], 2, 1e-6f);
    EXPECT_NEAR(primvarAt(*prim, 2, index, 0.1f, 1)[0], 7, 1e-6f);
  }
  const float u = 0.2f, v = 0.5f;
  float su, sv;
  prim->surfaceParameters(1, 1, &u, &v, &su, &sv);
  EXPECT_EQ(su, u);
  EXPECT_EQ(sv, 0.75f);
}

PrimPtr tubes(bool cubic, const Basis& basis, const std::vector<int>& counts, bool periodic, ParamList params) {
  Problems problems;
  const PrimPtr prim = makeTubes(cubic, basis, counts, periodic, params, problems);
  EXPECT_TRUE(problems.empty());
  return prim;
}

std::vector<PrimPtr> manyTubes() {
  const auto of = [](int n) { return positions(wiggle(n)); };
  return {
      tubes(true, bezierBasis(), {7, 4}, false, {of(11), width(Storage::Varying, {.1f, .2f, .3f, .1f, .2f})}),
      tubes(true, bsplineBasis(), {6}, true, {of(6), width(Storage::Vertex, {.1f, .2f, .3f, .1f, .2f, .1f})}),
      tubes(true, catmullRomBasis(), {6}, false, {of(6), width(Storage::Constant, {.1f})}),
      tubes(false, bezierBasis(), {5, 2}, false, {of(7), width(Storage::Varying, {.1f, .2f, .3f, .1f, .2f, .1f, .1f})}),
      tubes(false, bezierBasis(), {6}, true, {of(6), width(Storage::Constant, {.2f})})};
}

TEST(Tubes, DerivativesAgreeWithFiniteDifferences) {
  // Not over the places where the carried direction has a bend: v = 1/4, 1/2, 3/4 are none of those tested.
  for (const PrimPtr& prim : manyTubes()) expectDerivativesOfPositions(*prim, 8e-3f);
}

// A section turns from one mitre to the next, so that a thick tube has longer sides outside of a corner than inside.
TEST(Tubes, OfThickLinesTurnFromMitreToMitre) {
  const PrimPtr prim = tubes(false, bezierBasis(), {4}, false,
                             {positions({0, 0, 0, 1, 2, 0, 2, 0, 1, 3, 2, 0}), width(Storage::Constant, {.6f})});
  expectDerivativesOfPositions(*prim, 2e-3f);
}

TEST(Tubes, BoundsContainThemAndTheyAreSoundEverywhere) {
  for (const PrimPtr& prim : manyTubes()) {
    expectBoundsContainTheSurface(*prim);
    expectSoundEverywhere(*prim);
  }
}

TEST(Tubes, LieAtTheirRadiusFromTheCurveWithNormalsOutward) {
  for (const PrimPtr& tube : {manyTubes()[0], manyTubes()[1], manyTubes()[2]})  // polylines have mitres
    for (uint32_t patch = 0; patch < 2; ++patch)
      for (const float v : {0.1f, 0.6f, 0.9f}) {
        const vec3 center = 0.5f * (sampleAt(*tube, patch, 0, v).p + sampleAt(*tube, patch, 0.5f, v).p);
        const float radius = glm::length(sampleAt(*tube, patch, 0, v).p - center);
        EXPECT_GT(radius, 0.04f);
        for (const float u : {0.0f, 0.2f, 0.7f}) {
          const Sample s = sampleAt(*tube, patch, u, v);
          EXPECT_NEAR(glm::length(s.p - center), radius, 1e-5f);
          EXPECT_GT(dot(s.n, s.p - center), 0.2f * glm::length(s.n) * radius);
        }
      }
}

TEST(Tubes, OfAStraightLineAreClosedCylinders) {
  const PrimPtr prim =
      tubes(false, bezierBasis(), {2}, false, {positions({0, 0, 0, 0, 3, 0}), width(Storage::Constant, {2})});
  ASSERT_EQ(prim->patchCount(), 3u);
  expectAreaAtSecondOrder(*prim, 2 * M_PI * 3 + 2 * M_PI);
  // The flux of the position through a closed surface is three times its volume.
  constexpr int kSide = 64;
  double flux = 0;
  for (uint32_t patch = 0; patch < 3; ++patch)
    for (int j = 0; j < kSide; ++j)
      for (int i = 0; i < kSide; ++i) {
        const Sample s = sampleAt(*prim, patch, (i + 0.5f) / kSide, (j + 0.5f) / kSide);
        flux += dot(s.p, cross(s.du, s.dv));
        EXPECT_GT(dot(cross(s.du, s.dv), s.n), 0);
      }
  EXPECT_NEAR(flux / kSide / kSide / 3, 3 * M_PI, 1e-4);
}

TEST(Tubes, SegmentsAndTheEndsOfClosedOnesMeet) {
  const std::vector<PrimPtr> all = manyTubes();
  for (const auto& [prim, first, second] :
       {std::tuple{all[1], 0u, 1u}, {all[1], 5u, 0u}, {all[2], 1u, 2u}, {all[3], 0u, 1u}, {all[4], 5u, 0u}})
    for (const float u : {0.0f, 0.25f, 0.8f, 1.0f})
      EXPECT_LT(glm::length(sampleAt(*prim, first, u, 1).p - sampleAt(*prim, second, u, 0).p), 1e-5f) << first;
}

TEST(Tubes, OfAFewSidesAreAsWideAsTheyShouldOnAverage) {
  const PrimPtr prim =
      tubes(false, bezierBasis(), {2}, false, {positions({0, 0, 0, 0, 3, 0}), width(Storage::Constant, {2})});
  for (const int nu : {3, 4, 7}) {
    std::vector<float> u, v, f(12 * size_t{100});
    for (int j = 0; j <= 1; ++j)
      for (int i = 0; i <= nu; ++i) {
        u.push_back(static_cast<float>(i) / static_cast<float>(nu));
        v.push_back(static_cast<float>(j));
      }
    const auto a = [&](size_t k) { return &f[100 * k]; };
    prim->evaluateLattice(0, nu, 1, u.data(), v.data(),
                          {a(0), a(1), a(2), a(3), a(4), a(5), a(6), a(7), a(8), a(9), a(10), a(11)});
    double perimeter = 0;
    for (size_t i = 0; i < static_cast<size_t>(nu); ++i)
      perimeter += std::hypot(a(0)[i + 1] - a(0)[i], a(2)[i + 1] - a(2)[i]);
    EXPECT_NEAR(perimeter, 2 * M_PI, 1e-4) << nu;
  }
}

TEST(Tubes, InterpolateAlongVAndEndsTakeTheEndsValues) {
  const PrimPtr prim =
      tubes(false, bezierBasis(), {3}, false,
            {positions({0, 0, 0, 0, 1, 0, 0, 2, 0}), floats("c", Storage::Varying, ValueType::Float, {5, 6, 8})});
  ASSERT_EQ(prim->patchCount(), 4u);
  EXPECT_EQ(primvarAt(*prim, 1, 0, 0.3f, 0.5f)[0], 7);
  EXPECT_EQ(primvarAt(*prim, 2, 0, 0.3f, 0.5f)[0], 5);
  EXPECT_EQ(primvarAt(*prim, 3, 0, 0.3f, 0.5f)[0], 8);
  EXPECT_EQ(prim->facing(kEye, {0, 0, 1}, true), nullptr);
}

TEST(Tubes, ParametersRunAlongTheWholeCurveAndStandStillOnItsEnds) {
  Problems problems;
  const PrimPtr prim = makeTubes(false, bezierBasis(), {4}, false,
                                 {positions({0, 0, 0, 1, 0, 0, 2, 0, 0, 3, 0, 0}),
                                  floats("constantwidth", Storage::Constant, ValueType::Float, {0.2f})},
                                 problems);
  int beginnings = 0, ends = 0;
  float reached = 0;
  for (uint32_t patch = 0; patch < prim->patchCount(); ++patch) {
    const float u = 0.25f, v[] = {0, 0.5f, 1};
    for (const float at : v) {
      float su = -1, sv = -1;
      prim->surfaceParameters(patch, 1, &u, &at, &su, &sv);
      const vec3 p = sampleAt(*prim, patch, u, at).p;
      EXPECT_EQ(su, u);
      EXPECT_NEAR(sv, p.x / 3, 1e-6f) << "the line runs evenly along x";
      reached = std::max(reached, sv);
      beginnings += at == 0.5f && sv == 0;
      ends += at == 0.5f && sv == 1;
    }
  }
  EXPECT_EQ(reached, 1);
  EXPECT_EQ(beginnings, 1);
  EXPECT_EQ(ends, 1);
}

TEST(NastyCurves, DegenerateOnesAreSound) {
  const auto sound = [](const PrimPtr& prim) { expectSoundEverywhere(*seen(prim)); };
  sound(curves(true, bezierBasis(), {4}, false, {positions({0, 0, 0, 0, 0, 0, 1, 1, 0, 1, 1, 0})}));  // doubled ends
  sound(curves(true, bezierBasis(), {4}, false, {positions(std::vector<float>(12, 1.0f))}));          // a point
  sound(curves(false, bezierBasis(), {3}, false, {positions({0, 0, 0, 1, 0, 0, 0, 0, 0})}));          // there and back
  sound(
      curves(false, bezierBasis(), {2}, false, {positions({kEye.x, kEye.y, 0, kEye.x, kEye.y, 5})}));  // along the view
  sound(curves(false, bezierBasis(), {2}, false, {positions({0, 0, 0, 1, 0, 0}), width(Storage::Constant, {0})}));
}

TEST(NastyCurves, DegenerateTubesAreSound) {
  const auto sound = [](bool cubic, int count, const std::vector<float>& p, bool periodic = false) {
    expectSoundEverywhere(
        *tubes(cubic, bezierBasis(), {count}, periodic, {positions(p), width(Storage::Constant, {.2f})}));
  };
  sound(true, 4, {0, 0, 0, 0, 0, 0, 1, 1, 0, 1, 1, 0});         // doubled ends
  sound(true, 4, std::vector<float>(12, 1.0f));                 // a point
  sound(true, 4, {0, 0, 0, 3, 1, 0, -2, 1, 0, 1, 0, 0});        // a loop
  sound(true, 4, {0, 0, 0, 1, 1, 0, 0, 1, 0, 1, 0, 0});         // a cusp
  sound(false, 3, {0, 0, 0, 1, 0, 0, 0, 0, 0});                 // there and back
  sound(false, 3, {0, 0, 0, 0, 0, 0, 1, 0, 0});                 // a line of no length, and one with
  sound(false, 3, {0, 0, 0, 1, 0, 0, 1, 0, 0});                 // the other way round
  sound(false, 2, std::vector<float>(6, 1.0f));                 // a point
  sound(false, 4, {0, 0, 0, 1, 0, 0, 1, 1, 0, 1, 1, 0}, true);  // closed, with a line of no length
}

TEST(Curves, RibbonsAreLoneAndTubesAreClosedAllAround) {
  const ParamList line = {positions({0, 0, 0, 1, 0, 0})};
  const PrimPtr ribbon = curves(false, bezierBasis(), {2}, false, line),
                tube = tubes(false, bezierBasis(), {2}, false, line);
  EXPECT_TRUE(ribbon->isLone());
  EXPECT_FALSE(tube->isLone());
  for (uint32_t patch = 0; patch < tube->patchCount(); ++patch) EXPECT_EQ(tube->info(patch).openEdges, 0);
}

TEST(NastyCurves, WrongInputThrowsASentence) {
  Problems problems;
  const auto errorWith = [&](bool cubic, const Basis& basis, const std::vector<int>& counts, const ParamList& params) {
    return errorOf([&] { makeCurves(cubic, basis, counts, false, params, problems); });
  };
  EXPECT_EQ(errorWith(false, bezierBasis(), {1}, {positions({0, 0, 0})}),
            "curve 0 has 1 vertices, which make no whole number of segments");
  EXPECT_NE(errorWith(true, bezierBasis(), {5}, {positions(wiggle(5))}), "");
  EXPECT_NE(errorWith(true, {mat4(1.0f), 0}, {4}, {positions(wiggle(4))}), "");
  EXPECT_NE(errorWith(false, bezierBasis(), {-2}, {positions(wiggle(2))}), "");
  EXPECT_NE(errorWith(false, bezierBasis(), {}, {}), "");
  EXPECT_NE(errorWith(false, bezierBasis(), {3}, {positions(wiggle(2))}), "");
  EXPECT_NE(errorWith(false, bezierBasis(), {2}, {positions({0, 0, 0, NAN, 0, 0})}), "");
  EXPECT_NE(errorWith(false, bezierBasis(), {2}, {positions(wiggle(2)), width(Storage::Constant, {-1})}), "");
  EXPECT_NE(errorWith(false, bezierBasis(), {2}, {positions(wiggle(2)), width(Storage::Varying, {1, NAN})}), "");
}

}  // namespace
}  // namespace tomales
