#include "reyes/image/encoding.h"

#include "reyes/base/rng.h"
#include "reyes/image/image_file.h"

namespace tomales {
namespace {

// RISpec 3.2 section 4.1.7: round(zero + value (one - zero) + dither random), clamped. Random numbers are named by
// pixel and channel.
float quantised(float value, const Quantize& q, float limit, uint32_t name) {
  const float noisy = std::floor(q.zero + (q.one - q.zero) * value + q.dither * (2 * unitFloat(name) - 1) + 0.5f);
  const float low = std::max(q.min, 0.0f);
  return noisy > low ? std::min(noisy, std::min(q.max, limit)) : low;  // NaN becomes the minimum, too
}

}  // namespace

void quantise(Image& image, const std::vector<Quantize>& quantizers, float limit) {
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      for (size_t c = 0; c < image.channels.size(); ++c) {
        const uint32_t name = hashCombine(static_cast<uint32_t>(x + image.originX),
                                          static_cast<uint32_t>(y + image.originY), static_cast<uint32_t>(c));
        float& v = image.at(x, y)[c];
        v = quantised(v, quantizers[c], limit, name);
      }
}

float exposed(float value, float gain, float gamma) {
  value *= gain;
  return gamma == 1 ? value : std::pow(std::max(value, 0.0f), 1 / gamma);
}

void divideByAlpha(Image& image) {
  const int alpha = image.channelIndex("A");
  const size_t channels = image.channels.size();
  for (size_t i = 0; alpha >= 0 && i < image.pixels.size(); i += channels) {
    const float a = image.pixels[i + static_cast<size_t>(alpha)];
    for (size_t c = 0; c < channels; ++c)
      if (static_cast<int>(c) != alpha) image.pixels[i + c] = a > 0 ? image.pixels[i + c] / a : 0.0f;
  }
}

void encodeForScreen(Image& image) {
  const int alpha = image.channelIndex("A");
  for (size_t i = 0; i < image.pixels.size(); ++i)
    if (static_cast<int>(i % image.channels.size()) != alpha) image.pixels[i] = encodeSrgb(image.pixels[i]);
}

float encodeSrgb(float linear) {
  const float v = linear > 0 ? std::min(linear, 1.0f) : 0.0f;
  return v <= 0.0031308f ? 12.92f * v : 1.055f * std::pow(v, 1 / 2.4f) - 0.055f;
}

void expose(Image& image, const Options& options) {
  for (const char* name : {"R", "G", "B"}) {
    const int channel = image.channelIndex(name);
    for (size_t i = static_cast<size_t>(channel); channel >= 0 && i < image.pixels.size(); i += image.channels.size()) {
      image.pixels[i] = exposed(image.pixels[i], options.exposureGain, options.exposureGamma);
    }
  }
}

}  // namespace tomales
