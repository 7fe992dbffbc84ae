#include "reyes/app/denoise/filter.h"

#include <algorithm>
#include <cmath>

#include "reyes/base/parallel.h"

namespace tomales {
namespace {

constexpr int kReach = 8, kPatch = 3;                ///< Pixels from the middle of the window, and of a patch.
constexpr std::array<float, 2> kWidths{0.5f, 1.0f};  ///< Widths of the filter: k of Rousselle et al.
constexpr int kSmoothVariance = 2, kSmoothError = 4, kSmoothChoice = 1;
constexpr int kBand = 16;                  ///< Rows that one thread takes at a time.
constexpr size_t kMost = kMostGuides + 1;  ///< Unknowns of a regression: the colour and its slopes.
constexpr float kRidge = 1e-3f;            ///< Keeps slopes small that the neighbours say nothing about.

using Color = std::array<Plane, 3>;

struct Size {
  int width, height;
  size_t count() const { return static_cast<size_t>(width) * static_cast<size_t>(height); }
  size_t at(int x, int y) const { return static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x); }
};

/// Means over squares of 2 `reach` + 1 pixels, fewer at the edges.
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

/// The variance of one half, from the differences of both, which have the same.
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

/// The normal equations of one pixel, of which the upper half is kept.
struct Equations {
  std::array<float, kMost*(kMost + 1) / 2> products{};
  std::array<std::array<float, 3>, kMost> sums{};

  void add(const std::array<float, kMost>& x, size_t n, float weight, const std::array<float, 3>& color) {
    size_t k = 0;
    for (size_t i = 0; i < n; ++i) {
      const float wx = weight * x[i];
      for (size_t j = i; j < n; ++j) products[k++] += wx * x[j];
      for (size_t c = 0; c < 3; ++c) sums[i][c] += wx * color[c];
    }
  }

  /// The colour where all guides are those of the pixel, by Cholesky's decomposition.
  std::array<float, 3> solve(size_t n) const {
    std::array<std::array<double, kMost>, kMost> L{};
    size_t k = 0;
    for (size_t i = 0; i < n; ++i)
      for (size_t j = i; j < n; ++j) L[j][i] = products[k++];
    const double ridge = kRidge * L[0][0];
    for (size_t j = 0; j < n; ++j) {
      if (j > 0) L[j][j] += ridge;
      for (size_t m = 0; m < j; ++m) L[j][j] -= L[j][m] * L[j][m];
      L[j][j] = std::sqrt(std::max(L[j][j], 1e-12));
      for (size_t i = j + 1; i < n; ++i) {
        for (size_t m = 0; m < j; ++m) L[i][j] -= L[i][m] * L[j][m];
        L[i][j] /= L[j][j];
      }
    }
    std::array<float, 3> out{};
    for (size_t c = 0; c < 3; ++c) {
      std::array<double, kMost> y{};
      for (size_t i = 0; i < n; ++i) {
        y[i] = sums[i][c];
        for (size_t m = 0; m < i; ++m) y[i] -= L[i][m] * y[m];
        y[i] /= L[i][i];
      }
      for (size_t i = n; i-- > 0;) {
        for (size_t m = i + 1; m < n; ++m) y[i] -= L[m][i] * y[m];
        y[i] /= L[i][i];
      }
      out[c] = static_cast<float>(y[0]);
    }
    return out;
  }
};

/// Filters one half with weights of the other.
class Regression {
 public:
  Regression(const Size& size, const Color& filtered, const Color& weighing, const Color& variance,
             const std::vector<Plane>& guides, float width)
      : size_(size), filtered_(filtered), weighing_(weighing), variance_(variance), guides_(guides), width_(width) {}

  Color run() const {
    Color out;
    for (Plane& plane : out) plane.resize(size_.count());
    const auto bands = static_cast<size_t>((size_.height + kBand - 1) / kBand);
    parallelFor(bands, 1, [&](size_t first, size_t last) {
      for (size_t band = first; band < last; ++band) runBand(static_cast<int>(band) * kBand, out);
    });
    return out;
  }

 private:
  void runBand(int y0, Color& out) const {
    const int y1 = std::min(y0 + kBand, size_.height), padded0 = std::max(0, y0 - kPatch),
              padded1 = std::min(size_.height, y1 + kPatch);
    const Size part{size_.width, padded1 - padded0};
    std::vector<Equations> equations(static_cast<size_t>(size_.width) * static_cast<size_t>(y1 - y0));
    Plane distance(part.count()), across(part.count());
    for (int dy = -kReach; dy <= kReach; ++dy)
      for (int dx = -kReach; dx <= kReach; ++dx) {
        for (int y = padded0; y < padded1; ++y)
          for (int x = 0; x < size_.width; ++x) distance[part.at(x, y - padded0)] = distanceOf(x, y, dx, dy);
        sumAcross(distance, part, across);
        for (int y = std::max(y0, -dy); y < std::min(y1, size_.height - dy); ++y)
          for (int x = std::max(0, -dx); x < std::min(size_.width, size_.width - dx); ++x)
            add(x, y, dx, dy, patch(across, part, x, y - padded0),
                equations[static_cast<size_t>(y - y0) * static_cast<size_t>(size_.width) + static_cast<size_t>(x)]);
      }
    for (int y = y0; y < y1; ++y)
      for (int x = 0; x < size_.width; ++x) {
        const auto color =
            equations[static_cast<size_t>(y - y0) * static_cast<size_t>(size_.width) + static_cast<size_t>(x)].solve(
                guides_.size() + 1);
        for (size_t c = 0; c < 3; ++c) out[c][size_.at(x, y)] = color[c];
      }
  }

  /// Squared, less what noise explains, over the variance (Rousselle et al., eq. 3). Negative outside of the picture.
  float distanceOf(int x, int y, int dx, int dy) const {
    constexpr float kTiny = 1e-10f;
    if (x + dx < 0 || y + dy < 0 || x + dx >= size_.width || y + dy >= size_.height) return -1;
    const size_t p = size_.at(x, y), q = size_.at(x + dx, y + dy);
    float sum = 0;
    for (size_t c = 0; c < 3; ++c) {
      const float d = weighing_[c][p] - weighing_[c][q], vp = variance_[c][p], vq = variance_[c][q];
      sum += (d * d - (vp + std::min(vp, vq))) / (kTiny + width_ * width_ * (vp + vq));
    }
    return sum / 3;
  }

  static void sumAcross(const Plane& in, const Size& size, Plane& out) {
    for (int y = 0; y < size.height; ++y)
      for (int x = 0; x < size.width; ++x) {
        float sum = 0;
        for (int i = std::max(0, x - kPatch); i < std::min(size.width, x + kPatch + 1); ++i) sum += in[size.at(i, y)];
        out[size.at(x, y)] = sum;
      }
  }

  /// The mean distance of the patch around a pixel.
  static float patch(const Plane& across, const Size& size, int x, int y) {
    const int y0 = std::max(0, y - kPatch), y1 = std::min(size.height, y + kPatch + 1),
              columns = std::min(size.width, x + kPatch + 1) - std::max(0, x - kPatch);
    float sum = 0;
    for (int i = y0; i < y1; ++i) sum += across[size.at(x, i)];
    return sum / static_cast<float>(columns * (y1 - y0));
  }

  void add(int x, int y, int dx, int dy, float distance, Equations& to) const {
    const float weight = std::exp(-std::max(0.0f, distance));
    if (weight < 1e-4f) return;
    const size_t p = size_.at(x, y), q = size_.at(x + dx, y + dy);
    std::array<float, kMost> differences{1};
    for (size_t g = 0; g < guides_.size(); ++g) differences[g + 1] = guides_[g][q] - guides_[g][p];
    to.add(differences, guides_.size() + 1, weight, {filtered_[0][q], filtered_[1][q], filtered_[2][q]});
  }

  const Size size_;
  const Color &filtered_, &weighing_, &variance_;
  const std::vector<Plane>& guides_;
  const float width_;
};

/// A filter's answers for both halves, and their squared error, summed over the colours.
struct Candidate {
  Color a, b;
  Plane error;
};

/// The error of each half's answer is its difference from the other half, less what is the noise of that.
Candidate judged(Color a, Color b, const HalfBuffers& in, const Color& variance, const Size& size) {
  Plane squares(size.count(), 0.0f);
  for (size_t c = 0; c < 3; ++c)
    for (size_t i = 0; i < squares.size(); ++i) {
      const float da = a[c][i] - in.b[c][i], db = b[c][i] - in.a[c][i];
      squares[i] += 0.5f * (da * da + db * db) - variance[c][i];
    }
  return {std::move(a), std::move(b), smoothed(squares, size, kSmoothError)};
}

/// Guides of about the same scale: their root mean square over the picture is 1.
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
    candidates.push_back(judged(Regression(size, in.a, in.b, variance, guides, width).run(),
                                Regression(size, in.b, in.a, variance, guides, width).run(), in, variance, size));
  std::vector<Plane> chosen(candidates.size(), Plane(size.count(), 0.0f));
  for (size_t i = 0; i < size.count(); ++i) {
    size_t best = 0;
    for (size_t k = 1; k < candidates.size(); ++k)
      if (candidates[k].error[i] < candidates[best].error[i]) best = k;
    chosen[best][i] = 1;
  }
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
      // The variance of one half's answer is half of their squared difference, and the mean has half of that. What else
      // an answer differs from the other half by, beside that half's noise, is its bias.
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
