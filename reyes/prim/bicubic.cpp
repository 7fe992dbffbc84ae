#include "reyes/prim/bicubic.h"

#include <algorithm>
#include <optional>

#include "reyes/base/simd.h"
#include "reyes/prim/interpolation.h"

namespace tomales {
namespace {

TOMALES_HOT void evaluatePositions(const float* c, int n, const float* u, const float* v, float* p) {
  for (int i = 0; i < n; ++i) {
    const float t = u[i], s = 1 - t, b0 = s * s * s, b1 = 3 * s * s * t, b2 = 3 * s * t * t, b3 = t * t * t;
    const float r0 = b0 * c[0] + b1 * c[1] + b2 * c[2] + b3 * c[3];
    const float r1 = b0 * c[4] + b1 * c[5] + b2 * c[6] + b3 * c[7];
    const float r2 = b0 * c[8] + b1 * c[9] + b2 * c[10] + b3 * c[11];
    const float r3 = b0 * c[12] + b1 * c[13] + b2 * c[14] + b3 * c[15];
    const float y = v[i], x = 1 - y;
    p[i] = x * x * x * r0 + 3 * x * x * y * r1 + 3 * x * y * y * r2 + y * y * y * r3;
  }
}

TOMALES_HOT void evaluateDerivatives(const float* c, int n, const float* u, const float* v, float* du, float* dv) {
  for (int i = 0; i < n; ++i) {
    const float t = u[i], s = 1 - t, b0 = s * s * s, b1 = 3 * s * s * t, b2 = 3 * s * t * t, b3 = t * t * t;
    const float d0 = 3 * s * s, d1 = 6 * s * t, d2 = 3 * t * t;
    const float y = v[i], x = 1 - y, w0 = x * x * x, w1 = 3 * x * x * y, w2 = 3 * x * y * y, w3 = y * y * y;
    const float e0 = 3 * x * x, e1 = 6 * x * y, e2 = 3 * y * y;
    const float r0 = b0 * c[0] + b1 * c[1] + b2 * c[2] + b3 * c[3];
    const float r1 = b0 * c[4] + b1 * c[5] + b2 * c[6] + b3 * c[7];
    const float r2 = b0 * c[8] + b1 * c[9] + b2 * c[10] + b3 * c[11];
    const float r3 = b0 * c[12] + b1 * c[13] + b2 * c[14] + b3 * c[15];
    dv[i] = e0 * (r1 - r0) + e1 * (r2 - r1) + e2 * (r3 - r2);
    du[i] = w0 * (d0 * (c[1] - c[0]) + d1 * (c[2] - c[1]) + d2 * (c[3] - c[2])) +
            w1 * (d0 * (c[5] - c[4]) + d1 * (c[6] - c[5]) + d2 * (c[7] - c[6])) +
            w2 * (d0 * (c[9] - c[8]) + d1 * (c[10] - c[9]) + d2 * (c[11] - c[10])) +
            w3 * (d0 * (c[13] - c[12]) + d1 * (c[14] - c[13]) + d2 * (c[15] - c[14]));
  }
}

using Weights = std::array<double, 4>;

Weights bernstein(double t) {
  const double s = 1 - t;
  return {s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t};
}
Weights bernsteinDerivative(double t) {
  const double s = 1 - t;
  return {-3 * s * s, 3 * s * s - 6 * s * t, 6 * s * t - 3 * t * t, 3 * t * t};
}

glm::dvec3 controlOf(const BezierPatch& patch, size_t k) { return {patch[0][k], patch[1][k], patch[2][k]}; }

glm::dvec3 weighted(const BezierPatch& patch, const Weights& u, const Weights& v) {
  glm::dvec3 sum(0);
  for (size_t k = 0; k < 16; ++k) sum += u[k % 4] * v[k / 4] * controlOf(patch, k);
  return sum;
}

/// Tells whether all control points lie on a line, so that there is no normal anywhere.
bool isLine(const BezierPatch& patch) {
  const auto control = [&](size_t k) { return controlOf(patch, k); };
  glm::dvec3 along(0);
  for (size_t k = 1; k < 16; ++k)
    if (const glm::dvec3 step = control(k) - control(0); glm::length(step) > glm::length(along)) along = step;
  for (size_t k = 1; k < 16; ++k)
    if (glm::length(glm::cross(along, control(k) - control(0))) > 1e-9 * glm::dot(along, along)) return false;
  return true;
}

vec3 limitNormal(const BezierPatch& patch, double u, double v) {
  return vec3(glm::normalize(normalNearby(u, v, 1e-6, [&](double a, double b) {
    return std::pair(weighted(patch, bernsteinDerivative(a), bernstein(b)),
                     weighted(patch, bernstein(a), bernsteinDerivative(b)));
  })));
}

double extentOf(const BezierPatch& patch) {
  double extent = 0;
  for (const BezierNet& net : patch) {
    const auto [lo, hi] = std::minmax_element(net.begin(), net.end());
    extent = std::max(extent, static_cast<double>(*hi) - *lo);
  }
  return extent;
}

/// Computes control values of the curve's piece over [t0, t1], in place at c, c + step, ... (blossoming).
void restrictCurve(float* c, int step, float t0, float t1) {
  const auto blossom = [&](float r, float s, float t) {
    const float a = lerp(c[0], c[step], r), b = lerp(c[step], c[2 * step], r), d = lerp(c[2 * step], c[3 * step], r);
    return lerp(lerp(a, b, s), lerp(b, d, s), t);
  };
  const float piece[4] = {blossom(t0, t0, t0), blossom(t0, t0, t1), blossom(t0, t1, t1), blossom(t1, t1, t1)};
  for (int k = 0; k < 4; ++k) c[k * step] = piece[k];
}

}  // namespace

ToBezier bezierFrom(const Basis& basis) {
  // Rows of RISpec's matrix are powers t^3, t^2, t, 1; Bezier control values follow from the power coefficients.
  static constexpr double kBezierFromPower[4][4] = {
      {0, 0, 0, 1}, {0, 0, 1.0 / 3, 1}, {0, 1.0 / 3, 2.0 / 3, 1}, {1, 1, 1, 1}};
  ToBezier out;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) {
      double sum = 0;
      for (int k = 0; k < 4; ++k) sum += kBezierFromPower[i][k] * static_cast<double>(basis.matrix[k][j]);
      // The weights of named bases are twelfths. With exactly equal weights, two patches agree exactly on their common
      // edge.
      const double twelfths = std::round(12 * sum);
      out[static_cast<size_t>(i)][static_cast<size_t>(j)] =
          static_cast<float>(std::abs(12 * sum - twelfths) < 1e-5 ? twelfths / 12 : sum);
    }
  return out;
}

BezierNet convertNet(const BezierNet& control, const ToBezier& u, const ToBezier& v) {
  const auto weigh = [](const std::array<float, 4>& w, float a, float b, float c, float d) {
    return w[0] * a + w[1] * b + w[2] * c + w[3] * d;
  };
  BezierNet rows, out;
  for (size_t j = 0; j < 4; ++j)
    for (size_t i = 0; i < 4; ++i)
      rows[4 * j + i] = weigh(u[i], control[4 * j], control[4 * j + 1], control[4 * j + 2], control[4 * j + 3]);
  for (size_t j = 0; j < 4; ++j)
    for (size_t i = 0; i < 4; ++i) out[4 * j + i] = weigh(v[j], rows[i], rows[4 + i], rows[8 + i], rows[12 + i]);
  return out;
}

void evaluateNet(const BezierNet& net, int n, const float* u, const float* v, float* p) {
  evaluatePositions(net.data(), n, u, v, p);
}

void evaluateNet(const BezierNet& net, int n, const float* u, const float* v, float* p, float* du, float* dv) {
  evaluatePositions(net.data(), n, u, v, p);
  evaluateDerivatives(net.data(), n, u, v, du, dv);
}

void evaluateBicubic(const BezierPatch& patch, int n, const float* u, const float* v, SurfacePoints out) {
  evaluateNet(patch[0], n, u, v, out.px, out.dux, out.dvx);
  evaluateNet(patch[1], n, u, v, out.py, out.duy, out.dvy);
  evaluateNet(patch[2], n, u, v, out.pz, out.duz, out.dvz);
  crossDerivatives(n, out);
  const double extent = extentOf(patch);
  const float degenerate = static_cast<float>(1e-5 * extent * extent);
  std::optional<bool> line;
  for (int i = 0; i < n; ++i) {
    if (glm::length(normalOf(out, i)) > degenerate) continue;
    if (!line) line = isLine(patch);
    setNormal(out, i, *line ? vec3(0, 0, 1) : limitNormal(patch, u[i], v[i]));
  }
}

Bound3 boundBicubic(const BezierPatch& patch, const UvRect& rect) {
  Bound3 bound, whole;
  for (int axis = 0; axis < 3; ++axis) {
    BezierNet net = patch[static_cast<size_t>(axis)];
    whole.lo[axis] = *std::min_element(net.begin(), net.end());
    whole.hi[axis] = *std::max_element(net.begin(), net.end());
    for (size_t k = 0; k < 4; ++k) restrictCurve(&net[4 * k], 1, rect.u0, rect.u1);
    for (size_t k = 0; k < 4; ++k) restrictCurve(&net[k], 4, rect.v0, rect.v1);
    const auto [lo, hi] = std::minmax_element(net.begin(), net.end());
    bound.lo[axis] = *lo;
    bound.hi[axis] = *hi;
  }
  return paddedForRounding(bound, whole);
}

}  // namespace tomales
