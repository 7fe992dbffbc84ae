#include <array>

#include "reyes/image/image_file.h"
#include "reyes/image_compare.h"

namespace tomales {
namespace {

constexpr double kRelativeFloor = 0.01;  // It keeps relative figures finite in the dark.

/// Returns the indices of R, G and B or, if there is no colour, of all channels except alpha and depth.
std::vector<int> colorChannels(const Image& image) {
  std::vector<int> out;
  for (const char* name : {"R", "G", "B"})
    if (const int c = image.channelIndex(name); c >= 0) out.push_back(c);
  for (int c = 0; out.size() < 3 && c < image.channelCount(); ++c) {
    const std::string& name = image.channels[static_cast<size_t>(c)];
    if (name != "A" && name != "Z" && std::find(out.begin(), out.end(), c) == out.end()) out.push_back(c);
  }
  return out;
}

/// An image with one float for each pixel.
struct ComparedPlane {
  int width, height;
  std::vector<float> v;
  float at(int x, int y) const {
    return v[static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x)];
  }
};

template <class F>
ComparedPlane planeOf(const Image& image, F&& value) {
  ComparedPlane out{image.width, image.height, {}};
  out.v.reserve(static_cast<size_t>(image.width) * static_cast<size_t>(image.height));
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) out.v.push_back(value(image.at(x, y)));
  return out;
}

ComparedPlane product(const ComparedPlane& a, const ComparedPlane& b) {
  ComparedPlane out = a;
  for (size_t i = 0; i < out.v.size(); ++i) out.v[i] *= b.v[i];
  return out;
}

/// One pass of a Gaussian along (stepX, stepY), renormalised at the border.
ComparedPlane blurAlong(const ComparedPlane& in, float sigma, int radius, int stepX, int stepY) {
  ComparedPlane out = in;
  for (int y = 0; y < in.height; ++y)
    for (int x = 0; x < in.width; ++x) {
      float sum = 0, total = 0;
      for (int k = -radius; k <= radius; ++k) {
        const int sx = x + k * stepX, sy = y + k * stepY;
        if (sx < 0 || sy < 0 || sx >= in.width || sy >= in.height) continue;
        const float w = std::exp(-0.5f * static_cast<float>(k * k) / (sigma * sigma));
        sum += w * in.at(sx, sy);
        total += w;
      }
      out.v[static_cast<size_t>(y) * static_cast<size_t>(in.width) + static_cast<size_t>(x)] = sum / total;
    }
  return out;
}
ComparedPlane blur(const ComparedPlane& in, float sigma, int radius) {
  return blurAlong(blurAlong(in, sigma, radius, 1, 0), sigma, radius, 0, 1);
}

vec3 colorAt(const float* pixel, const std::vector<int>& channels) {
  const auto c = [&](size_t i) { return pixel[channels[std::min(i, channels.size() - 1)]]; };
  return {c(0), c(1), c(2)};
}

// Wang et al. 2004: an 11 x 11 Gaussian of sigma 1.5, on the luminance that an sRGB display of range [0,1] would show.
double ssim(const Image& test, const Image& reference) {
  constexpr float sigma = 1.5f, c1 = 0.01f * 0.01f, c2 = 0.03f * 0.03f;
  const auto shown = [](const Image& image) {
    const std::vector<int> channels = colorChannels(image);
    return planeOf(image, [&](const float* p) { return encodeSrgb(luminance(colorAt(p, channels))); });
  };
  const ComparedPlane a = shown(test), b = shown(reference);
  const ComparedPlane ma = blur(a, sigma, 5), mb = blur(b, sigma, 5);
  const ComparedPlane aa = blur(product(a, a), sigma, 5), bb = blur(product(b, b), sigma, 5),
                      ab = blur(product(a, b), sigma, 5);
  double sum = 0;
  for (size_t i = 0; i < a.v.size(); ++i) {
    const float x = ma.v[i], y = mb.v[i];
    const float covariance = ab.v[i] - x * y, variances = aa.v[i] - x * x + bb.v[i] - y * y;
    sum += (2 * x * y + c1) * (2 * covariance + c2) / ((x * x + y * y + c1) * (variances + c2));
  }
  return sum / static_cast<double>(a.v.size());
}

// CIE L*a*b* of linear sRGB, white D65.
vec3 lab(const vec3& rgb) {
  const vec3 xyz(dot(rgb, vec3(0.4124f, 0.3576f, 0.1805f)) / 0.9505f, dot(rgb, vec3(0.2126f, 0.7152f, 0.0722f)),
                 dot(rgb, vec3(0.0193f, 0.1192f, 0.9505f)) / 1.0890f);
  const auto f = [](float t) { return t > 0.008856f ? std::cbrt(t) : 7.787f * t + 16.0f / 116.0f; };
  const vec3 g(f(xyz.x), f(xyz.y), f(xyz.z));
  return {116 * g.y - 16, 500 * (g.x - g.y), 200 * (g.y - g.z)};
}
float hyab(const vec3& a, const vec3& b) {
  return std::abs(a.x - b.x) + std::sqrt((a.y - b.y) * (a.y - b.y) + (a.z - b.z) * (a.z - b.z));
}

std::array<ComparedPlane, 3> seenPlanes(const Image& image) {
  const std::vector<int> channels = colorChannels(image);
  const auto plane = [&](int axis) {
    return blur(planeOf(image, [&](const float* p) { return std::clamp(colorAt(p, channels)[axis], 0.0f, 1.0f); }),
                1.0f, 3);
  };
  return {plane(0), plane(1), plane(2)};
}

// Returns the colour half of FLIP (Andersson et al. 2020) in its simplest form. Colours are clamped to the display, and
// blurred by a Gaussian of one pixel where FLIP has contrast sensitivity. Their HyAB distance in L*a*b* is compressed
// by the power 0.7 and scaled so that green against blue is 1. It lacks FLIP's edge and point detection, so its numbers
// are not comparable with FLIP's.
double flipLike(const Image& test, const Image& reference) {
  const std::array<ComparedPlane, 3> a = seenPlanes(test), b = seenPlanes(reference);
  const float scale = std::pow(hyab(lab({0, 1, 0}), lab({0, 0, 1})), 0.7f);
  double sum = 0;
  for (size_t i = 0; i < a[0].v.size(); ++i) {
    const float d = hyab(lab({a[0].v[i], a[1].v[i], a[2].v[i]}), lab({b[0].v[i], b[1].v[i], b[2].v[i]}));
    sum += std::min(1.0f, std::pow(d, 0.7f) / scale);
  }
  return sum / static_cast<double>(a[0].v.size());
}

struct SmoothFigures {
  double smudges = 0, specks = 0;
};

/// Returns the smudges and specks of smooth regions, from blocks of `block` pixels along an edge. Both are computed
/// from ratios of test and reference, so a picture that is brighter as a whole has neither.
SmoothFigures smoothFigures(const Image& test, const Image& reference, int block) {
  constexpr double kSpeck = 0.2;  // A pixel that differs from its block by more than this share is a speck.
  const auto light = [](const Image& image) {
    const std::vector<int> channels = colorChannels(image);
    return planeOf(image, [&](const float* p) { return luminance(colorAt(p, channels)); });
  };
  const ComparedPlane t = light(test), r = light(reference);
  double blocks = 0, sum = 0, squares = 0, specks = 0;
  for (int top = 0; top + block <= r.height; top += block)
    for (int left = 0; left + block <= r.width; left += block) {
      const auto mean = [&](auto&& value) {
        double total = 0;
        for (int y = top; y < top + block; ++y)
          for (int x = left; x < left + block; ++x) total += value(x, y);
        return total / (block * block);
      };
      const double m = mean([&](int x, int y) { return r.at(x, y); });
      const double variance = mean([&](int x, int y) { return (r.at(x, y) - m) * (r.at(x, y) - m); });
      if (!isSmooth(m, variance)) continue;
      const double ratio = mean([&](int x, int y) { return t.at(x, y); }) / m;
      specks += mean([&](int x, int y) { return std::abs(t.at(x, y) - ratio * r.at(x, y)) > kSpeck * ratio * m; });
      ++blocks;
      sum += ratio;
      squares += ratio * ratio;
    }
  if (!(sum > 0)) return {};
  const double mean = sum / blocks;
  return {std::sqrt(std::max(0.0, squares / blocks - mean * mean)) / mean, specks / blocks};
}

}  // namespace

Comparison compare(const Image& test, const Image& reference) {
  const std::vector<int> inTest = colorChannels(test), inReference = colorChannels(reference);
  const size_t channels = std::min(inTest.size(), inReference.size());
  Comparison out;
  double squares = 0, relativeSquares = 0, relative = 0;
  for (int y = 0; y < reference.height; ++y)
    for (int x = 0; x < reference.width; ++x) {
      bool different = false;
      for (size_t c = 0; c < channels; ++c) {
        const double t = test.at(x, y)[inTest[c]], r = reference.at(x, y)[inReference[c]], d = t - r;
        squares += d * d;
        relativeSquares += d * d / (r * r + kRelativeFloor);
        relative += std::abs(d) / (r + kRelativeFloor);
        out.maxError = std::max(out.maxError, std::abs(d));
        different |= !(t == r);
      }
      out.differentPixels += different;
    }
  const double n = static_cast<double>(reference.width) * reference.height * static_cast<double>(channels);
  if (n == 0) return out;
  out.rmse = std::sqrt(squares / n);
  out.relativeMse = relativeSquares / n;
  out.meanAbsoluteRelativeError = relative / n;
  out.psnr_dB = -20 * std::log10(out.rmse);
  out.ssim = ssim(test, reference);
  out.flip = flipLike(test, reference);
  for (size_t i = 0; i < kSmudgeSizes.size(); ++i) {
    const SmoothFigures smooth = smoothFigures(test, reference, kSmudgeSizes[i]);
    out.smudges[i] = smooth.smudges;
    if (i == 0) out.specks = smooth.specks;
  }
  return out;
}

Image differenceImage(const Image& test, const Image& reference) {
  const std::vector<int> inTest = colorChannels(test), inReference = colorChannels(reference);
  Image out{reference.width,   reference.height,  {"R", "G", "B"},        {},
            reference.originX, reference.originY, reference.displayWidth, reference.displayHeight};
  out.pixels.reserve(static_cast<size_t>(out.width) * static_cast<size_t>(out.height) * 3);
  for (int y = 0; y < out.height; ++y)
    for (int x = 0; x < out.width; ++x) {
      const vec3 d = glm::abs(colorAt(test.at(x, y), inTest) - colorAt(reference.at(x, y), inReference));
      out.pixels.insert(out.pixels.end(), {d.x, d.y, d.z});
    }
  return out;
}

}  // namespace tomales
