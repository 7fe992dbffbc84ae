#include "reyes/prim/interpolation.h"

#include "reyes/base/simd.h"

namespace tomales {
namespace {

TOMALES_HOT void bilinear(const float* corner, int n, const float* u, const float* v, float* out) {
  const float a = corner[0], b = corner[1], c = corner[2], d = corner[3];
  for (int i = 0; i < n; ++i) {
    const float u1 = u[i], u0 = 1 - u1, v1 = v[i], v0 = 1 - v1;
    out[i] = (a * u0 + b * u1) * v0 + (c * u0 + d * u1) * v1;
  }
}

TOMALES_HOT void bilinearSurface(const float* corner, int n, const float* u, const float* v, float* p, float* du,
                                 float* dv) {
  const float a = corner[0], b = corner[1], c = corner[2], d = corner[3];
  const float ab = b - a, cd = d - c, ac = c - a, bd = d - b;
  for (int i = 0; i < n; ++i) {
    const float u1 = u[i], u0 = 1 - u1, v1 = v[i], v0 = 1 - v1;
    p[i] = (a * u0 + b * u1) * v0 + (c * u0 + d * u1) * v1;
    du[i] = ab * v0 + cd * v1;
    dv[i] = ac * u0 + bd * u1;
  }
}

TOMALES_HOT void crossProducts(int n, const float* ax, const float* ay, const float* az, const float* bx,
                               const float* by, const float* bz, float* __restrict x, float* __restrict y,
                               float* __restrict z) {
  for (int i = 0; i < n; ++i) {
    x[i] = ay[i] * bz[i] - az[i] * by[i];
    y[i] = az[i] * bx[i] - ax[i] * bz[i];
    z[i] = ax[i] * by[i] - ay[i] * bx[i];
  }
}

}  // namespace

void interpolateBilinear(const float* values, int width, const Corners& corners, int n, const float* u, const float* v,
                         float* out, int stride) {
  for (int c = 0; c < width; ++c) {
    float corner[4];
    for (size_t k = 0; k < 4; ++k) corner[k] = values[corners[k] * static_cast<size_t>(width) + static_cast<size_t>(c)];
    bilinear(corner, n, u, v, out + static_cast<ptrdiff_t>(c) * stride);
  }
}

void repeatElement(const float* element, int width, int n, float* out, int stride) {
  for (int c = 0; c < width; ++c) std::fill_n(out + static_cast<ptrdiff_t>(c) * stride, n, element[c]);
}

bool repeatIfEven(const Primvar& var, size_t uniform, int n, float* out, int stride) {
  if (var.storage != Storage::Constant && var.storage != Storage::Uniform) return false;
  const size_t element = var.storage == Storage::Uniform ? uniform : 0;
  repeatElement(&var.values[element * static_cast<size_t>(var.width)], var.width, n, out, stride);
  return true;
}

void evaluateBilinear(const std::array<vec3, 4>& corners, int n, const float* u, const float* v, SurfacePoints out) {
  float* const p[3] = {out.px, out.py, out.pz};
  float* const du[3] = {out.dux, out.duy, out.duz};
  float* const dv[3] = {out.dvx, out.dvy, out.dvz};
  for (int axis = 0; axis < 3; ++axis) {
    const float corner[4] = {corners[0][axis], corners[1][axis], corners[2][axis], corners[3][axis]};
    bilinearSurface(corner, n, u, v, p[axis], du[axis], dv[axis]);
  }
  crossDerivatives(n, out);
}

Bound3 boundBilinear(const std::array<vec3, 4>& corners, const UvRect& rect) {
  if (rect.u0 == 0 && rect.u1 == 1 && rect.v0 == 0 && rect.v1 == 1) {
    Bound3 whole;
    for (const vec3& corner : corners) whole.extend(corner);
    return paddedForRounding(whole, whole);
  }
  const float u[4] = {rect.u0, rect.u1, rect.u0, rect.u1}, v[4] = {rect.v0, rect.v0, rect.v1, rect.v1};
  Bound3 bound, whole;
  for (size_t k = 0; k < 4; ++k) {
    whole.extend(corners[k]);
    const vec3 low = corners[0] * (1 - u[k]) + corners[1] * u[k], high = corners[2] * (1 - u[k]) + corners[3] * u[k];
    bound.extend(low * (1 - v[k]) + high * v[k]);
  }
  return paddedForRounding(bound, whole);
}

void crossDerivatives(int n, SurfacePoints s) {
  crossProducts(n, s.dux, s.duy, s.duz, s.dvx, s.dvy, s.dvz, s.nx, s.ny, s.nz);
}

Bound3 paddedForRounding(const Bound3& bound, const Bound3& whole) {
  const vec3 farthest = glm::max(glm::abs(whole.lo), glm::abs(whole.hi));
  return bound.grown(1e-6f * maxComponent(farthest));
}

}  // namespace tomales
