#include "reyes/app/chart/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace tomales {
namespace {

std::array<int, 3> colors(const Image& image) {
  std::array<int, 3> out{image.channelIndex("R"), image.channelIndex("G"), image.channelIndex("B")};
  for (int& c : out) c = std::max(c, 0);
  return out;
}

vec3 colorAt(const Image& image, const std::array<int, 3>& c, int x, int y) {
  const float* p = image.at(x, y);
  return {p[c[0]], p[c[1]], p[c[2]]};
}

Image blank(const Image& like) {
  return {like.width,
          like.height,
          {"R", "G", "B"},
          std::vector<float>(static_cast<size_t>(like.width) * static_cast<size_t>(like.height) * 3),
          0,
          0,
          like.width,
          like.height};
}

void set(Image& image, int x, int y, const vec3& color) {
  float* p = image.at(x, y);
  p[0] = color.x;
  p[1] = color.y;
  p[2] = color.z;
}

/// Calls visit(test, reference) for each colour of each pixel where `lit` has any light. Returns the number of pixels
/// that are not finite (ErrorFigures::notFinite).
template <class Visit>
int64_t eachValue(const Image& test, const Image& reference, const Image& lit, Visit&& visit) {
  const auto t = colors(test), r = colors(reference), l = colors(lit);
  int64_t notFinite = 0;
  for (int y = 0; y < reference.height; ++y)
    for (int x = 0; x < reference.width; ++x) {
      vec3 a = colorAt(test, t, x, y);
      const vec3 b = colorAt(reference, r, x, y);
      if (!isFinite(a) || !isFinite(b)) {
        ++notFinite;
        a = vec3(0);
      }
      if (!isFinite(b) || colorAt(lit, l, x, y) == vec3(0)) continue;
      for (int c = 0; c < 3; ++c) visit(a[c], b[c]);
    }
  return notFinite;
}

/// Computes a * A + b * B of the colours.
Image blend(float a, const Image& A, float b, const Image& B) {
  Image out = blank(A);
  const auto ca = colors(A), cb = colors(B);
  for (int y = 0; y < out.height; ++y)
    for (int x = 0; x < out.width; ++x) set(out, x, y, a * colorAt(A, ca, x, y) + b * colorAt(B, cb, x, y));
  return out;
}

struct MeanErrors {
  double relative = 0, square = 0;
};

MeanErrors meanErrors(const Image& test, const Image& reference, const Image& lit) {
  MeanErrors sum;
  int64_t count = 0;
  eachValue(test, reference, lit, [&](float t, float r) {
    sum.relative += std::abs(t - r) / (std::abs(r) + ChartReference::kFloor);
    sum.square += double{t - r} * (t - r);
    ++count;
  });
  const double n = static_cast<double>(std::max<int64_t>(count, 1));
  return {sum.relative / n, sum.square / n};
}

/// Returns a squared error without the reference's noise. `all` is the square with all `batches`; `meanOfOthers` is the
/// mean of the squares with one batch left out.
double withoutNoise(double all, double meanOfOthers, double batches) {
  return std::max(0.0, batches * all - (batches - 1) * meanOfOthers);
}

/// Returns half the 95 % interval of a figure, from its values without each batch.
double jackknife(const std::vector<double>& without, double all) {
  double spread = 0;
  for (const double v : without) spread += (v - all) * (v - all);
  const double n = static_cast<double>(without.size());
  return n < 2 ? 0 : 2 * std::sqrt(spread * (n - 1) / n);
}

}  // namespace

bool ChartReference::add(const Image& batch) {
  if (!batches_.empty() && (batch.width != mean_.width || batch.height != mean_.height)) return false;
  batches_.push_back(batch);
  const float share = 1 / static_cast<float>(batches_.size());
  mean_ = blend(1 - share, batches_.size() > 1 ? mean_ : batch, share, batch);
  return true;
}

bool ChartReference::isBlack() const {
  return std::none_of(mean_.pixels.begin(), mean_.pixels.end(),
                      [](float v) { return std::isfinite(v) && std::abs(v) >= 1e-12f; });
}

Image ChartReference::meanWithout(size_t batch) const {
  const float others = static_cast<float>(batches_.size() - 1);
  return blend((others + 1) / others, mean_, -1 / others, batches_[batch]);
}

double ChartReference::noiseFloor() const {
  const double n = batches();
  if (n < 2) return kInfinity;
  // A batch differs from the mean of the others by its own noise and theirs, which is sqrt(n + n / (n - 1)) times the
  // noise of the mean of all.
  double sum = 0;
  for (size_t b = 0; b < batches_.size(); ++b) sum += meanErrors(batches_[b], meanWithout(b), mean_).relative;
  return sum / n / std::sqrt(n + n / (n - 1));
}

ErrorFigures ChartReference::errorOf(const Image& test) const {
  ErrorFigures out;
  std::vector<float> errors;
  double squares = 0, tests = 0, references = 0;
  out.notFinite = eachValue(test, mean_, mean_, [&](float t, float r) {
    errors.push_back(std::abs(t - r) / (std::abs(r) + kFloor));
    out.measured += errors.back();
    squares += double{t - r} * (t - r);
    tests += t;
    references += r;
  });
  if (errors.empty()) return out;
  const double count = static_cast<double>(errors.size());
  out.mean = out.measured /= count;
  squares /= count;
  const auto p99 = errors.begin() + static_cast<ptrdiff_t>(0.99 * (count - 1));
  std::nth_element(errors.begin(), p99, errors.end());
  out.p99 = *p99;
  if (batches() >= 2) {
    MeanErrors others;  // means of the squares
    for (size_t b = 0; b < batches_.size(); ++b) {
      const MeanErrors e = meanErrors(test, meanWithout(b), mean_);
      out.without.push_back(e.relative);
      others.relative += e.relative * e.relative / batches();
      others.square += e.square / batches();
    }
    out.mean = std::sqrt(withoutNoise(out.measured * out.measured, others.relative, batches()));
    squares = withoutNoise(squares, others.square, batches());
    out.confidence = jackknife(out.without, out.measured);
  }
  out.bias = references != 0 ? tests / references - 1 : 0;
  out.rms = references != 0 ? std::sqrt(squares) / (references / count) : 0;
  return out;
}

ErrorDifference operator-(const ErrorFigures& a, const ErrorFigures& b) {
  std::vector<double> without;
  for (size_t i = 0; i < std::min(a.without.size(), b.without.size()); ++i)
    without.push_back(a.without[i] - b.without[i]);
  return {a.mean - b.mean, jackknife(without, a.measured - b.measured)};
}

Image ChartReference::errorMap(const Image& test, float range) const {
  Image out = blank(mean_);
  const auto t = colors(test), r = colors(mean_);
  for (int y = 0; y < out.height; ++y)
    for (int x = 0; x < out.width; ++x) {
      const float b = luminance(colorAt(mean_, r, x, y)), d = luminance(colorAt(test, t, x, y)) - b;
      if (!std::isfinite(d)) {
        set(out, x, y, vec3(0, 1, 0));
        continue;
      }
      const float off = b == 0 ? 0 : std::clamp(d / (std::abs(b) + kFloor) / range, -1.0f, 1.0f);
      set(out, x, y, off > 0 ? vec3(1, 1 - off, 1 - off) : vec3(1 + off, 1 + off, 1));
    }
  return out;
}

std::string notFiniteNote(const ErrorFigures& error) {
  return error.notFinite > 0 ? fmt::format(", {} pixels not finite", error.notFinite) : "";
}

float brightness(const Image& image) {
  constexpr float kOfMedian = 8;  // a lamp would leave 8 bits too few steps for the rest
  std::vector<float> values;
  const auto c = colors(image);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      if (const vec3 color = colorAt(image, c, x, y); isFinite(color) && maxComponent(color) > 0)
        values.push_back(maxComponent(color));
  if (values.empty()) return 1;
  std::sort(values.begin(), values.end());
  const auto at = [&](double share) {
    return values[static_cast<size_t>(share * static_cast<double>(values.size() - 1))];
  };
  return std::max(std::min(at(0.995), kOfMedian * at(0.5)), 1e-6f);
}

Image thumbnail(const Image& image, int size, float gain) {
  const int step = (std::max(image.width, image.height) + size - 1) / size;
  Image out{image.width / step, image.height / step, {}, {}, 0, 0, 0, 0};
  out.width = std::max(1, out.width);
  out.height = std::max(1, out.height);
  out = blank(out);
  const auto c = colors(image);
  for (int y = 0; y < out.height; ++y)
    for (int x = 0; x < out.width; ++x) {
      vec3 sum(0);
      int count = 0;
      for (int j = y * step; j < std::min((y + 1) * step, image.height); ++j)
        for (int i = x * step; i < std::min((x + 1) * step, image.width); ++i) {
          sum += colorAt(image, c, i, j);
          ++count;
        }
      set(out, x, y, gain * sum / static_cast<float>(std::max(count, 1)));
    }
  return out;
}

}  // namespace tomales
