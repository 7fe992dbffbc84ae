#include "reyes/base/parallel.h"
#include "reyes/frame.h"

namespace tomales {
namespace {

/// Channels of Image that an imager reads and writes.
struct Channels {
  int color[3], alpha;
  explicit Channels(const Image& image)
      : color{image.channelIndex("R"), image.channelIndex("G"), image.channelIndex("B")},
        alpha(image.channelIndex("A")) {}
};

ShadedPixels rowOf(const Image& image, const Channels& channels, int y) {
  ShadedPixels row;
  row.x = static_cast<float>(image.originX) + 0.5f;
  row.y = static_cast<float>(image.originY + y) + 0.5f;
  row.colors.resize(image.width);
  row.alpha.assign(row.colors.Ci[0].size(), 0.0f);
  row.count = image.width;
  for (int x = 0; x < image.width; ++x) {
    const float* pixel = image.at(x, y);
    const auto i = static_cast<size_t>(x);
    row.alpha[i] = pixel[channels.alpha];
    for (int c = 0; c < 3; ++c) {
      row.colors.Ci[c][i] = pixel[channels.color[c]];
      row.colors.Oi[c][i] = row.alpha[i];
    }
  }
  return row;
}

void store(const ShadedPixels& row, const Channels& channels, int y, Image& image) {
  for (int x = 0; x < image.width; ++x) {
    float* pixel = image.at(x, y);
    const auto i = static_cast<size_t>(x);
    pixel[channels.alpha] = row.alpha[i];
    for (int c = 0; c < 3; ++c) pixel[channels.color[c]] = row.colors.Ci[c][i];
  }
}

}  // namespace

void runImager(Image& image, const ShadingSystem& shading) {
  if (!shading.hasImager()) return;
  const Channels channels(image);
  parallelFor(static_cast<size_t>(image.height), 16, [&](size_t begin, size_t end) {
    for (size_t y = begin; y < end; ++y) {
      ShadedPixels row = rowOf(image, channels, static_cast<int>(y));
      shading.image(row);
      store(row, channels, static_cast<int>(y), image);
    }
  });
}

}  // namespace tomales
