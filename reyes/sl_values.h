// Values of a whole batch with masks, and RSL's operators and shadeops on them. Include reyes/sl.h.
#pragma once
#include <functional>
#include <utility>

#include "reyes/shadeops.h"

namespace sl {

/// One run of a shader: its batch, with the mask of the conditionals that are open. A thread has a stack: shaders that trace run others.
class Run {
 public:
  explicit Run(const TmGrid* g) : grid(*g), outer_(std::exchange(current(), this)) {}
  ~Run() { current() = outer_; }
  Run(const Run&) = delete;
  static Run& now() { return *current(); }

  TmGrid grid;

 private:
  static Run*& current() {
    thread_local Run* run = nullptr;
    return run;
  }
  Run* const outer_;
};
inline const TmGrid* grid() { return &Run::now().grid; }

/// Memory of values, kept by the thread from one to the next.
class Lanes {
 public:
  Lanes() : size_(grid()->padded) {
    auto& list = spare();
    if (!list.empty() && list.back().first >= size_) {
      data_ = list.back().second, capacity_ = list.back().first;
      list.pop_back();
    } else {
      capacity_ = std::max(size_, 512);
      data_ = static_cast<float*>(::operator new(static_cast<size_t>(capacity_) * sizeof(float), std::align_val_t{64}));
    }
  }
  ~Lanes() {
    if (data_) spare().emplace_back(capacity_, data_);
  }
  Lanes(Lanes&& o) noexcept : data_(std::exchange(o.data_, nullptr)), size_(o.size_), capacity_(o.capacity_) {}
  Lanes(const Lanes& o) : Lanes() { std::copy_n(o.data_, size_, data_); }
  float* data() const { return data_; }
  int size() const { return size_; }

 private:
  struct Spare : std::vector<std::pair<int, float*>> {
    ~Spare() {
      for (auto& block : *this) ::operator delete(block.second, std::align_val_t{64});
    }
  };
  static Spare& spare() {
    thread_local Spare list;
    return list;
  }
  float* data_ = nullptr;
  int size_, capacity_ = 0;
};

/// Applies an operation to all points, those without a mask too: nothing depends on what they hold.
template <class Op>
void fill(float* out, const Op& op) {
  for (int i = 0, n = grid()->padded; i < n; ++i) out[i] = op(i);
}
template <class Op>
void forActive(const Op& op) {
  const TmGrid* g = grid();
  for (int i = 0; i < g->count; ++i)
    if (g->active[i]) op(i);
}

/// A condition at every point.
struct Mask {
  std::vector<uint8_t> on;
  template <class Op>
  static Mask of(const Op& op) {
    Mask m{std::vector<uint8_t>(static_cast<size_t>(grid()->padded))};
    for (int i = 0; i < grid()->count; ++i) m.on[static_cast<size_t>(i)] = op(i);
    return m;
  }
  friend Mask operator&&(const Mask& a, const Mask& b) { return of([&](int i) { return a.on[size_t(i)] && b.on[size_t(i)]; }); }
  friend Mask operator||(const Mask& a, const Mask& b) { return of([&](int i) { return a.on[size_t(i)] || b.on[size_t(i)]; }); }
  friend Mask operator!(const Mask& a) { return of([&](int i) { return !a.on[size_t(i)]; }); }
};

/// Runs `body` for the points that are active and in the mask; not at all where there are none.
template <class Body>
void where(const uint8_t* mask, bool wanted, const Body& body) {
  TmGrid& g = Run::now().grid;
  std::vector<uint8_t> inner(static_cast<size_t>(g.padded));
  bool any = false;
  for (int i = 0; i < g.count; ++i) any |= inner[size_t(i)] = g.active[i] && (mask[i] != 0) == wanted;
  if (!any) return;
  const uint8_t* outer = std::exchange(g.active, inner.data());
  body();
  g.active = outer;
}
template <class Then>
void If(const Mask& condition, const Then& then) { where(condition.on.data(), true, then); }
template <class Then, class Else>
void If(const Mask& condition, const Then& then, const Else& otherwise) {
  where(condition.on.data(), true, then);
  where(condition.on.data(), false, otherwise);
}

class Float {
 public:
  Float(double v = 0) { std::fill_n(x_.data(), x_.size(), static_cast<float>(v)); }
  explicit Float(const float* from) { std::copy_n(from, x_.size(), x_.data()); }
  Float(const rsl::FloatParam& p) {
    fill([&](int i) { return p(grid(), std::min(i, grid()->count - 1)); });
  }
  Float(const Float&) = default;
  Float(Float&&) = default;
  Float& operator=(const Float& v) { return assign([&](int i) { return v[i]; }); }
  Float& operator+=(const Float& v) { return assign([&](int i) { return (*this)[i] + v[i]; }); }
  Float& operator-=(const Float& v) { return assign([&](int i) { return (*this)[i] - v[i]; }); }
  Float& operator*=(const Float& v) { return assign([&](int i) { return (*this)[i] * v[i]; }); }
  Float& operator/=(const Float& v) { return assign([&](int i) { return (*this)[i] / v[i]; }); }

  float operator[](int i) const { return x_.data()[i]; }
  float* data() const { return x_.data(); }
  template <class Op>
  static Float of(const Op& op) {
    Float out{Lanes()};
    out.fill(op);
    return out;
  }

 private:
  explicit Float(Lanes&& lanes) : x_(std::move(lanes)) {}
  template <class Op>
  void fill(const Op& op) { sl::fill(x_.data(), op); }
  template <class Op>
  Float& assign(const Op& op) {
    forActive([&](int i) { x_.data()[i] = op(i); });
    return *this;
  }
  Lanes x_;
};

/// A colour, point, vector or normal.
class Triple {
 public:
  Triple() : Triple(rsl::Vec3{}) {}
  Triple(rsl::Vec3 v) { sl::fill(x_.data(), [&](int) { return v.x; }), sl::fill(y_.data(), [&](int) { return v.y; }), sl::fill(z_.data(), [&](int) { return v.z; }); }
  explicit Triple(double v) : Triple(rsl::Vec3{float(v), float(v), float(v)}) {}
  explicit Triple(const Float& v) : Triple(v, v, v) {}
  Triple(const Float& x, const Float& y, const Float& z) {
    std::copy_n(x.data(), x_.size(), x_.data()), std::copy_n(y.data(), x_.size(), y_.data()), std::copy_n(z.data(), x_.size(), z_.data());
  }
  explicit Triple(TmConstVec3 v) { std::copy_n(v.x, x_.size(), x_.data()), std::copy_n(v.y, x_.size(), y_.data()), std::copy_n(v.z, x_.size(), z_.data()); }
  template <TmType type>
  Triple(const rsl::TripleParam<type>& p) { setAll([&](int i) { return p(grid(), std::min(i, grid()->count - 1)); }); }
  Triple(const Triple&) = default;
  Triple(Triple&&) = default;
  Triple& operator=(const Triple& v) { return assign([&](int i) { return v[i]; }); }
  Triple& operator+=(const Triple& v) { return assign([&](int i) { return (*this)[i] + v[i]; }); }
  Triple& operator*=(const Triple& v) { return assign([&](int i) { return (*this)[i] * v[i]; }); }
  Triple& operator*=(const Float& v) { return assign([&](int i) { return (*this)[i] * v[i]; }); }

  rsl::Vec3 operator[](int i) const { return {x_.data()[i], y_.data()[i], z_.data()[i]}; }
  TmVec3 out() const { return {x_.data(), y_.data(), z_.data()}; }
  operator TmConstVec3() const { return {x_.data(), y_.data(), z_.data()}; }
  template <class Op>
  static Triple of(const Op& op) {
    Triple out{Lanes(), Lanes(), Lanes()};
    out.setAll(op);
    return out;
  }

 private:
  Triple(Lanes&& x, Lanes&& y, Lanes&& z) : x_(std::move(x)), y_(std::move(y)), z_(std::move(z)) {}
  void set(int i, rsl::Vec3 v) { x_.data()[i] = v.x, y_.data()[i] = v.y, z_.data()[i] = v.z; }
  template <class Op>
  void setAll(const Op& op) {
    for (int i = 0, n = grid()->padded; i < n; ++i) set(i, op(i));
  }
  template <class Op>
  Triple& assign(const Op& op) {
    forActive([&](int i) { set(i, op(i)); });
    return *this;
  }
  Lanes x_, y_, z_;
};
using Color = Triple;
using Point = Triple;
using Vector = Triple;
using Normal = Triple;

// --- Operators and shadeops, point by point

inline Float operator-(const Float& a) { return Float::of([&](int i) { return -a[i]; }); }
inline Triple operator-(const Triple& a) { return Triple::of([&](int i) { return -a[i]; }); }
inline Triple operator/(const Triple& a, const Float& b) { return Triple::of([&](int i) { return a[i] / b[i]; }); }
inline Float operator/(const Float& a, const Float& b) { return Float::of([&](int i) { return a[i] / b[i]; }); }
#define SL_OPERATOR(op)                                                                                              \
  inline Float operator op(const Float& a, const Float& b) { return Float::of([&](int i) { return a[i] op b[i]; }); } \
  inline Triple operator op(const Triple& a, const Triple& b) { return Triple::of([&](int i) { return a[i] op b[i]; }); }
SL_OPERATOR(+)
SL_OPERATOR(-)
SL_OPERATOR(*)
inline Triple operator*(const Float& a, const Triple& b) { return Triple::of([&](int i) { return a[i] * b[i]; }); }
inline Triple operator*(const Triple& a, const Float& b) { return b * a; }
#define SL_COMPARISON(op) \
  inline Mask operator op(const Float& a, const Float& b) { return Mask::of([&](int i) { return a[i] op b[i]; }); }
SL_COMPARISON(<)
SL_COMPARISON(>)
SL_COMPARISON(<=)
SL_COMPARISON(>=)
SL_COMPARISON(==)
SL_COMPARISON(!=)
#undef SL_OPERATOR
#undef SL_COMPARISON

#define SL_1(name, expression) \
  inline Float name(const Float& a) { return Float::of([&](int i) { const float x = a[i]; return expression; }); }
SL_1(abs, std::abs(x))
SL_1(floor, std::floor(x))
SL_1(ceil, std::ceil(x))
SL_1(round, std::round(x))
SL_1(sqrt, std::sqrt(x))
SL_1(exp, std::exp(x))
SL_1(log, std::log(x))
SL_1(sin, std::sin(x))
SL_1(cos, std::cos(x))
SL_1(tan, std::tan(x))
SL_1(asin, std::asin(x))
SL_1(acos, std::acos(x))
SL_1(atan, std::atan(x))
SL_1(sign, rsl::sign(x))
SL_1(radians, rsl::radians(x))
SL_1(degrees, rsl::degrees(x))
SL_1(noise, rsl::noise(x))
#undef SL_1
#define SL_2(name, expression) \
  inline Float name(const Float& a, const Float& b) { return Float::of([&](int i) { const float x = a[i], y = b[i]; return expression; }); }
SL_2(pow, std::pow(x, y))
SL_2(mod, rsl::mod(x, y))
SL_2(min, std::min(x, y))
SL_2(max, std::max(x, y))
SL_2(atan, std::atan2(x, y))
SL_2(step, rsl::step(x, y))
SL_2(noise, rsl::noise(x, y))
#undef SL_2
inline Float clamp(const Float& x, const Float& lo, const Float& hi) { return Float::of([&](int i) { return rsl::clamp(x[i], lo[i], hi[i]); }); }
inline Float mix(const Float& a, const Float& b, const Float& t) { return Float::of([&](int i) { return rsl::mix(a[i], b[i], t[i]); }); }
inline Triple mix(const Triple& a, const Triple& b, const Float& t) { return Triple::of([&](int i) { return rsl::mix(a[i], b[i], t[i]); }); }
inline Float smoothstep(const Float& lo, const Float& hi, const Float& x) { return Float::of([&](int i) { return rsl::smoothstep(lo[i], hi[i], x[i]); }); }
inline Float filterstep(const Float& edge, const Float& x, const Float& width) { return Float::of([&](int i) { return rsl::filterstep(edge[i], x[i], width[i]); }); }
inline Float spline(const Float& x, std::initializer_list<float> knots) {
  return Float::of([&](int i) { return rsl::spline(rsl::Basis::CatmullRom, x[i], knots.begin(), int(knots.size())); });
}
inline Triple spline(const Float& x, std::initializer_list<rsl::Color> knots) {
  return Triple::of([&](int i) { return rsl::spline(rsl::Basis::CatmullRom, x[i], knots.begin(), int(knots.size())); });
}
/// Over all points at once, so that the compiler vectorises it; `p` and `out` do not overlap.
RSL_HOT inline void noiseOver(int n, TmConstVec3 p, float* __restrict out) {
  for (int i = 0; i < n; ++i) out[i] = 0.5f + 0.5f * rsl::signedNoise(rsl::Vec3{p.x[i], p.y[i], p.z[i]});
}
inline Float noise(const Triple& p) {
  Float out;
  noiseOver(grid()->padded, p, out.data());
  return out;
}
inline Triple noise3(const Triple& p) { return Triple::of([&](int i) { return rsl::noise3(p[i]); }); }
inline Float cellnoise(const Triple& p) { return Float::of([&](int i) { return rsl::cellnoise(p[i]); }); }
inline Float pnoise(const Triple& p, const Triple& period) { return Float::of([&](int i) { return rsl::pnoise(p[i], period[i]); }); }
inline Float xcomp(const Triple& p) { return Float(TmConstVec3(p).x); }
inline Float ycomp(const Triple& p) { return Float(TmConstVec3(p).y); }
inline Float zcomp(const Triple& p) { return Float(TmConstVec3(p).z); }
inline Float dot(const Triple& a, const Triple& b) { return Float::of([&](int i) { return rsl::dot(a[i], b[i]); }); }
inline Triple cross(const Triple& a, const Triple& b) { return Triple::of([&](int i) { return rsl::cross(a[i], b[i]); }); }
inline Float length(const Triple& a) { return Float::of([&](int i) { return rsl::length(a[i]); }); }
inline Float distance(const Triple& a, const Triple& b) { return length(a - b); }
inline Triple normalize(const Triple& a) { return Triple::of([&](int i) { return rsl::normalize(a[i]); }); }
inline Triple reflect(const Triple& I, const Triple& N) { return Triple::of([&](int i) { return rsl::reflect(I[i], N[i]); }); }
inline Triple refract(const Triple& I, const Triple& N, const Float& eta) { return Triple::of([&](int i) { return rsl::refract(I[i], N[i], eta[i]); }); }
inline Triple faceforward(const Triple& N, const Triple& I, const Triple& Nref) { return Triple::of([&](int i) { return rsl::faceforward(N[i], I[i], Nref[i]); }); }
inline Triple faceforward(const Triple& N, const Triple& I) { return faceforward(N, I, Triple(grid()->Ng)); }
inline void fresnel(const Triple& I, const Triple& N, const Float& eta, Float& Kr, Float& Kt) {
  Kr = Float::of([&](int i) { return rsl::fresnel(I[i], N[i], eta[i]); });
  Kt = 1 - Kr;
}
inline Triple ctransform(const char* from, const char* to, const Triple& c) { return Triple::of([&](int i) { return rsl::ctransform(from, to, c[i]); }); }

}  // namespace sl
