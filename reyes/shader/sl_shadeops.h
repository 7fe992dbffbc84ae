// RSL's shadeops on values of a batch that ask nothing of the renderer: those of reyes/shader/shadeops.h and
// reyes/shader/noise.h point by point (RISpec 15.1 to 15.5). Part of reyes/sl.h.
#pragma once
#include <array>

#include "reyes/shader/sl_operators.h"
#include "reyes/shader/text.h"
#include "reyes/shader/wavelet.h"

namespace sl {

// --- Mathematics

#define SL_1(name, expression)        \
  inline Float name(const Float& a) { \
    return Float::of([&](int i) {     \
      const float x = a[i];           \
      return expression;              \
    });                               \
  }
SL_1(abs, std::abs(x))
SL_1(floor, std::floor(x))
SL_1(ceil, std::ceil(x))
SL_1(round, std::round(x))
SL_1(sqrt, rsl::sqrt(x))
SL_1(inversesqrt, rsl::inversesqrt(x))
SL_1(exp, std::exp(x))
SL_1(log, rsl::log(x))
SL_1(sin, std::sin(x))
SL_1(cos, std::cos(x))
SL_1(tan, std::tan(x))
SL_1(asin, rsl::asin(x))
SL_1(acos, rsl::acos(x))
SL_1(atan, std::atan(x))
SL_1(erf, std::erf(x))
SL_1(erfc, std::erfc(x))
SL_1(sign, rsl::sign(x))
SL_1(radians, rsl::radians(x))
SL_1(degrees, rsl::degrees(x))
SL_1(noise, rsl::noise(x))
SL_1(cellnoise, rsl::cellnoise(x))
#undef SL_1
#define SL_2(name, expression)                        \
  inline Float name(const Float& a, const Float& b) { \
    return Float::of([&](int i) {                     \
      const float x = a[i], y = b[i];                 \
      return expression;                              \
    });                                               \
  }
SL_2(pow, rsl::pow(x, y))
SL_2(log, rsl::log(x, y))
SL_2(mod, rsl::mod(x, y))
SL_2(min, std::min(x, y))
SL_2(max, std::max(x, y))
SL_2(atan, std::atan2(x, y))
SL_2(step, rsl::step(x, y))
SL_2(noise, rsl::noise(x, y))
SL_2(cellnoise, rsl::cellnoise(x, y))
SL_2(pnoise, rsl::pnoise(x, y))
#undef SL_2
#define SL_T2(name)                                                  \
  inline Triple name(const Triple& a, const Triple& b) {             \
    return Triple::of([&](int i) { return rsl::name(a[i], b[i]); }); \
  }
SL_T2(min)
SL_T2(max)
SL_T2(cross)
SL_T2(reflect)
SL_T2(pnoise3)
#undef SL_T2
template <class T, class... More>
T min(const T& a, const T& b, const T& c, const More&... more) {
  return min(min(a, b), c, more...);
}
template <class T, class... More>
T max(const T& a, const T& b, const T& c, const More&... more) {
  return max(max(a, b), c, more...);
}

inline Float clamp(const Float& x, const Float& lo, const Float& hi) {
  return Float::of([&](int i) { return rsl::clamp(x[i], lo[i], hi[i]); });
}
inline Triple clamp(const Triple& x, const Triple& lo, const Triple& hi) {
  return Triple::of([&](int i) { return rsl::clamp(x[i], lo[i], hi[i]); });
}
inline Float mix(const Float& a, const Float& b, const Float& t) {
  return Float::of([&](int i) { return rsl::mix(a[i], b[i], t[i]); });
}
inline Triple mix(const Triple& a, const Triple& b, const Float& t) {
  return Triple::of([&](int i) { return rsl::mix(a[i], b[i], t[i]); });
}
inline Triple mix(const Triple& a, const Triple& b, const Triple& t) {
  return Triple::of([&](int i) { return rsl::mix(a[i], b[i], t[i]); });
}
inline Float smoothstep(const Float& lo, const Float& hi, const Float& x) {
  return Float::of([&](int i) { return rsl::smoothstep(lo[i], hi[i], x[i]); });
}
/// Returns step() averaged over `width` around x.
inline Float filterstep(const Float& edge, const Float& x, const Float& width) {
  return Float::of([&](int i) { return rsl::filterstep(edge[i], x[i], width[i]); });
}
/// Implements RSL's filterstep(edge, s1, s2): step() averaged from s1 to s2.
inline Float filterstepBetween(const Float& edge, const Float& a, const Float& b) {
  return filterstep(edge, 0.5 * (a + b), abs(b - a));
}

// --- Splines. Knots are uniform, varying, or an array of parameters.

inline Float spline(rsl::Basis basis, const Float& x, std::initializer_list<float> knots) {
  return Float::of([&](int i) { return rsl::spline(basis, x[i], knots.begin(), int(knots.size())); });
}
inline Triple spline(rsl::Basis basis, const Float& x, std::initializer_list<rsl::Color> knots) {
  return Triple::of([&](int i) { return rsl::spline(basis, x[i], knots.begin(), int(knots.size())); });
}
/// Takes knots that are values of a batch.
template <class Knot>
Knot spline(rsl::Basis basis, const Float& x, const std::vector<Knot>& knots) {
  std::vector<decltype(knots[0][0])> own(knots.size());
  return Knot::of([&](int i) {
    for (size_t k = 0; k < knots.size(); ++k) own[k] = knots[k][i];
    return rsl::spline(basis, x[i], own.data(), int(own.size()));
  });
}
inline Float spline(rsl::Basis basis, const Float& x, const rsl::FloatArrayParam& knots) {
  std::vector<float> own;
  for (int k = 0; k < knots.length(grid()); ++k) own.push_back(knots(grid(), k));
  return Float::of([&](int i) { return rsl::spline(basis, x[i], own.data(), int(own.size())); });
}
inline Float solveSpline(rsl::Basis basis, const Float& value, const std::vector<float>& knots) {
  return Float::of([&](int i) { return rsl::solveSpline(basis, value[i], knots.data(), int(knots.size())); });
}
inline Float spline(const Float& x, std::initializer_list<float> knots) {
  return spline(rsl::Basis::CatmullRom, x, knots);
}
inline Triple spline(const Float& x, std::initializer_list<rsl::Color> knots) {
  return spline(rsl::Basis::CatmullRom, x, knots);
}

// --- Noise

/// Loops over all points in one function, so that the compiler vectorises it. `p` and `out` must not overlap.
RSL_HOT inline void noiseOver(int n, TmConstVec3 p, float* __restrict out) {
  for (int i = 0; i < n; ++i) out[i] = 0.5f + 0.5f * rsl::signedNoise(rsl::Vec3{p.x[i], p.y[i], p.z[i]});
}
inline Float noise(const Triple& p) {
  Float out;
  noiseOver(grid()->padded, p, out.data());
  return out;
}
inline Float noise(const Triple& p, const Float& t) {
  return Float::of([&](int i) { return rsl::noise(p[i], t[i]); });
}
inline Triple noise3(const Triple& p) {
  return Triple::of([&](int i) { return rsl::noise3(p[i]); });
}
inline Triple noise3(const Triple& p, const Float& t) {
  return Triple::of([&](int i) { return rsl::noise3(p[i], t[i]); });
}
inline Triple noise3(const Float& x) {
  return Triple::of([&](int i) { return rsl::noise3(x[i]); });
}
inline Triple noise3(const Float& x, const Float& y) {
  return Triple::of([&](int i) { return rsl::noise3(x[i], y[i]); });
}
inline Float pnoise(const Triple& p, const Triple& period) {
  return Float::of([&](int i) { return rsl::pnoise(p[i], period[i]); });
}
inline Float pnoise(const Float& x, const Float& y, const Float& xPeriod, const Float& yPeriod) {
  return Float::of([&](int i) { return rsl::pnoise(x[i], y[i], xPeriod[i], yPeriod[i]); });
}
inline Float pnoise(const Triple& p, const Float& t, const Triple& period, const Float& tPeriod) {
  return Float::of([&](int i) { return rsl::pnoise(p[i], t[i], period[i], tPeriod[i]); });
}
inline Float cellnoise(const Triple& p) {
  return Float::of([&](int i) { return rsl::cellnoise(p[i]); });
}
inline Float cellnoise(const Triple& p, const Float& t) {
  return Float::of([&](int i) { return rsl::cellnoise(p[i], t[i]); });
}
inline Triple cellnoise3(const Triple& p) {
  return Triple::of([&](int i) { return rsl::cellnoise3(p[i]); });
}
inline Triple cellnoise3(const Triple& p, const Float& t) {
  return Triple::of([&](int i) { return rsl::cellnoise3(p[i], t[i]); });
}

inline Float wnoise(const Triple& p, const Float& width = 0) {
  return Float::of([&](int i) { return rsl::wnoise(p[i], width[i]); });
}

// --- Geometry

inline Float xcomp(const Triple& p) { return Float(TmConstVec3(p).x); }
inline Float ycomp(const Triple& p) { return Float(TmConstVec3(p).y); }
inline Float zcomp(const Triple& p) { return Float(TmConstVec3(p).z); }
inline Float comp(const Triple& p, int k) { return k == 0 ? xcomp(p) : k == 1 ? ycomp(p) : zcomp(p); }
inline void setcomp(Triple& p, int k, const Float& v) {
  p = Triple(k == 0 ? v : xcomp(p), k == 1 ? v : ycomp(p), k == 2 ? v : zcomp(p));
}
inline void setxcomp(Triple& p, const Float& v) { setcomp(p, 0, v); }
inline void setycomp(Triple& p, const Float& v) { setcomp(p, 1, v); }
inline void setzcomp(Triple& p, const Float& v) { setcomp(p, 2, v); }
inline Float dot(const Triple& a, const Triple& b) {
  return Float::of([&](int i) { return rsl::dot(a[i], b[i]); });
}
inline Float length(const Triple& a) {
  return Float::of([&](int i) { return rsl::length(a[i]); });
}
inline Float distance(const Triple& a, const Triple& b) { return length(a - b); }
inline Float ptlined(const Triple& P0, const Triple& P1, const Triple& Q) {
  return Float::of([&](int i) { return rsl::ptlined(P0[i], P1[i], Q[i]); });
}
inline Triple rotate(const Triple& Q, const Float& angle, const Triple& P0, const Triple& P1) {
  return Triple::of([&](int i) { return rsl::rotate(Q[i], angle[i], P0[i], P1[i]); });
}
inline Triple normalize(const Triple& a) {
  return Triple::of([&](int i) { return rsl::normalize(a[i]); });
}
inline Triple refract(const Triple& I, const Triple& N, const Float& eta) {
  return Triple::of([&](int i) { return rsl::refract(I[i], N[i], eta[i]); });
}
inline Triple faceforward(const Triple& N, const Triple& I, const Triple& Nref) {
  return Triple::of([&](int i) { return rsl::faceforward(N[i], I[i], Nref[i]); });
}
inline Triple faceforward(const Triple& N, const Triple& I) { return faceforward(N, I, Triple(grid()->Ng)); }
inline void fresnel(const Triple& I, const Triple& N, const Float& eta, Float& Kr, Float& Kt) {
  Kr = Float::of([&](int i) { return rsl::fresnel(I[i], N[i], eta[i]); });
  Kt = 1 - Kr;
}
inline void fresnel(const Triple& I, const Triple& N, const Float& eta, Float& Kr, Float& Kt, Triple& R, Triple& T) {
  fresnel(I, N, eta, Kr, Kt);
  R = reflect(I, N);
  T = refract(I, N, eta);
}

// --- Colour

inline Triple ctransform(const char* from, const char* to, const Triple& c) {
  return Triple::of([&](int i) { return rsl::ctransform(from, to, c[i]); });
}
inline Triple ctransform(const char* to, const Triple& c) { return ctransform("rgb", to, c); }

// --- Matrices, one for each point. A uniform matrix is rsl::Matrix.

class Matrix {
 public:
  Matrix(const rsl::Matrix& m = {}) {
    setAll([&](int) { return m; });
  }
  Matrix(const rsl::MatrixParam& p) : Matrix(rsl::Matrix::of(p(grid()))) {}
  template <class Op>
  static Matrix of(const Op& op) {
    Matrix out;
    out.setAll(op);
    return out;
  }
  Matrix(const Matrix&) = default;
  Matrix& operator=(const Matrix& v) {
    for (size_t k = 0; k < m_.size(); ++k) m_[k] = v.m_[k];
    return *this;
  }
  rsl::Matrix operator[](int i) const {
    rsl::Matrix out;
    for (size_t k = 0; k < m_.size(); ++k) out.m[k / 4][k % 4] = m_[k][i];
    return out;
  }

 private:
  template <class Op>
  void setAll(const Op& op) {
    for (int i = 0, n = grid()->padded; i < n; ++i) {
      const rsl::Matrix m = op(i);
      for (size_t k = 0; k < m_.size(); ++k) m_[k].data()[i] = m.m[k / 4][k % 4];
    }
  }
  std::array<Float, 16> m_;
};
inline Matrix operator*(const Matrix& a, const Matrix& b) {
  return Matrix::of([&](int i) { return a[i] * b[i]; });
}
inline Float determinant(const Matrix& a) {
  return Float::of([&](int i) { return rsl::determinant(a[i]); });
}
/// Returns the identity where there is no inverse.
inline Matrix inverse(const Matrix& a) {
  return Matrix::of([&](int i) {
    rsl::Matrix out;
    rsl::invert(a[i], &out);
    return out;
  });
}
inline Matrix translate(const Matrix& a, const Triple& t) {
  return Matrix::of([&](int i) { return rsl::translate(a[i], t[i]); });
}
inline Matrix rotate(const Matrix& a, const Float& angle, const Triple& axis) {
  return Matrix::of([&](int i) { return rsl::rotate(a[i], angle[i], axis[i]); });
}
inline Matrix scale(const Matrix& a, const Triple& s) {
  return Matrix::of([&](int i) { return rsl::scale(a[i], s[i]); });
}
inline Triple transform(const Matrix& m, const Triple& p) {
  return Triple::of([&](int i) { return rsl::transform(m[i], p[i]); });
}
inline Triple vtransform(const Matrix& m, const Triple& v) {
  return Triple::of([&](int i) { return rsl::vtransform(m[i], v[i]); });
}
inline Triple ntransform(const Matrix& m, const Triple& n) {
  return Triple::of([&](int i) { return rsl::ntransform(m[i], n[i]); });
}

}  // namespace sl
