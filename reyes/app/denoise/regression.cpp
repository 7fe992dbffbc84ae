#include "reyes/app/denoise/regression.h"

#include <algorithm>
#include <cmath>

#include "reyes/base/parallel.h"

namespace tomales::denoising {
namespace {

constexpr int kReach = 8, kPatch = 3;      ///< Pixels from the middle of the window, and of a patch.
constexpr size_t kMost = kMostGuides + 1;  ///< Unknowns of a regression: the colour and its slopes.
constexpr float kRidge = 1e-3f;            ///< Keeps slopes small that the neighbours do not determine.

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

  /// Returns the colour where all guides are those of the pixel, by Cholesky's decomposition.
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

class Regression {
 public:
  Regression(const Size& size, const RegressionInput& in, float width) : size_(size), in_(in), width_(width) {}

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
            add(x, y, dx, dy, patch(distance, across, part, x, y - padded0, dx, dy),
                equations[static_cast<size_t>(y - y0) * static_cast<size_t>(size_.width) + static_cast<size_t>(x)]);
      }
    for (int y = y0; y < y1; ++y)
      for (int x = 0; x < size_.width; ++x) {
        const auto color =
            equations[static_cast<size_t>(y - y0) * static_cast<size_t>(size_.width) + static_cast<size_t>(x)].solve(
                in_.guides.size() + 1);
        for (size_t c = 0; c < 3; ++c) out[c][size_.at(x, y)] = color[c];
      }
  }

  /// Returns the squared difference, minus the part that noise explains, over the variance (Rousselle et al., eq. 3);
  /// negative outside of the picture.
  float distanceOf(int x, int y, int dx, int dy) const {
    constexpr float kTiny = 1e-10f;
    if (x + dx < 0 || y + dy < 0 || x + dx >= size_.width || y + dy >= size_.height) return -1;
    const size_t p = size_.at(x, y), q = size_.at(x + dx, y + dy);
    float sum = 0;
    for (size_t c = 0; c < 3; ++c) {
      const float d = in_.weighing[c][p] - in_.weighing[c][q], vp = in_.variance[c][p], vq = in_.variance[c][q];
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

  /// Returns the mean distance of the patches around a pixel, without comparisons of the pixel itself or of pixels up
  /// to kNear away.
  static float patch(const Plane& distance, const Plane& across, const Size& size, int x, int y, int dx, int dy) {
    const int x0 = std::max(0, x - kPatch), x1 = std::min(size.width, x + kPatch + 1), y0 = std::max(0, y - kPatch),
              y1 = std::min(size.height, y + kPatch + 1);
    float sum = 0;
    int count = (x1 - x0) * (y1 - y0);
    for (int i = y0; i < y1; ++i) sum += across[size.at(x, i)];
    const auto leaveOut = [&](int px, int py) {
      if (px < x0 || px >= x1 || py < y0 || py >= y1) return;
      sum -= distance[size.at(px, py)];
      --count;
    };
    for (int j = -kNear; j <= kNear; ++j)
      for (int i = -kNear; i <= kNear; ++i) {
        leaveOut(x + i, y + j);
        // the pair whose other pixel it is
        if (std::abs(i - dx) > kNear || std::abs(j - dy) > kNear) leaveOut(x + i - dx, y + j - dy);
      }
    return count > 0 ? sum / static_cast<float>(count) : 0.0f;
  }

  void add(int x, int y, int dx, int dy, float distance, Equations& to) const {
    const float weight = std::exp(-std::max(0.0f, distance));
    if (weight < 1e-4f) return;
    const size_t p = size_.at(x, y), q = size_.at(x + dx, y + dy);
    std::array<float, kMost> differences{1};
    for (size_t g = 0; g < in_.guides.size(); ++g) differences[g + 1] = in_.guides[g][q] - in_.guides[g][p];
    to.add(differences, in_.guides.size() + 1, weight, {in_.filtered[0][q], in_.filtered[1][q], in_.filtered[2][q]});
  }

  const Size size_;
  const RegressionInput in_;
  const float width_;
};

}  // namespace

Color regression(const Size& size, const RegressionInput& in, float width) { return Regression(size, in, width).run(); }

}  // namespace tomales::denoising
