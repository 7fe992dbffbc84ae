// Verb: two images of equal size -> figures of how much they differ.
#pragma once
#include <array>

#include "reyes/image.h"

namespace tomales {

/// Length of an edge, in pixels, of the blocks in which smudges are looked for.
inline constexpr std::array kSmudgeSizes{8, 16, 32, 64};
/// Tells whether a block of pixels that should have this mean luminance and variance is even enough to show smudges.
inline bool isSmooth(double mean, double variance) {
  constexpr double kMostDeviation = 0.1;  // root mean square over the mean
  return mean > 0 && variance <= kMostDeviation * kMostDeviation * mean * mean;
}

/// Figures of `tomales compare` over colour channels of images of equal size.
struct Comparison {
  double rmse = 0, relativeMse = 0, meanAbsoluteRelativeError = 0, maxError = 0, psnr_dB = 0, ssim = 0, flip = 0;
  /// Relative standard deviation of test / reference over the smooth blocks of each size; 0 where fewer than two are.
  std::array<double, kSmudgeSizes.size()> smudges{};
  double specks = 0;  ///< Share of the pixels of smooth 8 x 8 blocks whose error exceeds a fifth of their block's mean.
  int64_t differentPixels = 0;
};
/// Compares the colours of all pixels. Pre: both have the same size.
Comparison compare(const Image& test, const Image& reference);
/// Returns the magnitudes of the differences of red, green and blue. Pre: the same.
Image differenceImage(const Image& test, const Image& reference);

}  // namespace tomales
