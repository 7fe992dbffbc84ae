// The errors of pictures against a reference that is itself the mean of independent pictures.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "reyes/image.h"

namespace tomales {

/// Figures of |test - reference| / (reference + 0.01) over the colours of all pixels where the reference is not black.
struct ErrorFigures {
  /// The mean without the noise of the reference (ChartReference::errorOf); 0 if that hides it all.
  double mean = 0;
  double measured = 0;  ///< The mean with that noise.
  double p99 = 0;       ///< The 99th percentile, with that noise.
  double bias = 0;      ///< The sums of all pixels: test / reference - 1.
  double rms = 0;       ///< Root mean square of (test - reference), over the mean of the reference; without its noise.
  /// Pixels that are infinite or no numbers: in the test they count as black, in the reference not at all.
  int64_t notFinite = 0;
  /// Half the 95 % interval of `mean` that the noise of the reference leaves (jackknife over its batches).
  double confidence = 0;
  std::vector<double> without{};  ///< Indexed by batch of the reference: the value of `measured` without that batch.
};

/// The difference of the errors of two pictures, and half of its 95 % interval. Both were compared with the same
/// reference, whose noise mostly cancels in the difference.
struct ErrorDifference {
  double mean = 0, confidence = 0;
};
ErrorDifference operator-(const ErrorFigures& a, const ErrorFigures& b);

class ChartReference {
 public:
  static constexpr float kFloor = 0.01f;

  /// Returns false if it is not as large as the earlier ones.
  bool add(const Image& batch);
  int batches() const { return static_cast<int>(batches_.size()); }
  const Image& mean() const { return mean_; }
  bool isBlack() const;  ///< True if no pixel has light that is a number.
  /// Returns the mean error of the reference itself, from the spread of its batches; infinite with fewer than two.
  double noiseFloor() const;
  /// Takes the reference's own noise out of the error by the jackknife (Efron and Stein 1981). The square of an error
  /// is taken to grow by the variance of the reference, which is the variance of one batch over the number of batches.
  /// For Gaussian differences this holds exactly.
  ErrorFigures errorOf(const Image& test) const;
  /// Shows the sign of the error, which grey levels would hide: red is too bright, blue too dark, white is right; the
  /// colour is full at `range`. Green is not finite.
  Image errorMap(const Image& test, float range) const;

 private:
  /// Returns the mean of all batches but one.
  Image meanWithout(size_t batch) const;

  std::vector<Image> batches_;
  Image mean_;
};

/// Returns ", 3 pixels not finite", or nothing if all are.
std::string notFiniteNote(const ErrorFigures& error);

/// Returns a picture's brightness without outliers: all but a few pixels are darker, and it is not far above the
/// median.
float brightness(const Image& image);
/// Returns the largest reduction of at most `size` pixels, times a gain: squares of a whole number of pixels are
/// averaged to one.
Image thumbnail(const Image& image, int size, float gain = 1);

}  // namespace tomales
