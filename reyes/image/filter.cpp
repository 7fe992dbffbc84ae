#include <array>
#include <cmath>

#include "reyes/filter_width.h"
#include "reyes/image.h"

namespace tomales {
namespace {

// Formulas of RISpec 3.2 section 5.1.2, not normalised; the caller divides by the sum of weights. Where a printed
// formula is not the filter of its name, a comment at the function describes the correction.
using Kernel = float (*)(float x, float y, float xWidth, float yWidth);

float box(float, float, float, float) { return 1; }

// The printed formula holds for width 2 alone: (1 - |x|) / (width / 2) turns negative beyond one pixel in wider
// filters.
float triangle(float x, float y, float xWidth, float yWidth) {
  return (1 - std::abs(2 * x / xWidth)) * (1 - std::abs(2 * y / yWidth));
}

float gaussian(float x, float y, float xWidth, float yWidth) {
  const float u = 2 * x / xWidth, v = 2 * y / yWidth;
  return std::exp(-2 * (u * u + v * v));
}

float cubic(float r) {
  if (r < 1) return (3 * r - 5) * r * r + 2;
  return r < 2 ? ((5 - r) * r - 8) * r + 4 : 0;
}
// The printed formula is radial and depends on its width only by clipping; PRMan calls the product of two "separable".
float catmullRom(float x, float y, float, float) { return cubic(std::sqrt(x * x + y * y)); }
float separableCatmullRom(float x, float y, float, float) { return cubic(std::abs(x)) * cubic(std::abs(y)); }

float sinc(float x) {
  const float t = kPi * x;
  return std::abs(t) < 1e-4f ? 1 : std::sin(t) / t;
}
// The formula is printed without pi and without a window. Common renderers pass frequencies up to half a cycle per
// pixel, under a cosine lobe.
float sincLobe(float x, float width) { return std::cos(kPi * x / (2 * width)) * sinc(x); }
float windowedSinc(float x, float y, float xWidth, float yWidth) { return sincLobe(x, xWidth) * sincLobe(y, yWidth); }

// Mitchell and Netravali 1988, B = C = 1/3, stretched so that it ends at half the width.
float mitchell(float x, float width) {
  const float t = std::abs(4 * x / width);
  if (t < 1) return ((7.0f * t - 12.0f) * t * t + 16.0f / 3.0f) / 6;
  return t < 2 ? (((-7.0f / 3.0f * t + 12.0f) * t - 20.0f) * t + 32.0f / 3.0f) / 6 : 0;
}
float mitchell(float x, float y, float xWidth, float yWidth) { return mitchell(x, xWidth) * mitchell(y, yWidth); }

float blackmanHarris(float x, float width) {
  const float t = 2 * kPi * (x / width + 0.5f);
  return 0.35875f - 0.48829f * std::cos(t) + 0.14128f * std::cos(2 * t) - 0.01168f * std::cos(3 * t);
}
float blackmanHarris(float x, float y, float xWidth, float yWidth) {
  return blackmanHarris(x, xWidth) * blackmanHarris(y, yWidth);
}

float lanczos(float x, float y, float xWidth, float yWidth) {
  return sinc(x) * sinc(2 * x / xWidth) * sinc(y) * sinc(2 * y / yWidth);
}

float disk(float x, float y, float xWidth, float yWidth) {
  const float u = 2 * x / xWidth, v = 2 * y / yWidth;
  return u * u + v * v <= 1 ? 1.0f : 0.0f;
}

// Returns the transform of a disk, Airy's amplitude 2 J1(x) / x. Its first zero is at 1.22 pixels: it passes the
// frequencies in the largest circle that pixels can represent. Its window is the first lobe of the same function,
// stretched to the width of the filter.
float airy(float r) { return r < 1e-3f ? 1.0f : 2 * std::cyl_bessel_jf(1, kPi * r) / (kPi * r); }
float bessel(float x, float y, float xWidth, float yWidth) {
  const float u = 2 * x / xWidth, v = 2 * y / yWidth, edge = std::sqrt(u * u + v * v);
  constexpr float kFirstZero = 1.219669891f;
  return edge >= 1 ? 0.0f : airy(std::sqrt(x * x + y * y)) * airy(kFirstZero * edge);
}

struct Named {
  const char* name;
  Kernel kernel;
};
constexpr std::array<Named, 11> kFilters = {{{"gaussian", gaussian},
                                             {"box", box},
                                             {"triangle", triangle},
                                             {"catmull-rom", catmullRom},
                                             {"separable-catmull-rom", separableCatmullRom},
                                             {"sinc", windowedSinc},
                                             {"mitchell", mitchell},
                                             {"blackman-harris", blackmanHarris},
                                             {"lanczos", lanczos},
                                             {"bessel", bessel},
                                             {"disk", disk}}};

// std::max comes first, so that a NaN becomes the narrowest filter.
float usableWidth(float width) { return std::min(std::max(kNarrowestFilter_px, width), kWidestFilter_px); }

int reach(float width) { return static_cast<int>(std::ceil((width - 1) / 2)); }

}  // namespace

PixelFilter::PixelFilter(const std::string& name, float xWidth, float yWidth, bool* known)
    : kind_(0), xWidth_(usableWidth(xWidth)), yWidth_(usableWidth(yWidth)) {
  bool found = false;
  for (size_t i = 0; i < kFilters.size() && !found; ++i)
    if (name == kFilters[i].name) {
      kind_ = static_cast<int>(i);
      found = true;
    }
  if (known) *known = found;
}

float PixelFilter::operator()(float x, float y) const {
  // The interval is half open, so that under a box of one pixel a sample between two pixels belongs to one of them.
  const bool inside = x >= -0.5f * xWidth_ && x < 0.5f * xWidth_ && y >= -0.5f * yWidth_ && y < 0.5f * yWidth_;
  return inside ? kFilters[static_cast<size_t>(kind_)].kernel(x, y, xWidth_, yWidth_) : 0.0f;
}

bool PixelFilter::hasNegativeLobes() const {
  static constexpr std::string_view kNames[] = {"catmull-rom", "separable-catmull-rom", "sinc", "mitchell", "lanczos",
                                                "bessel"};
  const std::string_view name = kFilters[static_cast<size_t>(kind_)].name;
  return std::find(std::begin(kNames), std::end(kNames), name) != std::end(kNames);
}

std::vector<std::string> PixelFilter::names() {
  std::vector<std::string> out;
  for (const Named& filter : kFilters) out.push_back(filter.name);
  return out;
}

int PixelFilter::reachX() const { return reach(xWidth_); }
int PixelFilter::reachY() const { return reach(yWidth_); }

}  // namespace tomales
