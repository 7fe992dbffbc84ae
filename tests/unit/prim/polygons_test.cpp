#include <numeric>
#include <random>

#include "tests/unit/prim/support.h"

namespace tomales {
namespace {
using namespace test;

PrimPtr polygon(std::vector<float> p, Problems* problems = nullptr) {
  Problems mine;
  const int n = static_cast<int>(p.size() / 3);
  std::vector<int> vertices;
  for (int i = 0; i < n; ++i) vertices.push_back(i);
  return makePolygons({n}, vertices, {positions(std::move(p))}, problems ? *problems : mine);
}

std::vector<float> flat(const std::vector<vec2>& outline, float z = 0) {
  std::vector<float> p;
  for (const vec2& q : outline) p.insert(p.end(), {q.x, q.y, z});
  return p;
}

/// Every piece, and that all face the same way.
void expectArea(const std::vector<vec2>& outline, double area) {
  const PrimPtr prim = polygon(flat(outline));
  EXPECT_NEAR(dicedArea(*prim, 1), area, 1e-6 * area);
  for (uint32_t patch = 0; patch < prim->patchCount(); ++patch) {
    EXPECT_TRUE(prim->info(patch).planar);
    EXPECT_EQ(sampleAt(*prim, patch, 0.5f, 0.5f).n, vec3(0, 0, 1));
    EXPECT_GT(cross(sampleAt(*prim, patch, 0.5f, 0.5f).du, sampleAt(*prim, patch, 0.5f, 0.5f).dv).z, 0);
  }
  expectSoundEverywhere(*prim);
}

std::vector<vec3> pointsOf(const std::vector<float>& p) {
  std::vector<vec3> out;
  for (size_t i = 0; i < p.size(); i += 3) out.emplace_back(p[i], p[i + 1], p[i + 2]);
  return out;
}

/// A flat face at several keys: its patches cover each point of it once at every key, by their areas. `loops`: their
/// number, then their sizes.
void expectCutsCover(const std::vector<std::vector<float>>& keys, const std::vector<int>& loops) {
  const std::vector<int> counts(loops.begin() + 1, loops.end());
  PointKeys points;
  for (const auto& key : keys) points.push_back(pointsOf(key));
  std::vector<int> vertices(points[0].size());
  std::iota(vertices.begin(), vertices.end(), 0);
  for (size_t k = 0; k < keys.size(); ++k) {
    Problems problems;
    const PrimPtr prim = makeGeneralPolygons({loops[0]}, counts, vertices, {positions(keys[k])}, problems, points);
    EXPECT_TRUE(problems.empty()) << problems[0];
    double expected = 0;
    size_t begin = 0;
    for (const int count : counts) {
      double loop = 0;
      for (int i = 0; i < count; ++i) {
        const vec3 &a = points[k][begin + static_cast<size_t>(i)],
                   &b = points[k][begin + static_cast<size_t>((i + 1) % count)];
        loop += 0.5 * (double(a.x) * double(b.y) - double(a.y) * double(b.x));
      }
      expected += begin ? -std::abs(loop) : std::abs(loop);
      begin += static_cast<size_t>(count);
    }
    EXPECT_NEAR(dicedArea(*prim, 1), expected, 1e-4 * expected) << "key " << k;
  }
}

TEST(Polygons, ShadeByThePlaneNormalThatIsGivenUnlessVerticesHaveTheirs) {
  const Param positionsOfTwo = positions({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0});
  const Param ofPlanes = floats("Np", Storage::Uniform, ValueType::Normal, {1, 0, 0, 0, 1, 0});
  const Param ofVertices = floats("N", Storage::Varying, ValueType::Normal, {0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1});
  Problems problems;
  const auto named = [&](const ParamList& params) {
    return offsetOf(makePolygons({3, 3}, {0, 1, 2, 0, 2, 3}, params, problems)->primvars(), "N");
  };
  EXPECT_EQ(named({positionsOfTwo}), -1);
  const PrimPtr prim = makePolygons({3, 3}, {0, 1, 2, 0, 2, 3}, {positionsOfTwo, ofPlanes}, problems);
  ASSERT_EQ(offsetOf(prim->primvars(), "N"), 0);
  EXPECT_EQ(primvarAt(*prim, 0, 0, 0.5f, 0.5f), (std::vector<float>{1, 0, 0}));
  EXPECT_EQ(primvarAt(*prim, 1, 0, 0.5f, 0.5f), (std::vector<float>{0, 1, 0}));
  EXPECT_EQ(named({positionsOfTwo, ofPlanes, ofVertices}), 3);
  EXPECT_TRUE(problems.empty());
}

TEST(Polygon, AllKeysOfAMotionAreCutAlike) {
  std::mt19937 rng(7);
  std::uniform_real_distribution<float> at(-1, 1);
  for (int round = 0; round < 200; ++round) {
    const int n = 3 + round % 5;
    std::vector<float> before, after;
    std::vector<int> vertices;
    Param share;  // another number for every vertex: which ones a point is made of
    share.name = "share";
    share.storage = Storage::Vertex;
    for (int i = 0; i < n; ++i) {
      vertices.push_back(i);
      share.floats.push_back(static_cast<float>(1 << (2 * i)));
      for (int axis = 0; axis < 3; ++axis) {
        before.push_back(at(rng));
        after.push_back(at(rng));
      }
    }
    Problems problems;
    const PointKeys keys = {pointsOf(before), pointsOf(after)};
    const PrimPtr first = makePolygons({n}, vertices, {positions(before), share}, problems, keys);
    const PrimPtr key = makePolygons({n}, vertices, {positions(after), share}, problems, keys);
    ASSERT_EQ(key->patchCount(), first->patchCount());
    for (uint32_t patch = 0; patch < first->patchCount(); ++patch)
      for (const float u : {0.0f, 0.3f, 1.0f})
        for (const float v : {0.0f, 0.6f, 1.0f}) {
          float a = 0, b = 0;
          first->interpolate(patch, 0, 1, &u, &v, &a, 1);
          key->interpolate(patch, 0, 1, &u, &v, &b, 1);
          EXPECT_EQ(a, b);
          EXPECT_TRUE(isFinite(sampleAt(*key, patch, u, v).n));
        }
  }
}

TEST(Polygon, AKeyWhoseFaceHasCollapsedKeepsIt) {
  Problems problems;
  const std::vector<float> whole = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0},
                           half = {0, 0, 0, 0.5f, 0.5f, 0, 1, 1, 0, 0, 1, 0};
  for (const PointKeys& keys :
       {PointKeys{pointsOf(whole), pointsOf(half)}, PointKeys{pointsOf(half), pointsOf(whole)}}) {
    const PrimPtr key = makePolygons({3, 3}, {0, 1, 2, 0, 2, 3}, {positions(half)}, problems, keys);
    EXPECT_EQ(key->patchCount(), 2u);
    EXPECT_EQ(sampleAt(*key, 0, 0.5f, 0.5f).n, vec3(0, 0, 1));
  }
  EXPECT_TRUE(problems.empty());
}

// Two triangles of a dart on one side of the wrong diagonal cover more than the dart.
TEST(Polygon, AReflexCornerThatMovesLeavesNoOverlapAtAnyKey) {
  const std::vector<float> shallow = {-1, -1, 0, 1, -1, 0, 1, 1, 0, 0, 0.1f, 0, -1, 1, 0};
  const std::vector<float> deep = {-1, -1, 0, 1, -1, 0, 1, 1, 0, 0, -0.5f, 0, -1, 1, 0};
  const std::vector<float> square = {-1, -1, 0, 1, -1, 0, 1, 1, 0, 0, 1, 0, -1, 1, 0};
  for (const auto& [before, after] : {std::pair(shallow, deep), std::pair(square, deep), std::pair(deep, square)})
    expectCutsCover({before, after}, {1, 5});
  // A quadrilateral that bends in.
  expectCutsCover({{0, 0, 0, 2, 0, 0, 2, 2, 0, 0, 2, 0}, {0, 0, 0, 2, 0, 0, 0.5f, 0.5f, 0, 0, 2, 0}}, {1, 4});
}

TEST(Polygon, AHoleThatMovesPastItsBridgeLeavesNoOverlap) {
  const auto holed = [](float x, float y) {
    return std::vector<float>{0, 0, 0, 4, 0, 0, 4, 4, 0, 0, 4, 0, x, y, 0, x, y + 1, 0, x + 1, y + 1, 0, x + 1, y, 0};
  };
  expectCutsCover({holed(0.5f, 0.5f), holed(2.5f, 2.5f)}, {2, 4, 4});
  expectCutsCover({holed(2.5f, 0.5f), holed(0.5f, 2.5f), holed(1.5f, 1.5f)}, {2, 4, 4});
}

// Darts whose reflex corner changes places have no cut in common.
TEST(Polygon, OneThatCannotBeCutAlikeIsToldOf) {
  const std::vector<float> before = {1.2f, 1.2f, 0, 2, 0, 0, 2, 2, 0, 0, 2, 0},
                           after = {0, 0, 0, 0.9f, 1.1f, 0, 2, 2, 0, 0, 2, 0};
  Problems problems;
  makePolygons({4}, {0, 1, 2, 3}, {positions(after)}, problems, {pointsOf(before), pointsOf(after)});
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_NE(problems[0].find("overlap"), std::string::npos);
}

TEST(Polygon, AConvexQuadIsOnePatchAlongItsFirstAndLastEdge) {
  const PrimPtr prim = polygon({0, 0, 0, 2, 0, 0, 3, 3, 0, 0, 2, 0});
  ASSERT_EQ(prim->patchCount(), 1u);
  EXPECT_EQ(sampleAt(*prim, 0, 1, 0).p, vec3(2, 0, 0));
  EXPECT_EQ(sampleAt(*prim, 0, 0, 1).p, vec3(0, 2, 0));
  EXPECT_EQ(sampleAt(*prim, 0, 1, 1).p, vec3(3, 3, 0));
  EXPECT_EQ(prim->info(0).openEdges, kAllEdges);
  expectDerivativesOfPositions(*prim, 1e-3f);
}

TEST(Polygon, AreaIsExactForEveryShape) {
  expectArea({{0, 0}, {1, 0}, {0, 1}}, 0.5);  // triangle
  expectArea({{0, 0}, {4, 0}, {4, 3}, {1, 1}},
             4 * 3 * 0.5 + 0.5 * std::abs(4 * 1 - 3 * 1));          // concave: an arrow head
  expectArea({{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 3}, {0, 3}}, 5);  // L
  expectArea({{0, 0}, {5, 0}, {5, 3}, {4, 3}, {4, 1}, {3, 1}, {3, 3}, {2, 3}, {2, 1}, {1, 1}, {1, 3}, {0, 3}},
             11);                                                   // comb
  expectArea({{0, 0}, {1, 0}, {2, 0}, {2, 2}, {0, 2}}, 4);          // collinear vertex
  expectArea({{0, 0}, {2, 0}, {2, 0}, {2, 2}, {0, 2}, {0, 0}}, 4);  // repeated vertices
  expectArea({{0, 0}, {2, 0}, {2, 2}, {4, 2}, {4, 4}, {2, 4}, {2, 2}, {0, 2}},
             8);  // touches itself at a vertex
  expectArea({{0, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 0}, {1, 1}, {1, 3}, {3, 3}, {3, 1}, {1, 1}},
             12);  // a hole by a bridge
}

TEST(Polygon, AreaOfARegular100GonIsExact) {
  std::vector<vec2> outline;
  for (int i = 0; i < 100; ++i) outline.push_back({std::cos(2 * M_PI * i / 100), std::sin(2 * M_PI * i / 100)});
  expectArea(outline, 50 * std::sin(2 * M_PI / 100));
}

TEST(Polygon, AreaOfAConcaveStarIsExact) {
  std::vector<vec2> outline;
  for (int i = 0; i < 20; ++i) {
    const double r = i % 2 ? 0.3 : 1, a = 2 * M_PI * i / 20;
    outline.push_back({r * std::cos(a), r * std::sin(a)});
  }
  expectArea(outline, 20 * 0.5 * 0.3 * std::sin(2 * M_PI / 20));
}

TEST(Polygon, FacesOfOneMeshAreCutEachByItself) {
  // A pentagon, a hexagon above it, and a triangle, with corners of their own.
  const std::vector<vec2> pentagon = {{0, 0}, {2, 0}, {3, 1}, {1, 3}, {-1, 1}},
                          hexagon = {{5, 0}, {7, 0}, {8, 2}, {7, 4}, {5, 4}, {4, 2}},
                          triangle = {{10, 0}, {12, 0}, {11, 3}};
  std::vector<float> p;
  std::vector<int> counts, vertices;
  float z = 0;
  for (const auto& outline : {pentagon, hexagon, triangle}) {
    for (const vec2& q : outline) p.insert(p.end(), {q.x, q.y, z});
    counts.push_back(static_cast<int>(outline.size()));
    z += 1;
  }
  for (size_t i = 0; i < p.size() / 3; ++i) vertices.push_back(static_cast<int>(i));
  Problems problems;
  const PrimPtr prim = makePolygons(counts, vertices, {positions(p)}, problems);
  ASSERT_EQ(prim->patchCount(), 5u + 6u + 1u);
  double area[3] = {0, 0, 0};
  for (uint32_t patch = 0; patch < prim->patchCount(); ++patch) {
    const auto face = static_cast<size_t>(patch < 5 ? 0 : patch < 11 ? 1 : 2);
    const Sample s = sampleAt(*prim, patch, 0.5f, 0.5f);
    EXPECT_EQ(s.p.z, static_cast<float>(face));
    area[face] += glm::length(cross(s.du, s.dv));  // of a bilinear patch in its plane, that at its middle is the mean
  }
  EXPECT_NEAR(area[0], 7, 1e-5);
  EXPECT_NEAR(area[1], 12, 1e-5);
  EXPECT_NEAR(area[2], 3, 1e-5);
  expectSoundEverywhere(*prim);
}

TEST(Polygon, ReversedOrderTurnsTheNormal) {
  EXPECT_EQ(sampleAt(*polygon({0, 0, 0, 0, 1, 0, 1, 1, 0, 1, 0, 0}), 0, 0.3f, 0.3f).n, vec3(0, 0, -1));
  EXPECT_EQ(sampleAt(*polygon({0, 0, 0, 0, 1, 0, 1, 0, 0}), 0, 0.3f, 0.3f).n, vec3(0, 0, -1));
}

TEST(Polygon, ParametersAreObjectSpaceXAndY) {
  const PrimPtr prim = polygon({1, 5, 0, 3, 5, 2, 3, 9, 2, 1, 9, 0});
  const float u = 0.25f, v = 0.5f;
  float su, sv;
  prim->surfaceParameters(0, 1, &u, &v, &su, &sv);
  EXPECT_FLOAT_EQ(su, 1.5f);
  EXPECT_FLOAT_EQ(sv, 7);
}

TEST(Polygon, AWarpedQuadIsNotPlanarAndHasItsOwnNormals) {
  const PrimPtr prim = polygon({0, 0, 0, 1, 0, 0, 1, 1, 1, 0, 1, 0});
  EXPECT_FALSE(prim->info(0).planar);
  expectDerivativesOfPositions(*prim, 1e-3f);
  expectBoundsContainTheSurface(*prim);
}

TEST(Polygon, EdgesBetweenFacesAndInsideThemAreClosed) {
  Problems problems;  // a quad and a triangle that share edge 1-2
  const PrimPtr prim =
      makePolygons({4, 3}, {0, 1, 2, 3, 1, 4, 2}, {positions({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 2, 0, 0})}, problems);
  ASSERT_EQ(prim->patchCount(), 2u);
  EXPECT_EQ(prim->info(0).openEdges, kAllEdges & ~kEdgeU1);
  // From 1-4 to corner 2; 2-1 is shared, and the edge at the corner has no length that could gape.
  EXPECT_EQ(prim->info(1).openEdges, kEdgeV0 | kEdgeU1 | kEdgeV1);
}

TEST(Polygon, FacesThatShareAnEdgeAgreeOnItsPoints) {
  Problems problems;
  const std::vector<float> p = {0.1f, 0.2f, 0.3f, 1.7f, 0.1f, 0.9f,  1.3f, 1.1f, 0.2f, 0, 1,  0,
                                2.9f, 0.3f, 0.7f, 2.1f, 1.4f, -0.3f, 0,    -1,   0.4f, 2, -1, 0.1f};
  const PrimPtr prim = makePolygons({4, 4}, {0, 1, 2, 3, 1, 4, 5, 2}, {positions(p)}, problems);
  for (int k = 0; k <= 16; ++k) EXPECT_EQ(sampleAt(*prim, 0, 1, k / 16.0f).p, sampleAt(*prim, 1, 0, k / 16.0f).p);
  // The opposite sense: two faces that both walk 0-1 first.
  const PrimPtr mirrored = makePolygons({4, 4}, {0, 1, 2, 3, 1, 0, 6, 7}, {positions(p)}, problems);
  for (int k = 0; k <= 16; ++k)
    EXPECT_EQ(sampleAt(*mirrored, 0, k / 16.0f, 0).p, sampleAt(*mirrored, 1, 1 - k / 16.0f, 0).p);
}

TEST(Polygon, ATriangleIsOnePatchFromItsShortestSideToTheCornerAcross) {
  for (const std::vector<float>& p :
       {std::vector<float>{0, 0, 0, 1, 0, 0, 0, 3, 0}, {0, 3, 0, 0, 0, 0, 1, 0, 0}, {1, 0, 0, 0, 3, 0, 0, 0, 0}}) {
    const PrimPtr prim = polygon(p);
    ASSERT_EQ(prim->patchCount(), 1u);
    EXPECT_EQ(sampleAt(*prim, 0, 0, 0).p, vec3(0));
    EXPECT_EQ(sampleAt(*prim, 0, 1, 0).p, vec3(1, 0, 0));
    for (const float u : {0.0f, 0.5f, 1.0f}) EXPECT_EQ(sampleAt(*prim, 0, u, 1).p, vec3(0, 3, 0));
  }
}

TEST(Polygon, VaryingIsLinearOverATriangle) {
  Problems problems;
  const PrimPtr prim =
      makePolygons({3}, {0, 1, 2},
                   {positions({0, 0, 0, 1, 0, 0, 0, 1, 0}), floats("k", Storage::Varying, ValueType::Float, {0, 3, 6}),
                    floats("f", Storage::FaceVarying, ValueType::Float, {3, 6, 9})},
                   problems);
  for (const float u : {0.0f, 0.3f, 1.0f})
    for (const float v : {0.0f, 0.6f, 1.0f}) {
      const vec3 p = sampleAt(*prim, 0, u, v).p;
      EXPECT_NEAR(primvarAt(*prim, 0, 0, u, v)[0], 3 * p.x + 6 * p.y, 1e-6f);
      EXPECT_NEAR(primvarAt(*prim, 0, 1, u, v)[0], 3 + 3 * p.x + 6 * p.y, 1e-6f);
    }
}

TEST(Polygon, VaryingIsTheMeanAtTheCentreOfOthers) {
  Problems problems;  // a pentagon
  const PrimPtr prim = makePolygons({5}, {0, 1, 2, 3, 4},
                                    {positions({0, 0, 0, 2, 0, 0, 3, 2, 0, 1, 3, 0, -1, 2, 0}),
                                     floats("k", Storage::Varying, ValueType::Float, {0, 3, 6, 9, 12})},
                                    problems);
  ASSERT_EQ(prim->patchCount(), 5u);
  EXPECT_FLOAT_EQ(primvarAt(*prim, 0, 0, 0, 0)[0], 0);
  EXPECT_FLOAT_EQ(primvarAt(*prim, 0, 0, 1, 0)[0], 1.5f);
  for (uint32_t patch = 0; patch < 5; ++patch) EXPECT_FLOAT_EQ(primvarAt(*prim, patch, 0, 1, 1)[0], 6);
}

TEST(Polygon, UniformAndFaceVaryingBelongToTheirFaceWhenOthersAreDropped) {
  Problems problems;  // face 0 has no area
  const PrimPtr prim = makePolygons(
      {3, 4}, {0, 1, 1, 0, 1, 2, 3},
      {positions({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}), floats("k", Storage::Uniform, ValueType::Float, {7, 8}),
       floats("f", Storage::FaceVarying, ValueType::Float, {0, 0, 0, 1, 2, 3, 4})},
      problems);
  ASSERT_EQ(problems.size(), 1u);
  ASSERT_EQ(prim->patchCount(), 1u);
  EXPECT_EQ(primvarAt(*prim, 0, 0, 0.5f, 0.5f)[0], 8);
  EXPECT_EQ(primvarAt(*prim, 0, 1, 1, 0)[0], 2);
  EXPECT_EQ(primvarAt(*prim, 0, 1, 0, 1)[0], 4);
}

TEST(Polygon, WrongInputThrowsASentence) {
  Problems problems;
  EXPECT_EQ(errorOf([&] {
              makePolygons({4}, {0, 1, 2, 7}, {positions({0, 0, 0, 1, 0, 0, 1})}, problems);
            }),
            "P has 7 values where 8 vertices need 24 floats");
  EXPECT_NE(errorOf([&] { makePolygons({-3}, {0, 1, 2}, {positions({0, 0, 0})}, problems); }), "");
  EXPECT_NE(errorOf([&] { makePolygons({3}, {0, -1, 2}, {positions({0, 0, 0})}, problems); }), "");
  EXPECT_NE(errorOf([&] { makePolygons({4}, {0, 1, 2}, {positions({0, 0, 0})}, problems); }), "");
  EXPECT_NE(errorOf([&] { makePolygons({}, {}, {}, problems); }), "");
  EXPECT_NE(errorOf([&] { makePolygons({3}, {0, 1, 2}, {}, problems); }), "");
  EXPECT_NE(errorOf([&] { makePolygons({3}, {0, 1, 2}, {positions({0, 0, 0, 1, 0, 0, 0, NAN, 0})}, problems); }), "");
}

TEST(Polygon, DegenerateFacesAreDroppedWithASentence) {
  for (const std::vector<float>& p :
       {std::vector<float>{0, 0, 0, 1, 1, 1}, {0, 0, 0, 1, 1, 1, 2, 2, 2}, {1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1}}) {
    Problems problems;
    EXPECT_EQ(polygon(p, &problems)->patchCount(), 0u);
    EXPECT_EQ(problems.size(), 1u);
  }
}

TEST(NastyPolygon, SelfCrossingAndSpiralsNeitherCrashNorHang) {
  std::vector<vec2> pentagram, spiral;
  for (int i = 0; i < 5; ++i) pentagram.push_back({std::cos(4 * M_PI * i / 5), std::sin(4 * M_PI * i / 5)});
  for (int i = 0; i < 400; ++i) {
    const double turn = (i < 200 ? i : 399 - i) / 30.0, r = turn + (i < 200 ? 1 : 0.7);
    spiral.push_back({r * std::cos(turn), r * std::sin(turn)});
  }
  for (const auto& outline : {pentagram, spiral, std::vector<vec2>{{0, 0}, {2, 2}, {2, 0}, {0, 3}}}) {
    const PrimPtr prim = polygon(flat(outline));
    EXPECT_GT(prim->patchCount(), 0u);
    expectSoundEverywhere(*prim);
    expectBoundsContainTheSurface(*prim, 1000);
  }
}

TEST(NastyPolygon, ABowTieWhoseHalvesCancelIsDrawnInItsPlane) {
  const PrimPtr prim = polygon(flat({{0, 0}, {2, 2}, {2, 0}, {0, 2}}));
  EXPECT_GT(prim->patchCount(), 0u);
  EXPECT_EQ(std::abs(sampleAt(*prim, 0, 0.5f, 0.5f).n.z), glm::length(sampleAt(*prim, 0, 0.5f, 0.5f).n));
  Problems problems;
  makePolygons({4}, {0, 1, 2, 3}, {positions({0, 0, 0, 1, 1, 0, 3, 3, 0, 2, 2, 0})}, problems);
  EXPECT_EQ(problems.size(), 1u);  // on one line
}

TEST(NastyPolygon, FarFromTheOriginAndTinyKeepsItsNormal) {
  const PrimPtr prim = polygon({1000, 1000, 0, 1000.01f, 1000, 0, 1000.01f, 1000.01f, 0, 1000, 1000.01f, 0});
  EXPECT_EQ(sampleAt(*prim, 0, 0.5f, 0.5f).n, vec3(0, 0, 1));
}

TEST(Polygons, PartsOfAnOpenEdgeKnowTheWholeEdge) {
  for (const int n : {5, 7}) {
    std::vector<vec2> outline;
    for (int k = 0; k < n; ++k) {
      const float angle = 2 * kPi * static_cast<float>(k) / static_cast<float>(n);
      outline.emplace_back(std::cos(angle), std::sin(angle));
    }
    const PrimPtr prim = polygon(flat(outline));
    const std::vector<vec3> corners = pointsOf(flat(outline));
    int open = 0;
    for (uint32_t patch = 0; patch < prim->patchCount(); ++patch)
      for (const PatchEdge edge : {kEdgeU0, kEdgeU1, kEdgeV0, kEdgeV1}) {
        if (!(prim->info(patch).openEdges & edge)) continue;
        ++open;
        const auto ends = prim->straightEdge(patch, edge);
        ASSERT_TRUE(ends);
        const auto numberOf = [&](const vec3& p) {
          return std::find(corners.begin(), corners.end(), p) - corners.begin();
        };
        const auto a = numberOf((*ends)[0]), b = numberOf((*ends)[1]);
        EXPECT_TRUE((a + 1) % n == b || (b + 1) % n == a) << "patch " << patch << ": corners " << a << " and " << b;
      }
    EXPECT_GT(open, n) << "some edges are in two parts";
  }
}

}  // namespace
}  // namespace tomales
