// Verbs: shaded DeepFrame -> pixels -> files. Filter, exposure, quantise, write (RISpec imaging pipeline, in that order).
#pragma once
#include <functional>
#include "reyes/base/stats.h"
#include "reyes/deep.h"

namespace tomales {

/// Linear float channels, interleaved, rows from the top.
struct Image {
  int width = 0, height = 0;
  std::vector<std::string> channels;  ///< "R" "G" "B" "A" "Z"
  std::vector<float> pixels;
  int originX = 0, originY = 0;       ///< Of the data window inside the display window (crop).
  int displayWidth = 0, displayHeight = 0;

  int channelCount() const { return static_cast<int>(channels.size()); }
  float* at(int x, int y) { return pixels.data() + (static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x)) * channels.size(); }
  const float* at(int x, int y) const { return const_cast<Image*>(this)->at(x, y); }
  int channelIndex(const std::string& name) const;  ///< -1: none
};

/// A separable or radial pixel filter; names and formulas of RISpec 3.2 section 5.1.2, with the repairs that docs/rib_support.md lists.
class PixelFilter {
 public:
  /// Unknown names fall back to gaussian and say so through `known`.
  PixelFilter(const std::string& name, float xWidth, float yWidth, bool* known = nullptr);
  float operator()(float x, float y) const;   ///< Offset from the pixel centre, in pixels.
  int reachX() const, reachY() const;         ///< Whole pixels beyond its own that a pixel's filter touches.
 private:
  int kind_;
  float xWidth_, yWidth_;
};

/// Sample offsets of a pixel pattern, as the filter needs them; supplied by the composer.
struct SampleOffsets {
  int count = 0;
  std::vector<std::vector<vec2>> byPattern;              ///< Position inside the pixel, [0,1)^2.
  std::function<int(int x, int y)> patternOf;
};

/// Filters every pixel of the crop window. Channels R G B A Z; colour premultiplied, linear, before exposure.
/// Z is the nearest camera-space depth, infinite where nothing was hit. The sum runs in a fixed order (rows, columns,
/// fragments), so that buckets and threads leave no trace.
Image filterFrame(const DeepFrame& frame, const Options& options, const SampleOffsets& samples);

/// Applies exposure to colour and alpha-independent gamma, per Options.
void expose(Image& image, const Options& options);

/// Writes one Display: picks channels by `display.mode`, type by `display.type` or the name's extension (.exr .tif .png),
/// quantises (8-bit types: sRGB only where the Display's "string transfer" says so), to a temporary name, then renames.
/// False: could not be written; reported to the log.
bool writeDisplay(const Image& image, const DisplayCall& display, const Options& options, Log& log);
bool writeImage(const std::string& path, const Image& image, bool srgb, Log& log);
std::optional<Image> readImage(const std::string& path, std::string& error);

/// Figures of `tomales compare` over colour channels of images of equal size.
struct Comparison {
  double rmse = 0, relativeMse = 0, meanAbsoluteRelativeError = 0, maxError = 0, psnr_dB = 0, ssim = 0, flip = 0;
  int64_t differentPixels = 0;
};
Comparison compare(const Image& test, const Image& reference);
Image differenceImage(const Image& test, const Image& reference);

}  // namespace tomales
