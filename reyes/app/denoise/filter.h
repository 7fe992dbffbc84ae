// Takes noise out of a picture that was rendered twice with different random numbers of light (half buffers). Each
// pixel is a first-order regression over its neighbours on what is known without noise (Bitterli et al. 2016,
// "Nonlinearly Weighted First-order Regression for Denoising Monte Carlo Renderings"). Weights are those of non-local
// means by the other half's colours and variance (Rousselle, Knaus and Zwicker 2012, "Adaptive Rendering with Non-Local
// Means Filtering"). Each pixel takes the filter width, or no filter, that has the least error around it, as measured
// against the other half. The colour of the other half at a pixel has no part in the weights for it, and hardly any in
// the choice, so it can measure the error there (Batson and Royer 2019, "Noise2Self"). Threads: pure; the result has
// the same bits for any number of them.
#pragma once
#include <array>
#include <cstddef>
#include <vector>

namespace tomales {

/// One float for each pixel, in rows from the top.
using Plane = std::vector<float>;

struct HalfBuffers {
  int width = 0, height = 0;
  std::array<Plane, 3> a, b;  ///< Colours of the halves: linear, finite.
  std::vector<Plane> guides;  ///< Planes of albedo, normal and depth, in any scale; finite. At most kMostGuides.
};
constexpr size_t kMostGuides = 7;

struct Denoised {
  std::array<Plane, 3> color;
  /// Relative errors of the mean of the halves and of `color`: the root mean square over the mean colour. Both are
  /// estimated from the halves.
  double before = 0, after = 0;
};

Denoised denoise(const HalfBuffers& in);

}  // namespace tomales
