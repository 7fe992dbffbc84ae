#include "reyes/app/denoise/filter.h"

#include <algorithm>
#include <cmath>

#include "reyes/app/denoise/regression.h"
#include "reyes/base/parallel.h"

namespace tomales {
namespace {

using denoising::Color, denoising::Size, denoising::kBand, denoising::kNear, denoising::regression;

constexpr std::array<float, 2> kWidths{0.5f, 1.0f};  ///< Widths of the filter: k of Rousselle et al.
constexpr int kSmoothVariance = 2, kSmoothError = 4, kSmoothChoice = 1;
/// A filter blurs something if its error at a pixel exceeds that of no filter by this many times the variance around
/// it. Noise alone has that effect at very few pixels.
constexpr float kBlurs = 4;

/// Returns means over squares of 2 `reach` + 1 pixels, fewer at the edges.
Plane smoothed(const Plane& in, const Size& size, int reach) {
  Plane across(in.size()), out(in.size());
  const auto mean = [&](const Plane& from, int middle, int length, const auto& index) {
    double sum = 0;
    const int begin = std::max(0, middle - reach), end = std::min(length, middle + reach + 1);
    for (int i = begin; i < end; ++i) sum += from[index(i)];
    return static_cast<float>(sum / (end - begin));
  };
  parallelFor(static_cast<size_t>(size.height), kBand, [&](size_t first, size_t last) {
    for (int y = static_cast<int>(first); y < static_cast<int>(last); ++y)
      for (int x = 0; x < size.width; ++x)
        across[size.at(x, y)] = mean(in, x, size.width, [&](int i) { return size.at(i, y); });
  });
  parallelFor(static_cast<size_t>(size.height), kBand, [&](size_t first, size_t last) {
    for (int y = static_cast<int>(first); y < static_cast<int>(last); ++y)
      for (int x = 0; x < size.width; ++x)
        out[size.at(x, y)] = mean(across, y, size.height, [&](int i) { return size.at(x, i); });
  });
  return out;
}

/// Returns the variance of one half, from the differences of both halves, whose variances are equal.
Color varianceOf(const HalfBuffers& in, const Size& size) {
  Color out;
  for (size_t c = 0; c < 3; ++c) {
    Plane squares(size.count());
    for (size_t i = 0; i < squares.size(); ++i) {
      const float d = in.a[c][i] - in.b[c][i];
      squares[i] = 0.5f * d * d;
    }
    out[c] = smoothed(squares, size, kSmoothVariance);
  }
  return out;
}

/// A filter's answers for both halves, and their squared errors, summed over the colours: means over near pixels, and
/// over the pixels around those.
struct Candidate {
  Color a, b;
  Plane near, around;
};

/// Returns means over squares of 2 kSmoothError + 1 pixels without the near ones, whose means are given.
Plane meansAround(const Plane& in, const Plane& near, const Size& size) {
  Plane out = smoothed(in, size, kSmoothError);
  const auto area = [&](int x, int y, int reach) {
    return (std::min(size.width, x + reach + 1) - std::max(0, x - reach)) *
           (std::min(size.height, y + reach + 1) - std::max(0, y - reach));
  };
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x) {
      const size_t i = size.at(x, y);
      const auto all = static_cast<float>(area(x, y, kSmoothError)), inner = static_cast<float>(area(x, y, kNear));
      if (all > inner) out[i] = (all * out[i] - inner * near[i]) / (all - inner);
    }
  return out;
}

/// Measures a filter. The error of each half's answer is its difference from the other half minus the noise of the
/// other half.
Candidate judged(Color a, Color b, const HalfBuffers& in, const Color& variance, const Size& size) {
  Plane squares(size.count(), 0.0f);
  for (size_t c = 0; c < 3; ++c)
    for (size_t i = 0; i < squares.size(); ++i) {
      const float da = a[c][i] - in.b[c][i], db = b[c][i] - in.a[c][i];
      squares[i] += 0.5f * (da * da + db * db) - variance[c][i];
    }
  Plane near = smoothed(squares, size, kNear), around = meansAround(squares, near, size);
  return {std::move(a), std::move(b), std::move(near), std::move(around)};
}

/// Returns the index of the candidate for a pixel; 0 does not filter. Only surrounding pixels decide, so that the error
/// at the pixel is an unbiased measure of the chosen candidate.
size_t bestAt(size_t pixel, const std::vector<Candidate>& candidates) {
  const Candidate& none = candidates[0];
  size_t best = 0;
  for (size_t k = 1; k < candidates.size(); ++k)
    if (candidates[k].around[pixel] < candidates[best].around[pixel] &&
        candidates[k].near[pixel] - none.near[pixel] < kBlurs * none.around[pixel])
      best = k;
  return best;
}

/// Scales the guides so that their root mean square over the picture is 1.
std::vector<Plane> scaled(std::vector<Plane> guides) {
  for (Plane& g : guides) {
    double sum = 0, squares = 0;
    for (const float v : g) {
      sum += v;
      squares += double{v} * v;
    }
    const double n = static_cast<double>(g.size()), mean = sum / n,
                 deviation = std::sqrt(std::max(0.0, squares / n - mean * mean));
    for (float& v : g) v = deviation > 0 ? static_cast<float>((v - mean) / deviation) : 0.0f;
  }
  return guides;
}

}  // namespace

Denoised denoise(const HalfBuffers& in) {
  const Size size{in.width, in.height};
  const Color variance = varianceOf(in, size);
  const std::vector<Plane> guides = scaled(in.guides);
  std::vector<Candidate> candidates;
  candidates.push_back(judged(in.a, in.b, in, variance, size));
  for (const float width : kWidths)
    candidates.push_back(judged(regression(size, {in.a, in.b, variance, guides}, width),
                                regression(size, {in.b, in.a, variance, guides}, width), in, variance, size));
  std::vector<Plane> chosen(candidates.size(), Plane(size.count(), 0.0f));
  for (size_t i = 0; i < size.count(); ++i) chosen[bestAt(i, candidates)][i] = 1;
  for (Plane& share : chosen) share = smoothed(share, size, kSmoothChoice);

  Denoised out;
  double sum = 0, before = 0, left = 0, bias = 0;
  for (size_t c = 0; c < 3; ++c) {
    out.color[c].resize(size.count());
    for (size_t i = 0; i < size.count(); ++i) {
      float a = 0, b = 0;
      for (size_t k = 0; k < candidates.size(); ++k) {
        a += chosen[k][i] * candidates[k].a[c][i];
        b += chosen[k][i] * candidates[k].b[c][i];
      }
      out.color[c][i] = 0.5f * (a + b);
      const double da = a - in.b[c][i], db = b - in.a[c][i], apart = a - b, noise = in.a[c][i] - in.b[c][i];
      sum += 0.5 * (double{in.a[c][i]} + in.b[c][i]);
      before += 0.25 * noise * noise;
      // The variance of one half's answer is half of their squared difference, and the mean has half of that. An answer
      // differs from the other half by that half's noise and by its own bias, which are independent.
      left += 0.25 * apart * apart;
      bias += 0.5 * (da * da + db * db) - 0.5 * noise * noise - 0.5 * apart * apart;
    }
  }
  const double n = 3 * static_cast<double>(size.count()), mean = std::abs(sum) / n;
  const auto relative = [&](double squares) { return mean > 0 ? std::sqrt(std::max(0.0, squares) / n) / mean : 0.0; };
  out.before = relative(before);
  out.after = relative(left + std::max(0.0, bias));
  return out;
}

}  // namespace tomales
