#include "gi/gather/hemisphere.h"
#include "gi/gather/hessian.h"

#include <gtest/gtest.h>

#include <functional>
#include <set>

#include "reyes/base/rng.h"

namespace tomales {
namespace {

struct Seen {
  vec3 radiance;
  float distance;
};
using SeenFrom = std::function<Seen(const vec3& origin, const vec3& direction)>;

struct Curved {
  IrradianceRecord record;
  IrradianceCurvature curvature;
};

Curved lookTwice(const SeenFrom& world, const vec3& origin, const vec3& normal, int count, uint32_t seed) {
  const HemisphereCells cells = hemisphereCells(count);
  HemisphereSamples s{cells, {}, {}, normal, {}, {}, {}};
  orthonormalBasis(normal, s.tangent, s.bitangent);
  std::vector<vec3> directions, radiance;
  std::vector<float> distances;
  for (int j = 0; j < cells.rings; ++j)
    for (int k = 0; k < cells.sectors; ++k) {
      const uint32_t key = hashCombine(static_cast<uint32_t>(j * cells.sectors + k), seed);
      const vec3 d = hemisphereDirection(cells, j, k, {unitFloat(hash32(key)), unitFloat(hash32(key ^ 99U))});
      directions.push_back(d.x * s.tangent + d.y * s.bitangent + d.z * normal);
      const Seen seen = world(origin, directions.back());
      radiance.push_back(seen.radiance);
      distances.push_back(seen.distance);
    }
  s.directions = directions;
  s.radiance = radiance;
  s.distances = distances;
  return {summarize(s), curvatureOf(s)};
}

IrradianceRecord look(const SeenFrom& world, const vec3& origin, const vec3& normal, int count, uint32_t seed = 1) {
  return lookTwice(world, origin, normal, count, seed).record;
}

Curved lookCurved(const SeenFrom& world, int count, uint32_t seed) {
  return lookTwice(world, vec3(0), {0, 0, 1}, count, seed);
}

// E/pi by a midpoint rule, fine enough to differentiate.
double exactE(const SeenFrom& world, const vec3& origin, const vec3& normal) {
  constexpr int kRings = 400, kSectors = 1200;
  vec3 tangent, bitangent;
  orthonormalBasis(normal, tangent, bitangent);
  double sum = 0;
  for (int j = 0; j < kRings; ++j)
    for (int k = 0; k < kSectors; ++k) {
      const vec3 d = hemisphereDirection({kRings, kSectors}, j, k, vec2(0.5f));
      sum += static_cast<double>(world(origin, d.x * tangent + d.y * bitangent + d.z * normal).radiance.x);
    }
  return sum / (kRings * kSectors);
}

// A plane z = height that shines smoothly.
Seen smoothCeiling(const vec3& o, const vec3& d) {
  if (d.z <= 1e-4f) return {vec3(0.0f), kInfinity};
  const float t = (1.5f - o.z) / d.z;
  const vec3 p = o + t * d;
  return {vec3(std::exp(-((p.x - 1) * (p.x - 1) + 0.5f * p.y * p.y))), t};
}

// A bright rectangle that hangs below a dark ceiling.
Seen patchBelowCeiling(const vec3& o, const vec3& d) {
  if (d.z <= 1e-4f) return {vec3(0.0f), kInfinity};
  const float t = (1 - o.z) / d.z;
  const vec3 p = o + t * d;
  if (p.x > 0.2f && p.x < 1.4f && std::abs(p.y) < 0.8f) return {vec3(1.0f), t};
  return {vec3(0.0f), 4 / d.z};
}

constexpr vec3 kPole{0, 0, 1};

TEST(Hemisphere, CellsAreCloseToTheNumberAskedForAndNearlySquare) {
  for (const int asked : {1, 7, 50, 256, 600, 1000, 4000}) {
    const HemisphereCells c = hemisphereCells(asked);
    EXPECT_NEAR(c.rings * c.sectors, asked, 1 + 0.05f * static_cast<float>(asked)) << asked;
    if (asked < 50) continue;
    EXPECT_NEAR(static_cast<float>(c.sectors) / static_cast<float>(c.rings), kPi, 0.5f) << asked;
  }
}

TEST(Hemisphere, EveryCellHoldsExactlyOneUnitDirection) {
  const HemisphereCells cells = hemisphereCells(600);
  std::set<std::pair<int, int>> seen;
  for (int j = 0; j < cells.rings; ++j)
    for (int k = 0; k < cells.sectors; ++k) {
      const uint32_t key = hashCombine(static_cast<uint32_t>(j), static_cast<uint32_t>(k));
      const vec2 xi = 0.01f + 0.98f * vec2(unitFloat(key), unitFloat(hash32(key)));
      const vec3 d = hemisphereDirection(cells, j, k, xi);
      EXPECT_NEAR(glm::length(d), 1, 1e-6f);
      EXPECT_GE(d.z, 0);
      const float phi = std::atan2(d.y, d.x) / (2 * kPi);
      seen.insert({static_cast<int>((d.x * d.x + d.y * d.y) * static_cast<float>(cells.rings)),
                   static_cast<int>((phi < 0 ? phi + 1 : phi) * static_cast<float>(cells.sectors))});
    }
  EXPECT_EQ(seen.size(), static_cast<size_t>(cells.rings * cells.sectors));
}

TEST(Hemisphere, UniformRadianceGivesExactlyItself) {
  const auto r = look([](const vec3&, const vec3&) { return Seen{{1, 2, 0.5f}, kInfinity}; }, vec3(0), kPole, 600);
  EXPECT_EQ(r.light.E, vec3(1, 2, 0.5f));
  for (int c = 0; c < 3; ++c) {
    EXPECT_LT(glm::length(r.light.rotationGradient[c]), 1e-5f);
    EXPECT_EQ(r.light.translationGradient[c], vec3(0));
    EXPECT_NEAR(r.dominant[c].z, 1, 1e-3f);
  }
  EXPECT_EQ(r.closest, kInfinity);
  EXPECT_EQ(r.harmonicMean, kInfinity);
}

TEST(Hemisphere, IrradianceOfACosineLobeIsTwoThirds) {
  const vec3 n = glm::normalize(vec3(1, -2, 0.5f));
  const auto r = look([&](const vec3&, const vec3& d) { return Seen{vec3(dot(d, n)), 1}; }, vec3(0), n, 2000);
  EXPECT_NEAR(r.light.E.x, 2.0f / 3, 1e-3f);
}

TEST(Hemisphere, HalfADarkHemisphereGivesOneHalf) {
  const auto r = look(
      [](const vec3&, const vec3& d) {
        return Seen{vec3(d.x > 0 ? 1.0f : 0.0f), 1};
      },
      vec3(0), kPole, 2000);
  EXPECT_NEAR(r.light.E.x, 0.5f, 0.01f);
  EXPECT_NEAR(r.dominant[0].x, r.dominant[0].z / kPi * 2,
              0.02f);  // mean of x against mean of z: 4/(3 pi) to 2/3
}

TEST(Hemisphere, DistancesAreHarmonicMeanAndLeast) {
  const auto r = look(
      [](const vec3&, const vec3& d) {
        return Seen{vec3(0), d.x > 0 ? 2.0f : kInfinity};
      },
      vec3(0), kPole, 4000);
  EXPECT_EQ(r.closest, 2);
  EXPECT_NEAR(r.harmonicMean, 4, 0.05f);
  EXPECT_EQ(r.dominant[0], kPole);  // black: the normal
}

TEST(Hemisphere, DominantDirectionsAreThoseOfTheirChannel) {
  const auto r = look(
      [](const vec3&, const vec3& d) {
        return Seen{{d.x > 0.3f, d.y > 0.3f, 1}, 1};
      },
      vec3(0), kPole, 1000);
  EXPECT_GT(r.dominant[0].x, 0.5f);
  EXPECT_NEAR(r.dominant[0].y, 0, 0.03f);
  EXPECT_GT(r.dominant[1].y, 0.5f);
  EXPECT_NEAR(r.dominant[2].z, 1, 1e-3f);
}

TEST(Hemisphere, RotationGradientIsExactForALinearField) {
  // L = 1 + a.d has E/pi = 1 + 2/3 a.n over a whole sphere of directions.
  const vec3 a{0.6f, -0.3f, 0.1f}, n = glm::normalize(vec3(0.2f, 0.1f, 1));
  const auto r = look(
      [&](const vec3&, const vec3& d) {
        return Seen{vec3(1 + dot(a, d)), kInfinity};
      },
      vec3(0), n, 4000);
  for (const vec3& axis : {vec3(1, 0, 0), vec3(0, 1, 0)}) {
    const vec3 turned = glm::normalize(n + 0.01f * axis);
    const float change = 2.0f / 3 * dot(a, turned - n);
    EXPECT_NEAR(dot(cross(n, turned), r.light.rotationGradient[0]), change, 0.05f * std::abs(change));
  }
}

TEST(Hemisphere, RotationGradientMatchesFiniteDifferences) {
  for (const SeenFrom& world : {SeenFrom(smoothCeiling), SeenFrom(patchBelowCeiling)}) {
    const auto r = look(world, vec3(0), kPole, 4000);
    const vec3 turned = glm::normalize(vec3(0.02f, 0, 1)), back = glm::normalize(vec3(-0.02f, 0, 1));
    const double slope = exactE(world, vec3(0), turned) - exactE(world, vec3(0), back);
    EXPECT_NEAR(dot(cross(back, turned), r.light.rotationGradient[0]), slope, 0.03 * std::abs(slope));
  }
}

TEST(Hemisphere, TranslationGradientMatchesFiniteDifferences) {
  for (const SeenFrom& world : {SeenFrom(smoothCeiling), SeenFrom(patchBelowCeiling)}) {
    vec3 mean(0);
    constexpr int kRecords = 16;
    for (uint32_t seed = 0; seed < kRecords; ++seed)
      mean += look(world, vec3(0), kPole, 4000, seed).light.translationGradient[0] / static_cast<float>(kRecords);
    const double slope = (exactE(world, {0.05f, 0, 0}, kPole) - exactE(world, {-0.05f, 0, 0}, kPole)) / 0.1;
    EXPECT_NEAR(mean.x, slope, 0.05 * std::abs(slope));
    EXPECT_NEAR(mean.y, 0, 0.05 * std::abs(slope));
    EXPECT_EQ(mean.z, 0);
  }
}

TEST(Hemisphere, GradientsTurnWithTheFrame) {
  // The same world about another axis: magnitudes agree.
  const mat3 turn{vec3(0, 1, 0), vec3(0, 0, 1), vec3(1, 0, 0)};
  const SeenFrom turned = [&](const vec3&, const vec3& d) { return smoothCeiling(vec3(0), glm::transpose(turn) * d); };
  const auto a = look(smoothCeiling, vec3(0), kPole, 8000), b = look(turned, vec3(0), turn * kPole, 8000);
  const vec3 back = glm::transpose(turn) * b.light.translationGradient[0];
  EXPECT_LT(glm::length(back - a.light.translationGradient[0]), 0.1f * glm::length(a.light.translationGradient[0]));
  EXPECT_LT(glm::length(glm::transpose(turn) * b.light.rotationGradient[0] - a.light.rotationGradient[0]),
            0.03f * glm::length(a.light.rotationGradient[0]));
}

// Second differences of the exact E/pi.
vec3 exactHessian(const SeenFrom& world, float step) {
  const auto E = [&](float x, float y) { return exactE(world, {x, y, 0}, kPole); };
  const double h2 = static_cast<double>(step) * static_cast<double>(step), middle = E(0, 0);
  return {(E(step, 0) + E(-step, 0) - 2 * middle) / h2,
          (E(step, step) + E(-step, -step) - E(step, -step) - E(-step, step)) / (4 * h2),
          (E(0, step) + E(0, -step) - 2 * middle) / h2};
}

TEST(Hemisphere, TheHessianIsTheSecondDerivativeOfE) {
  for (const SeenFrom& world : {SeenFrom(smoothCeiling), SeenFrom(patchBelowCeiling)}) {
    const vec3 exact = exactHessian(world, 0.1f);
    vec3 mean(0);
    constexpr int kTries = 8;
    for (uint32_t seed = 0; seed < kTries; ++seed) {
      const Curved seen = lookCurved(world, 6000, seed);
      mean += vec3(seen.curvature.xx.x, seen.curvature.xy.x, seen.curvature.yy.x) / static_cast<float>(kTries);
    }
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(mean[c], exact[c], 0.12f * glm::length(exact)) << c;
  }
}

// E/pi of a rectangle (from and to x, from and to y) in the plane z = height, at a point of z = 0 (Lambert).
double exactOfRectangle(const glm::dvec4& r, double height, const glm::dvec2& at) {
  const glm::dvec3 corners[] = {{r.x, r.z, height}, {r.y, r.z, height}, {r.y, r.w, height}, {r.x, r.w, height}};
  double sum = 0;
  for (int i = 0; i < 4; ++i) {
    const glm::dvec3 a = corners[i] - glm::dvec3(at, 0), b = corners[(i + 1) % 4] - glm::dvec3(at, 0),
                     normal = cross(a, b);
    sum += std::atan2(glm::length(normal), dot(a, b)) * normal.z / glm::length(normal);
  }
  return sum / (2 * static_cast<double>(kPi));
}

TEST(Hemisphere, TheHessianIsThatOfTheClosedFormWhereASheetHidesTheLight) {
  const SeenFrom world = [](const vec3& o, const vec3& d) -> Seen {
    const vec3 p = o + 0.6f / d.z * d;
    const bool meetsOccluder = p.x > -0.3f && p.x < 0.25f && p.y > -0.35f && p.y < 0.4f;
    return meetsOccluder ? Seen{vec3(0.2f), 0.6f / d.z} : Seen{vec3(1), 5};
  };
  const auto E = [&](double x, double y) { return 1 - 0.8 * exactOfRectangle({-0.3, 0.25, -0.35, 0.4}, 0.6, {x, y}); };
  for (uint32_t i = 0; i < 40; ++i) {
    const vec3 at = 0.9f * vec3(2 * unitFloat(hash32(2 * i + 1)) - 1, 2 * unitFloat(hash32(2 * i + 2)) - 1, 0);
    const double x = static_cast<double>(at.x), y = static_cast<double>(at.y), h = 2e-3;
    const double middle = 2 * E(x, y);
    const double xx = (E(x + h, y) + E(x - h, y) - middle) / (h * h),
                 yy = (E(x, y + h) + E(x, y - h) - middle) / (h * h);
    const double xy = (E(x + h, y + h) + E(x - h, y - h) - E(x + h, y - h) - E(x - h, y + h)) / (4 * h * h);
    const IrradianceCurvature seen = lookTwice(world, at, kPole, 8000, i).curvature;
    const double size = std::abs(xx) + std::abs(xy) + std::abs(yy);
    EXPECT_NEAR(seen.xx.x, xx, 0.25 * size) << at.x << " " << at.y;
    EXPECT_NEAR(seen.xy.x, xy, 0.25 * size) << at.x << " " << at.y;
    EXPECT_NEAR(seen.yy.x, yy, 0.25 * size) << at.x << " " << at.y;
  }
}

TEST(Hemisphere, ALightThatFillsTheHemisphereHasNoHessian) {
  const Curved seen = lookCurved([](const vec3&, const vec3&) { return Seen{vec3(1), 2}; }, 600, 1);
  EXPECT_NEAR(seen.curvature.xx.x, 0, 1e-4f);
  EXPECT_GT(hessianRadius(seen.curvature, 1, 0.1f, 1), 2);
  EXPECT_FALSE(std::isnan(hessianRadius(seen.curvature, -1, 0.1f, 1))) << "estimates of light may be negative";
}

}  // namespace
}  // namespace tomales
