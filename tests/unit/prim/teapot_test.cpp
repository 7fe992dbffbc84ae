#include "tests/unit/prim/support.h"

namespace tomales {
namespace {
using namespace test;

TEST(Teapot, StandsOnTheGroundAndHasItsSize) {
  Problems problems;
  const PrimPtr prim = makeTeapot({floats("k", Storage::Constant, ValueType::Float, {3})}, problems);
  EXPECT_TRUE(problems.empty());
  ASSERT_EQ(prim->patchCount(), 32u);
  Bound3 box;
  glm::dvec3 area(0);
  double volume = 0;
  const int side = 16;
  for (uint32_t patch = 0; patch < 32; ++patch)
    for (int j = 0; j < side; ++j)
      for (int i = 0; i < side; ++i) {
        const auto p = [&](int a, int b) {
          const vec3 q = sampleAt(*prim, patch, static_cast<float>(i + a) / side, static_cast<float>(j + b) / side).p;
          box.extend(q);
          return glm::dvec3(q);
        };
        const glm::dvec3 a = p(0, 0), b = p(1, 0), c = p(1, 1), d = p(0, 1), n = 0.5 * glm::cross(c - a, d - b);
        area += n;
        volume += glm::dot(0.25 * (a + b + c + d), n) / 3;
      }
  EXPECT_LT(glm::length(box.lo - vec3(-3, -2, 0)), 0.02f);
  EXPECT_LT(glm::length(box.hi - vec3(3.434f, 2, 3.15f)), 0.02f);
  EXPECT_NEAR(area.y, 0, 1e-4);  // the two halves mirror each other, both with their outside out
  EXPECT_GT(volume, 20);         // about a cylinder of radius 2 and height 2
  EXPECT_LT(volume, 28);
  for (uint32_t patch = 0; patch < 4; ++patch) {
    const Sample s = sampleAt(*prim, 4 + patch, 0.5f, 0.5f);  // the body's wall
    EXPECT_GT(dot(s.n, vec3(s.p.x, s.p.y, 0)), 0);
  }
  EXPECT_EQ(primvarAt(*prim, 31, 0, 0.5f, 0.5f)[0], 3);
  expectSoundEverywhere(*prim);
  expectBoundsContainTheSurface(*prim);
}

TEST(Teapot, ItsHalvesMirrorEachOtherAndItsPatchesMeetSmoothly) {
  Problems problems;
  const PrimPtr prim = makeTeapot({}, problems);
  struct Border {
    Sample ends[3];
  };
  std::vector<Border> borders;
  glm::dvec3 moments(0);
  for (uint32_t patch = 0; patch < 32; ++patch) {
    for (const float u : {0.2f, 0.5f, 0.8f})
      for (const float v : {0.2f, 0.5f, 0.8f}) {
        const glm::dvec3 p = sampleAt(*prim, patch, u, v).p;
        moments += p.y * glm::dvec3(1, p.x, p.z);
      }
    for (const auto& [u0, v0, u1, v1] : {std::array<float, 4>{0, 0, 1, 0}, {0, 1, 1, 1}, {0, 0, 0, 1}, {1, 0, 1, 1}}) {
      Border border;
      for (int k = 0; k < 3; ++k) {
        const float t = 0.25f * static_cast<float>(k + 1);
        border.ends[k] = sampleAt(*prim, patch, lerp(u0, u1, t), lerp(v0, v1, t));
      }
      borders.push_back(border);
    }
  }
  EXPECT_LT(glm::length(moments), 1e-3);
  const auto meet = [](const Border& a, const Border& b) {
    const float same = glm::length(a.ends[0].p - b.ends[0].p) + glm::length(a.ends[2].p - b.ends[2].p),
                opposite = glm::length(a.ends[0].p - b.ends[2].p) + glm::length(a.ends[2].p - b.ends[0].p);
    return std::min(same, opposite) < 1e-4f;
  };
  int joined = 0, creased = 0;
  for (size_t i = 0; i < borders.size(); ++i)
    for (size_t k = i + 1; k < borders.size(); ++k)
      if (glm::length(borders[i].ends[0].p - borders[i].ends[2].p) > 1e-4f && meet(borders[i], borders[k])) {
        ++joined;
        creased += std::abs(dot(glm::normalize(borders[i].ends[1].n), glm::normalize(borders[k].ends[1].n))) < 0.999f;
      }
  EXPECT_EQ(joined, 52);
  EXPECT_EQ(creased, 0);
}

// Sums over Newell's table, which any slip in it would change. The pot is open, so they depend on the origin.
TEST(Teapot, EachOfItsPartsHasTheAreaAndTheMomentsOfNewellsData) {
  Problems problems;
  const PrimPtr prim = makeTeapot({}, problems);
  struct Part {
    const char* name;
    uint32_t first, count;
    double area, volume;
    glm::dvec3 moment;
  };
  for (const Part& part : {Part{"body", 0, 12, 31.00016, 18.96901, {0, 0, 40.51910}},
                           Part{"lid", 12, 8, 6.76244, 5.15744, {0, 0, 17.67953}},
                           Part{"bottom", 20, 4, 7.56914, 0.47506, {0, 0, 0.28076}},
                           Part{"handle", 24, 4, 3.28591, 0.38842, {-7.90481, 0, 5.38679}},
                           Part{"spout", 28, 4, 4.27063, 0.96806, {10.27264, 0, 6.40296}}}) {
    double area = 0, volume = 0;
    glm::dvec3 moment(0);
    constexpr int kSide = 8;
    for (uint32_t patch = part.first; patch < part.first + part.count; ++patch)
      for (int k = 0; k < kSide * kSide; ++k) {
        const auto place = [](int i) { return (static_cast<float>(i) + 0.5f) / kSide; };
        const Sample s = sampleAt(*prim, patch, place(k % kSide), place(k / kSide));
        const glm::dvec3 p(s.p), n = glm::cross(glm::dvec3(s.du), glm::dvec3(s.dv)) / double{kSide * kSide};
        area += glm::length(n);
        volume += glm::dot(p, n) / 3;
        moment += glm::length(n) * p;
      }
    EXPECT_NEAR(area, part.area, 1e-3) << part.name;
    EXPECT_NEAR(volume, part.volume, 1e-3) << part.name;
    EXPECT_LT(glm::length(moment - part.moment), 1e-3)
        << part.name << ' ' << moment.x << ' ' << moment.y << ' ' << moment.z;
  }
}

TEST(Teapot, BlendsVaryingValuesOverEachPatch) {
  Problems problems;
  const PrimPtr prim = makeTeapot({floats("heat", Storage::Varying, ValueType::Float, {0, 1, 2, 4})}, problems);
  EXPECT_TRUE(problems.empty());
  EXPECT_FLOAT_EQ(primvarAt(*prim, 17, 0, 0.5f, 0.5f)[0], 1.75f);
  EXPECT_FLOAT_EQ(primvarAt(*prim, 17, 0, 1, 0)[0], 1);
}

TEST(Teapot, IsOpenOnlyWhereItsPartsEnd) {
  Problems problems;
  const PrimPtr prim = makeTeapot({}, problems);
  int open = 0;
  for (uint32_t patch = 0; patch < 32; ++patch)
    for (int bit = 0; bit < 4; ++bit) open += prim->info(patch).openEdges >> bit & 1;
  // Four quarters of the rim's inner edge and of the lid's lower one; two halves of both ends of handle and spout.
  EXPECT_EQ(open, 16);
}

}  // namespace
}  // namespace tomales
