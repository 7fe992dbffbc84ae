// The lobe that plugins and disney share, against the integrals that define it.
#include "reyes/shader/ggx.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace tomales {
namespace {

using rsl::Ggx;
using rsl::Vec3;

const Vec3 kNormal = rsl::normalize({0.3f, -0.2f, 0.9f});

/// A direction by its angle to the normal and around it.
Vec3 direction(double cosine, double around) {
  Vec3 tangent, bitangent;
  rsl::orthonormalBasis(kNormal, tangent, bitangent);
  const double sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
  return float(sine * std::cos(around)) * tangent + float(sine * std::sin(around)) * bitangent +
         float(cosine) * kNormal;
}

/// The integral over the hemisphere, whose middle has most of the points: cosine = 1 - x^4.
template <class Of>
double overHemisphere(const Of& of) {
  constexpr int kAcross = 400, kAround = 240;
  double sum = 0;
  for (int i = 0; i < kAcross; ++i)
    for (int j = 0; j < kAround; ++j) {
      const double x = (i + 0.5) / kAcross, around = 2 * M_PI * (j + 0.5) / kAround;
      sum += of(direction(1 - std::pow(x, 4), around)) * 4 * std::pow(x, 3) / kAcross * 2 * M_PI / kAround;
    }
  return sum;
}

float reflectedDensity(const Ggx& ggx, const Vec3& V, const Vec3& L) {
  return ggx.reflectedDensity(rsl::dot(kNormal, V), rsl::dot(kNormal, rsl::normalize(L + V)));
}

constexpr float kWidths[] = {0.1f, 0.3f, 0.7f, 1};
constexpr double kCosines[] = {0.05, 0.3, 0.8, 1};

TEST(Ggx, TheFacetsCoverTheSurfaceOnce) {
  for (const float alpha : kWidths)
    EXPECT_NEAR(overHemisphere([&](const Vec3& H) {
                  const float NH = rsl::dot(kNormal, H);
                  return Ggx(alpha).distribution(NH) * NH;
                }),
                1, 2e-3)
        << alpha;
}

// Smith's masking is what makes this so (Heitz 2014, eq. 14): the facets that a viewer sees cover what it sees of the
// surface.
TEST(Ggx, TheFacetsThatAViewerSeesCoverWhatItSeesOfTheSurface) {
  for (const float alpha : kWidths)
    for (const double NV : kCosines) {
      const Vec3 V = direction(NV, 1.1);
      EXPECT_NEAR(overHemisphere([&](const Vec3& H) {
                    return Ggx(alpha).visibleDensity(float(NV), rsl::dot(kNormal, H), rsl::dot(V, H));
                  }),
                  1, 4e-3)
          << alpha << " " << NV;
    }
}

// The weak white furnace test (Heitz 2014, section 5.2): without shadowing, every ray that comes in goes out, up or
// down.
TEST(Ggx, ReflectedDirectionsAreAllDirections) {
  for (const float alpha : {0.3f, 1.0f})
    for (const double NV : kCosines) {
      const Vec3 V = direction(NV, 2);
      const auto density = [&](const Vec3& L) {
        return dot(L + V, L + V) > 1e-8f ? reflectedDensity(Ggx(alpha), V, L) : 0.0f;
      };
      EXPECT_NEAR(overHemisphere(density) + overHemisphere([&](const Vec3& L) { return density(-L); }), 1, 1e-2)
          << alpha << " " << NV;
    }
}

TEST(Ggx, ReflectsTheSameBothWaysAndNoMoreThanItGets) {
  for (const float alpha : kWidths)
    for (const double NV : kCosines) {
      const Ggx ggx(alpha);
      EXPECT_EQ(ggx.reflection(0.4f, float(NV), 0.9f), ggx.reflection(float(NV), 0.4f, 0.9f));
      const Vec3 V = direction(NV, 0.4);
      const double sent = overHemisphere([&](const Vec3& L) {
        const float NL = rsl::dot(kNormal, L);
        return NL * ggx.reflection(NL, float(NV), rsl::dot(kNormal, rsl::normalize(L + V)));
      });
      EXPECT_LE(sent, 1.003) << alpha << " " << NV;
      if (alpha == 0.1f && NV > 0.5) {
        EXPECT_GT(sent, 0.98) << "hardly a facet hides another";
      }
    }
}

// Pearson's test, over the bins where at least 20 are expected.
TEST(Ggx, NormalsAreDrawnByTheirDensity) {
  constexpr int kAcross = 12, kAround = 12, kDrawn = 60000;
  for (const float alpha : {0.2f, 0.6f, 1.0f})
    for (const double NV : {0.1, 0.5, 0.95}) {
      const Ggx ggx(alpha);
      const Vec3 V = direction(NV, 0.7);
      Vec3 tangent, bitangent;
      rsl::orthonormalBasis(kNormal, tangent, bitangent);
      const auto binOf = [&](const Vec3& H) {
        const double x = std::pow(std::max(0.0, 1.0 - rsl::dot(kNormal, H)), 0.25),
                     around = std::atan2(rsl::dot(H, bitangent), rsl::dot(H, tangent)) / (2 * M_PI) + 0.5;
        return std::min(kAcross - 1, int(x * kAcross)) * kAround + std::min(kAround - 1, int(around * kAround));
      };
      std::vector<double> expected(kAcross * kAround), drawn(kAcross * kAround);
      overHemisphere([&](const Vec3& H) {
        const double x = std::pow(std::max(0.0, 1.0 - rsl::dot(kNormal, H)), 0.25);
        expected[size_t(binOf(H))] += kDrawn * ggx.visibleDensity(float(NV), rsl::dot(kNormal, H), rsl::dot(V, H)) * 4 *
                                      std::pow(x, 3) / 400 * 2 * M_PI / 240;
        return 0.0;
      });
      std::mt19937 random(11);
      std::uniform_real_distribution<float> number(0, 1);
      for (int k = 0; k < kDrawn; ++k) {
        const float xi0 = number(random), xi1 = number(random);
        const Vec3 H = ggx.visibleNormal(kNormal, V, xi0, xi1);
        ASSERT_NEAR(rsl::length(H), 1, 1e-5f);
        ++drawn[size_t(binOf(H))];
      }
      double sum = 0;
      int bins = 0;
      for (size_t b = 0; b < drawn.size(); ++b)
        if (expected[b] > 20) {
          sum += (drawn[b] - expected[b]) * (drawn[b] - expected[b]) / expected[b];
          ++bins;
        }
      // A right sampler exceeds this once in some ten thousand: the mean is `bins`, the variance twice that.
      EXPECT_LT(sum, bins + 4 * std::sqrt(2.0 * bins) + 0.15 * bins) << alpha << " " << NV;
      EXPECT_GT(bins, 15) << alpha << " " << NV;
    }
}

}  // namespace
}  // namespace tomales
