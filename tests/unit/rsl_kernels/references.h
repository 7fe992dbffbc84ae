// What every kernel should give at one point: the test compares with it, tests/bench/kernel_bench.cpp loops over it.
#pragma once
#include <algorithm>
#include <cmath>
#include <limits>

#include "kernel_run.h"
#include "reyes/shader/noise.h"
#include "reyes/shader/shadeops.h"
#include "reyes/shader/wavelet.h"

namespace tomales::compiler {

/// The kernel's own sine or cosine, which is held against the C library by itself.
inline float kernelsOwn(Op op, float x) {
  float in[kBlock], out[kBlock];
  std::fill_n(in, kBlock, x);
  const Lanes from{in, kBlock, kBlock};
  kernelOf(op)(1, {out, kBlock, kBlock}, &from);
  return out[0];
}
inline int indexOf(float x, int last) { return x >= 0 ? static_cast<int>(std::min(x, static_cast<float>(last))) : 0; }
inline float truth(bool x) { return x ? 1.0f : 0.0f; }

/// Calls visit.bits(op, f) where a kernel gives the bits of f, a function of float, rsl::Vec3 and rsl::Matrix, and
/// visit.library(op, f) where it comes near f, which is one of the C library's for whatever precision it is asked in.
template <class Visit>
void visitArithmetic(Visit& visit) {
  visit.bits(Op::Add, [](float a, float b) { return a + b; });
  visit.bits(Op::Sub, [](float a, float b) { return a - b; });
  visit.bits(Op::Mul, [](float a, float b) { return a * b; });
  visit.bits(Op::Div, [](float a, float b) { return a / b; });
  visit.bits(Op::Neg, [](float a) { return -a; });
  visit.bits(Op::Less, [](float a, float b) { return truth(a < b); });
  visit.bits(Op::LessEqual, [](float a, float b) { return truth(a <= b); });
  visit.bits(Op::Equal, [](float a, float b) { return truth(a == b); });
  visit.bits(Op::NotEqual, [](float a, float b) { return truth(a != b); });
  visit.bits(Op::And, [](float a, float b) { return truth(a != 0 && b != 0); });
  visit.bits(Op::Or, [](float a, float b) { return truth(a != 0 || b != 0); });
  visit.bits(Op::Not, [](float a) { return truth(a == 0); });
  visit.bits(Op::Select, [](float a, float b, float c) { return a != 0 ? b : c; });
  visit.bits(Op::Min, [](float a, float b) { return rsl::min(a, b); });
  visit.bits(Op::Max, [](float a, float b) { return rsl::max(a, b); });
  visit.bits(Op::Clamp, [](float x, float lo, float hi) { return rsl::clamp(x, lo, hi); });
  visit.bits(Op::Mix, [](float a, float b, float t) { return rsl::mix(a, b, t); });
  visit.bits(Op::Step, [](float edge, float x) { return rsl::step(edge, x); });
  visit.bits(Op::Smoothstep, [](float lo, float hi, float x) { return rsl::smoothstep(lo, hi, x); });
  visit.bits(Op::Filterstep, [](float edge, float x, float width) { return rsl::filterstep(edge, x, width); });
  visit.bits(Op::Abs, [](float a) { return std::abs(a); });
  visit.bits(Op::Sign, [](float a) { return rsl::sign(a); });
  visit.bits(Op::Floor, [](float a) { return std::floor(a); });
  visit.bits(Op::Ceil, [](float a) { return std::ceil(a); });
  visit.bits(Op::Round, [](float a) { return std::round(a); });
  visit.bits(Op::Mod, [](float a, float b) { return b == 0 ? 0 : a - b * std::floor(a / b); });
  visit.bits(Op::Sqrt, [](float a) { return a < 0 ? 0 : std::sqrt(a); });
  visit.bits(Op::InverseSqrt, [](float a) { return a <= 0 ? 0 : 1 / std::sqrt(a); });
}
/// RSL's functions where the C library's have no value.
template <class T>
T logOrLeast(T x) {
  return x <= 0 ? -static_cast<T>(std::numeric_limits<float>::max()) : std::log(x);
}
template <class T>
T powOrZero(T x, T y) {
  const bool none = (x == 0 && y < 0) || (x < 0 && std::isfinite(x) && y != std::floor(y));
  return none ? 0 : std::pow(x, y);
}
template <class T>
T inUnit(T x) {
  return std::clamp(x, T{-1}, T{1});
}
template <class Visit>
void visitLibrary(Visit& visit) {
  visit.library(Op::Exp, [](auto x) { return std::exp(x); });
  visit.library(Op::Log, [](auto x) { return logOrLeast(x); });
  visit.library(Op::Pow, [](auto x, auto y) { return powOrZero(x, y); });
  visit.library(Op::Sin, [](auto x) { return std::sin(x); });
  visit.library(Op::Cos, [](auto x) { return std::cos(x); });
  visit.library(Op::Tan, [](auto x) { return std::tan(x); });
  visit.library(Op::Asin, [](auto x) { return std::asin(inUnit(x)); });
  visit.library(Op::Acos, [](auto x) { return std::acos(inUnit(x)); });
  visit.library(Op::Atan, [](auto x) { return std::atan(x); });
  visit.library(Op::Atan2, [](auto y, auto x) { return std::atan2(y, x); });
  visit.library(Op::Erf, [](auto x) { return std::erf(x); });
  visit.library(Op::Erfc, [](auto x) { return std::erfc(x); });
}
template <class Visit>
void visitTriples(Visit& visit) {
  using rsl::Vec3;
  visit.bits(Op::MakeTriple, [](float x, float y, float z) { return Vec3{x, y, z}; });
  visit.bits(Op::Component, [](Vec3 v, float which) {
    const int k = indexOf(which, 2);
    return k == 0 ? v.x : k == 1 ? v.y : v.z;
  });
  visit.bits(Op::SetComponent, [](Vec3 v, float which, float value) {
    const int k = indexOf(which, 2);
    return Vec3{k == 0 ? value : v.x, k == 1 ? value : v.y, k == 2 ? value : v.z};
  });
  visit.bits(Op::Dot, [](Vec3 a, Vec3 b) { return rsl::dot(a, b); });
  visit.bits(Op::Cross, [](Vec3 a, Vec3 b) { return rsl::cross(a, b); });
  visit.bits(Op::Length, [](Vec3 a) { return rsl::length(a); });
  visit.bits(Op::Normalize, [](Vec3 a) { return rsl::normalize(a); });
  visit.bits(Op::Reflect, [](Vec3 I, Vec3 N) { return rsl::reflect(I, N); });
  visit.bits(Op::Refract, [](Vec3 I, Vec3 N, float eta) { return rsl::refract(I, N, eta); });
  visit.bits(Op::Faceforward, [](Vec3 N, Vec3 I, Vec3 Nref) { return rsl::faceforward(N, I, Nref); });
  visit.bits(Op::Fresnel, [](Vec3 I, Vec3 N, float eta) { return rsl::fresnel(I, N, eta); });
  visit.bits(Op::Ptlined, [](Vec3 P0, Vec3 P1, Vec3 Q) { return rsl::ptlined(P0, P1, Q); });
  visit.bits(Op::RotatePoint, [](Vec3 Q, float angle, Vec3 P0, Vec3 P1) {
    return rsl::rotated(Q, kernelsOwn(Op::Cos, angle), kernelsOwn(Op::Sin, angle), P0, P1);
  });
  visit.bits(Op::TripleEqual, [](Vec3 a, Vec3 b) { return truth(a.x == b.x && a.y == b.y && a.z == b.z); });
}
template <class Visit>
void visitNoise(Visit& visit) {
  using rsl::Vec3;
  visit.bits(Op::Noise1F, [](float x) { return rsl::noise(x); });
  visit.bits(Op::Noise2F, [](float x, float y) { return rsl::noise(x, y); });
  visit.bits(Op::Noise3F, [](Vec3 p) { return rsl::noise(p); });
  visit.bits(Op::Noise4F, [](Vec3 p, float t) { return rsl::noise(p, t); });
  visit.bits(Op::Noise1T, [](float x) { return rsl::noise3(x); });
  visit.bits(Op::Noise2T, [](float x, float y) { return rsl::noise3(x, y); });
  visit.bits(Op::Noise3T, [](Vec3 p) { return rsl::noise3(p); });
  visit.bits(Op::Noise4T, [](Vec3 p, float t) { return rsl::noise3(p, t); });
  visit.bits(Op::Cell1F, [](float x) { return rsl::cellnoise(x); });
  visit.bits(Op::Cell2F, [](float x, float y) { return rsl::cellnoise(x, y); });
  visit.bits(Op::Cell3F, [](Vec3 p) { return rsl::cellnoise(p); });
  visit.bits(Op::Cell4F, [](Vec3 p, float t) { return rsl::cellnoise(p, t); });
  visit.bits(Op::Cell1T, [](float x) { return rsl::cellnoise3({x, 0, 0}); });
  visit.bits(Op::Cell2T, [](float x, float y) { return rsl::cellnoise3({x, y, 0}); });
  visit.bits(Op::Cell3T, [](Vec3 p) { return rsl::cellnoise3(p); });
  visit.bits(Op::Cell4T, [](Vec3 p, float t) { return rsl::cellnoise3(p, t); });
  visit.bits(Op::Pnoise1F, [](float x, float period) { return rsl::pnoise(x, period); });
  visit.bits(Op::Pnoise2F, [](float x, float y, float u, float v) { return rsl::pnoise(x, y, u, v); });
  visit.bits(Op::Pnoise3F, [](Vec3 p, Vec3 period) { return rsl::pnoise(p, period); });
  visit.bits(Op::Pnoise4F, [](Vec3 p, float t, Vec3 q, float u) { return rsl::pnoise(p, t, q, u); });
  visit.bits(Op::Pnoise1T, [](float x, float period) { return rsl::pnoise3({x, 0.5f, 0.5f}, {period, 0, 0}); });
  visit.bits(Op::Pnoise2T, [](float x, float y, float u, float v) { return rsl::pnoise3({x, y, 0.5f}, {u, v, 0}); });
  visit.bits(Op::Pnoise3T, [](Vec3 p, Vec3 period) { return rsl::pnoise3(p, period); });
  visit.bits(Op::Pnoise4T, [](Vec3 p, float t, Vec3 q, float u) {
    return rsl::triple(p, [&](Vec3 at) { return rsl::pnoise(at, t, q, u); });
  });
  visit.bits(Op::Wnoise, [](Vec3 p, float width) { return rsl::wnoise(p, width); });
}
template <class Visit>
void visitMatrices(Visit& visit) {
  using rsl::Matrix, rsl::Vec3;
  visit.bits(Op::MatrixOf, [](float x) { return Matrix{{{x, 0, 0, 0}, {0, x, 0, 0}, {0, 0, x, 0}, {0, 0, 0, x}}}; });
  visit.bits(Op::MakeMatrix, [](float a, float b, float c, float d, float e, float f, float g, float h, float i,
                                float j, float k, float l, float m, float n, float o, float p) {
    return Matrix{{{a, b, c, d}, {e, f, g, h}, {i, j, k, l}, {m, n, o, p}}};
  });
  visit.bits(Op::MatrixProduct, [](const Matrix& a, const Matrix& b) { return a * b; });
  visit.bits(Op::MatrixInverse, [](const Matrix& a) {
    Matrix inverse;
    rsl::invert(a, &inverse);
    return inverse;
  });
  visit.bits(Op::Determinant, [](const Matrix& a) { return rsl::determinant(a); });
  visit.bits(Op::TranslateMatrix, [](const Matrix& a, Vec3 t) { return rsl::translate(a, t); });
  visit.bits(Op::RotateMatrix, [](const Matrix& a, float angle, Vec3 axis) {
    return rsl::rotate(a, kernelsOwn(Op::Cos, angle), kernelsOwn(Op::Sin, angle), axis);
  });
  visit.bits(Op::ScaleMatrix, [](const Matrix& a, Vec3 s) { return rsl::scale(a, s); });
  visit.bits(Op::TransformPoint, [](const Matrix& a, Vec3 p) { return rsl::transform(a, p); });
  visit.bits(Op::TransformVector, [](const Matrix& a, Vec3 v) { return rsl::vtransform(a, v); });
  visit.bits(Op::TransformNormal, [](const Matrix& a, Vec3 n) { return rsl::ntransform(a, n); });
  visit.bits(Op::MatrixElement, [](const Matrix& a, float i, float j) { return a.m[indexOf(i, 3)][indexOf(j, 3)]; });
  visit.bits(Op::SetMatrixElement, [](Matrix a, float i, float j, float x) {
    a.m[indexOf(i, 3)][indexOf(j, 3)] = x;
    return a;
  });
  visit.bits(Op::MatrixEqual, [](const Matrix& a, const Matrix& b) {
    return truth(std::equal(&a.m[0][0], &a.m[0][0] + 16, &b.m[0][0]));
  });
}
/// All but those of slopes, which have no simpler form: slopes_test.cpp.
template <class Visit>
void visitReferences(Visit& visit) {
  visitArithmetic(visit), visitLibrary(visit), visitTriples(visit), visitNoise(visit), visitMatrices(visit);
}

}  // namespace tomales::compiler
