#include <set>

#include "tests/unit/prim/support.h"

namespace tomales {
namespace {
using namespace test;

using Loop = std::vector<vec2>;

Loop reversed(Loop loop) {
  std::reverse(loop.begin(), loop.end());
  return loop;
}

Loop circle(vec2 center, float radius, int n, float turn = 0) {
  Loop out;
  for (int i = 0; i < n; ++i) {
    const double a = 2 * M_PI * (i + turn) / n;
    out.push_back(center + radius * vec2(std::cos(a), std::sin(a)));
  }
  return out;
}

double areaOf(const Loop& loop) {
  double twice = 0;
  for (size_t i = 0; i < loop.size(); ++i) {
    const glm::dvec2 a = loop[i], b = loop[(i + 1) % loop.size()];
    twice += a.x * b.y - a.y * b.x;
  }
  return std::abs(twice) / 2;
}

PrimPtr polygon(const std::vector<Loop>& loops, Problems& problems, ParamList params = {}) {
  std::vector<int> counts, vertices;
  std::vector<float> p;
  for (const Loop& loop : loops) {
    counts.push_back(static_cast<int>(loop.size()));
    for (const vec2& q : loop) {
      vertices.push_back(static_cast<int>(vertices.size()));
      p.insert(p.end(), {q.x, q.y, 0});
    }
  }
  params.push_back(positions(p));
  return makeGeneralPolygons({static_cast<int>(loops.size())}, counts, vertices, params, problems);
}

/// The area of the outline less that of the holes, and nothing inside of a hole.
void expectHolesAreOut(const std::vector<Loop>& loops) {
  Problems problems;
  const PrimPtr prim = polygon(loops, problems);
  EXPECT_TRUE(problems.empty());
  double area = areaOf(loops[0]), signedArea = 0;
  for (size_t k = 1; k < loops.size(); ++k) area -= areaOf(loops[k]);
  EXPECT_NEAR(dicedArea(*prim, 1), area, 1e-5 * area);
  for (uint32_t patch = 0; patch < prim->patchCount(); ++patch) {
    const Sample s = sampleAt(*prim, patch, 0.5f, 0.5f);
    signedArea += cross(s.du, s.dv).z;
    EXPECT_EQ(s.n, vec3(0, 0, 1));
  }
  EXPECT_NEAR(signedArea, area, 1e-5 * area);
  expectSoundEverywhere(*prim);
}

const Loop kSquare = {{0, 0}, {4, 0}, {4, 4}, {0, 4}}, kHole = {{1, 1}, {2, 1}, {2, 3}, {1, 3}};

TEST(PolygonWithHoles, AreaIsExactWhicheverWayTheHoleGoes) {
  expectHolesAreOut({kSquare, kHole});
  expectHolesAreOut({kSquare, reversed(kHole)});
}

TEST(PolygonWithHoles, AreaIsExactForManyHolesInAConcaveOutline) {
  const Loop comb = {{0, 0}, {9, 0}, {9, 6}, {6, 6}, {6, 2}, {5, 2}, {5, 6}, {0, 6}};
  expectHolesAreOut({comb,
                     circle({2, 3}, 1, 12),
                     circle({7.5f, 3}, 1, 7, 0.4f),
                     circle({2, 5}, 0.4f, 3),
                     circle({4, 1}, 0.5f, 40, 0.1f),
                     {{8, 0.5f}, {8.5f, 0.5f}, {8.25f, 1}}});
}

TEST(PolygonWithHoles, AreaIsExactForAGridOfEqualHoles) {
  std::vector<Loop> loops = {{{0, 0}, {10, 0}, {10, 10}, {0, 10}}};
  for (int j = 0; j < 9; ++j)
    for (int i = 0; i < 9; ++i) loops.push_back(circle({i + 1, j + 1}, 0.4f, 4 + (i + j) % 5, 0.5f));
  expectHolesAreOut(loops);
}

TEST(PolygonWithHoles, AreaIsExactForRandomHoles) {
  for (uint32_t seed = 0; seed < 60; ++seed) {
    std::vector<Loop> loops = {circle({0, 0}, 10, 5 + static_cast<int>(seed % 20), unitFloat(hash32(seed)))};
    std::vector<vec3> taken;
    for (uint32_t k = 0; k < 40; ++k) {
      const auto random = [&](uint32_t what) { return unitFloat(hashCombine(seed, k, what)); };
      const vec3 c(10 * random(0) - 5, 10 * random(1) - 5, 0.2f + random(2));
      const auto meets = [&](const vec3& o) { return glm::length(vec2(o) - vec2(c)) < o.z + c.z + 0.01f; };
      if (std::any_of(taken.begin(), taken.end(), meets)) continue;
      taken.push_back(c);
      const Loop hole = circle(vec2(c), c.z, 3 + static_cast<int>(k % 9), random(3));
      loops.push_back(k % 2 ? hole : reversed(hole));
    }
    expectHolesAreOut(loops);
  }
}

TEST(PolygonWithHoles, AHoleMayTouchTheOutlineOrAnotherHole) {
  expectHolesAreOut({kSquare, {{2, 1}, {4, 2}, {2, 3}}});                            // a corner on an edge
  expectHolesAreOut({kSquare, {{2, 1}, {4, 4}, {1, 3}}});                            // on a corner
  expectHolesAreOut({kSquare, {{1, 1}, {2, 2}, {1, 3}}, {{2, 2}, {3, 1}, {3, 3}}});  // two holes at a corner
}

TEST(PolygonWithHoles, HolesMayTouchTheOutlineAtCorners) {
  const Loop spike = {{0, 0}, {2, 3.25f}, {3.25f, 3.25f}};  // widens from a corner of the outline
  expectHolesAreOut({kSquare, spike});
  expectHolesAreOut({kSquare, spike, {{0, 0}, {1, 0.5f}, {0.5f, 0.25f}}, {{0, 0}, {0.5f, 3}, {0.25f, 3}}});
  expectHolesAreOut({kSquare, {{0, 0}, {4, 4}, {3, 0.5f}}});                               // cuts it in two
  expectHolesAreOut({kSquare, {{4, 0}, {1, 1}, {2, 3}}, {{1, 1}, {0.5f, 3}, {0.5f, 1}}});  // one behind the other
}

/// The loops around a connected set of unit squares, the outline first; where two squares touch at a corner
/// the walk stays at its own, or passes over.
std::vector<Loop> loopsAround(const std::set<std::pair<int, int>>& squares, bool stay, const glm::mat2& place) {
  using Way = std::array<int, 4>;  // from x, y by dx, dy; the set is to the left
  std::set<Way> ways;
  for (const auto& [x, y] : squares) {
    if (!squares.contains({x, y - 1})) ways.insert({x, y, 1, 0});
    if (!squares.contains({x + 1, y})) ways.insert({x + 1, y, 0, 1});
    if (!squares.contains({x, y + 1})) ways.insert({x + 1, y + 1, -1, 0});
    if (!squares.contains({x - 1, y})) ways.insert({x, y + 1, 0, -1});
  }
  std::vector<Loop> loops;
  while (!ways.empty()) {
    Loop loop;
    double twice = 0;
    for (Way way = *ways.begin(); ways.erase(way);) {
      loop.push_back(place * vec2(way[0], way[1]));
      twice += way[0] * way[3] - way[1] * way[2];
      const int x = way[0] + way[2], y = way[1] + way[3], turned = stay ? 1 : -1;
      for (const Way& next : {Way{x, y, -turned * way[3], turned * way[2]}, Way{x, y, way[2], way[3]},
                              Way{x, y, turned * way[3], -turned * way[2]}})
        if (ways.contains(next)) {
          way = next;
          break;
        }
    }
    loops.insert(twice > 0 ? loops.begin() : loops.end(), loop);
  }
  return loops;
}

TEST(PolygonWithHoles, AreaIsExactWhereLoopsTouchThemselvesAndEachOtherAtVertices) {
  for (uint32_t seed = 0; seed < 400; ++seed) {
    const auto isGiven = [&](int x, int y) {
      return x >= 0 && y >= 0 && x < 7 && y < 7 &&
             unitFloat(hashCombine(seed, static_cast<uint32_t>(x), static_cast<uint32_t>(y))) < 0.65f;
    };
    std::set<std::pair<int, int>> squares;
    std::vector<std::pair<int, int>> found = {{3, 3}};
    while (!found.empty()) {
      const auto [x, y] = found.back();
      found.pop_back();
      if (!squares.insert({x, y}).second) continue;
      for (const auto& next : {std::pair(x + 1, y), std::pair(x - 1, y), std::pair(x, y + 1), std::pair(x, y - 1)})
        if (isGiven(next.first, next.second)) found.push_back(next);
    }
    for (const bool stay : {false, true})
      for (const glm::mat2& place : {glm::mat2(1), glm::mat2(0.8f, 0.6f, -0.5f, 0.9f)}) {
        const std::vector<Loop> loops = loopsAround(squares, stay, place);
        double area = areaOf(loops[0]);
        for (size_t k = 1; k < loops.size(); ++k) area -= areaOf(loops[k]);
        EXPECT_NEAR(area, static_cast<double>(squares.size()) * glm::determinant(place), 1e-4) << "the test is wrong";
        expectHolesAreOut(loops);
        if (HasFailure()) FAIL() << "seed " << seed << " stay " << stay;
      }
  }
}

TEST(PolygonWithHoles, EdgesOfTheHoleAreOpenAndBridgesAreNot) {
  Problems problems;
  const PrimPtr prim = polygon({kSquare, kHole}, problems);
  int open = 0;
  for (uint32_t patch = 0; patch < prim->patchCount(); ++patch) {
    const uint8_t edges = prim->info(patch).openEdges;
    open += !!(edges & kEdgeU0) + !!(edges & kEdgeU1) + !!(edges & kEdgeV0);
    EXPECT_EQ(edges & kEdgeV1, kEdgeV1);  // a corner of a triangle
  }
  EXPECT_EQ(open, 8);
}

TEST(PolygonWithHoles, ValuesAreCountedByLoop) {
  Problems problems;
  std::vector<float> x, faceVarying;
  for (const Loop& loop : {kSquare, kHole})
    for (const vec2& p : loop) {
      x.push_back(p.x);
      faceVarying.push_back(p.y);
    }
  const PrimPtr prim = polygon({kSquare, kHole}, problems,
                               {floats("x", Storage::Varying, ValueType::Float, x),
                                floats("y", Storage::FaceVarying, ValueType::Float, faceVarying)});
  EXPECT_TRUE(problems.empty());
  for (uint32_t patch = 0; patch < prim->patchCount(); ++patch) {
    const vec3 p = sampleAt(*prim, patch, 0.3f, 0.6f).p;
    EXPECT_NEAR(primvarAt(*prim, patch, 0, 0.3f, 0.6f)[0], p.x, 1e-5f);
    EXPECT_NEAR(primvarAt(*prim, patch, 1, 0.3f, 0.6f)[0], p.y, 1e-5f);
  }
}

TEST(PolygonWithHoles, FacesKeepTheirLoopsAndUniformValues) {
  Problems problems;  // two squares side by side, the first with a hole
  const std::vector<float> p = {0, 0, 0, 4, 0, 0, 4, 4, 0, 0, 4, 0, 8, 0, 0,
                                8, 4, 0, 1, 1, 0, 2, 1, 0, 2, 3, 0, 1, 3, 0};
  const PrimPtr prim =
      makeGeneralPolygons({2, 1}, {4, 4, 4}, {0, 1, 2, 3, 6, 7, 8, 9, 1, 4, 5, 2},
                          {positions(p), floats("k", Storage::Uniform, ValueType::Float, {1, 2})}, problems);
  EXPECT_NEAR(dicedArea(*prim, 1), 14 + 16, 1e-4);
  const uint32_t last = prim->patchCount() - 1;
  EXPECT_EQ(primvarAt(*prim, 0, 0, 0.5f, 0.5f)[0], 1);
  EXPECT_EQ(primvarAt(*prim, last, 0, 0.5f, 0.5f)[0], 2);
  EXPECT_EQ(prim->info(last).openEdges, kAllEdges & ~kEdgeU0);
}

TEST(NastyHoles, OutsideCrossingOrFlatNeitherCrashNorHang) {
  Problems problems;
  EXPECT_NEAR(dicedArea(*polygon({kSquare, {{7, 7}, {8, 7}, {8, 8}}}, problems), 1), 16, 1e-5);
  EXPECT_EQ(problems.size(), 1u);
  EXPECT_NEAR(dicedArea(*polygon({kSquare, {{1, 1}, {2, 2}}, {}, {{3, 3}}}, problems), 1), 16, 1e-5);
  for (const Loop& hole : {Loop{{2, 2}, {9, 1}, {9, 5}}, Loop{{-1, -1}, {5, -1}, {5, 5}, {-1, 5}}, kSquare,
                           Loop{{1, 1}, {3, 3}, {3, 1}, {1, 3.5f}}})
    expectSoundEverywhere(*polygon({kSquare, hole, kHole}, problems));
}

TEST(NastyHoles, LoopsThatDoNotAddUpThrowASentence) {
  Problems problems;
  const auto errorWith = [&](const std::vector<int>& loops) {
    return errorOf([&] {
      makeGeneralPolygons(loops, {3}, {0, 1, 2}, {positions({0, 0, 0, 1, 0, 0, 1, 1, 0})}, problems);
    });
  };
  EXPECT_EQ(errorWith({1}), "");
  EXPECT_EQ(errorWith({2}), "the faces need 2 loops and 1 are given");
  EXPECT_EQ(errorWith({0, 1}), "face 0 has 0 loops");
  EXPECT_NE(errorWith({}), "");
}

}  // namespace
}  // namespace tomales
