// Coverage against closed form, and how fast its error falls with the number of samples (docs/measured/coverage.md).
// Stratified in one cell a sample, an edge of one dimension crosses sqrt(N) of N cells: error N^-3/4. Random: N^-1/2.
#include <gtest/gtest.h>

#include "tests/unit/hide/tile.h"

namespace tomales::test {
namespace {

constexpr PixelRect kFrame{0, 0, 64, 64};
using Coverage = std::function<double(int x, int y)>;

/// Root of the mean squared error over the pixels that an edge crosses, and the mean error.
struct Error {
  double rms = 0, bias = 0;
  int pixels = 0;
};

Error errorOf(const World& w, const RasterGrid& surface, const Coverage& exact, int n, uint32_t seed) {
  const SamplePattern pattern(n, n, true, seed);
  const DeepTile t = hide(w, pattern, kFrame, {std::shared_ptr<const RasterGrid>(&surface, [](const RasterGrid*) {})});
  Error e;
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x) {
      const double area = exact(x, y);
      if (area < 1e-6 || area > 1 - 1e-6) continue;
      const double error = coverage(t, x, y, n * n) - area;
      e.rms += error * error;
      e.bias += error;
      ++e.pixels;
    }
  e.rms = std::sqrt(e.rms / e.pixels);
  e.bias /= e.pixels;
  return e;
}

/// Errors at 2 x 2, 4 x 4, 8 x 8 and 16 x 16 samples; `order` is how fast they must fall: N^-order.
void expectOrder(const World& w, const std::shared_ptr<const RasterGrid>& surface, const Coverage& exact,
                 double order) {
  double first = 0, last = 0;
  for (const int n : {2, 4, 8, 16}) {
    const Error e = errorOf(w, *surface, exact, n, 7);
    ASSERT_GT(e.pixels, 60);
    EXPECT_NEAR(e.bias, 0, 4 * e.rms / std::sqrt(e.pixels)) << n;
    (n == 2 ? first : last) = e.rms;
  }
  EXPECT_GT(std::log(first / last) / std::log(64.0), order);
}

double mean(int steps, const std::function<double(double)>& f) {
  double sum = 0;
  for (int k = 0; k < steps; ++k) sum += f((k + 0.5) / steps);
  return sum / steps;
}

World still() {
  World w;
  w.add();
  w.freeze();
  return w;
}

TEST(Accuracy, ErrorAtAHalfPlaneFallsFasterThanThatOfRandomSamples) {
  const World w = still();
  const auto edge = [](double y) { return 20.3 + 0.27 * y; };
  const auto g = makeGrid(0, 1, 30, 60, [&](float u, float v, int) {
    const float y = -1 + 66 * v;
    return at(lerp(-1, static_cast<float>(edge(y)), u), y);
  });
  expectOrder(
      w, raster(w, g),
      [&](int x, int y) { return mean(512, [&](double v) { return std::clamp(edge(y + v) - x, 0.0, 1.0); }); }, 0.7);
}

TEST(Accuracy, ErrorAtADiskFallsFasterThanThatOfRandomSamples) {
  const World w = still();
  const auto g = makeGrid(0, 1, 600, 12, [](float u, float v, int) {
    return at(32.2f + 25 * v * std::cos(2 * kPi * u), 31.7f + 25 * v * std::sin(2 * kPi * u));
  });
  expectOrder(
      w, raster(w, g),
      [](int x, int y) {
        return mean(512, [&](double v) {
          const double dy = y + v - 31.7, half = std::sqrt(std::max(0.0, 625 - dy * dy));
          return std::max(0.0, std::min(x + 1.0, 32.2 + half) - std::max<double>(x, 32.2 - half));
        });
      },
      0.7);
}

TEST(Accuracy, ErrorAtAThinTriangleFallsFasterThanThatOfRandomSamples) {
  const World w = still();
  // 0.7 px wide at its foot.
  const auto left = [](double y) { return 20.3 + 0.11 * y; };
  const auto right = [&](double y) { return left(y) + 0.7 * (1 - y / 64); };
  const auto g = makeGrid(0, 1, 2, 64, [&](float u, float v, int) {
    return at(lerp(static_cast<float>(left(64 * v)), static_cast<float>(right(64 * v)), u), 64 * v);
  });
  expectOrder(
      w, raster(w, g),
      [&](int x, int y) {
        return mean(512, [&](double v) {
          return std::max(0.0, std::min(x + 1.0, right(y + v)) - std::max<double>(x, left(y + v)));
        });
      },
      0.65);
}

TEST(Accuracy, ErrorAtAMovingEdgeFallsFasterThanThatOfRandomSamples) {
  World w;
  w.scene.options.shutterClose = 1;
  w.add();
  w.scene.objects[0].keyTimes = {0, 1};
  w.freeze();
  w.scene.objects[0].keyTimes = {0, 1};
  const auto edge = [](double y, double time) { return 20.3 + 0.27 * y + 6 * time; };
  const auto g = makeGrid(
      0, 1, 30, 60,
      [&](float u, float v, int key) {
        const float y = -1 + 66 * v;
        return at(lerp(-1, static_cast<float>(edge(y, key)), u), y);
      },
      2);
  expectOrder(
      w, raster(w, g),
      [&](int x, int y) {
        return mean(64, [&](double v) {
          return mean(128, [&](double t) { return std::clamp(edge(y + v, t) - x, 0.0, 1.0); });
        });
      },
      0.5);
}

TEST(Accuracy, ErrorAtADefocusedEdgeFallsFasterThanThatOfRandomSamples) {
  constexpr float kFocus = 5, kLens = 1.5f, kFar = 10, kScale_px = 32;
  Options o;
  o.xResolution = o.yResolution = 64;
  o.projection = ProjectionKind::Perspective;
  o.focalDistance = kFocus;
  o.focalLength = 2 * kLens;
  o.fStop = 1;
  World w(o);
  w.add();
  w.freeze();
  const auto edge = [](double y) { return 20.3 + 0.27 * y; };
  const auto g = makeGrid(0, 1, 40, 60, [&](float u, float v, int) {
    const float y = -20 + 104 * v, x = lerp(-30, static_cast<float>(edge(y)), u);
    return vec3((x - 32) / kScale_px * kFar, -(y - 32) / kScale_px * kFar, kFar);
  });
  // A thin lens moves the edge over a disk; across the edge the disk's chords are 2/pi sqrt(1 - s^2) of it.
  const double radius = kScale_px * kLens * (1 / kFocus - 1 / kFar) * std::sqrt(1 + 0.27 * 0.27);
  expectOrder(
      w, raster(w, g),
      [&](int x, int y) {
        return mean(32, [&](double v) {
          return mean(256, [&](double k) {
            const double s = 2 * k - 1;
            return 4 / M_PI * std::sqrt(1 - s * s) * std::clamp(edge(y + v) + radius * s - x, 0.0, 1.0);
          });
        });
      },
      0.5);
}

}  // namespace
}  // namespace tomales::test
