#include "tests/unit/prim/thin.h"

namespace tomales {
namespace {
using namespace test;

PrimPtr points(ParamList params) {
  Problems problems;
  const PrimPtr prim = makePoints(params, problems);
  EXPECT_TRUE(problems.empty());
  return prim;
}

TEST(Points, AreDisksOfTheirWidth) {
  const PrimPtr prim = seen(points({positions(wiggle(3)), width(Storage::Varying, {1, 2, 0.5f})}));
  ASSERT_EQ(prim->patchCount(), 3u);
  EXPECT_NEAR(dicedArea(*prim, 64), M_PI / 4 * (1 + 4 + 0.25), 0.01);
  expectSoundEverywhere(*prim);
  expectBoundsContainTheSurface(*prim);
  expectDerivativesOfPositions(*prim, 1e-3f);
  const float radius[] = {0.5f, 1, 0.25f};
  for (uint32_t patch = 0; patch < 3; ++patch) {
    const vec3 center = sampleAt(*prim, patch, 0.5f, 0.5f).p;
    for (float t : {0.0f, 0.3f, 0.8f})
      EXPECT_NEAR(glm::length(sampleAt(*prim, patch, t, 1).p - center), radius[patch], 1e-5f);
    EXPECT_LT(glm::length(glm::normalize(sampleAt(*prim, patch, 0.2f, 0.9f).n) - glm::normalize(kEye - center)), 1e-5f);
  }
}

/// The area of the polygons that a lattice over a patch makes.
double latticeArea(const Prim& prim, uint32_t patch, int nu, int nv) {
  std::vector<float> u, v;
  for (int j = 0; j <= nv; ++j)
    for (int i = 0; i <= nu; ++i) {
      u.push_back(static_cast<float>(i) / nu);
      v.push_back(static_cast<float>(j) / nv);
    }
  std::vector<float> f[12];
  for (auto& array : f) array.resize(u.size());
  prim.evaluateLattice(patch, nu, nv, u.data(), v.data(),
                       {f[0].data(), f[1].data(), f[2].data(), f[3].data(), f[4].data(), f[5].data(), f[6].data(),
                        f[7].data(), f[8].data(), f[9].data(), f[10].data(), f[11].data()});
  const auto at = [&](int i, int j) {
    const size_t k = static_cast<size_t>(j * (nu + 1) + i);
    const glm::dvec3 p(f[0][k], f[1][k], f[2][k]);
    const Bound3 bound = prim.bound(patch, {});
    EXPECT_TRUE(p == glm::clamp(p, glm::dvec3(bound.lo), glm::dvec3(bound.hi)));
    return p;
  };
  double area = 0;
  for (int j = 0; j < nv; ++j)
    for (int i = 0; i < nu; ++i)
      area += glm::length(glm::cross(at(i + 1, j + 1) - at(i, j), at(i, j + 1) - at(i + 1, j))) / 2;
  return area;
}

TEST(Points, FewPolygonsHaveTheAreaOfTheDiskTheyStandFor) {
  const PrimPtr prim = seen(points({positions({1, 2, 3}), width(Storage::Constant, {0.5f})}));
  for (int nu = 1; nu < 6; ++nu)
    for (int nv = 1; nv < 6; ++nv) EXPECT_NEAR(latticeArea(*prim, 0, nu, nv), M_PI / 16, 1e-6) << nu << ' ' << nv;
  for (const int n : {31, 32, 33}) EXPECT_NEAR(latticeArea(*prim, 0, n, 1), M_PI / 16, 1e-6) << n;
}

Param typed(const char* name) {
  Param type;
  type.name = "type";
  type.storage = Storage::Constant;
  type.type = ValueType::String;
  type.strings = {name};
  return type;
}

TEST(Points, OfOneCellHaveTheCornersOfTheirDiskMovedOutward) {
  const PrimPtr prim = seen(points({positions(wiggle(2)), width(Storage::Varying, {1, 0.3f})}));
  const std::vector<float> u{0, 1, 0, 1}, v{0, 0, 1, 1};
  for (uint32_t patch = 0; patch < 2; ++patch) {
    const std::vector<Sample> rim = samplesAt(*prim, patch, u, v);
    std::vector<float> f[12];
    for (auto& array : f) array.resize(4);
    prim->evaluateLattice(patch, 1, 1, u.data(), v.data(),
                          {f[0].data(), f[1].data(), f[2].data(), f[3].data(), f[4].data(), f[5].data(), f[6].data(),
                           f[7].data(), f[8].data(), f[9].data(), f[10].data(), f[11].data()});
    const vec3 center = sampleAt(*prim, patch, 0.5f, 0.5f).p;
    for (size_t i = 0; i < 4; ++i) {
      EXPECT_NEAR(glm::length(vec3(f[0][i], f[1][i], f[2][i]) - (center + std::sqrt(kPi / 2) * (rim[i].p - center))), 0,
                  1e-6f);
      EXPECT_EQ(vec3(f[3][i], f[4][i], f[5][i]), rim[i].du);
      EXPECT_EQ(vec3(f[6][i], f[7][i], f[8][i]), rim[i].dv);
      EXPECT_EQ(vec3(f[9][i], f[10][i], f[11][i]), rim[i].n);
    }
  }
}

TEST(Points, OfTypeSphereAreSpheres) {
  const Param type = typed("sphere");
  const PrimPtr prim = points({positions({1, 2, 3, 0, 0, 0}), width(Storage::Vertex, {0.5f, 4}), type});
  EXPECT_EQ(prim->facing(kEye, {0, 0, 1}, true), nullptr);
  expectSoundEverywhere(*prim);
  expectBoundsContainTheSurface(*prim);
  expectDerivativesOfPositions(*prim, 1e-3f);
  for (const float t : {0.0f, 0.2f, 0.7f, 1.0f}) EXPECT_NEAR(glm::length(sampleAt(*prim, 1, t, 0.3f * t).p), 2, 1e-6f);
  expectAreaAtSecondOrder(*points({positions({1, 2, 3}), width(Storage::Constant, {2}), type}), 4 * M_PI);
  for (const int n : {3, 5, 9}) EXPECT_NEAR(latticeArea(*prim, 0, n, n - 1), M_PI / 4, 1e-6) << n;
}

TEST(Points, OfTypePatchAreCardsThatStandUprightUntilTheirAngleTurnsThem) {
  const auto card = [](float angle_degrees, float aspect) {
    return points({positions({1, 2, 3}), width(Storage::Constant, {2}), typed("patch"),
                   floats("patchangle", Storage::Varying, ValueType::Float, {angle_degrees}),
                   floats("constantpatchaspectratio", Storage::Constant, ValueType::Float, {aspect})});
  };
  const PrimPtr front = card(0, 2)->facing({0, 0, 0}, {0, 0, 1}, false);
  EXPECT_LT(glm::length(sampleAt(*front, 0, 0, 0).p - vec3(0, 2.5f, 3)), 1e-6f);
  EXPECT_LT(glm::length(sampleAt(*front, 0, 1, 1).p - vec3(2, 1.5f, 3)), 1e-6f);
  EXPECT_EQ(sampleAt(*front, 0, 0.2f, 0.9f).n.z < 0, true);
  const PrimPtr turned = card(90, 2)->facing({0, 0, 0}, {0, 0, 1}, false);
  EXPECT_LT(glm::length(sampleAt(*turned, 0, 1, 0.5f).p - vec3(1, 3, 3)), 1e-6f);
  expectSoundEverywhere(*front);
  expectBoundsContainTheSurface(*turned);
  expectDerivativesOfPositions(*turned, 1e-3f);
  Problems problems;
  EXPECT_THROW(makePoints({positions({0, 0, 0}), typed("patch"),
                           floats("patchaspectratio", Storage::Varying, ValueType::Float, {0})},
                          problems),
               PrimError);
}

TEST(Points, TellWhetherTheyAreFlatOpenDisksAndLone) {
  const auto shape = [](const char* type) { return points({positions({0, 0, 0}), typed(type)}); };
  const PrimPtr disk = shape("particle"), card = shape("patch"), ball = shape("sphere");
  EXPECT_TRUE(disk->info(0).disk && !disk->info(0).planar) << "its outline is round";
  EXPECT_TRUE(card->info(0).planar && !card->info(0).disk);
  EXPECT_FALSE(ball->info(0).planar || ball->info(0).disk);
  EXPECT_EQ(disk->info(0).openEdges, kAllEdges);
  EXPECT_EQ(card->info(0).openEdges, kAllEdges);
  EXPECT_EQ(ball->info(0).openEdges, 0);
  EXPECT_TRUE(disk->isLone() && card->isLone());
  EXPECT_FALSE(ball->isLone());
}

TEST(Points, OfTypePatchAreAsLargeHoweverFewPolygonsTheyHave) {
  const PrimPtr card = points({positions({1, 2, 3}), width(Storage::Constant, {2}), typed("patch")});
  for (const int n : {1, 2, 5}) EXPECT_NEAR(latticeArea(*card, 0, n, n), 4, 1e-5) << n;
}

TEST(Points, OfTypesNobodyKnowsAreDisksAndSaySo) {
  Problems problems;
  EXPECT_EQ(makePoints({positions({0, 0, 0}), typed("wrong")}, problems)->patchCount(), 1u);
  EXPECT_EQ(problems.size(), 1u);
}

TEST(Points, FaceTheirNormalIfTheyHaveOne) {
  const PrimPtr prim = points({positions({0, 0, 0, 5, 0, 0}), width(Storage::Constant, {2}),
                               floats("N", Storage::Varying, ValueType::Normal, {0, 2, 0, 1, 0, 0})});
  EXPECT_EQ(prim->facing(kEye, {0, 0, 1}, true), nullptr);
  EXPECT_EQ(sampleAt(*prim, 0, 0.3f, 0.3f).n, vec3(0, 1, 0));
  EXPECT_EQ(sampleAt(*prim, 1, 0.3f, 0.3f).n, vec3(1, 0, 0));
  EXPECT_NEAR(prim->bound(1, {}).size().x, 0, 1e-4f);
  EXPECT_LT(prim->bound(0, {0.4f, 0.6f, 0.4f, 0.6f}).size().x, 0.45f);
}

TEST(Points, ValuesBelongToTheirPoint) {
  const PrimPtr prim = points({positions({0, 0, 0, 5, 0, 0}), floats("c", Storage::Varying, ValueType::Float, {3, 4}),
                               floats("k", Storage::Constant, ValueType::Float, {9})});
  EXPECT_EQ(primvarAt(*prim, 1, 0, 0.2f, 0.3f)[0], 4);
  EXPECT_EQ(primvarAt(*prim, 1, 1, 0.2f, 0.3f)[0], 9);
}

TEST(NastyPoints, WrongInputThrowsASentenceAndNoWidthIsSound) {
  Problems problems;
  const auto errorWith = [&](const ParamList& params) { return errorOf([&] { makePoints(params, problems); }); };
  EXPECT_NE(errorWith({}), "");
  EXPECT_NE(errorWith({positions({})}), "");
  EXPECT_NE(errorWith({positions({0, 0})}), "");
  EXPECT_NE(errorWith({positions({0, 0, INFINITY})}), "");
  EXPECT_NE(errorWith({positions({0, 0, 0}), width(Storage::Constant, {-1})}), "");
  expectSoundEverywhere(*seen(points({positions({0, 0, 0}), width(Storage::Constant, {0})})));
  expectSoundEverywhere(*seen(points({positions({kEye.x, kEye.y, kEye.z})})));
}

}  // namespace
}  // namespace tomales
