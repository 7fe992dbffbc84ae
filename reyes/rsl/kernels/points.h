// Helpers to write a kernel as a function of one point: each() applies it to the sixteen points of a block, in a loop
// that the compiler vectorises, once for each kind of processor.
#pragma once
#include <cstddef>
#include <cstring>
#include <utility>

#include "reyes/rsl/kernels.h"
#include "reyes/shader/math.h"

/// The head of the kernel that the table calls `name`.
#define RSL_KERNEL(name) RSL_HOT void name(int blocks, const Lanes& out, const Lanes* in)

/// Stands before a loop over the points of a block. Points do not depend on each other (kernels.h), so their order does
/// not matter; and the loop must not be unrolled before it is vectorised.
#if defined(__GNUC__) && !defined(__clang__)
#define RSL_LANES _Pragma("GCC ivdep") _Pragma("GCC unroll 1")
#else
#define RSL_LANES
#endif

namespace tomales::compiler::kernels {

#define RSL_OP(name, signature, traits) void name(int blocks, const Lanes& out, const Lanes* in);
RSL_OPS(RSL_OP)
#undef RSL_OP

/// Returns the address of component c of the first point of block b.
RSL_INLINE float* planeOf(const Lanes& l, int b, int c = 0) {
  return l.data + static_cast<ptrdiff_t>(b) * l.block + static_cast<ptrdiff_t>(c) * l.component;
}

/// Uses memcpy, because the compiler would turn a loop into a call.
RSL_INLINE void copyBlock(float* to, const float* from) { std::memcpy(to, from, kBlock * sizeof(float)); }

/// The values of one block, by point.
template <class T>
struct Plane;
template <>
struct Plane<float> {
  float* value;
  RSL_INLINE Plane(const Lanes& l, int b) : value(planeOf(l, b)) {}
  RSL_INLINE float get(int k) const { return value[k]; }
  RSL_INLINE void set(int k, float v) const { value[k] = v; }
};
template <>
struct Plane<rsl::Vec3> {
  float *x, *y, *z;
  RSL_INLINE Plane(const Lanes& l, int b) : x(planeOf(l, b, 0)), y(planeOf(l, b, 1)), z(planeOf(l, b, 2)) {}
  RSL_INLINE rsl::Vec3 get(int k) const { return {x[k], y[k], z[k]}; }
  RSL_INLINE void set(int k, rsl::Vec3 v) const {
    x[k] = v.x;
    y[k] = v.y;
    z[k] = v.z;
  }
};

template <class Op, class Out, class... In>
RSL_INLINE void eachPoint(const Op& op, const Plane<Out> out, const Plane<In>... in) {
  RSL_LANES for (int k = 0; k < kBlock; ++k) out.set(k, op(in.get(k)...));
}
template <class Op, class Out, class... In, int... argument>
RSL_INLINE void eachBlock(int blocks, const Lanes& out, const Lanes* in, const Op& op, Out (Op::*)(In...) const,
                          std::integer_sequence<int, argument...>) {
  for (int b = 0; b < blocks; ++b) eachPoint<Op, Out, In...>(op, Plane<Out>(out, b), Plane<In>(in[argument], b)...);
}
template <class Out, class Op, class... In>
constexpr auto argumentsOf(Out (Op::*)(In...) const) {
  return std::make_integer_sequence<int, sizeof...(In)>();
}
/// Sets out = op(in...) at every point. `op` takes and gives float and rsl::Vec3, and is RSL_INLINED.
template <class Op>
RSL_INLINE void each(int blocks, const Lanes& out, const Lanes* in, const Op& op) {
  eachBlock(blocks, out, in, op, &Op::operator(), argumentsOf(&Op::operator()));
}

/// Does the same as eachBlock(), with a cheaper function `near` for blocks where isNear holds at all points, and `far`
/// for all others. All three take the arguments of `op`.
template <class IsNear, class Near, class Far, class Out, class... In, int... argument>
RSL_INLINE void eachBlockByReach(int blocks, const Lanes& out, const Lanes* in, const IsNear& isNear, const Near& near,
                                 const Far& far, Out (Far::*)(In...) const, std::integer_sequence<int, argument...>) {
  for (int b = 0; b < blocks; ++b) {
    uint32_t beyond = 0;
    RSL_LANES for (int k = 0; k < kBlock; ++k) beyond |= isNear(Plane<In>(in[argument], b).get(k)...) ? 0u : 1u;
    if (beyond == 0)
      eachPoint<Near, Out, In...>(near, Plane<Out>(out, b), Plane<In>(in[argument], b)...);
    else
      eachPoint<Far, Out, In...>(far, Plane<Out>(out, b), Plane<In>(in[argument], b)...);
  }
}
template <class IsNear, class Near, class Far>
RSL_INLINE void eachByReach(int blocks, const Lanes& out, const Lanes* in, const IsNear& isNear, const Near& near,
                            const Far& far) {
  eachBlockByReach(blocks, out, in, isNear, near, far, &Far::operator(), argumentsOf(&Far::operator()));
}

/// Returns component c of a register, as a register of numbers.
inline Lanes componentOf(const Lanes& l, int c) {
  return {l.data + static_cast<ptrdiff_t>(c) * l.component, l.block, l.component};
}

}  // namespace tomales::compiler::kernels
