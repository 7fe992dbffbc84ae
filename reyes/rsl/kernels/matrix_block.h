// The matrices of one block: an array over the points for each of the sixteen numbers, and functions with loops.
#pragma once
#include "reyes/rsl/kernels/points.h"
#include "reyes/shader/shadeops.h"

namespace tomales::compiler::kernels {

/// One matrix at a time, for arithmetic without loops.
template <>
struct Plane<rsl::Matrix> {
  const float* first;
  ptrdiff_t component;
  RSL_INLINE Plane(const Lanes& l, int b) : first(planeOf(l, b)), component(l.component) {}
  RSL_INLINE rsl::Matrix get(int k) const {
    const auto at = [&](int c) RSL_INLINED { return first[c * component + k]; };
    return {{{at(0), at(1), at(2), at(3)},
             {at(4), at(5), at(6), at(7)},
             {at(8), at(9), at(10), at(11)},
             {at(12), at(13), at(14), at(15)}}};
  }
};

struct MatrixBlock {
  alignas(64) float at[4][4][kBlock];

  RSL_INLINE MatrixBlock() {  // the identity
    for (int c = 0; c < 16; ++c) std::fill_n(at[c / 4][c % 4], kBlock, c % 5 == 0 ? 1.0f : 0.0f);
  }
  RSL_INLINE MatrixBlock(const Lanes& from, int b) {
    for (int c = 0; c < 16; ++c) copyBlock(at[c / 4][c % 4], planeOf(from, b, c));
  }
  RSL_INLINE void write(const Lanes& to, int b) const {
    for (int c = 0; c < 16; ++c) copyBlock(planeOf(to, b, c), at[c / 4][c % 4]);
  }
};

RSL_INLINE void multiply(const MatrixBlock& a, const MatrixBlock& b, MatrixBlock& out) {
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j)
      RSL_LANES for (int k = 0; k < kBlock; ++k) out.at[i][j][k] =
          a.at[i][0][k] * b.at[0][j][k] + a.at[i][1][k] * b.at[1][j][k] + a.at[i][2][k] * b.at[2][j][k] +
          a.at[i][3][k] * b.at[3][j][k];
}

/// Does rsl::invert() at all points at once. `right` must be the identity at first, and `left` is overwritten. Where a
/// column has no pivot, `exists` becomes 0 and `right` is meaningless.
RSL_INLINE void invert(MatrixBlock& left, MatrixBlock& right, float* determinant, float* exists) {
  for (int k = 0; k < kBlock; ++k) determinant[k] = exists[k] = 1;
  for (int c = 0; c < 4; ++c) {
    float pivot[kBlock], largest[kBlock], by[kBlock];
    RSL_LANES for (int k = 0; k < kBlock; ++k) {
      pivot[k] = static_cast<float>(c);
      largest[k] = std::abs(left.at[c][c][k]);
    }
    for (int r = c + 1; r < 4; ++r) RSL_LANES for (int k = 0; k < kBlock; ++k) {
        const float size = std::abs(left.at[r][c][k]);
        const bool larger = size > largest[k];
        pivot[k] = larger ? static_cast<float>(r) : pivot[k];
        largest[k] = larger ? size : largest[k];
      }
    for (int r = c + 1; r < 4; ++r)
      for (int j = 0; j < 8; ++j) {
        float *above = j < 4 ? left.at[c][j] : right.at[c][j - 4], *below = j < 4 ? left.at[r][j] : right.at[r][j - 4];
        RSL_LANES for (int k = 0; k < kBlock; ++k) {
          const bool swap = pivot[k] == static_cast<float>(r);
          const float x = above[k], y = below[k];
          above[k] = swap ? y : x;
          below[k] = swap ? x : y;
        }
      }
    RSL_LANES for (int k = 0; k < kBlock; ++k) {
      const float d = left.at[c][c][k], so = pivot[k] != static_cast<float>(c) ? -determinant[k] : determinant[k];
      exists[k] = largest[k] == 0 ? 0 : exists[k];
      determinant[k] = so * d;
      by[k] = 1 / d;
    }
    for (int j = 0; j < 4; ++j) RSL_LANES for (int k = 0; k < kBlock; ++k) {
        left.at[c][j][k] *= by[k];
        right.at[c][j][k] *= by[k];
      }
    for (int r = 0; r < 4; ++r) {
      if (r == c) continue;
      float factor[kBlock];
      copyBlock(factor, left.at[r][c]);
      for (int j = 0; j < 4; ++j) RSL_LANES for (int k = 0; k < kBlock; ++k) {
          left.at[r][j][k] -= factor[k] * left.at[c][j][k];
          right.at[r][j][k] -= factor[k] * right.at[c][j][k];
        }
    }
  }
  RSL_LANES for (int k = 0; k < kBlock; ++k) determinant[k] = exists[k] == 0 ? 0 : determinant[k];
}

}  // namespace tomales::compiler::kernels
