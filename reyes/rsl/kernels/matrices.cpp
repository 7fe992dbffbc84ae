// Matrices (RISpec 15.4): sixteen numbers a point, row by row; points are rows, the translation is the last row.
#include "reyes/rsl/kernels/angles.h"
#include "reyes/rsl/kernels/matrix_block.h"

namespace tomales::compiler::kernels {

using rsl::Matrix;
using rsl::Vec3;

namespace {

/// Puts a new transformation before a matrix: each block of `out` is the MatrixBlock that `left` sets times the block
/// of the first argument.
template <class Left>
RSL_INLINE void before(int blocks, const Lanes& out, const Lanes* in, const Left& left) {
  for (int b = 0; b < blocks; ++b) {
    MatrixBlock first, second(in[0], b), result;
    left(b, first);
    multiply(first, second, result);
    result.write(out, b);
  }
}

/// Computes the index among the sixteen numbers from a row and a column, each rounded down and clamped to 0..3; NaN
/// counts as 0.
RSL_INLINE void placesOf(const Lanes& row, const Lanes& column, int b, float* places) {
  const auto held = [](float x) RSL_INLINED {
    return (x >= 1 ? 1.0f : 0.0f) + (x >= 2 ? 1.0f : 0.0f) + (x >= 3 ? 1.0f : 0.0f);
  };
  const float *i = planeOf(row, b), *j = planeOf(column, b);
  RSL_LANES for (int k = 0; k < kBlock; ++k) places[k] = 4 * held(i[k]) + held(j[k]);
}

}  // namespace

RSL_KERNEL(MatrixOf) {
  for (int b = 0; b < blocks; ++b) {
    MatrixBlock m;
    for (int i = 0; i < 4; ++i) copyBlock(m.at[i][i], planeOf(in[0], b));
    m.write(out, b);
  }
}
RSL_KERNEL(MakeMatrix) {
  for (int b = 0; b < blocks; ++b)
    for (int c = 0; c < 16; ++c) copyBlock(planeOf(out, b, c), planeOf(in[c], b));
}
RSL_KERNEL(MatrixProduct) {
  for (int b = 0; b < blocks; ++b) {
    const MatrixBlock left(in[0], b), right(in[1], b);
    MatrixBlock result;
    multiply(left, right, result);
    result.write(out, b);
  }
}
RSL_KERNEL(TranslateMatrix) {
  before(blocks, out, in, [&](int b, MatrixBlock& m) RSL_INLINED {
    for (int j = 0; j < 3; ++j) copyBlock(m.at[3][j], planeOf(in[1], b, j));
  });
}
RSL_KERNEL(ScaleMatrix) {
  before(blocks, out, in, [&](int b, MatrixBlock& m) RSL_INLINED {
    for (int j = 0; j < 3; ++j) copyBlock(m.at[j][j], planeOf(in[1], b, j));
  });
}
RSL_KERNEL(RotateMatrix) {
  before(blocks, out, in, [&](int b, MatrixBlock& m) RSL_INLINED {
    const Angles angles(planeOf(in[1], b));
    const Plane<Vec3> axis(in[2], b);
    for (int i = 0; i < 3; ++i) {
      const Vec3 unit{i == 0 ? 1.0f : 0.0f, i == 1 ? 1.0f : 0.0f, i == 2 ? 1.0f : 0.0f};
      float *x = m.at[i][0], *y = m.at[i][1], *z = m.at[i][2];
      RSL_LANES for (int k = 0; k < kBlock; ++k) {
        const Vec3 row = rsl::rotated(unit, cosineOf(angles[k]), sineOf(angles[k]), {}, axis.get(k));
        x[k] = row.x;
        y[k] = row.y;
        z[k] = row.z;
      }
    }
  });
}

RSL_KERNEL(MatrixInverse) {
  for (int b = 0; b < blocks; ++b) {
    MatrixBlock left(in[0], b), inverse;
    float determinant[kBlock], exists[kBlock];
    invert(left, inverse, determinant, exists);
    const MatrixBlock identity;
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j) {
        const float *found = inverse.at[i][j], *none = identity.at[i][j];
        float* to = planeOf(out, b, 4 * i + j);
        RSL_LANES for (int k = 0; k < kBlock; ++k) to[k] = exists[k] == 0 ? none[k] : found[k];
      }
  }
}
RSL_KERNEL(Determinant) {
  for (int b = 0; b < blocks; ++b) {
    MatrixBlock left(in[0], b), inverse;
    float determinant[kBlock], exists[kBlock];
    invert(left, inverse, determinant, exists);
    copyBlock(planeOf(out, b), determinant);
  }
}

RSL_KERNEL(TransformPoint) {
  each(blocks, out, in, [](Matrix m, Vec3 p) RSL_INLINED { return rsl::transform(m, p); });
}
RSL_KERNEL(TransformVector) {
  each(blocks, out, in, [](Matrix m, Vec3 v) RSL_INLINED { return rsl::vtransform(m, v); });
}
RSL_KERNEL(TransformNormal) {
  for (int b = 0; b < blocks; ++b) {
    MatrixBlock left(in[0], b), inverse;
    float determinant[kBlock], exists[kBlock];
    invert(left, inverse, determinant, exists);
    const Plane<Vec3> to(out, b), normal(in[1], b);
    const auto& m = inverse.at;
    RSL_LANES for (int k = 0; k < kBlock; ++k) {
      const Vec3 n = normal.get(k),
                 r{rsl::dot({m[0][0][k], m[0][1][k], m[0][2][k]}, n), rsl::dot({m[1][0][k], m[1][1][k], m[1][2][k]}, n),
                   rsl::dot({m[2][0][k], m[2][1][k], m[2][2][k]}, n)};
      const bool none = determinant[k] == 0;
      to.set(k, {none ? 0 : r.x, none ? 0 : r.y, none ? 0 : r.z});
    }
  }
}

RSL_KERNEL(MatrixElement) {
  for (int b = 0; b < blocks; ++b) {
    float place[kBlock], *to = planeOf(out, b);
    placesOf(in[1], in[2], b, place);
    copyBlock(to, planeOf(in[0], b));
    for (int c = 1; c < 16; ++c) {
      const float *from = planeOf(in[0], b, c), here = static_cast<float>(c);
      RSL_LANES for (int k = 0; k < kBlock; ++k) to[k] = place[k] == here ? from[k] : to[k];
    }
  }
}
RSL_KERNEL(SetMatrixElement) {
  for (int b = 0; b < blocks; ++b) {
    float place[kBlock];
    placesOf(in[1], in[2], b, place);
    const float* value = planeOf(in[3], b);
    for (int c = 0; c < 16; ++c) {
      const float *from = planeOf(in[0], b, c), here = static_cast<float>(c);
      float* to = planeOf(out, b, c);
      RSL_LANES for (int k = 0; k < kBlock; ++k) to[k] = place[k] == here ? value[k] : from[k];
    }
  }
}
RSL_KERNEL(MatrixEqual) {
  each(blocks, out, in, [](Matrix a, Matrix b) RSL_INLINED {
    const auto row = [&](int i) RSL_INLINED {
      return (a.m[i][0] == b.m[i][0]) & (a.m[i][1] == b.m[i][1]) & (a.m[i][2] == b.m[i][2]) & (a.m[i][3] == b.m[i][3]);
    };
    return row(0) & row(1) & row(2) & row(3) ? 1.0f : 0.0f;
  });
}

}  // namespace tomales::compiler::kernels
