#include <glm/gtc/matrix_transform.hpp>

#include "reyes/prim/blobby_field.h"
#include "tests/unit/prim/support.h"

namespace tomales {
namespace {
using namespace test;

constexpr int kAdd = 0, kMultiply = 1, kMaximum = 2, kMinimum = 3, kDivide = 4, kSubtract = 5, kNegate = 6,
              kIdentity = 7, kConstant = 1000, kEllipsoid = 1001, kSegment = 1002;

PrimPtr blobby(int leaves, const std::vector<int>& code, const std::vector<float>& numbers, ParamList params = {}) {
  Problems problems;
  const PrimPtr prim = makeBlobby(leaves, code, numbers, {}, params, problems);
  EXPECT_TRUE(problems.empty());
  return prim;
}

/// Sixteen floats as RIB has them: scaled, then moved.
std::vector<float> ball(const vec3& center, const vec3& scale = vec3(1)) {
  return {scale.x, 0, 0, 0, 0, scale.y, 0, 0, 0, 0, scale.z, 0, center.x, center.y, center.z, 1};
}
std::vector<float> joined(std::initializer_list<std::vector<float>> lists) {
  std::vector<float> out;
  for (const auto& list : lists) out.insert(out.end(), list.begin(), list.end());
  return out;
}

/// The fall-off by its definition.
double fall(double distance) { return distance < 1 ? std::pow(1 - distance * distance, 3) : 0; }
double ballAt(const vec3& p, const vec3& center, const vec3& scale = vec3(1)) {
  return fall(glm::length(glm::dvec3(p - center) / glm::dvec3(scale)));
}

/// Calls check(sample) at 1000 random points.
template <class Check>
void atRandomPoints(const Prim& prim, const Check& check) {
  for (uint32_t k = 0; k < 1000; ++k)
    check(sampleAt(prim, k % prim.patchCount(), unitFloat(hashCombine(k, 1u)), unitFloat(hashCombine(k, 2u))));
}

/// The volume that the diced quadrilaterals enclose (Gauss), and the sum of their area vectors, which is 0 if they
/// enclose anything.
struct Enclosed {
  double volume = 0;
  glm::dvec3 gap{0};
};
Enclosed enclosedBy(const Prim& prim, int side) {
  Enclosed out;
  for (uint32_t patch = 0; patch < prim.patchCount(); ++patch)
    for (int j = 0; j < side; ++j)
      for (int i = 0; i < side; ++i) {
        const auto p = [&](int a, int b) {
          return glm::dvec3(
              sampleAt(prim, patch, static_cast<float>(i + a) / side, static_cast<float>(j + b) / side).p);
        };
        const glm::dvec3 a = p(0, 0), b = p(1, 0), c = p(1, 1), d = p(0, 1), area = 0.5 * glm::cross(c - a, d - b);
        out.gap += area;
        out.volume += glm::dot(0.25 * (a + b + c + d), area) / 3;
      }
  return out;
}

TEST(Blobby, AFieldIsTheSameWithinABoxHoweverLongItsChainOfOperations) {
  // Deeper than a stack, if each operation called the one before.
  constexpr uint32_t kOperations = 500'000;
  BlobField field({{glm::dmat3(1), glm::dvec3(0), glm::dvec3(0), glm::dvec3(0), 1}});
  field.addLeaf(0);
  for (uint32_t k = 0; k < kOperations; ++k) field.addOperation(k % 2 ? BlobOp::Identity : BlobOp::Negate, {&k, 1});
  const glm::dvec3 p(0.25, 0.125, -0.5);
  const BlobField part = field.within({p - 0.1, p + 0.1});
  EXPECT_EQ(part.leavesUsed(), 1u);
  EXPECT_EQ(part.at(p).value, field.at(p).value);
  EXPECT_EQ(std::abs(part.at(p).value), std::pow(1 - glm::dot(p, p), 3));
}

TEST(Blobby, LeavesOfAMaximumThatNearlyTouchStayApart) {
  // Two fingers of the width 0.8, 0.9 from axis to axis: a gap of 0.1, less than half a cell.
  const vec3 a(-0.45f, 0, 0), b(0.45f, 0.1f, 0), scale(0.8f, 1.6f, 0.8f);
  const PrimPtr prim =
      blobby(2, {kEllipsoid, 0, kEllipsoid, 16, kMaximum, 2, 0, 1}, joined({ball(a, scale), ball(b, scale)}));
  atRandomPoints(*prim, [&](const Sample& s) {
    EXPECT_NEAR(std::max(ballAt(s.p, a, scale), ballAt(s.p, b, scale)), 27.0 / 64, 1e-5);
  });
  const double one = 4 / 3.0 * M_PI * 0.4 * 0.8 * 0.4;
  EXPECT_NEAR(enclosedBy(*prim, 8).volume, 2 * one, 0.01 * one);
}

// Beside a crease some paths from the mesh miss the surface. They would miss it by far if they went on.
TEST(Blobby, WhatMissesTheSurfaceAtACreaseStaysBesideIt) {
  constexpr uint32_t kSeed = 6, kBalls = 4;
  std::vector<vec3> centers;
  std::vector<float> numbers, sizes;
  std::vector<int> code;
  for (uint32_t k = 0; k < kBalls; ++k) {
    const auto random = [&](uint32_t j) { return unitFloat(hashCombine(kSeed, k, j)); };
    centers.push_back({random(1), random(2), random(3)});
    sizes.push_back(0.3f + 0.7f * random(9));
    numbers = joined({numbers, ball(centers.back(), vec3(sizes.back()))});
    code.insert(code.end(), {kEllipsoid, static_cast<int>(16 * k)});
  }
  code.insert(code.end(), {kMaximum, 4, 0, 1, 2, 3});
  const PrimPtr prim = blobby(kBalls, code, numbers);
  int missed = 0;
  for (uint32_t i = 0; i < 2000; ++i) {
    const Sample s =
        sampleAt(*prim, i * 7919 % prim->patchCount(), unitFloat(hashCombine(i, 1u)), unitFloat(hashCombine(i, 2u)));
    double most = 0;
    for (size_t k = 0; k < kBalls; ++k) most = std::max(most, ballAt(s.p, centers[k], vec3(sizes[k])));
    EXPECT_NEAR(most, 27.0 / 64, 0.05);
    missed += std::abs(most - 27.0 / 64) > 1e-3;
  }
  EXPECT_GT(missed, 5) << "otherwise this tests nothing";
  EXPECT_LT(missed, 40);
}

TEST(Blobby, AKeyOfMotionIsTheNewSurfaceOnTheMeshOfTheFirst) {
  const std::vector<int> code = {kEllipsoid, 0, kEllipsoid, 16, kSegment, 32, kAdd, 3, 0, 1, 2};
  const auto numbers = [](const vec3& at, const vec3& scale, const vec3& end) {
    return joined(
        {ball(vec3(-0.4f, 0, 0)), ball(at, scale), {0, 0, 0, end.x, end.y, end.z, 0.7f}, ball(vec3(0, 1.8f, 0))});
  };
  const vec3 at(0.45f, 0.15f, 0.1f), scale(1.1f, 1, 1), end(0.6f, 0.2f, 0);  // neither parts nor merges
  Problems problems;
  const PrimPtr first = blobby(3, code, numbers({0.5f, 0, 0}, vec3(1), {0.5f, 0, 0}));
  const PrimPtr key = makeBlobbyKey(*first, 3, code, numbers(at, scale, end), {}, {}, problems);
  EXPECT_TRUE(problems.empty());
  ASSERT_EQ(key->patchCount(), first->patchCount());
  atRandomPoints(*key, [&](const Sample& s) {
    const vec3 q = s.p - vec3(0, 1.8f, 0);
    const float t = std::clamp(dot(q, end) / dot(end, end), 0.0f, 1.0f);
    EXPECT_NEAR(ballAt(s.p, {-0.4f, 0, 0}) + ballAt(s.p, at, scale) + fall(glm::length(q - t * end) / 0.7), 27.0 / 64,
                1e-5);
  });
  // Moved as a whole it is moved as a whole.
  const auto still = [](const vec3& by) { return joined({ball(by), ball(vec3(0.8f, 0, 0) + by)}); };
  const std::vector<int> two = {kEllipsoid, 0, kEllipsoid, 16, kAdd, 2, 0, 1};
  const vec3 by(1, 2, 3);
  const PrimPtr here = blobby(2, two, still(vec3(0))),
                there = makeBlobbyKey(*here, 2, two, still(by), {}, {}, problems);
  for (uint32_t patch = 0; patch < here->patchCount(); patch += 5)
    EXPECT_LT(glm::length(sampleAt(*there, patch, 0.3f, 0.6f).p - sampleAt(*here, patch, 0.3f, 0.6f).p - by), 1e-5f);
}

TEST(Blobby, AKeyOfOtherLeavesHasAMeshOfItsOwn) {
  const PrimPtr first = blobby(1, {kEllipsoid, 0}, ball(vec3(0)));
  const std::vector<int> code = {kEllipsoid, 0, kEllipsoid, 16, kAdd, 2, 0, 1};
  const std::vector<float> numbers = joined({ball(vec3(0)), ball(vec3(3, 0, 0))});
  Problems problems;
  const PrimPtr key = makeBlobbyKey(*first, 2, code, numbers, {}, {}, problems);
  EXPECT_EQ(key->patchCount(), blobby(2, code, numbers)->patchCount());
  for (uint32_t patch = 0; patch < key->patchCount(); ++patch) EXPECT_EQ(key->info(patch).openEdges, 0) << "closed";
}

TEST(Blobby, ALoneEllipsoidIsAnEllipsoidOfHalfItsSize) {
  const vec3 center(3, -1, 2), scale(2, 1, 0.5f);
  const PrimPtr prim = blobby(1, {kEllipsoid, 0}, ball(center, scale));
  atRandomPoints(*prim, [&](const Sample& s) {
    const vec3 q = (s.p - center) / scale;
    EXPECT_NEAR(glm::length(q), 0.5f, 5e-6f * 0.5f * 2);
    const vec3 normal = glm::normalize(q / scale);
    EXPECT_GT(dot(glm::normalize(s.n), normal), 1 - 1e-6f);
    EXPECT_LT(std::abs(dot(normal, s.du)) + std::abs(dot(normal, s.dv)), 1e-4f);
    EXPECT_GE(dot(cross(s.du, s.dv), normal), 0);
  });
  expectSoundEverywhere(*prim);
  expectBoundsContainTheSurface(*prim);
  expectDerivativesOfPositions(*prim, 1e-4f);
}

TEST(Blobby, AreaAndVolumeOfASphereConvergeAtSecondOrder) {
  const PrimPtr prim = blobby(1, {kEllipsoid, 0}, ball(vec3(0), vec3(2)));
  const double area = 4 * M_PI, volume = area / 3;
  const double coarse = std::abs(dicedArea(*prim, 2) - area), fine = std::abs(dicedArea(*prim, 8) - area);
  EXPECT_LT(fine, coarse / 12);
  EXPECT_LT(fine, 1e-3 * area);
  const double before = std::abs(enclosedBy(*prim, 2).volume - volume),
               after = std::abs(enclosedBy(*prim, 8).volume - volume);
  EXPECT_LT(after, before / 12);
  EXPECT_LT(after, 2e-3 * volume);
  EXPECT_LT(glm::length(enclosedBy(*prim, 3).gap), 1e-5 * area);
}

TEST(Blobby, ASegmentIsACapsuleOfHalfItsRadius) {
  const PrimPtr prim = blobby(1, {kSegment, 0}, joined({{-1, 0, 0, 2, 0, 0, 0.8f}, ball({0, 5, 0})}));
  atRandomPoints(*prim, [](const Sample& s) {
    EXPECT_NEAR(glm::length(s.p - vec3(std::clamp(s.p.x, -1.0f, 2.0f), 5, 0)), 0.4f, 1e-5f);
  });
  EXPECT_NEAR(dicedArea(*prim, 8), 2 * M_PI * 0.4 * 3 + 4 * M_PI * 0.16, 5e-3);
}

TEST(Blobby, EveryOperationIsWhatItsNameSays) {
  const vec3 a(0, 0, 0), b(0.6f, 0.1f, 0), c(0.2f, 0.5f, 0.3f);
  const std::vector<float> numbers = joined({ball(a), ball(b), ball(c), {0.3f}});
  const std::vector<int> leaves = {kEllipsoid, 0, kEllipsoid, 16, kEllipsoid, 32, kConstant, 48};
  struct Case {
    std::vector<int> code;
    double (*field)(double, double, double);
  };
  const Case cases[] = {
      {{kAdd, 3, 0, 1, 2}, [](double x, double y, double z) { return x + y + z; }},
      {{kMultiply, 2, 0, 1}, [](double x, double y, double) { return x * y; }},
      {{kMaximum, 3, 0, 1, 2},
       [](double x, double y, double z) {
         return std::max({x, y, z});
       }},
      {{kMinimum, 2, 0, 2}, [](double x, double, double z) { return std::min(x, z); }},
      {{kDivide, 0, 3}, [](double x, double, double) { return x / double{0.3f}; }},
      {{kSubtract, 0, 2}, [](double x, double, double z) { return x - z; }},
      {{kNegate, 1, kAdd, 2, 0, 4}, [](double x, double y, double) { return x - y; }},
      {{kIdentity, 1}, [](double, double y, double) { return y; }},
      {{kAdd, 2, 0, 1, kAdd, 2, 1, 2, kMaximum, 2, 4, 5},
       [](double x, double y, double z) { return std::max(x + y, y + z); }},
  };
  for (const Case& k : cases) {
    std::vector<int> code = leaves;
    code.insert(code.end(), k.code.begin(), k.code.end());
    const PrimPtr prim = blobby(4, code, numbers);
    ASSERT_GT(prim->patchCount(), 5u);
    int off = 0;
    atRandomPoints(*prim, [&](const Sample& s) {
      off += !(std::abs(k.field(ballAt(s.p, a), ballAt(s.p, b), ballAt(s.p, c)) - 0.421875) < 5e-6);
    });
    EXPECT_EQ(off, 0) << k.code[0] << " after " << k.code.size();
    const Enclosed enclosed = enclosedBy(*prim, 3);
    EXPECT_GT(enclosed.volume, 0) << k.code[0];
    EXPECT_LT(glm::length(enclosed.gap), 1e-4) << k.code[0];
    expectSoundEverywhere(*prim);
  }
}

TEST(Blobby, LeavesOfManySizesCloseTheirSurface) {
  // From 1 to 1/64, each touching the one before: cells of seven sizes next to each other.
  std::vector<int> code;
  std::vector<float> numbers;
  float x = 0, size = 1;
  for (int k = 0; k < 7; ++k, x += 0.5f * size, size *= 0.5f) {
    code.insert(code.end(), {kEllipsoid, 16 * k});
    numbers = joined({numbers, ball({x, 0.1f * size, 0}, vec3(size))});
  }
  code.insert(code.end(), {kAdd, 7, 0, 1, 2, 3, 4, 5, 6});
  const PrimPtr prim = blobby(7, code, numbers);
  EXPECT_LT(prim->patchCount(), 5000u);
  const Enclosed enclosed = enclosedBy(*prim, 2);
  EXPECT_LT(glm::length(enclosed.gap), 1e-4);
  EXPECT_GT(enclosed.volume, 4.0 / 3 * M_PI / 8);
  expectBoundsContainTheSurface(*prim);
}

TEST(Blobby, ValuesOfLeavesBlendByTheirShareOfTheField) {
  const vec3 a(-0.3f, 0, 0), b(0.3f, 0, 0);
  ParamList params = {floats("k", Storage::Varying, ValueType::Float, {1, 3}),
                      floats("Cs", Storage::Vertex, ValueType::Color, {1, 0, 0, 0, 0, 1}),
                      floats("c", Storage::Constant, ValueType::Float, {7})};
  const PrimPtr sum = blobby(2, {kEllipsoid, 0, kEllipsoid, 16, kAdd, 2, 0, 1}, joined({ball(a), ball(b)}), params);
  const PrimPtr larger =
      blobby(2, {kEllipsoid, 0, kEllipsoid, 16, kMaximum, 2, 0, 1}, joined({ball(a), ball(b)}), params);
  for (uint32_t patch = 0; patch < sum->patchCount(); ++patch) {
    const vec3 p = sampleAt(*sum, patch, 0.3f, 0.6f).p;
    const double x = ballAt(p, a), y = ballAt(p, b);
    EXPECT_NEAR(primvarAt(*sum, patch, 0, 0.3f, 0.6f)[0], (x + 3 * y) / (x + y), 1e-4);
    EXPECT_NEAR(primvarAt(*sum, patch, 1, 0.3f, 0.6f)[2], y / (x + y), 1e-4);
    EXPECT_EQ(primvarAt(*sum, patch, 2, 0.3f, 0.6f)[0], 7);
  }
  for (uint32_t patch = 0; patch < larger->patchCount(); ++patch) {
    const vec3 p = sampleAt(*larger, patch, 0.3f, 0.6f).p;
    EXPECT_EQ(primvarAt(*larger, patch, 0, 0.3f, 0.6f)[0], p.x < 0 ? 1 : 3);
  }
}

/// A picture from 2 above the plane z = 0, looking down: two wide, row 0 at y = 1. Depth grows with x by `slope`;
/// nothing is seen beyond x = edge.
GroundPicture groundAt(float slope, float edge = 1) {
  constexpr int kSize = 64;
  GroundPicture out{kSize, kSize, {}, mat4(1.0f), mat4(1.0f)};
  for (int y = 0; y < kSize; ++y)
    for (int x = 0; x < kSize; ++x) {
      const float at = -1 + 2 * (static_cast<float>(x) + 0.5f) / kSize;
      out.depth.push_back(at < edge ? 2 + slope * at : INFINITY);
    }
  out.cameraFromObject = glm::translate(mat4(1.0f), vec3(0, 0, 2)) * glm::scale(mat4(1.0f), vec3(1, 1, -1));
  out.texelFromObject =
      glm::scale(glm::translate(mat4(1.0f), vec3(kSize / 2, kSize / 2, 0)), vec3(kSize / 2, -kSize / 2, 1));
  return out;
}

/// The note's formula, word by word.
double repulsionAt(double z, double A, double B, double C, double D) {
  const auto bump = [](double r) {
    return r <= 0 || r >= 2 ? 0 : std::pow(r, 3) * (8 - 12 * r + 6 * r * r - std::pow(r, 3));
  };
  const auto ease = [](double r) { return r >= 1 ? 1 : r * r * (3 - 2 * r); };
  return z >= A ? 0 : (D * bump(z / C) - B / z) * (1 - ease(z / A));
}

TEST(RepelledBlobby, FollowsTheFormulaOverPlaneAndSlopedGrounds) {
  const std::vector<float> numbers = joined({ball(vec3(0, 0, 0.3f)), {0.4f, 0.01f, 0.15f, 0.3f}});
  const std::vector<int> code = {kEllipsoid, 0, 1003, 0, 16, kAdd, 2, 0, 1};
  for (const float slope : {0.0f, -0.3f}) {
    Problems problems;
    const PrimPtr prim = makeBlobby(
        2, code, numbers, [&](int) { return groundAt(slope); }, {}, problems);
    EXPECT_TRUE(problems.empty());
    float lowest = 1;
    atRandomPoints(*prim, [&](const Sample& s) {
      const double z = s.p.z + slope * s.p.x;  // above the ground, along the view
      ASSERT_GT(z, 0);
      EXPECT_NEAR(ballAt(s.p, {0, 0, 0.3f}) + repulsionAt(z, 0.4f, 0.01f, 0.15f, 0.3f), 27.0 / 64, 1e-4);
      lowest = std::min(lowest, static_cast<float>(z));
    });
    EXPECT_LT(lowest, 0.1f) << "it comes near";
    EXPECT_LT(enclosedBy(*prim, 8).gap.x, 1e-3);
    expectSoundEverywhere(*prim);
  }
}

TEST(RepelledBlobby, IsWhatItIsWithoutGroundAboveItsHeightAndWherePicturesShowNothing) {
  const std::vector<int> code = {kEllipsoid, 0, 1003, 0, 16, kAdd, 2, 0, 1};
  Problems problems;
  for (const bool high : {true, false}) {
    const vec3 center(0, 0, high ? 1.0f : 0.3f);
    const PrimPtr prim = makeBlobby(
        2, code, joined({ball(center), {0.4f, 0.01f, 0.15f, 0.3f}}),
        [&](int) -> std::optional<GroundPicture> { return high ? groundAt(0) : groundAt(0, -1); }, {}, problems);
    atRandomPoints(*prim, [&](const Sample& s) { EXPECT_NEAR(glm::distance(s.p, center), 0.5f, 1e-4f); });
  }
  const PrimPtr unread = makeBlobby(
      2, code, joined({ball(vec3(0)), {0.4f, 0.01f, 0.15f, 0.3f}}), [](int) { return std::nullopt; }, {}, problems);
  atRandomPoints(*unread, [&](const Sample& s) { EXPECT_NEAR(glm::length(s.p), 0.5f, 1e-4f); });
  EXPECT_TRUE(problems.empty());
}

TEST(NastyBlobby, ArraysThatDoNotFitThrowASentence) {
  Problems problems;
  const auto errorWith = [&](const std::vector<int>& code, const std::vector<float>& numbers) {
    return errorOf([&] { makeBlobby(1, code, numbers, {}, {}, problems); });
  };
  EXPECT_EQ(errorWith({}, {}), "it has no operations and no leaves");
  EXPECT_EQ(errorWith({kEllipsoid}, {}), "its list of codes ends in the middle of an operation");
  EXPECT_NE(errorWith({kEllipsoid, 1}, ball(vec3(0))), "");
  EXPECT_NE(errorWith({kEllipsoid, -1}, ball(vec3(0))), "");
  EXPECT_NE(errorWith({kEllipsoid, 0, kAdd, 2, 0, 1}, ball(vec3(0))), "");  // of itself
  EXPECT_NE(errorWith({kEllipsoid, 0, kAdd, -1}, ball(vec3(0))), "");
  EXPECT_NE(errorWith({kEllipsoid, 0, kNegate, 5}, ball(vec3(0))), "");
  EXPECT_EQ(errorWith({99}, {}), "there is no operation or leaf 99");
  EXPECT_EQ(errorWith({kConstant, 0}, {1}), "it has no leaf of any size");
}

TEST(NastyBlobby, WhatHasNoSurfaceIsEmptyAndWhatIsUnknownIsNamed) {
  EXPECT_EQ(
      blobby(2, {kEllipsoid, 0, kConstant, 16, kMultiply, 2, 0, 1}, joined({ball(vec3(0)), {0.1f}}))->patchCount(), 0u);
  EXPECT_EQ(blobby(2, {kEllipsoid, 0, kConstant, 16, kDivide, 0, 1}, joined({ball(vec3(0)), {0}}))->patchCount(), 0u);
  Problems problems;
  EXPECT_GT(makeBlobby(2, {kEllipsoid, 0, 1004, 0, 1, 16, 0, 0, kAdd, 2, 0, 1}, joined({ball(vec3(0)), {1}}), {}, {},
                       problems)
                ->patchCount(),
            0u);
  EXPECT_EQ(problems.size(), 1u);
  problems.clear();
  makeBlobby(3, {kEllipsoid, 0, kEllipsoid, 16, kAdd, 2, 0, 1}, joined({ball(vec3(0)), ball(vec3(1), {1, 0, 1})}), {},
             {}, problems);
  EXPECT_EQ(problems.size(), 2u);  // a flat leaf; two leaves where three are announced
}

TEST(NastyBlobby, ExtremeScalesAndOverlapsAreSound) {
  for (const float scale : {1e-6f, 1e6f}) {
    const PrimPtr prim = blobby(1, {kEllipsoid, 0}, ball(vec3(scale), vec3(scale)));
    expectSoundEverywhere(*prim);
    EXPECT_NEAR(dicedArea(*prim, 4) / scale / scale, M_PI, 0.02);
  }
  expectSoundEverywhere(*blobby(2, {kEllipsoid, 0, kEllipsoid, 0, kAdd, 2, 0, 1}, ball(vec3(0), {1, 0.05f, 1})));
  // A thousandth as thick as wide: its cells would be too many, which it says.
  Problems problems;
  makeBlobby(1, {kEllipsoid, 0}, ball(vec3(0), {1, 1e-3f, 1}), {}, {}, problems);
  EXPECT_EQ(problems.size(), 1u);
}

}  // namespace
}  // namespace tomales
