#include "references.h"

#include <cmath>

#include "reyes/shader/noise.h"
#include "reyes/shader/shadeops.h"
#include "reyes/shader/wavelet.h"

namespace tomales::compiler {

namespace {

using rsl::Matrix;
using rsl::Vec3;

Vec3 triple(const float* v) { return {v[0], v[1], v[2]}; }

/// Reads arguments one after the other.
struct Arguments {
  const float* at;
  operator float() { return *at++; }
};

Reference number(std::function<float(const float*)> f, int ulps = 0) {
  return {[f](const float* in, float* out) { *out = f(in); }, ulps};
}
Reference three(std::function<Vec3(const float*)> f, int ulps = 0) {
  return {[f](const float* in, float* out) {
            const Vec3 v = f(in);
            out[0] = v.x, out[1] = v.y, out[2] = v.z;
          },
          ulps};
}
Reference matrix(std::function<Matrix(const float*)> f) {
  return {[f](const float* in, float* out) {
    const Matrix m = f(in);
    std::copy_n(&m.m[0][0], 16, out);
  }};
}
/// Of the C library in double precision, rounded once.
Reference rounded(double (*f)(double), int ulps) {
  return number([f](const float* a) { return static_cast<float>(f(static_cast<double>(a[0]))); }, ulps);
}
Reference rounded2(double (*f)(double, double), int ulps) {
  return number(
      [f](const float* a) { return static_cast<float>(f(static_cast<double>(a[0]), static_cast<double>(a[1]))); },
      ulps);
}
/// The kernel's own, which is held against the C library by itself.
float kernelsOwn(Op op, float x) {
  Values in(1, 1, true), out(1, 1, true);
  std::fill(in.data.begin(), in.data.end(), x);
  const Lanes from = in.lanes();
  kernelOf(op)(1, out.lanes(), &from);
  return out.data[0];
}

int index(float x, int last) { return !(x >= 0) ? 0 : static_cast<int>(std::min(x, static_cast<float>(last))); }

Vec3 tripleOf(const std::function<float(Vec3)>& of, Vec3 p) { return rsl::triple(p, of); }

/// The slope of noise along d by differences in double precision is too coarse to compare bits with; see slopes_test.
const std::map<Op, Reference> kAll = {
    {Op::Add, number([](const float* a) { return a[0] + a[1]; })},
    {Op::Sub, number([](const float* a) { return a[0] - a[1]; })},
    {Op::Mul, number([](const float* a) { return a[0] * a[1]; })},
    {Op::Div, number([](const float* a) { return a[0] / a[1]; })},
    {Op::Neg, number([](const float* a) { return -a[0]; })},
    {Op::Less, number([](const float* a) { return a[0] < a[1] ? 1.0f : 0.0f; })},
    {Op::LessEqual, number([](const float* a) { return a[0] <= a[1] ? 1.0f : 0.0f; })},
    {Op::Equal, number([](const float* a) { return a[0] == a[1] ? 1.0f : 0.0f; })},
    {Op::NotEqual, number([](const float* a) { return a[0] != a[1] ? 1.0f : 0.0f; })},
    {Op::And, number([](const float* a) { return a[0] != 0 && a[1] != 0 ? 1.0f : 0.0f; })},
    {Op::Or, number([](const float* a) { return a[0] != 0 || a[1] != 0 ? 1.0f : 0.0f; })},
    {Op::Not, number([](const float* a) { return a[0] == 0 ? 1.0f : 0.0f; })},
    {Op::Select, number([](const float* a) { return a[0] != 0 ? a[1] : a[2]; })},

    {Op::Min, number([](const float* a) { return rsl::min(a[0], a[1]); })},
    {Op::Max, number([](const float* a) { return rsl::max(a[0], a[1]); })},
    {Op::Clamp, number([](const float* a) { return rsl::clamp(a[0], a[1], a[2]); })},
    {Op::Mix, number([](const float* a) { return rsl::mix(a[0], a[1], a[2]); })},
    {Op::Step, number([](const float* a) { return rsl::step(a[0], a[1]); })},
    {Op::Smoothstep, number([](const float* a) { return rsl::smoothstep(a[0], a[1], a[2]); })},
    {Op::Filterstep, number([](const float* a) { return rsl::filterstep(a[0], a[1], a[2]); })},
    {Op::Abs, number([](const float* a) { return std::abs(a[0]); })},
    {Op::Sign, number([](const float* a) { return rsl::sign(a[0]); })},
    {Op::Floor, number([](const float* a) { return std::floor(a[0]); })},
    {Op::Ceil, number([](const float* a) { return std::ceil(a[0]); })},
    {Op::Round, number([](const float* a) { return std::round(a[0]); })},
    {Op::Mod, number([](const float* a) { return a[0] - a[1] * std::floor(a[0] / a[1]); })},
    {Op::Sqrt, number([](const float* a) { return std::sqrt(a[0]); })},
    {Op::InverseSqrt, number([](const float* a) { return 1 / std::sqrt(a[0]); })},
    {Op::Exp, rounded(std::exp, 1)},
    {Op::Log, rounded(std::log, 1)},
    {Op::Pow, rounded2(std::pow, 1)},
    {Op::Sin, rounded(std::sin, 1)},
    {Op::Cos, rounded(std::cos, 1)},
    {Op::Tan, rounded(std::tan, 1)},
    {Op::Asin, rounded(std::asin, 1)},
    {Op::Acos, rounded(std::acos, 1)},
    {Op::Atan, rounded(std::atan, 1)},
    {Op::Atan2, rounded2(std::atan2, 1)},
    {Op::Erf, rounded(std::erf, 1)},
    {Op::Erfc, rounded(std::erfc, 1)},

    {Op::MakeTriple, three([](const float* a) { return triple(a); })},
    {Op::Component, number([](const float* a) { return a[index(a[3], 2)]; })},
    {Op::SetComponent, three([](const float* a) {
       float v[3] = {a[0], a[1], a[2]};
       v[index(a[3], 2)] = a[4];
       return triple(v);
     })},
    {Op::Dot, number([](const float* a) { return rsl::dot(triple(a), triple(a + 3)); })},
    {Op::Cross, three([](const float* a) { return rsl::cross(triple(a), triple(a + 3)); })},
    {Op::Length, number([](const float* a) { return rsl::length(triple(a)); })},
    {Op::Normalize, three([](const float* a) { return rsl::normalize(triple(a)); })},
    {Op::Reflect, three([](const float* a) { return rsl::reflect(triple(a), triple(a + 3)); })},
    {Op::Refract, three([](const float* a) { return rsl::refract(triple(a), triple(a + 3), a[6]); })},
    {Op::Faceforward, three([](const float* a) { return rsl::faceforward(triple(a), triple(a + 3), triple(a + 6)); })},
    {Op::Fresnel, number([](const float* a) { return rsl::fresnel(triple(a), triple(a + 3), a[6]); })},
    {Op::Ptlined, number([](const float* a) { return rsl::ptlined(triple(a), triple(a + 3), triple(a + 6)); })},
    {Op::RotatePoint, three([](const float* a) {
       return rsl::rotated(triple(a), kernelsOwn(Op::Cos, a[3]), kernelsOwn(Op::Sin, a[3]), triple(a + 4),
                           triple(a + 7));
     })},
    {Op::TripleEqual,
     number([](const float* a) { return a[0] == a[3] && a[1] == a[4] && a[2] == a[5] ? 1.0f : 0.0f; })},

    {Op::Noise1F, number([](const float* a) { return rsl::noise(a[0]); })},
    {Op::Noise2F, number([](const float* a) { return rsl::noise(a[0], a[1]); })},
    {Op::Noise3F, number([](const float* a) { return rsl::noise(triple(a)); })},
    {Op::Noise4F, number([](const float* a) { return rsl::noise(triple(a), a[3]); })},
    {Op::Noise1T, three([](const float* a) { return rsl::noise3(a[0]); })},
    {Op::Noise2T, three([](const float* a) { return rsl::noise3(a[0], a[1]); })},
    {Op::Noise3T, three([](const float* a) { return rsl::noise3(triple(a)); })},
    {Op::Noise4T, three([](const float* a) { return rsl::noise3(triple(a), a[3]); })},
    {Op::Cell1F, number([](const float* a) { return rsl::cellnoise(a[0]); })},
    {Op::Cell2F, number([](const float* a) { return rsl::cellnoise(a[0], a[1]); })},
    {Op::Cell3F, number([](const float* a) { return rsl::cellnoise(triple(a)); })},
    {Op::Cell4F, number([](const float* a) { return rsl::cellnoise(triple(a), a[3]); })},
    {Op::Cell1T, three([](const float* a) {
       return rsl::cellnoise3({a[0], 0, 0});
     })},
    {Op::Cell2T, three([](const float* a) {
       return rsl::cellnoise3({a[0], a[1], 0});
     })},
    {Op::Cell3T, three([](const float* a) { return rsl::cellnoise3(triple(a)); })},
    {Op::Cell4T, three([](const float* a) { return rsl::cellnoise3(triple(a), a[3]); })},
    {Op::Pnoise1F, number([](const float* a) { return rsl::pnoise(a[0], a[1]); })},
    {Op::Pnoise2F, number([](const float* a) { return rsl::pnoise(a[0], a[1], a[2], a[3]); })},
    {Op::Pnoise3F, number([](const float* a) { return rsl::pnoise(triple(a), triple(a + 3)); })},
    {Op::Pnoise4F, number([](const float* a) { return rsl::pnoise(triple(a), a[3], triple(a + 4), a[7]); })},
    {Op::Pnoise1T, three([](const float* a) {
       return rsl::pnoise3({a[0], 0.5f, 0.5f}, {a[1], 0, 0});
     })},
    {Op::Pnoise2T, three([](const float* a) {
       return rsl::pnoise3({a[0], a[1], 0.5f}, {a[2], a[3], 0});
     })},
    {Op::Pnoise3T, three([](const float* a) { return rsl::pnoise3(triple(a), triple(a + 3)); })},
    {Op::Pnoise4T, three([](const float* a) {
       return tripleOf([a](Vec3 q) { return rsl::pnoise(q, a[3], triple(a + 4), a[7]); }, triple(a));
     })},
    {Op::Wnoise, number([](const float* a) { return rsl::wnoise(triple(a), a[3]); })},

    {Op::MatrixOf, matrix([](const float* a) {
       Matrix m;
       m.m[0][0] = m.m[1][1] = m.m[2][2] = a[0];
       return m;
     })},
    {Op::MakeMatrix, matrix([](const float* a) { return Matrix::of(a); })},
    {Op::MatrixProduct, matrix([](const float* a) { return Matrix::of(a) * Matrix::of(a + 16); })},
    {Op::MatrixInverse, matrix([](const float* a) {
       Matrix m;
       rsl::invert(Matrix::of(a), &m);
       return m;
     })},
    {Op::Determinant, number([](const float* a) { return rsl::determinant(Matrix::of(a)); })},
    {Op::TranslateMatrix, matrix([](const float* a) { return rsl::translate(Matrix::of(a), triple(a + 16)); })},
    {Op::RotateMatrix, matrix([](const float* a) {
       return rsl::rotate(Matrix::of(a), kernelsOwn(Op::Cos, a[16]), kernelsOwn(Op::Sin, a[16]), triple(a + 17));
     })},
    {Op::ScaleMatrix, matrix([](const float* a) { return rsl::scale(Matrix::of(a), triple(a + 16)); })},
    {Op::TransformPoint, three([](const float* a) { return rsl::transform(Matrix::of(a), triple(a + 16)); })},
    {Op::TransformVector, three([](const float* a) { return rsl::vtransform(Matrix::of(a), triple(a + 16)); })},
    {Op::TransformNormal, three([](const float* a) { return rsl::ntransform(Matrix::of(a), triple(a + 16)); })},
    {Op::MatrixElement, number([](const float* a) { return a[4 * index(a[16], 3) + index(a[17], 3)]; })},
    {Op::SetMatrixElement, matrix([](const float* a) {
       Matrix m = Matrix::of(a);
       m.m[index(a[16], 3)][index(a[17], 3)] = a[18];
       return m;
     })},
    {Op::MatrixEqual, number([](const float* a) {
       for (int k = 0; k < 16; ++k)
         if (!(a[k] == a[16 + k])) return 0.0f;
       return 1.0f;
     })},
};

}  // namespace

const std::map<Op, Reference>& references() { return kAll; }

}  // namespace tomales::compiler
