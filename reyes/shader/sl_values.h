// Values of a whole batch with masks. Part of reyes/sl.h.
#pragma once
#include <string_view>
#include <utility>

#include "reyes/shader/shadeops.h"

namespace sl {

/// One run of a shader: its batch, whose `active` is the mask of the enclosing conditionals. A thread keeps a stack of
/// runs, because shaders that trace rays run others.
class Run {
 public:
  explicit Run(const TmGrid* g) : grid(*g), outer_(std::exchange(current(), this)) {}
  ~Run() { current() = outer_; }
  Run(const Run&) = delete;
  static Run& now() { return *current(); }

  TmGrid grid;
  int randoms = 0;          ///< The number of calls of random() so far.
  float specularScale = 0;  ///< Value that sl::specularScale() returns; 0 until it has been called.

 private:
  TM_OF_THIS_PLUGIN static Run*& current() {
    thread_local Run* run = nullptr;
    return run;
  }
  Run* const outer_;
};
inline const TmGrid* grid() { return &Run::now().grid; }

/// Memory of values. The thread keeps freed memory for later values.
class Lanes {
 public:
  Lanes() : size_(grid()->padded) {
    auto& list = spare();
    if (!list.empty() && list.back().first >= size_) {
      data_ = list.back().second;
      capacity_ = list.back().first;
      list.pop_back();
    } else {
      capacity_ = std::max(size_, 512);
      data_ =
          static_cast<float*>(::operator new (static_cast<size_t>(capacity_) * sizeof(float), std::align_val_t{64}));
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
      for (auto& block : *this) ::operator delete (block.second, std::align_val_t{64});
    }
  };
  TM_OF_THIS_PLUGIN static Spare& spare() {
    thread_local Spare list;
    return list;
  }
  float* data_ = nullptr;
  int size_, capacity_ = 0;
};

/// Applies an operation to all points, inactive ones too, since nothing depends on their values.
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
  friend Mask operator&&(const Mask& a, const Mask& b) {
    return of([&](int i) { return a.on[size_t(i)] && b.on[size_t(i)]; });
  }
  friend Mask operator||(const Mask& a, const Mask& b) {
    return of([&](int i) { return a.on[size_t(i)] || b.on[size_t(i)]; });
  }
  friend Mask operator!(const Mask& a) {
    return of([&](int i) { return !a.on[size_t(i)]; });
  }
};

/// Runs `body` for active points whose mask equals `wanted`, or not at all if there are none.
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
void If(const Mask& condition, const Then& then) {
  where(condition.on.data(), true, then);
}
template <class Then, class Else>
void If(const Mask& condition, const Then& then, const Else& otherwise) {
  where(condition.on.data(), true, then);
  where(condition.on.data(), false, otherwise);
}

/// RSL's while: runs `body` repeatedly, each time for the points at which `condition`, a function that returns a Mask,
/// still holds.
template <class Condition, class Body>
void While(const Condition& condition, const Body& body) {
  TmGrid& g = Run::now().grid;
  const uint8_t* outer = g.active;
  std::vector<uint8_t> left(outer, outer + g.padded);
  g.active = left.data();
  for (;;) {
    const Mask goesOn = condition();
    bool any = false;
    for (int i = 0; i < g.count; ++i) any |= left[size_t(i)] = left[size_t(i)] && goesOn.on[size_t(i)];
    if (!any) break;
    body();
  }
  g.active = outer;
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
  Float& operator=(const Float& v) {
    return assign([&](int i) { return v[i]; });
  }
  Float& operator+=(const Float& v) {
    return assign([&](int i) { return (*this)[i] + v[i]; });
  }
  Float& operator-=(const Float& v) {
    return assign([&](int i) { return (*this)[i] - v[i]; });
  }
  Float& operator*=(const Float& v) {
    return assign([&](int i) { return (*this)[i] * v[i]; });
  }
  Float& operator/=(const Float& v) {
    return assign([&](int i) { return (*this)[i] / v[i]; });
  }

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
  void fill(const Op& op) {
    sl::fill(x_.data(), op);
  }
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
  Triple(rsl::Vec3 v) {
    sl::fill(x_.data(), [&](int) { return v.x; });
    sl::fill(y_.data(), [&](int) { return v.y; });
    sl::fill(z_.data(), [&](int) { return v.z; });
  }
  explicit Triple(double v) : Triple(rsl::Vec3{float(v), float(v), float(v)}) {}
  explicit Triple(const Float& v) : Triple(v, v, v) {}
  Triple(const Float& x, const Float& y, const Float& z) {
    std::copy_n(x.data(), x_.size(), x_.data());
    std::copy_n(y.data(), x_.size(), y_.data());
    std::copy_n(z.data(), x_.size(), z_.data());
  }
  explicit Triple(TmConstVec3 v) {
    std::copy_n(v.x, x_.size(), x_.data());
    std::copy_n(v.y, x_.size(), y_.data());
    std::copy_n(v.z, x_.size(), z_.data());
  }
  template <TmType type>
  Triple(const rsl::TripleParam<type>& p) {
    setAll([&](int i) { return p(grid(), std::min(i, grid()->count - 1)); });
  }
  Triple(const Triple&) = default;
  Triple(Triple&&) = default;
  Triple& operator=(const Triple& v) {
    return assign([&](int i) { return v[i]; });
  }
  Triple& operator+=(const Triple& v) {
    return assign([&](int i) { return (*this)[i] + v[i]; });
  }
  Triple& operator-=(const Triple& v) {
    return assign([&](int i) { return (*this)[i] - v[i]; });
  }
  Triple& operator*=(const Triple& v) {
    return assign([&](int i) { return (*this)[i] * v[i]; });
  }
  Triple& operator*=(const Float& v) {
    return assign([&](int i) { return (*this)[i] * v[i]; });
  }
  Triple& operator/=(const Float& v) {
    return assign([&](int i) { return (*this)[i] / v[i]; });
  }
  Triple& operator/=(const Triple& v) {
    return assign([&](int i) {
      return rsl::Vec3{(*this)[i].x / v[i].x, (*this)[i].y / v[i].y, (*this)[i].z / v[i].z};
    });
  }

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
  void set(int i, rsl::Vec3 v) {
    x_.data()[i] = v.x;
    y_.data()[i] = v.y;
    z_.data()[i] = v.z;
  }
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

// --- Parameters that are the same at all points

inline float uniform(const rsl::UniformFloatParam& p) { return p(grid()); }
inline const char* uniform(const rsl::StringParam& p) { return p(grid()); }
inline bool operator==(const rsl::StringParam& a, std::string_view b) { return uniform(a) == b; }
inline bool operator!=(const rsl::StringParam& a, std::string_view b) { return uniform(a) != b; }

// --- Output parameters

/// Assigns to an output parameter, as in RSL. It does nothing if no Display wants the output. Colours are
/// premultiplied, like Ci.
inline void output(const rsl::FloatOutput& o, const Float& v) {
  if (o.wanted(grid())) forActive([&](int i) { o.set(grid(), i, v[i]); });
}
template <int32_t type>
void output(const rsl::Output<type, rsl::Vec3>& o, const Triple& v) {
  if (o.wanted(grid())) forActive([&](int i) { o.set(grid(), i, v[i]); });
}

}  // namespace sl
