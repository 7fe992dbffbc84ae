// RSL's operators, point by point. Part of reyes/sl.h.
#pragma once
#include "reyes/shader/sl_values.h"

namespace sl {

inline Float operator-(const Float& a) {
  return Float::of([&](int i) { return -a[i]; });
}
inline Triple operator-(const Triple& a) {
  return Triple::of([&](int i) { return -a[i]; });
}
inline Triple operator/(const Triple& a, const Float& b) {
  return Triple::of([&](int i) { return a[i] / b[i]; });
}
inline Triple operator/(const Triple& a, const Triple& b) {
  return Triple::of([&](int i) { return rsl::Vec3{a[i].x / b[i].x, a[i].y / b[i].y, a[i].z / b[i].z}; });
}
inline Triple operator/(const Float& a, const Triple& b) { return Triple(a) / b; }
inline Float operator/(const Float& a, const Float& b) {
  return Float::of([&](int i) { return a[i] / b[i]; });
}
#define SL_OPERATOR(op)                                         \
  inline Float operator op(const Float& a, const Float& b) {    \
    return Float::of([&](int i) { return a[i] op b[i]; });      \
  }                                                             \
  inline Triple operator op(const Triple& a, const Triple& b) { \
    return Triple::of([&](int i) { return a[i] op b[i]; });     \
  }
SL_OPERATOR(+)
SL_OPERATOR(-)
SL_OPERATOR(*)
inline Triple operator*(const Float& a, const Triple& b) {
  return Triple::of([&](int i) { return a[i] * b[i]; });
}
inline Triple operator*(const Triple& a, const Float& b) { return b * a; }
// A number beside a triple stands for all three components.
inline Triple operator+(const Triple& a, const Float& b) { return a + Triple(b); }
inline Triple operator+(const Float& a, const Triple& b) { return Triple(a) + b; }
inline Triple operator-(const Triple& a, const Float& b) { return a - Triple(b); }
inline Triple operator-(const Float& a, const Triple& b) { return Triple(a) - b; }
#define SL_COMPARISON(op)                                   \
  inline Mask operator op(const Float& a, const Float& b) { \
    return Mask::of([&](int i) { return a[i] op b[i]; });   \
  }
SL_COMPARISON(<)
SL_COMPARISON(>)
SL_COMPARISON(<=)
SL_COMPARISON(>=)
SL_COMPARISON(==)
SL_COMPARISON(!=)
inline Mask operator==(const Triple& a, const Triple& b) {
  return Mask::of([&](int i) { return a[i].x == b[i].x && a[i].y == b[i].y && a[i].z == b[i].z; });
}
inline Mask operator!=(const Triple& a, const Triple& b) { return !(a == b); }
#undef SL_OPERATOR
#undef SL_COMPARISON

}  // namespace sl
