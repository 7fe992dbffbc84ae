#include "tests/unit/prim/support.h"

namespace tomales {
namespace {
using namespace test;

Problems none;
PrimPtr ballOfTwo() { return makeSphere(2, -2, 2, 360, {}, none); }
PrimPtr cone() { return makeCone(3, 2, 360, {}, none); }
PrimPtr cylinder() { return makeCylinder(2, -1, 3, 360, {}, none); }
PrimPtr hyperboloid() { return makeHyperboloid({1, -1, -1}, {1, 1, 1}, 360, {}, none); }
PrimPtr paraboloid() { return makeParaboloid(2, 0, 3, 360, {}, none); }
PrimPtr disk() { return makeDisk(0.5f, 2, 360, {}, none); }
PrimPtr torus() { return makeTorus(3, 1, 0, 360, 360, {}, none); }

std::vector<PrimPtr> manyQuadrics() {
  return {ballOfTwo(),
          cone(),
          cylinder(),
          hyperboloid(),
          paraboloid(),
          disk(),
          torus(),
          makeSphere(2, -1, 1.5f, 200, {}, none),
          makeSphere(-2, -1, 1.5f, -77, {}, none),
          makeCone(-3, 2, 33, {}, none),
          makeCylinder(0.1f, 5, -5, 271, {}, none),
          makeHyperboloid({1, 0, 0}, {0, 2, 3}, 100, {}, none),
          makeHyperboloid({2, 1, 5}, {0, 0, -1}, -300, {}, none),
          makeParaboloid(1, 1, 4, 120, {}, none),
          makeParaboloid(1, -1, -4, 120, {}, none),
          makeDisk(7, -2, 90, {}, none),
          makeTorus(3, 1, 30, 300, 190, {}, none),
          makeTorus(1, 2, 0, 360, 360, {}, none),
          makeTorus(3, 1, 135, 495, 360, {}, none)};
}

TEST(Quadric, AreaOfADicedSphereTendsTo4PiRSquared) { expectAreaAtSecondOrder(*ballOfTwo(), 16 * M_PI); }
TEST(Quadric, AreaOfADicedSphericalZoneTendsToArchimedes) {
  expectAreaAtSecondOrder(*makeSphere(2, -1, 1.5f, 90, {}, none), 2 * M_PI * 2 * 2.5 / 4);
}
TEST(Quadric, AreaOfADicedConeTendsToItsClosedForm) { expectAreaAtSecondOrder(*cone(), M_PI * 2 * std::sqrt(13.0)); }
TEST(Quadric, AreaOfADicedCylinderTendsToItsClosedForm) { expectAreaAtSecondOrder(*cylinder(), 2 * M_PI * 2 * 4); }
TEST(Quadric, AreaOfADicedDiskTendsToItsClosedForm) { expectAreaAtSecondOrder(*disk(), 4 * M_PI); }
TEST(Quadric, AreaOfADicedTorusTendsToItsClosedForm) { expectAreaAtSecondOrder(*torus(), 4 * M_PI * M_PI * 3); }
TEST(Quadric, AreaOfADicedParaboloidTendsToItsClosedForm) {
  const double r = 2, h = 3;
  const double area = M_PI * r / (6 * h * h) * (std::pow(r * r + 4 * h * h, 1.5) - r * r * r);
  EXPECT_NEAR(dicedArea(*paraboloid(), 256), area, 2e-3 * area);
}
TEST(Quadric, AreaOfADicedHyperboloidTendsToTheIntegralOfItsCircles) {
  // x^2 + y^2 = 1 + z^2 for z in [-1, 1]: dA = 2 pi sqrt(1 + 2 z^2) dz.
  const double area = 2 * M_PI * (std::sqrt(3.0) + std::asinh(std::sqrt(2.0)) / std::sqrt(2.0));
  expectAreaAtSecondOrder(*hyperboloid(), area);
}

TEST(Quadric, OfTheTableIsMadeOfItsNumbersAndHasNoAreaWhereOneOfThemLeavesNone) {
  const std::vector<std::tuple<const char*, std::vector<float>, PrimPtr>> all = {
      {"Sphere", {2, -2, 2, 360}, ballOfTwo()},     {"Cone", {3, 2, 360}, cone()},
      {"Cylinder", {2, -1, 3, 360}, cylinder()},    {"Hyperboloid", {1, -1, -1, 1, 1, 1, 360}, hyperboloid()},
      {"Paraboloid", {2, 0, 3, 360}, paraboloid()}, {"Disk", {0.5f, 2, 360}, disk()},
      {"Torus", {3, 1, 0, 360, 360}, torus()}};
  EXPECT_EQ(all.size(), quadrics().size());
  for (const auto& [name, numbers, direct] : all) {
    const Quadric* const entry = findQuadric(name);
    ASSERT_TRUE(entry) << name;
    ASSERT_EQ(entry->numberCount, static_cast<int>(numbers.size())) << name;
    const PrimPtr made = entry->make(numbers.data(), {}, none);
    ASSERT_TRUE(made) << name;
    EXPECT_EQ(sampleAt(*made, 0, 0.3f, 0.6f).p, sampleAt(*direct, 0, 0.3f, 0.6f).p) << name;
    EXPECT_FALSE(entry->hasNoArea(numbers.data())) << name;
    std::vector<float> flat = numbers;
    flat.back() = 0;  // thetamax
    EXPECT_TRUE(entry->hasNoArea(flat.data())) << name;
  }
  EXPECT_EQ(findQuadric("Cube"), nullptr);
  for (const auto& [name, numbers] :
       std::vector<std::pair<const char*, std::vector<float>>>{{"Sphere", {0, -2, 2, 360}},
                                                               {"Sphere", {2, 1, 1, 360}},
                                                               {"Cone", {3, 0, 360}},
                                                               {"Cylinder", {0, -1, 3, 360}},
                                                               {"Cylinder", {2, 3, 3, 360}},
                                                               {"Hyperboloid", {1, 2, 3, 1, 2, 3, 360}},
                                                               {"Paraboloid", {0, 0, 3, 360}},
                                                               {"Paraboloid", {2, 3, 3, 360}},
                                                               {"Disk", {0.5f, 0, 360}},
                                                               {"Torus", {3, 0, 0, 360, 360}},
                                                               {"Torus", {3, 1, 90, 90, 360}}})
    EXPECT_TRUE(findQuadric(name)->hasNoArea(numbers.data())) << name;
  const float flatCone[] = {0, 2, 360}, flatDisk[] = {0, 2, 360};
  EXPECT_FALSE(findQuadric("Cone")->hasNoArea(flatCone)) << "it is a disk";
  EXPECT_FALSE(findQuadric("Disk")->hasNoArea(flatDisk)) << "its height";
}

TEST(Quadric, DerivativesAgreeWithFiniteDifferences) {
  for (const PrimPtr& prim : manyQuadrics()) expectDerivativesOfPositions(*prim, 2e-3f);
}

TEST(Quadric, BoundsContainTheSurface) {
  for (const PrimPtr& prim : manyQuadrics()) expectBoundsContainTheSurface(*prim);
}

TEST(Quadric, IsSoundAtPolesAndSeams) {
  for (const PrimPtr& prim : manyQuadrics()) expectSoundEverywhere(*prim);
}

TEST(Quadric, BoundsAreTight) {
  const Bound3 b = ballOfTwo()->bound(0, {});
  EXPECT_LT(glm::length(b.lo - vec3(-2)) + glm::length(b.hi - vec3(2)), 1e-4f);
  const Bound3 quarter = ballOfTwo()->bound(0, {0, 0.25f, 0.5f, 1});
  EXPECT_LT(glm::length(quarter.lo) + glm::length(quarter.hi - vec3(2)), 1e-4f);
}

TEST(Quadric, SphereNormalsPointOutwardPolesIncluded) {
  for (float u : {0.0f, 0.3f, 1.0f})
    for (float v : {0.0f, 0.2f, 0.9f, 1.0f}) {
      const Sample s = sampleAt(*ballOfTwo(), 0, u, v);
      EXPECT_GT(dot(glm::normalize(s.n), s.p) / 2, 0.99999f) << u << ' ' << v;
    }
}

TEST(Quadric, ConeNormalsAreExactAtTheApex) {
  for (float u : {0.0f, 0.25f, 0.6f}) {
    const float theta = 2 * kPi * u;
    const vec3 expected = glm::normalize(vec3(3 * std::cos(theta), 3 * std::sin(theta), 2));
    EXPECT_LT(glm::length(glm::normalize(sampleAt(*cone(), 0, u, 1).n) - expected), 1e-6f) << u;
  }
}

TEST(Quadric, ParaboloidAndDiskNormalsAreExactOnTheAxis) {
  EXPECT_EQ(glm::normalize(sampleAt(*paraboloid(), 0, 0.3f, 0).n), vec3(0, 0, -1));
  EXPECT_EQ(glm::normalize(sampleAt(*disk(), 0, 0.3f, 1).n), vec3(0, 0, 1));
}

TEST(Quadric, FollowsTheParametrisationOfRISpec) {
  const auto near = [](const Prim& prim, float u, float v, const vec3& p) {
    EXPECT_LT(glm::length(sampleAt(prim, 0, u, v).p - p), 1e-5f);
  };
  near(*ballOfTwo(), 0, 0.5f, {2, 0, 0});
  near(*ballOfTwo(), 0.25f, 0.5f, {0, 2, 0});
  near(*ballOfTwo(), 0, 1, {0, 0, 2});
  near(*cone(), 0.5f, 0, {-2, 0, 0});
  near(*cone(), 0.5f, 1, {0, 0, 3});
  near(*cylinder(), 0.75f, 1, {0, -2, 3});
  near(*hyperboloid(), 0, 0, {1, -1, -1});
  near(*hyperboloid(), 0, 1, {1, 1, 1});
  near(*paraboloid(), 0, 1, {2, 0, 3});
  near(*disk(), 0, 0, {2, 0, 0.5f});
  near(*torus(), 0, 0.25f, {3, 0, 1});
}

TEST(Quadric, SeamsOfAClosedSweepHaveTheSameBits) {
  for (float v : {0.0f, 0.1f, 0.37f, 1.0f}) {
    EXPECT_EQ(sampleAt(*ballOfTwo(), 0, 0, v).p, sampleAt(*ballOfTwo(), 0, 1, v).p);
    EXPECT_EQ(sampleAt(*torus(), 0, 0, v).p, sampleAt(*torus(), 0, 1, v).p);
    EXPECT_EQ(sampleAt(*torus(), 0, v, 0).p, sampleAt(*torus(), 0, v, 1).p);
    EXPECT_EQ(sampleAt(*hyperboloid(), 0, 0, v).p, sampleAt(*hyperboloid(), 0, 1, v).p);
  }
}

TEST(Quadric, OnlyWholeSpheresAndWholeDisksAreRound) {
  Problems problems;
  const auto sphere = [&](float r, float low, float high, float sweep) {
    return makeSphere(r, low, high, sweep, {}, problems)->round();
  };
  for (const float r : {2.0f, -2.0f}) {
    const std::optional<RoundShape> whole = sphere(r, -2, 2, 360);
    ASSERT_TRUE(whole);
    EXPECT_EQ(whole->radius, 2);
    EXPECT_EQ(whole->center, vec3(0));
    EXPECT_EQ(whole->axis, vec3(0));
  }
  EXPECT_TRUE(sphere(2, -3, 3, -360));
  EXPECT_FALSE(sphere(2, -2, 1.9f, 360));
  EXPECT_FALSE(sphere(2, -1.9f, 2, 360));
  EXPECT_FALSE(sphere(2, -2, 2, 350));
  EXPECT_FALSE(makeTorus(0, 1, 0, 360, 360, {}, problems)->round());
  EXPECT_FALSE(makeTorus(2, 1, -90, 90, 360, {}, problems)->round());
  const std::optional<RoundShape> disk = makeDisk(3, 2, 360, {}, problems)->round();
  ASSERT_TRUE(disk);
  EXPECT_EQ(disk->center, vec3(0, 0, 3));
  EXPECT_EQ(disk->radius, 2);
  EXPECT_EQ(disk->axis, vec3(0, 0, 1));
  EXPECT_FALSE(makeDisk(3, 2, 180, {}, problems)->round());
  EXPECT_FALSE(makeCone(3, 2, 360, {}, problems)->round());
  EXPECT_FALSE(makeHyperboloid({2, 0, 1}, {1, 0, 1}, 360, {}, problems)->round()) << "a ring";
}

TEST(Quadric, MoreThanOneTurnIsOneTurn) {
  Problems problems;
  for (const float sign : {-1.0f, 1.0f}) {
    const PrimPtr once = makeTorus(3, 1, 0, 360, sign * 360, {}, problems),
                  twice = makeTorus(3, 1, 0, 360, sign * 720, {}, problems);
    const Sample a = sampleAt(*once, 0, 0.3f, 0.4f), b = sampleAt(*twice, 0, 0.3f, 0.4f);
    EXPECT_EQ(a.p, b.p);
    EXPECT_EQ(a.du, b.du);
  }
}

TEST(Quadric, PolesAreOnePoint) {
  EXPECT_EQ(sampleAt(*ballOfTwo(), 0, 0.1f, 1).p, vec3(0, 0, 2));
  EXPECT_EQ(sampleAt(*ballOfTwo(), 0, 0.7f, 0).p, vec3(0, 0, -2));
  EXPECT_EQ(sampleAt(*cone(), 0, 0.7f, 1).p, vec3(0, 0, 3));
}

TEST(Quadric, OnlyEdgesThatEndTheSurfaceAreOpen) {
  EXPECT_EQ(ballOfTwo()->info(0).openEdges, 0);
  EXPECT_EQ(torus()->info(0).openEdges, 0);
  EXPECT_EQ(cone()->info(0).openEdges, kEdgeV0);
  EXPECT_EQ(disk()->info(0).openEdges, kEdgeV0);
  EXPECT_EQ(paraboloid()->info(0).openEdges, kEdgeV1);
  EXPECT_EQ(cylinder()->info(0).openEdges, kEdgeV0 | kEdgeV1);
  EXPECT_EQ(makeSphere(1, -1, 0.5f, 90, {}, none)->info(0).openEdges, kEdgeU0 | kEdgeU1 | kEdgeV1);
}

TEST(Quadric, ManyPointsGiveTheBitsOfOne) {
  std::vector<float> u, v;
  for (uint32_t i = 0; i < 301; ++i) {
    u.push_back(unitFloat(hash32(i)));
    v.push_back(unitFloat(hash32(i + 1000)));
  }
  for (const PrimPtr& prim : manyQuadrics()) {
    const std::vector<Sample> together = samplesAt(*prim, 0, u, v);
    for (size_t i = 0; i < u.size(); i += 7) EXPECT_EQ(together[i].p, sampleAt(*prim, 0, u[i], v[i]).p);
  }
}

TEST(Quadric, InterpolatesPrimvarsOverItsFourCorners) {
  Problems problems;
  const PrimPtr prim = makeSphere(1, -1, 1, 360,
                                  {floats("k", Storage::Varying, ValueType::Float, {0, 1, 2, 4}),
                                   floats("Cs", Storage::Uniform, ValueType::Color, {1, 2, 3})},
                                  problems);
  EXPECT_TRUE(problems.empty());
  EXPECT_FLOAT_EQ(primvarAt(*prim, 0, 0, 0.5f, 0.5f)[0], 1.75f);
  EXPECT_FLOAT_EQ(primvarAt(*prim, 0, 0, 1, 0)[0], 1);
  EXPECT_FLOAT_EQ(primvarAt(*prim, 0, 0, 0, 1)[0], 2);
  EXPECT_EQ(primvarAt(*prim, 0, 1, 0.2f, 0.9f), (std::vector<float>{1, 2, 3}));
}

TEST(Quadric, WithoutAreaThrowsASentence) {
  EXPECT_EQ(errorOf([] { makeSphere(0, -1, 1, 360, {}, none); }), "the sphere's radius is 0");
  EXPECT_NE(errorOf([] { makeSphere(1, -1, 1, 0, {}, none); }), "");
  EXPECT_NE(errorOf([] { makeSphere(1, 2, 3, 360, {}, none); }), "");
  EXPECT_NE(errorOf([] { makeSphere(NAN, -1, 1, 360, {}, none); }), "");
  EXPECT_NE(errorOf([] { makeSphere(1, -1, 1, INFINITY, {}, none); }), "");
  EXPECT_NE(errorOf([] { makeCone(1, 0, 360, {}, none); }), "");
  EXPECT_NE(errorOf([] { makeCylinder(1, 2, 2, 360, {}, none); }), "");
  EXPECT_NE(errorOf([] { makeHyperboloid({1, 1, 1}, {1, 1, 1}, 360, {}, none); }), "");
  EXPECT_NE(errorOf([] { makeHyperboloid({0, 0, 1}, {0, 0, 2}, 360, {}, none); }), "");
  EXPECT_NE(errorOf([] { makeParaboloid(1, -1, 1, 360, {}, none); }), "");
  EXPECT_NE(errorOf([] { makeParaboloid(1, 0, 0, 360, {}, none); }), "");
  EXPECT_NE(errorOf([] { makeDisk(1, 0, 360, {}, none); }), "");
  EXPECT_NE(errorOf([] { makeTorus(1, 0, 0, 360, 360, {}, none); }), "");
  EXPECT_NE(errorOf([] { makeTorus(1, 0.5f, 90, 90, 360, {}, none); }), "");
}

TEST(Quadric, HasNoAreaWhereANumberThatMakesItWideIsZeroOrItEndsWhereItBegins) {
  const struct {
    const char* name;
    std::vector<float> numbers;
    std::vector<size_t> sizes;                   // each makes it vanish if it is zero
    std::vector<std::array<size_t, 2>> extents;  // and these if all pairs of them are equal
  } rows[] = {{"Sphere", {1, -1, 2, 360}, {0, 3}, {{1, 2}}},
              {"Cone", {1, 2, 360}, {1, 2}, {}},
              {"Cylinder", {1, -1, 2, 360}, {0, 3}, {{1, 2}}},
              {"Hyperboloid", {1, 2, 3, 4, 5, 6, 360}, {6}, {{0, 3}, {1, 4}, {2, 5}}},
              {"Paraboloid", {1, 2, 3, 360}, {0, 3}, {{1, 2}}},
              {"Disk", {1, 2, 360}, {1, 2}, {}},
              {"Torus", {2, 1, 10, 360, 360}, {1, 4}, {{2, 3}}}};
  ASSERT_EQ(std::size(rows), quadrics().size());
  for (const auto& row : rows) {
    const Quadric& quadric = *findQuadric(row.name);
    ASSERT_EQ(quadric.numberCount, static_cast<int>(row.numbers.size())) << row.name;
    EXPECT_FALSE(quadric.hasNoArea(row.numbers.data())) << row.name;
    for (size_t i = 0; i < row.numbers.size(); ++i) {
      std::vector<float> zero = row.numbers;
      zero[i] = 0;
      const bool vanishes = std::find(row.sizes.begin(), row.sizes.end(), i) != row.sizes.end();
      EXPECT_EQ(quadric.hasNoArea(zero.data()), vanishes) << row.name << ' ' << i;
    }
    std::vector<float> flat = row.numbers;
    for (size_t i = 0; i < row.extents.size(); ++i) {
      EXPECT_FALSE(quadric.hasNoArea(flat.data())) << row.name;
      flat[row.extents[i][1]] = flat[row.extents[i][0]];
    }
    EXPECT_EQ(quadric.hasNoArea(flat.data()), !row.extents.empty()) << row.name;
  }
  EXPECT_EQ(findQuadric("Polygon"), nullptr);
}

}  // namespace
}  // namespace tomales
