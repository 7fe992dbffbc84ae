// Correlated multi-jittered sampling (Kensler 2013): every cell of the xSamples by ySamples raster holds one
// sample, and so does every column and row of the finer raster with count() columns and rows.

#include "reyes/base/random_streams.h"
#include "reyes/base/rng.h"
#include "reyes/hide.h"
#include "reyes/hide/aperture.h"
#include "reyes/hide/subpixel.h"

namespace tomales {
namespace {

/// Limits on the number of patterns. With 256 no repetition is visible. With very many samples, a pixel has little
/// error that could repeat, and many patterns would fill the memory.
constexpr int kMostPatterns = 256, kLeastPatterns = 16, kSamplesOfPatterns = 1 << 20;

/// Returns the position `inside` (0..1) of stratum `i` of n, on the lattice but never in another stratum.
float placed(int i, int n, float inside) {
  const float width = kSubpixels / static_cast<float>(n);
  const float lo = std::ceil(static_cast<float>(i) * width), hi = std::ceil(static_cast<float>(i + 1) * width) - 1;
  return std::clamp(std::round((static_cast<float>(i) + inside) * width), lo, std::max(lo, hi)) / kSubpixels;
}

/// Returns a number in stratum `i` of n: rounding must not carry it into the next.
float within(int i, int n, float inside) {
  const float count = static_cast<float>(n);
  return std::min((static_cast<float>(i) + inside) / count, std::nextafter(static_cast<float>(i + 1) / count, 0.0f));
}

/// The part of the shutter that a cell samples, as a shuffled Latin square. So each row and column of a pixel, not only
/// the whole pixel, samples the whole shutter, and motion along x or y is blurred evenly.
class Times {
 public:
  Times(int xSamples, int ySamples, uint32_t name)
      : column_(permutation(xSamples, hash32(name ^ 3U))),
        row_(permutation(ySamples, hash32(name ^ 4U))),
        coarse_(permutation(xSamples, hash32(name ^ 5U))) {}

  int stratum(int i, int j) const {
    const int fine = row_[static_cast<size_t>(j)], n = static_cast<int>(coarse_.size());
    const int coarse = coarse_[static_cast<size_t>((column_[static_cast<size_t>(i)] + fine) % n)];
    return coarse * static_cast<int>(row_.size()) + fine;
  }

 private:
  std::vector<int> column_, row_, coarse_;
};

}  // namespace

SamplePattern::SamplePattern(int xSamples, int ySamples, bool jitter, uint32_t seed, const Aperture& aperture)
    : count_(xSamples * ySamples),
      padded_(tomales::padded(count_)),
      patterns_(std::clamp(kSamplesOfPatterns / count_, kLeastPatterns, kMostPatterns)),
      seed_(seed) {
  const size_t size = static_cast<size_t>(patterns_) * static_cast<size_t>(padded_);
  // Padding lanes have the corner of the pixel as position; the hider gives them a depth that nothing is in front of.
  x_.assign(size, 0);
  y_.assign(size, 0);
  time_.assign(size, 0);
  lensX_.assign(size, 0);
  lensY_.assign(size, 0);
  detail_.assign(size, 0);
  const ApertureShape throughAperture(aperture);
  for (uint32_t p = 0; p < static_cast<uint32_t>(patterns_); ++p) {
    const uint32_t name = hashCombine(seed, randomStream("patt"), p);
    const std::vector<int> inColumn = permutation(ySamples, hash32(name ^ 1U));
    const std::vector<int> inRow = permutation(xSamples, hash32(name ^ 2U));
    const Times times(xSamples, ySamples, name);
    // The stratum of the lens is independent of the sample's position and time.
    const std::vector<int> throughLens = permutation(count_, hash32(name ^ 6U));
    const std::vector<int> ofDetail = permutation(count_, hash32(name ^ 7U));
    for (int s = 0; s < count_; ++s) {
      const int i = s % xSamples, j = s / xSamples;
      const auto random = [&](uint32_t dimension) {
        return jitter ? unitFloat(hashCombine(name, static_cast<uint32_t>(s), dimension)) : 0.5f;
      };
      const size_t at = static_cast<size_t>(p) * static_cast<size_t>(padded_) + static_cast<size_t>(s);
      const float x = (static_cast<float>(inColumn[static_cast<size_t>(j)]) + random(0)) / static_cast<float>(ySamples);
      const float y = (static_cast<float>(inRow[static_cast<size_t>(i)]) + random(1)) / static_cast<float>(xSamples);
      x_[at] = placed(i, xSamples, jitter ? x : 0.5f);
      y_[at] = placed(j, ySamples, jitter ? y : 0.5f);
      time_[at] = within(times.stratum(i, j), count_, random(2));
      const int stratum = throughLens[static_cast<size_t>(s)];
      const vec2 lens = throughAperture(
          {within(stratum % xSamples, xSamples, random(3)), within(stratum / xSamples, ySamples, random(4))});
      lensX_[at] = lens.x;
      lensY_[at] = lens.y;
      detail_[at] = within(ofDetail[static_cast<size_t>(s)], count_, random(5));
    }
  }
}

int SamplePattern::patternOf(int x, int y) const {
  return static_cast<int>(hashCombine(seed_, static_cast<uint32_t>(x), static_cast<uint32_t>(y)) %
                          static_cast<uint32_t>(patterns_));
}

}  // namespace tomales
