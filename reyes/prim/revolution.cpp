#include "reyes/prim/revolution.h"

#include "reyes/base/simd.h"
#include "reyes/prim/interpolation.h"
#include "reyes/prim/primvars.h"

namespace tomales {
namespace {

constexpr float kRound =
    12582912.0f;  // 1.5 * 2^23: adding and subtracting it rounds to an integer, in any vector width.

/// Rotates meridian vectors by the angles.
TOMALES_HOT void rotate(int n, const float* sine, const float* cosine, const float* x, const float* y, const float* z,
                        float scale, float* __restrict outX, float* __restrict outY, float* __restrict outZ) {
  for (int i = 0; i < n; ++i) {
    outX[i] = scale * (x[i] * cosine[i] - y[i] * sine[i]);
    outY[i] = scale * (x[i] * sine[i] + y[i] * cosine[i]);
    outZ[i] = scale * z[i];
  }
}

TOMALES_HOT void sweepDerivative(int n, float scale, const float* px, const float* py, float* __restrict dux,
                                 float* __restrict duy, float* __restrict duz) {
  for (int i = 0; i < n; ++i) {
    dux[i] = -scale * py[i];
    duy[i] = scale * px[i];
    duz[i] = 0;
  }
}

/// Extends a bound by the arc of a point that turns from `turn0` to `turn1`.
void extendByArc(Bound3& bound, const vec3& point, float turn0, float turn1) {
  const double radius = std::hypot(point.x, point.y), start = std::atan2(point.y, point.x) / (2 * M_PI);
  const double lo = start + std::min(turn0, turn1), hi = start + std::max(turn0, turn1);
  const auto extendAt = [&](double turn) {
    bound.extend(vec3(radius * std::cos(2 * M_PI * turn), radius * std::sin(2 * M_PI * turn), point.z));
  };
  extendAt(lo);
  extendAt(hi);
  for (double quarter = std::ceil(4 * lo); quarter <= 4 * hi; ++quarter) extendAt(quarter / 4);
}

}  // namespace

// Cephes' minimax polynomials on [-pi/4, pi/4] (S. Moshier, sinf/cosf) are used quadrant by quadrant.
TOMALES_HOT void sinCosTurns(float offset, float scale, int n, const float* t, float* sine, float* cosine) {
  for (int i = 0; i < n; ++i) {
    const float whole = scale * t[i];
    const float quarters = 4 * (offset + (whole - ((whole + kRound) - kRound)));
    const float nearest = (quarters + kRound) - kRound;
    const float x = (quarters - nearest) * (kPi / 2), x2 = x * x;
    const float s = x + x * x2 * (-1.6666654611e-1f + x2 * (8.3321608736e-3f + x2 * -1.9515295891e-4f));
    const float c =
        1 - 0.5f * x2 + x2 * x2 * (4.166664568298827e-2f + x2 * (-1.388731625493765e-3f + x2 * 2.443315711809948e-5f));
    const int quadrant = static_cast<int>(nearest) & 3;
    const float a = quadrant & 1 ? c : s, b = quadrant & 1 ? s : c;
    sine[i] = quadrant & 2 ? -a : a;
    cosine[i] = quadrant == 1 || quadrant == 2 ? -b : b;
  }
}

Revolution::Revolution(float thetaMax_degrees, const ParamList& params, Problems& problems)
    : Prim(takePrimvars(params, {}, problems)), sweep_turns_(std::clamp(thetaMax_degrees / 360.0f, -1.0f, 1.0f)) {
  requireFinite({thetaMax_degrees}, "the sweep angle");
  if (thetaMax_degrees == 0) throw PrimError("the sweep angle is 0, so the surface has no area");
  if (std::abs(sweep_turns_) == 1) close(kEdgeU0 | kEdgeU1);
}

Bound3 Revolution::bound(uint32_t, const UvRect& rect) const {
  Bound3 bound, whole;
  for (const vec3& point : meridianHull(0, 1)) extendByArc(whole, point, 0, 1);
  for (const vec3& point : meridianHull(rect.v0, rect.v1))
    extendByArc(bound, point, rect.u0 * sweep_turns_, rect.u1 * sweep_turns_);
  return paddedForRounding(bound, whole);
}

void Revolution::evaluate(uint32_t, int n, const float* u, const float* v, SurfacePoints s) const {
  const float radians = 2 * kPi * sweep_turns_;
  Meridian m;
  float sine[Meridian::kChunk], cosine[Meridian::kChunk];
  for (int i = 0; i < n; i += Meridian::kChunk) {
    const int count = std::min(Meridian::kChunk, n - i);
    meridian(count, v + i, m);
    sinCosTurns(0, sweep_turns_, count, u + i, sine, cosine);
    rotate(count, sine, cosine, m.x, m.y, m.z, 1, s.px + i, s.py + i, s.pz + i);
    rotate(count, sine, cosine, m.dx, m.dy, m.dz, 1, s.dvx + i, s.dvy + i, s.dvz + i);
    rotate(count, sine, cosine, m.nx, m.ny, m.nz, std::copysign(1.0f, radians), s.nx + i, s.ny + i, s.nz + i);
    sweepDerivative(count, radians, s.px + i, s.py + i, s.dux + i, s.duy + i, s.duz + i);
  }
}

void Revolution::interpolate(uint32_t, int index, int n, const float* u, const float* v, float* out, int stride) const {
  const Primvar& var = primvars_[static_cast<size_t>(index)];
  if (!repeatIfEven(var, 0, n, out, stride))
    interpolateBilinear(var.values.data(), var.width, {0, 1, 2, 3}, n, u, v, out, stride);
}

}  // namespace tomales
