// Sums over lights, against the same in double precision.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "reyes/base/simd.h"
#include "reyes/shade/illuminate.h"

namespace tomales {
namespace {

constexpr int kCount = 37;  // no whole number of vectors
constexpr float kNotFinite = std::numeric_limits<float>::infinity();

struct Vectors {
  AlignedVector<float> x = AlignedVector<float>(kCount + 1, 0.0f), y = x, z = x;
  operator TmConstVec3() const { return {x.data(), y.data(), z.data()}; }
  TmVec3 out() { return {x.data(), y.data(), z.data()}; }
};

/// N along z; L at angles from 0 to more than a right one; V = L, so that H is L.
struct Lit {
  Vectors N, L, Cl, out;
  std::vector<float> share = std::vector<float>(kCount, 0.5f);

  explicit Lit(float least) {
    for (size_t i = 0; i < kCount; ++i) {
      const double angle = least * std::exp(0.45 * static_cast<double>(i));
      L.x[i] = static_cast<float>(std::sin(std::min(angle, 2.0)));
      L.z[i] = static_cast<float>(std::cos(std::min(angle, 2.0)));
      N.z[i] = 1;
      Cl.x[i] = 1;
      Cl.y[i] = 2;
      Cl.z[i] = 3;
    }
  }
  /// As addHighlight has it: what the power is taken of.
  float cosine(size_t i) const {
    const float x = L.x[i] + L.x[i], z = L.z[i] + L.z[i];
    return z * (1.0f / std::sqrt(x * x + 0.0f + z * z));
  }
};

TEST(Illuminate, HighlightsArePowersOfTheCosine) {
  for (const float exponent : {8.0f, 27.0f, 800.0f, 8e4f, 8e6f}) {
    Lit lit(0.5f / std::sqrt(exponent) * 0.01f);
    const std::vector<float> exponents(kCount, exponent);
    addHighlight(kCount, lit.share.data(), lit.N, lit.L, exponents.data(), lit.L, lit.Cl, lit.out.out());
    for (size_t i = 0; i < kCount; ++i) {
      const double c = std::clamp(double{lit.cosine(i)}, 0.0, 1.0), power = std::pow(c, double{exponent});
      EXPECT_NEAR(lit.out.y[i], power, (power > 1e-3 ? 2e-6 : 2e-5) * power + 1e-37) << exponent << " of " << c;
    }
    EXPECT_EQ(lit.out.x[kCount], 0);
  }
}

TEST(Illuminate, DiffuseIsTheCosine) {
  Lit lit(1e-3f);
  addDiffuse(kCount, lit.share.data(), lit.N, lit.L, lit.Cl, lit.out.out());
  for (size_t i = 0; i < kCount; ++i) EXPECT_FLOAT_EQ(lit.out.z[i], 1.5f * lit.L.z[i]);
}

TEST(Illuminate, WhereNothingCountsNothingIsAddedWhateverIsThere) {
  Lit lit(1e-3f);
  std::fill(lit.share.begin(), lit.share.end(), 0.0f);
  std::fill(lit.Cl.x.begin(), lit.Cl.x.end(), kNotFinite);
  std::fill(lit.L.x.begin(), lit.L.x.end(), std::nanf(""));
  std::fill(lit.out.y.begin(), lit.out.y.end(), 7.0f);
  const std::vector<float> exponents(kCount, 80.0f);
  addDiffuse(kCount, lit.share.data(), lit.N, lit.L, lit.Cl, lit.out.out());
  addHighlight(kCount, lit.share.data(), lit.N, lit.L, exponents.data(), lit.L, lit.Cl, lit.out.out());
  for (size_t i = 0; i < kCount; ++i) {
    EXPECT_EQ(lit.out.x[i], 0);
    EXPECT_EQ(lit.out.y[i], 7);
  }
}

TEST(Illuminate, FacingIsOnTheSideOfTheNormalAndActive) {
  Lit lit(1e-3f);
  std::vector<uint8_t> active(kCount, 1), facing(kCount, 9);
  active[3] = 0;
  markFacing(kCount, active.data(), lit.N, lit.L, facing.data());
  for (size_t i = 0; i < kCount; ++i) EXPECT_EQ(facing[i], i != 3 && lit.L.z[i] > 0);
}

}  // namespace
}  // namespace tomales
