// How far pictures are from a reference that is itself the mean of independent pictures.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "reyes/image.h"

namespace tomales {

/// Of |test - reference| / (reference + 0.01) over the colours of all pixels where the reference is not black.
struct ErrorFigures {
  double mean = 0, p99 = 0;
  double bias = 0;  ///< Of the sums of all pixels: test / reference - 1.
  double rms = 0;   ///< Root mean square of (test - reference), over the mean of the reference.
  int64_t notFinite =
      0;  ///< Pixels that are infinite or no numbers: of the test they count as black, of the reference not at all.
  double confidence =
      0;  ///< Half the 95 % interval of `mean` that the noise of the reference leaves (jackknife over its batches).
};

class ChartReference {
 public:
  static constexpr float kFloor = 0.01f;

  /// False: not as large as the earlier ones.
  bool add(const Image& batch);
  int batches() const { return static_cast<int>(batches_.size()); }
  const Image& mean() const { return mean_; }
  bool isBlack() const;  ///< Nowhere has it light that is a number.
  /// ErrorFigures::mean of the reference itself, from the spread of its batches. Infinite with fewer than two.
  double noiseFloor() const;
  ErrorFigures errorOf(const Image& test) const;
  /// Grey levels would hide the sign: red is too bright, blue too dark, white is right; full colour at `range`. Green:
  /// not finite.
  Image errorMap(const Image& test, float range) const;

 private:
  /// Mean of all batches but one.
  Image meanWithout(size_t batch) const;

  std::vector<Image> batches_;
  Image mean_;
};

/// ", 3 pixels not finite"; empty if all are.
std::string notFiniteNote(const ErrorFigures& error);

/// Largest of its sizes at most `size`: a whole number of pixels become one by their mean.
Image thumbnail(const Image& image, int size);

}  // namespace tomales
