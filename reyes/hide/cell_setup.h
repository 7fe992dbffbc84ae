// Private to the hider: finds the cells of still, sharp grids that touch a bucket, kLanes of them at a time: their
// corners, bounds, pixels and numbers. It is included once for each vector width, after reyes/base/vector.h.
#include "reyes/hide/quad.h"

HWY_BEFORE_NAMESPACE();
namespace tomales {
namespace HWY_NAMESPACE {
namespace {

HWY_INLINE void loadCorners(float to[4][kLanes], const float* from, int row) {
  std::copy_n(from, kLanes, to[0]);
  std::copy_n(from + 1, kLanes, to[1]);
  std::copy_n(from + row, kLanes, to[2]);
  std::copy_n(from + row + 1, kLanes, to[3]);
}

HWY_INLINE void setLattice(const float from[4][kLanes], float origin, int32_t to[4][kLanes]) {
  const Floats zero = all(origin), scale = all(kSubpixels), far = all(65536.0f);
  for (int k = 0; k < 4; ++k)
    for (size_t g = 0; g < kLanes; g += hn::Lanes(kF)) {
      const Floats at = hn::Mul(hn::Sub(hn::Load(kF, from[k] + g), zero), scale);
      hn::Store(hn::ConvertTo(kI, hn::Min(hn::Max(at, hn::Neg(far)), far)), kI, to[k] + g);
    }
}

HWY_INLINE void setBounds(const float v[4][kLanes], float* lo, float* hi) {
  for (int i = 0; i < kLanes; ++i) {
    const float lo01 = v[0][i] < v[1][i] ? v[0][i] : v[1][i], lo23 = v[2][i] < v[3][i] ? v[2][i] : v[3][i];
    const float hi01 = v[0][i] < v[1][i] ? v[1][i] : v[0][i], hi23 = v[2][i] < v[3][i] ? v[3][i] : v[2][i];
    lo[i] = lo01 < lo23 ? lo01 : lo23;
    hi[i] = hi01 > hi23 ? hi01 : hi23;
  }
}

/// A cell that ends at a line may be visible beyond its corners, up to that line.
HWY_INLINE void growBounds(float* lo, float* hi, float by) {
  for (int i = 0; i < kLanes; ++i) {
    lo[i] -= by;
    hi[i] += by;
  }
}

/// Finds which of kLanes vertices of a grid are the first vertex of a cell, and that cell's index.
class CellNumbers {
 public:
  explicit CellNumbers(const Grid& g)
      : nu_(g.nu), nv_(g.nv), perRow_(1 / static_cast<float>(nu_ + 1)), perPiece_(1 / static_cast<float>(nv_ + 1)) {}

  HWY_INLINE uint64_t set(Corners& q, int first, int end) const {
    HWY_ALIGN int32_t begins[kLanes];
    for (int i = 0; i < kLanes; ++i) {
      // Adding a half keeps the quotients of whole numbers below 2^21 away from where rounding would matter.
      const int a = first + i, row = static_cast<int>((static_cast<float>(a) + 0.5f) * perRow_);
      const int piece = static_cast<int>((static_cast<float>(row) + 0.5f) * perPiece_), u = a - row * (nu_ + 1);
      q.cell[i] = row * nu_ + u;
      begins[i] = (u != nu_) & (row - piece * (nv_ + 1) != nv_) & (a < end);
    }
    uint64_t bits = 0;
    for (size_t g = 0; g < kLanes; g += hn::Lanes(kI))
      bits |= bitsOf(hn::RebindMask(kF, hn::Ne(hn::Load(kI, begins + g), hn::Zero(kI)))) << g;
    return bits;
  }

 private:
  int nu_, nv_;
  float perRow_, perPiece_;
};

/// Pixels of the bucket that bounds touch, the same as SampleBuffer::touched().
HWY_INLINE void setPixels(const float* lo, const float* hi, int first, int end, int32_t* from, int32_t* to) {
  const float origin = static_cast<float>(first), size = static_cast<float>(end - first);
  for (int i = 0; i < kLanes; ++i) {
    const float a = lo[i] - origin, b = hi[i] - origin;
    const int32_t x0 = static_cast<int32_t>((a < -1     ? -1
                                             : a > size ? size
                                                        : a) +
                                            1) -
                       1,
                  x1 = static_cast<int32_t>((b < -1     ? -1
                                             : b > size ? size
                                                        : b) +
                                            1);
    from[i] = first + (x0 < 0 ? 0 : x0);
    to[i] = x1 < end - first ? first + x1 : end;
  }
}

/// Sets corners, bounds and numbers of the cells from vertex `first` on. Returns which of them touch the bucket.
HWY_INLINE uint64_t setUp(Corners& q, const RasterGrid& r, const CellNumbers& numbers, int first, int end,
                          const PixelRect& bucket) {
  const int row = r.grid->nu + 1;
  loadCorners(q.x, r.x.data() + first, row);
  loadCorners(q.y, r.y.data() + first, row);
  setBounds(q.x, q.xMin, q.xMax);
  setBounds(q.y, q.yMin, q.yMax);
  if (!r.lines.empty()) {
    growBounds(q.xMin, q.xMax, kLineReach_px);
    growBounds(q.yMin, q.yMax, kLineReach_px);
  }
  const Floats left = all(static_cast<float>(bucket.x0)), right = all(static_cast<float>(bucket.x1));
  const Floats top = all(static_cast<float>(bucket.y0)), bottom = all(static_cast<float>(bucket.y1));
  uint64_t touching = 0;
  for (size_t g = 0; g < kLanes; g += hn::Lanes(kF)) {
    const Mask inX = hn::And(hn::Lt(hn::Load(kF, q.xMin + g), right), hn::Ge(hn::Load(kF, q.xMax + g), left));
    const Mask inY = hn::And(hn::Lt(hn::Load(kF, q.yMin + g), bottom), hn::Ge(hn::Load(kF, q.yMax + g), top));
    touching |= bitsOf(hn::And(inX, inY)) << g;
  }
  if (touching == 0) return 0;
  loadCorners(q.d, r.d.data() + first, row);
  setBounds(q.d, q.dMin, q.dMax);
  setPixels(q.xMin, q.xMax, bucket.x0, bucket.x1, q.x0, q.x1);
  setPixels(q.yMin, q.yMax, bucket.y0, bucket.y1, q.y0, q.y1);
  return touching & numbers.set(q, first, end);
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace tomales
HWY_AFTER_NAMESPACE();
