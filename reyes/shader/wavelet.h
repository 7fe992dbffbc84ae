// RSL's wnoise: wavelet noise (R. Cook, T. DeRose 2005, "Wavelet Noise"). It has a single band of frequencies, so bands
// finer than a pixel can be left out without loss of coarser detail. Results have the same bits on every machine,
// because they use only integer hashes and IEEE arithmetic. A table of 1 MB is made at the first use.
#pragma once
#include <vector>

#include "reyes/shader/noise.h"

namespace rsl {

class WaveletTile {
 public:
  TM_OF_THIS_PLUGIN static const WaveletTile& get() {
    static const WaveletTile tile;
    return tile;
  }

  /// Returns noise of mean 0 and standard deviation 1, with half a wave to one wave per unit. It repeats after kSize
  /// units.
  float operator()(Vec3 p) const {
    const float x[3] = {p.x, p.y, p.z};
    int middle[3];
    float weight[3][3];  // of a quadratic B-spline along each axis (section 3.2)
    for (int k = 0; k < 3; ++k) {
      const float rest = x[k] - kSize * wholeBelow(x[k] / kSize), at = std::abs(rest) <= kSize ? rest : 0,
                  m = -wholeBelow(0.5f - at), t = m - (at - 0.5f);
      middle[k] = static_cast<int>(m);
      weight[k][0] = t * t / 2;
      weight[k][2] = (1 - t) * (1 - t) / 2;
      weight[k][1] = 1 - weight[k][0] - weight[k][2];
    }
    float sum = 0;
    for (int k = -1; k <= 1; ++k)
      for (int j = -1; j <= 1; ++j)
        for (int i = -1; i <= 1; ++i)
          sum += weight[0][i + 1] * weight[1][j + 1] * weight[2][k + 1] *
                 coefficients_[index(middle[0] + i, middle[1] + j, middle[2] + k)];
    return sum;
  }

 private:
  static constexpr int kSize = 64;

  static size_t index(int x, int y, int z) {
    const auto wrapped = [](int c) { return static_cast<size_t>(c & (kSize - 1)); };
    return (wrapped(z) * kSize + wrapped(y)) * kSize + wrapped(x);
  }

  /// Fills the tile with random numbers minus the part that half the resolution can represent (section 3.5).
  WaveletTile() : coefficients_(size_t{kSize} * kSize * kSize) {
    std::vector<float> coarse(coefficients_.size());
    for (int z = 0; z < kSize; ++z)
      for (int y = 0; y < kSize; ++y)
        for (int x = 0; x < kSize; ++x) coarse[index(x, y, z)] = coefficients_[index(x, y, z)] = random(x, y, z);
    for (int axis = 0; axis < 3; ++axis)
      for (int b = 0; b < kSize; ++b)
        for (int a = 0; a < kSize; ++a) leaveCoarse(coarse, axis, a, b);
    for (size_t i = 0; i < coarse.size(); ++i) coefficients_[i] -= coarse[i];
    double squares = 0;
    for (int z = 0; z < kSize; z += 2)
      for (int y = 0; y < kSize; y += 2)
        for (int x = 0; x < kSize; x += 2) {
          const double w =
              (*this)({static_cast<float>(x) + 0.3f, static_cast<float>(y) + 0.6f, static_cast<float>(z) + 0.1f});
          squares += w * w;
        }
    const double deviation = std::sqrt(squares * 8 / (static_cast<double>(kSize) * kSize * kSize));
    for (float& c : coefficients_) c = static_cast<float>(c / deviation);
  }

  /// Returns a sum of four uniform numbers, which is near enough to a Gaussian.
  static float random(int x, int y, int z) {
    float sum = -2;
    for (int k = 0; k < 4; ++k) sum += static_cast<float>(latticeHash(x, y, z * 4 + k) >> 8) * 0x1p-24f;
    return sum;
  }

  /// Replaces one row by its part that half the resolution can represent: it is downsampled and upsampled again.
  static void leaveCoarse(std::vector<float>& values, int axis, int a, int b) {
    // The analysis filter that belongs to quadratic B-splines (appendix 1).
    static const float down[32] = {0.000334f, -0.001528f, 0.000410f,  0.003545f, -0.000938f, -0.008233f, 0.002172f,
                                   0.019120f, -0.005040f, -0.044412f, 0.011655f, 0.103311f,  -0.025936f, -0.243780f,
                                   0.033979f, 0.655340f,  0.655340f,  0.033979f, -0.243780f, -0.025936f, 0.103311f,
                                   0.011655f, -0.044412f, -0.005040f, 0.019120f, 0.002172f,  -0.008233f, -0.000938f,
                                   0.003546f, 0.000410f,  -0.001528f, 0.000334f};
    static const float up[4] = {0.25f, 0.75f, 0.75f, 0.25f};
    const auto at = [&](int i) -> float& {
      return values[axis == 0 ? index(i, a, b) : axis == 1 ? index(a, i, b) : index(a, b, i)];
    };
    float half[kSize / 2];
    for (int i = 0; i < kSize / 2; ++i) {
      half[i] = 0;
      for (int k = 0; k < 32; ++k) half[i] += down[k] * at(2 * i - 16 + k);
    }
    for (int i = 0; i < kSize; ++i) {
      const int first = i / 2, second = (first + 1) & (kSize / 2 - 1);
      at(i) = up[2 + (i & 1)] * half[first] + up[i & 1] * half[second];
    }
  }

  std::vector<float> coefficients_;
};

/// Returns noise in [0, 1] with mean 1/2 and standard deviation 1/6. Where it is finer than `width`, the distance to
/// the next point, it fades to its mean.
inline float wnoise(Vec3 p, float width = 0) {
  const float seen = 1 - smoothstep(0.5f, 1, width);  // the band ends at one wave a unit
  return clamp(0.5f + seen / 6 * (seen > 0 ? WaveletTile::get()(p) : 0), 0, 1);
}

}  // namespace rsl
