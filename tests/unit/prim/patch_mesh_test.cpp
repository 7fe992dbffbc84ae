#include "tests/unit/prim/support.h"

namespace tomales {
namespace {
using namespace test;

float jitter(uint32_t i) { return 2 * unitFloat(hash32(i + 77)) - 1; }

std::vector<float> randomPoints(int nu, int nv) {
  std::vector<float> p;
  for (int j = 0; j < nv; ++j)
    for (int i = 0; i < nu; ++i)
      for (int axis = 0; axis < 3; ++axis)
        p.push_back((axis == 0 ? i : axis == 1 ? j : 0) + jitter(static_cast<uint32_t>((j * nu + i) * 3 + axis)));
  return p;
}

PrimPtr bicubic(int nu, bool uPeriodic, const Basis& ub, int nv, bool vPeriodic, const Basis& vb,
                ParamList params = {}) {
  Problems problems;
  params.push_back(positions(randomPoints(nu, nv)));
  const PrimPtr prim = makeBicubicPatchMesh(nu, uPeriodic, ub, nv, vPeriodic, vb, params, problems);
  EXPECT_TRUE(problems.empty());
  return prim;
}

std::vector<PrimPtr> manyMeshes() {
  Problems problems;
  return {bicubic(4, false, bezierBasis(), 4, false, bezierBasis()),
          bicubic(7, false, bezierBasis(), 10, false, bezierBasis()),
          bicubic(6, true, bezierBasis(), 5, false, bsplineBasis()),
          bicubic(6, false, catmullRomBasis(), 7, true, bsplineBasis()),
          bicubic(6, false, hermiteBasis(), 4, false, catmullRomBasis()),
          bicubic(8, false, powerBasis(), 4, false, powerBasis()),
          makeBilinearPatchMesh(5, true, 4, false, {positions(randomPoints(5, 4))}, problems),
          makeBilinearPatchMesh(2, false, 2, false, {positions(randomPoints(2, 2))}, problems)};
}

TEST(PatchMesh, HasRISpecsNumberOfPatches) {
  EXPECT_EQ(bicubic(7, false, bezierBasis(), 10, false, bezierBasis())->patchCount(), 6u);
  EXPECT_EQ(bicubic(6, true, bezierBasis(), 5, false, bsplineBasis())->patchCount(), 4u);
  EXPECT_EQ(bicubic(6, false, hermiteBasis(), 4, false, catmullRomBasis())->patchCount(), 2u);
}

TEST(PatchMesh, DerivativesAgreeWithFiniteDifferences) {
  for (const PrimPtr& prim : manyMeshes()) expectDerivativesOfPositions(*prim, 5e-3f);
}

TEST(PatchMesh, BoundsContainTheSurface) {
  for (const PrimPtr& prim : manyMeshes()) expectBoundsContainTheSurface(*prim);
}

TEST(PatchMesh, BoundsOfSmallPiecesAreTight) {
  const PrimPtr prim = bicubic(4, false, bezierBasis(), 4, false, bezierBasis());
  const vec3 size = prim->bound(0, {0.4f, 0.41f, 0.6f, 0.61f}).size(), whole = prim->bound(0, {}).size();
  EXPECT_LT(glm::length(size), 0.05f * glm::length(whole));
}

TEST(PatchMesh, APartOfABilinearPatchIsBoundedByItsCorners) {
  Problems problems;
  const PrimPtr prim = makeBilinearPatchMesh(2, false, 2, false, {positions(randomPoints(2, 2))}, problems);
  const UvRect part{0.4f, 0.7f, 0.6f, 0.8f};
  Bound3 corners;
  for (const float u : {part.u0, part.u1})
    for (const float v : {part.v0, part.v1}) corners.extend(sampleAt(*prim, 0, u, v).p);
  const Bound3 bound = prim->bound(0, part);
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(bound.lo[axis], corners.lo[axis], 1e-5f);
    EXPECT_NEAR(bound.hi[axis], corners.hi[axis], 1e-5f);
  }
}

/// Control points along u that depend on x only, for a mesh that is straight in v.
vec3 onCurve(const Basis& basis, const std::vector<vec3>& controls, float u) {
  std::vector<float> p;
  const std::vector<float> heights = {0, 1, 2, 3};
  for (float h : heights)
    for (const vec3& c : controls) p.insert(p.end(), {c.x, c.y, h});
  Problems problems;
  const PrimPtr prim = makeBicubicPatchMesh(4, false, basis, 4, false, bezierBasis(), {positions(p)}, problems);
  return sampleAt(*prim, 0, u, 0.5f).p;
}

TEST(BicubicPatch, EachBasisReproducesItsCurve) {
  const std::vector<vec3> c = {{0, 1, 0}, {1, 4, 0}, {2, -2, 0}, {5, 3, 0}};
  for (float t : {0.0f, 0.3f, 0.5f, 1.0f}) {
    const float s = 1 - t, t2 = t * t, t3 = t2 * t;
    const auto expectCurve = [&](const Basis& basis, float w0, float w1, float w2, float w3) {
      const vec3 expected = w0 * c[0] + w1 * c[1] + w2 * c[2] + w3 * c[3], got = onCurve(basis, c, t);
      EXPECT_NEAR(got.x, expected.x, 1e-5);
      EXPECT_NEAR(got.y, expected.y, 1e-5);
    };
    expectCurve(bezierBasis(), s * s * s, 3 * s * s * t, 3 * s * t2, t3);
    expectCurve(bsplineBasis(), s * s * s / 6, (3 * t3 - 6 * t2 + 4) / 6, (-3 * t3 + 3 * t2 + 3 * t + 1) / 6, t3 / 6);
    expectCurve(catmullRomBasis(), (-t3 + 2 * t2 - t) / 2, (3 * t3 - 5 * t2 + 2) / 2, (-3 * t3 + 4 * t2 + t) / 2,
                (t3 - t2) / 2);
    expectCurve(hermiteBasis(), 2 * t3 - 3 * t2 + 1, t3 - 2 * t2 + t, -2 * t3 + 3 * t2, t3 - t2);
    expectCurve(powerBasis(), t3, t2, t, 1);
  }
}

TEST(BicubicPatch, ABezierSphereOctantHasTheAreaOfAnOctant) {
  const float k = 0.5522847f;  // the usual cubic arc: right to 3e-4
  const vec2 arc[4] = {{1, 0}, {1, k}, {k, 1}, {0, 1}};
  std::vector<float> p;
  for (const vec2& phi : arc)
    for (const vec2& theta : arc) p.insert(p.end(), {phi.x * theta.x, phi.x * theta.y, phi.y});
  Problems problems;
  const PrimPtr prim = makeBicubicPatchMesh(4, false, bezierBasis(), 4, false, bezierBasis(), {positions(p)}, problems);
  EXPECT_NEAR(dicedArea(*prim, 64), M_PI / 2, 2e-3);
  EXPECT_EQ(prim->info(0).openEdges, kAllEdges & ~kEdgeV1);  // the pole is a point
  for (float u : {0.0f, 0.4f, 1.0f})
    for (float v : {0.0f, 0.5f, 1.0f}) {
      const Sample s = sampleAt(*prim, 0, u, v);
      EXPECT_GT(dot(glm::normalize(s.n), glm::normalize(s.p)), 0.999f) << u << ' ' << v;
    }
}

TEST(PatchMesh, PatchesThatShareAnEdgeHaveTheSameBitsThere) {
  const auto expectSharedEdges = [](const Prim& prim, uint32_t nu, uint32_t nv) {
    for (uint32_t j = 0; j < nv; ++j)
      for (uint32_t i = 0; i < nu; ++i)
        for (float t : {0.0f, 0.123f, 0.7f, 1.0f}) {
          const uint32_t patch = j * nu + i, right = j * nu + (i + 1) % nu, above = (j + 1) % nv * nu + i;
          const bool joinsRight = !(prim.info(patch).openEdges & kEdgeU1),
                     joinsAbove = !(prim.info(patch).openEdges & kEdgeV1);
          EXPECT_TRUE(!joinsRight || sampleAt(prim, patch, 1, t).p == sampleAt(prim, right, 0, t).p) << patch;
          EXPECT_TRUE(!joinsAbove || sampleAt(prim, patch, t, 1).p == sampleAt(prim, above, t, 0).p) << patch;
          EXPECT_TRUE(joinsRight || i + 1 == nu);
          EXPECT_TRUE(joinsAbove || j + 1 == nv);
        }
  };
  Problems problems;
  expectSharedEdges(*makeBilinearPatchMesh(5, true, 4, false, {positions(randomPoints(5, 4))}, problems), 5, 3);
  expectSharedEdges(*bicubic(7, false, bezierBasis(), 10, false, bezierBasis()), 2, 3);
  expectSharedEdges(*bicubic(6, true, bsplineBasis(), 5, true, catmullRomBasis()), 6, 5);
  expectSharedEdges(*bicubic(8, false, hermiteBasis(), 8, true, hermiteBasis()), 3, 4);
}

TEST(PatchMesh, OnlyTheOutlineIsOpen) {
  Problems problems;
  const PrimPtr sheet = makeBilinearPatchMesh(3, false, 3, false, {positions(randomPoints(3, 3))}, problems);
  EXPECT_EQ(sheet->info(0).openEdges, kEdgeU0 | kEdgeV0);
  EXPECT_EQ(sheet->info(3).openEdges, kEdgeU1 | kEdgeV1);
  const PrimPtr tube = bicubic(6, true, bsplineBasis(), 5, false, bsplineBasis());
  EXPECT_EQ(tube->info(0).openEdges, kEdgeV0);
  EXPECT_EQ(tube->info(6).openEdges, kEdgeV1);
  EXPECT_EQ(bicubic(6, true, bsplineBasis(), 5, true, bsplineBasis())->info(7).openEdges, 0);
  EXPECT_EQ(bicubic(8, false, powerBasis(), 4, false, powerBasis())->info(0).openEdges,
            kAllEdges);  // pieces that do not meet
}

TEST(PatchMesh, OfRationalPatchesIsOpenAtItsOutlineOnly) {
  std::vector<float> pw;
  for (int j = 0; j < 7; ++j)
    for (int i = 0; i < 7; ++i) {
      const float w = 1 + 0.1f * static_cast<float>((3 * i + j) % 5), x = static_cast<float>(i),
                  y = static_cast<float>(j);
      pw.insert(pw.end(), {w * x, w * y, w * 0.2f * x * y, w});
    }
  Problems problems;
  const PrimPtr prim = makeBicubicPatchMesh(7, false, bezierBasis(), 7, false, bezierBasis(),
                                            {floats("Pw", Storage::Vertex, ValueType::HPoint, pw)}, problems);
  const int open[] = {kEdgeU0 | kEdgeV0, kEdgeU1 | kEdgeV0, kEdgeU0 | kEdgeV1, kEdgeU1 | kEdgeV1};
  for (uint32_t patch = 0; patch < 4; ++patch) EXPECT_EQ(prim->info(patch).openEdges, open[patch]) << patch;
  EXPECT_GT(prim->bytes(), pw.size() * sizeof(float));
}

TEST(PatchMesh, BilinearPatchesHaveStraightEdgesAndBlendTheirVertices) {
  Problems problems;
  std::vector<float> heat(12);
  for (size_t i = 0; i < heat.size(); ++i) heat[i] = static_cast<float>(i * i);
  const PrimPtr prim = makeBilinearPatchMesh(
      4, false, 3, false, {positions(randomPoints(4, 3)), floats("heat", Storage::Vertex, ValueType::Float, heat)},
      problems);
  for (uint32_t patch = 0; patch < 6; ++patch) {
    const auto at = [&](float u, float v) { return sampleAt(*prim, patch, u, v).p; };
    const std::pair<PatchEdge, std::array<vec3, 2>> edges[] = {{kEdgeU0, {at(0, 0), at(0, 1)}},
                                                               {kEdgeU1, {at(1, 0), at(1, 1)}},
                                                               {kEdgeV0, {at(0, 0), at(1, 0)}},
                                                               {kEdgeV1, {at(0, 1), at(1, 1)}}};
    for (const auto& [edge, ends] : edges) EXPECT_EQ(prim->straightEdge(patch, edge), ends);
    const size_t corner = patch / 3 * 4 + patch % 3;
    const float a = heat[corner], b = heat[corner + 1], c = heat[corner + 4], d = heat[corner + 5];
    EXPECT_NEAR(primvarAt(*prim, patch, 0, 0.25f, 0.5f)[0], (3 * a + b + 3 * c + d) / 8, 1e-4f);
  }
}

TEST(PatchMesh, HeightsAndHomogeneousPointsMustBeFiniteAndOneForEachVertex) {
  Problems problems;
  const auto error = [&](const char* name, ValueType type, std::vector<float> values) {
    return errorOf([&] {
      makeBilinearPatchMesh(2, false, 2, false, {floats(name, Storage::Vertex, type, std::move(values))}, problems);
    });
  };
  EXPECT_EQ(error("Pz", ValueType::Float, {1, 2, 3}), "Pz has 3 values where 4 vertices need 4 floats");
  EXPECT_EQ(error("Pz", ValueType::Float, {1, 2, NAN, 3}), "Pz of vertex 2 is not a finite number");
  EXPECT_EQ(error("Pz", ValueType::Float, {1, 2, 3, 4}), "");
}

TEST(PatchMesh, HomogeneousPointsMustBeFiniteAndOneForEachVertex) {
  Problems problems;
  const auto error = [&](std::vector<float> pw) {
    return errorOf([&] {
      makeBilinearPatchMesh(2, false, 2, false, {floats("Pw", Storage::Vertex, ValueType::HPoint, std::move(pw))},
                            problems);
    });
  };
  std::vector<float> pw = {0, 0, 0, 1, 2, 0, 0, 2, 0, 1, 0, 1, 1, 1, 0, 1};  // of two weights
  EXPECT_EQ(error(pw), "");
  for (const size_t k : {4u, 6u, 7u}) {
    std::vector<float> bad = pw;
    bad[k] = NAN;
    EXPECT_EQ(error(bad), "Pw of vertex 1 is not a finite number") << k;
  }
  pw.pop_back();
  EXPECT_EQ(error(pw), "Pw has 15 values where 4 vertices need 16 floats");
}

TEST(PatchMesh, HasAtMostAMillionControlPointsAlongADirection) {
  Problems problems;
  constexpr int kMost = 1 << 20;
  const auto error = [&](int controls) {
    return errorOf([&] { makeBilinearPatchMesh(controls, false, 2, false, {positions({})}, problems); });
  };
  EXPECT_NE(error(kMost).find("vertices need"), std::string::npos) << error(kMost);
  EXPECT_EQ(error(kMost + 1), "the mesh has 1048577 control points along u");
}

TEST(PatchMesh, AMeshThatEndsWhereItBeganIsClosedThere) {
  Problems problems;
  const PrimPtr prism = makeBilinearPatchMesh(
      4, false, 2, false, {positions({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 1, 1, 0, 1, 0, 1, 1, 0, 0, 1})},
      problems);
  for (uint32_t patch = 0; patch < 3; ++patch) EXPECT_EQ(prism->info(patch).openEdges, kEdgeV0 | kEdgeV1);
}

TEST(PatchMesh, SurfaceParametersRunOverTheWholeMesh) {
  const PrimPtr prim = bicubic(7, false, bezierBasis(), 10, false, bezierBasis());
  const float u = 1, v = 0.5f;
  float su, sv;
  prim->surfaceParameters(2, 1, &u, &v, &su, &sv);
  EXPECT_FLOAT_EQ(su, 0.5f);
  EXPECT_FLOAT_EQ(sv, 0.5f);
}

TEST(PatchMesh, InterpolatesEveryStorage) {
  std::vector<float> vertex, varying;
  const std::vector<float> p = randomPoints(7, 4);
  for (size_t i = 0; i < 28; ++i) vertex.push_back(p[3 * i + 1]);
  for (int i = 0; i < 6; ++i) varying.push_back(static_cast<float>(i * i));
  const PrimPtr prim = bicubic(
      7, false, bezierBasis(), 4, false, bezierBasis(),
      {floats("y", Storage::Vertex, ValueType::Float, vertex), floats("k", Storage::Varying, ValueType::Float, varying),
       floats("a", Storage::Uniform, ValueType::Float, {5, 6}), floats("c", Storage::Constant, ValueType::Float, {9})});
  EXPECT_FLOAT_EQ(primvarAt(*prim, 1, 0, 0.3f, 0.8f)[0], sampleAt(*prim, 1, 0.3f, 0.8f).p.y);
  EXPECT_FLOAT_EQ(primvarAt(*prim, 1, 1, 0, 0)[0], 1);
  EXPECT_FLOAT_EQ(primvarAt(*prim, 1, 1, 1, 1)[0], 25);
  EXPECT_FLOAT_EQ(primvarAt(*prim, 0, 1, 0.5f, 1)[0], 12.5f);
  EXPECT_EQ(primvarAt(*prim, 1, 2, 0.5f, 1)[0], 6);
  EXPECT_EQ(primvarAt(*prim, 1, 3, 0.5f, 1)[0], 9);
}

TEST(PatchMesh, PzIsAHeightFieldOverTheUnitSquare) {
  Problems problems;
  const PrimPtr prim = makeBilinearPatchMesh(
      3, false, 2, false, {floats("Pz", Storage::Vertex, ValueType::Float, {0, 1, 2, 3, 4, 5})}, problems);
  EXPECT_EQ(sampleAt(*prim, 1, 1, 1).p, vec3(1, 1, 5));
  EXPECT_EQ(sampleAt(*prim, 0, 1, 0).p, vec3(0.5f, 0, 1));
}

TEST(PatchMesh, PwIsDividedByItsWeight) {
  Problems problems;
  const PrimPtr prim = makeBilinearPatchMesh(
      2, false, 2, false,
      {floats("Pw", Storage::Vertex, ValueType::HPoint, {0, 0, 0, 2, 2, 0, 0, 2, 0, 2, 0, 2, 2, 2, 0, 2})}, problems);
  EXPECT_EQ(sampleAt(*prim, 0, 1, 1).p, vec3(1, 1, 0));
  EXPECT_TRUE(prim->info(0).planar);
  EXPECT_TRUE(problems.empty());
}

TEST(PatchMesh, PwOfDifferentWeightsIsRationalSoThatCirclesAreExact) {
  const float w = 0.70710678f, a = (1 + 2 * w) / 3, b = 2 * w / 3,
              c = 1 / 3.0f;  // a quarter, from (1, 0) to (0, 1), of cubics
  std::vector<float> pw;
  for (const float z : {0.0f, 1 / 3.0f, 2 / 3.0f, 1.0f})
    for (const vec3& h : {vec3(1, 0, 1), vec3(c + b, b, a), vec3(b, c + b, a), vec3(0, 1, 1)})
      pw.insert(pw.end(), {h.x, h.y, z * h.z, h.z});
  const Param heat = floats("heat", Storage::Vertex, ValueType::Float, std::vector<float>(16, 0.25f));
  Problems problems;
  const PrimPtr prim = makeBicubicPatchMesh(4, false, bezierBasis(), 4, false, bezierBasis(),
                                            {floats("Pw", Storage::Vertex, ValueType::HPoint, pw), heat}, problems);
  EXPECT_TRUE(problems.empty());
  for (const float u : {0.0f, 0.3f, 0.8f, 1.0f}) {
    const Sample s = sampleAt(*prim, 0, u, 0.4f);
    EXPECT_NEAR(glm::length(vec2(s.p.x, s.p.y)), 1, 1e-6f);
    EXPECT_NEAR(std::abs(dot(glm::normalize(s.n), vec3(s.p.x, s.p.y, 0))), 1, 1e-6f);
    EXPECT_NEAR(primvarAt(*prim, 0, 0, u, 0.4f)[0], 0.25f, 1e-6f);
  }
  expectSoundEverywhere(*prim);
  expectBoundsContainTheSurface(*prim);
}

TEST(PatchMesh, WrongCountsThrowASentence) {
  Problems problems;
  const auto mesh = [&](int nu, int nv, std::vector<float> p) {
    return errorOf([&] {
      makeBicubicPatchMesh(nu, false, bezierBasis(), nv, false, bezierBasis(), {positions(std::move(p))}, problems);
    });
  };
  EXPECT_NE(mesh(5, 4, randomPoints(5, 4)), "");  // no whole number of patches
  EXPECT_NE(mesh(3, 4, randomPoints(3, 4)), "");
  EXPECT_NE(mesh(-4, 4, {}), "");
  EXPECT_EQ(mesh(4, 4, {1, 2, 3}), "P has 3 values where 16 vertices need 48 floats");
  EXPECT_NE(errorOf([&] {
              makeBicubicPatchMesh(4, false, {mat4(1), 0}, 4, false, bezierBasis(), {positions(randomPoints(4, 4))},
                                   problems);
            }),
            "");
  EXPECT_NE(errorOf([&] {
              makeBilinearPatchMesh(2, false, 2, false,
                                    {floats("Pw", Storage::Vertex, ValueType::HPoint, std::vector<float>(16, 0))},
                                    problems);
            }),
            "");
}

TEST(NastyPatch, CollapsedEdgesCornersAndPointsAreSound) {
  Problems problems;
  std::vector<float> sheet = randomPoints(4, 4);
  std::copy_n(sheet.begin(), 3, sheet.begin() + 3);  // a corner's tangent is zero
  expectSoundEverywhere(
      *makeBicubicPatchMesh(4, false, bezierBasis(), 4, false, bezierBasis(), {positions(sheet)}, problems));
  expectSoundEverywhere(*makeBicubicPatchMesh(4, false, bezierBasis(), 4, false, bezierBasis(),
                                              {positions(std::vector<float>(48, 2))}, problems));
  expectSoundEverywhere(
      *makeBilinearPatchMesh(2, false, 2, false, {positions({0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 1, 0})}, problems));
  expectSoundEverywhere(*makeBilinearPatchMesh(2, false, 2, false, {positions(std::vector<float>(12, 1))}, problems));
}

TEST(NastyPatch, OneControlPointBesideALineDecidesWhereTheNormalPoints) {
  const auto normal = [](size_t control, float height) {
    std::vector<float> p;
    for (int k = 0; k < 16; ++k) p.insert(p.end(), {static_cast<float>(k % 4 + 2 * (k / 4)), 0, 0});
    p[3 * control + 1] = height;
    Problems problems;
    return sampleAt(*makeBicubicPatchMesh(4, false, bezierBasis(), 4, false, bezierBasis(), {positions(p)}, problems),
                    0, 1, 0)
        .n;
  };
  for (size_t control = 0; control < 16; ++control) {
    EXPECT_EQ(normal(control, 0), vec3(0, 0, 1));
    if (control == 12) continue;  // that of the opposite corner is not felt here
    const float above = glm::normalize(normal(control, 1)).z, below = glm::normalize(normal(control, -1)).z;
    EXPECT_NEAR(std::abs(above), 1, 1e-4f) << control;
    EXPECT_NEAR(above + below, 0, 1e-4f) << control;
  }
}

TEST(PatchMesh, AnHpointThatIsNoPositionIsDividedToo) {
  Problems problems;
  const PrimPtr prim = makeBilinearPatchMesh(
      2, false, 2, false,
      {positions({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0}),
       floats("rest", Storage::Varying, ValueType::HPoint, {0, 0, 0, 2, 2, 4, 6, 2, 0, 2, 0, 2, 8, 12, 16, 4})},
      problems);
  EXPECT_EQ(prim->primvars()[0].type, ValueType::Point);
  EXPECT_EQ(primvarAt(*prim, 0, 0, 1, 0), (std::vector<float>{1, 2, 3}));
  EXPECT_EQ(primvarAt(*prim, 0, 0, 1, 1), (std::vector<float>{2, 3, 4}));
}

}  // namespace
}  // namespace tomales
