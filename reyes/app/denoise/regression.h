// Private to the filter of `tomales denoise`: planes of a picture, and one half filtered with weights of the other.
#pragma once
#include "reyes/app/denoise/filter.h"

namespace tomales::denoising {

using Color = std::array<Plane, 3>;

struct Size {
  int width, height;
  size_t count() const { return static_cast<size_t>(width) * static_cast<size_t>(height); }
  size_t at(int x, int y) const { return static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x); }
};

constexpr int kBand = 16;  ///< Rows that one thread takes at a time.
/// Noise is independent between pixels that are farther apart than this: nearer ones share shading points, and the
/// pixel filter mixes them.
constexpr int kNear = 1;

/// The planes that a regression reads.
struct RegressionInput {
  const Color &filtered, &weighing;
  const Color& variance;             ///< Variance of either half.
  const std::vector<Plane>& guides;  ///< Planes of about the same scale.
};

/// Filters one half with weights of the other. The answer at a pixel depends on the weighing half there, and up to
/// kNear pixels away, only through `variance`; so that half can measure the answer's error. width: k of Rousselle et
/// al.
Color regression(const Size& size, const RegressionInput& in, float width);

}  // namespace tomales::denoising
