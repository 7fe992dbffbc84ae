// Matrices (RISpec 15.4): sixteen numbers a point, row by row; points are rows, the translation is the last row.
#include "reyes/rsl/kernels/angles.h"
#include "reyes/shader/shadeops.h"

namespace tomales::compiler::kernels {

using rsl::Vec3;

namespace {

/// The numbers of a block, each of all its points.
struct Block {
  const Lanes& lanes;
  int b;
  RSL_INLINE float* operator()(int row, int column) const { return planeOf(lanes, b, 4 * row + column); }
  RSL_INLINE rsl::Matrix at(int k) const {
    rsl::Matrix m;
    for (int i = 0; i < 16; ++i) m.m[i / 4][i % 4] = planeOf(lanes, b, i)[k];
    return m;
  }
  RSL_INLINE void set(int k, const rsl::Matrix& m) const {
    for (int i = 0; i < 16; ++i) planeOf(lanes, b, i)[k] = m.m[i / 4][i % 4];
  }
};

/// 0 to 3, rounded down; what is not a number is 0.
RSL_INLINE float heldIndex(float x) { return x >= 3 ? 3.0f : x >= 2 ? 2.0f : x >= 1 ? 1.0f : 0.0f; }

}  // namespace

RSL_KERNEL(MatrixOf) {
  for (int b = 0; b < blocks; ++b)
    for (int i = 0; i < 16; ++i) {
      const float* value = planeOf(*in, b);
      float* to = planeOf(out, b, i);
#pragma GCC ivdep
      for (int k = 0; k < kBlock; ++k) to[k] = i == 15 ? 1.0f : i % 5 == 0 ? value[k] : 0.0f;
    }
}
RSL_KERNEL(MakeMatrix) {
  for (int i = 0; i < 16; ++i) each(blocks, componentOf(out, i), in + i, [](float x) RSL_INLINED { return x; });
}
RSL_KERNEL(MatrixProduct) {
  for (int b = 0; b < blocks; ++b)
    for (int i = 0; i < 16; ++i) {
      const Block l{in[0], b}, r{in[1], b};
      const int row = i / 4, column = i % 4;
      const float *a0 = l(row, 0), *a1 = l(row, 1), *a2 = l(row, 2), *a3 = l(row, 3);
      const float *b0 = r(0, column), *b1 = r(1, column), *b2 = r(2, column), *b3 = r(3, column);
      float* to = planeOf(out, b, i);
#pragma GCC ivdep
      for (int k = 0; k < kBlock; ++k) to[k] = a0[k] * b0[k] + a1[k] * b1[k] + a2[k] * b2[k] + a3[k] * b3[k];
    }
}
RSL_KERNEL(MatrixInverse) {
  for (int b = 0; b < blocks; ++b)
    for (int k = 0; k < kBlock; ++k) {
      rsl::Matrix inverse;
      rsl::invert(Block{*in, b}.at(k), &inverse);
      Block{out, b}.set(k, inverse);
    }
}
RSL_KERNEL(Determinant) {
  for (int b = 0; b < blocks; ++b)
    for (int k = 0; k < kBlock; ++k) planeOf(out, b)[k] = rsl::determinant(Block{*in, b}.at(k));
}
RSL_KERNEL(TranslateMatrix) {
  for (int b = 0; b < blocks; ++b)
    for (int k = 0; k < kBlock; ++k)
      Block{out, b}.set(k, rsl::translate(Block{in[0], b}.at(k), Plane<Vec3>(in[1], b).get(k)));
}
RSL_KERNEL(RotateMatrix) {
  for (int b = 0; b < blocks; ++b) {
    const Angles angles(planeOf(in[1], b));
    for (int k = 0; k < kBlock; ++k)
      Block{out, b}.set(
          k, rsl::rotate(Block{in[0], b}.at(k), cosineOf(angles[k]), sineOf(angles[k]), Plane<Vec3>(in[2], b).get(k)));
  }
}
RSL_KERNEL(ScaleMatrix) {
  for (int b = 0; b < blocks; ++b)
    for (int k = 0; k < kBlock; ++k)
      Block{out, b}.set(k, rsl::scale(Block{in[0], b}.at(k), Plane<Vec3>(in[1], b).get(k)));
}
RSL_KERNEL(TransformPoint) {
  for (int b = 0; b < blocks; ++b)
    for (int k = 0; k < kBlock; ++k)
      Plane<Vec3>(out, b).set(k, rsl::transform(Block{in[0], b}.at(k), Plane<Vec3>(in[1], b).get(k)));
}
RSL_KERNEL(TransformVector) {
  for (int b = 0; b < blocks; ++b)
    for (int k = 0; k < kBlock; ++k)
      Plane<Vec3>(out, b).set(k, rsl::vtransform(Block{in[0], b}.at(k), Plane<Vec3>(in[1], b).get(k)));
}
RSL_KERNEL(TransformNormal) {
  for (int b = 0; b < blocks; ++b)
    for (int k = 0; k < kBlock; ++k)
      Plane<Vec3>(out, b).set(k, rsl::ntransform(Block{in[0], b}.at(k), Plane<Vec3>(in[1], b).get(k)));
}
RSL_KERNEL(MatrixElement) {
  for (int b = 0; b < blocks; ++b) {
    float* to = planeOf(out, b);
    for (int i = 0; i < 16; ++i) {
      const float *row = planeOf(in[1], b), *column = planeOf(in[2], b), *from = planeOf(in[0], b, i);
      const float n = static_cast<float>(i);
#pragma GCC ivdep
      for (int k = 0; k < kBlock; ++k) to[k] = 4 * heldIndex(row[k]) + heldIndex(column[k]) == n ? from[k] : to[k];
    }
  }
}
RSL_KERNEL(SetMatrixElement) {
  for (int b = 0; b < blocks; ++b)
    for (int i = 0; i < 16; ++i) {
      const float *row = planeOf(in[1], b), *column = planeOf(in[2], b), *value = planeOf(in[3], b);
      const float *from = planeOf(in[0], b, i), n = static_cast<float>(i);
      float* to = planeOf(out, b, i);
#pragma GCC ivdep
      for (int k = 0; k < kBlock; ++k) to[k] = 4 * heldIndex(row[k]) + heldIndex(column[k]) == n ? value[k] : from[k];
    }
}
RSL_KERNEL(MatrixEqual) {
  for (int b = 0; b < blocks; ++b) {
    float* to = planeOf(out, b);
    for (int k = 0; k < kBlock; ++k) to[k] = 1;
    for (int i = 0; i < 16; ++i) {
      const float *l = planeOf(in[0], b, i), *r = planeOf(in[1], b, i);
#pragma GCC ivdep
      for (int k = 0; k < kBlock; ++k) to[k] = l[k] == r[k] ? to[k] : 0.0f;
    }
  }
}

}  // namespace tomales::compiler::kernels
