// Private to the hider: coverage of samples by micropolygons that move or are out of focus. It is included once for
// each vector width, after reyes/base/vector.h.
#include "reyes/hide/raster.h"

HWY_BEFORE_NAMESPACE();
namespace tomales {
namespace HWY_NAMESPACE {
namespace {

constexpr hn::RebindToSigned<decltype(kF)> kI;  // NOLINT(misc-definitions-in-headers): no header of others
using Ints = hn::Vec<decltype(kI)>;

/// Samples as vectors.
struct SampleVector {
  Floats x, y, t, lensX, lensY;
};

/// The kinds of blur of a grid. Each combination has its own loops, so that none pays for another.
template <bool kMovesT, bool kDefocusesT>
struct Blur {
  static constexpr bool kMoves = kMovesT, kDefocuses = kDefocusesT;
};

/// The corners a b c d of a micropolygon at two successive motion keys, or at one if it is still.
template <class B>
struct BlurredQuad {
  static constexpr int kKeys = B::kMoves ? 2 : 1;
  using Values = float[size_t{kKeys}][4];
  Values x, y, d;
  bool swapped[5];  ///< True if the second end of the edge is the canonical one, in the order ab, bc, ca, bd, dc.
  float dMin = kInfinity, dMax = -kInfinity;

  BlurredQuad(const RasterGrid& r, int key, int a) {
    const int row = r.grid->nu + 1;
    const int corner[4] = {a, a + 1, a + row, a + row + 1};
    for (int k = 0; k < kKeys; ++k)
      for (int c = 0; c < 4; ++c) {
        const size_t v = static_cast<size_t>((key + k) * r.grid->stride() + corner[c]);
        x[k][c] = r.x[v], y[k][c] = r.y[v], d[k][c] = r.d[v];
        dMin = std::min(dMin, r.d[v]);
        dMax = std::max(dMax, r.d[v]);
      }
    const int ends[5][2] = {{0, 1}, {1, 2}, {2, 0}, {1, 3}, {3, 2}};
    for (int e = 0; e < 5; ++e) swapped[e] = before(ends[e][1], ends[e][0]);
  }

  /// The order of an edge's ends must be the same for all samples, so the first coordinate in which they differ
  /// decides. Ends that differ in depth alone part when they are out of focus.
  bool before(int p, int q) const {
    for (int k = 0; k < kKeys; ++k)
      for (const auto& value : {x[k], y[k], d[k]})
        if (value[p] != value[q]) return value[p] < value[q];
    return false;
  }
};

struct SeenVertex {
  Floats x, y, d;
};

/// Returns the position of a vertex at the time of a sample, seen through its point of the lens.
template <class B>
HWY_INLINE SeenVertex seen(const BlurredQuad<B>& q, int c, const SampleVector& s, Floats focus) {
  SeenVertex v{all(q.x[0][c]), all(q.y[0][c]), all(q.d[0][c])};
  if constexpr (B::kMoves) {
    v.x = hn::Add(v.x, hn::Mul(hn::Sub(all(q.x[1][c]), v.x), s.t));
    v.y = hn::Add(v.y, hn::Mul(hn::Sub(all(q.y[1][c]), v.y), s.t));
    v.d = hn::Add(v.d, hn::Mul(hn::Sub(all(q.d[1][c]), v.d), s.t));
  }
  if constexpr (B::kDefocuses) {
    const Floats fromFocus = hn::Sub(v.d, focus);
    v.x = hn::Add(v.x, hn::Mul(s.lensX, fromFocus));
    v.y = hn::Add(v.y, hn::Mul(s.lensY, fromFocus));
  }
  return v;
}

/// Returns twice the area of (p, q, sample), computed from the canonical end; positive if the sample is on the left of
/// pq.
HWY_INLINE Floats edge(const SeenVertex& p, const SeenVertex& q, bool swapped, const SampleVector& s) {
  const SeenVertex& origin = swapped ? q : p;
  return hn::Sub(hn::Mul(hn::Sub(q.x, p.x), hn::Sub(s.y, origin.y)),
                 hn::Mul(hn::Sub(q.y, p.y), hn::Sub(s.x, origin.x)));
}

/// Returns a negative number where a sample is on the left of an edge. Zero belongs to the right seen from the
/// canonical end.
HWY_INLINE Ints leftOf(Floats value, bool swapped) {
  return hn::BitCast(kI, hn::Sub(all(swapped ? -kTiny : 0.0f), value));
}

/// Returns -1 where the inside of a triangle is on the right of its edges.
HWY_INLINE Ints turnsRight(const SeenVertex& p, const SeenVertex& q, const SeenVertex& r) {
  const Floats area =
      hn::Sub(hn::Mul(hn::Sub(q.x, p.x), hn::Sub(r.y, p.y)), hn::Mul(hn::Sub(q.y, p.y), hn::Sub(r.x, p.x)));
  return hn::BitCast(kI, hn::VecFromMask(kF, hn::Lt(area, hn::Zero(kF))));
}

/// Tells whether a sample is on the same side of all three edges of a triangle that may be seen.
HWY_INLINE Mask inside(Ints left0, Ints left1, Ints left2, Ints right, float facing) {
  Ints in = hn::And(hn::And(hn::Xor(left0, right), hn::Xor(left1, right)), hn::Xor(left2, right));
  if (facing != 0) in = facing > 0 ? hn::AndNot(right, in) : hn::And(right, in);
  return hn::RebindMask(kF, hn::Lt(in, hn::Zero(kI)));
}

/// Returns the samples that the quad covers, and their depth keys. facing: RasterGrid::facing, at the time and lens
/// point of each sample.
template <class B>
HWY_INLINE Mask covers(const BlurredQuad<B>& q, const SampleVector& s, Floats focus, float facing, Floats& depth) {
  const SeenVertex a = seen(q, 0, s, focus), b = seen(q, 1, s, focus), c = seen(q, 2, s, focus),
                   d = seen(q, 3, s, focus);
  const Floats ab = edge(a, b, q.swapped[0], s), bc = edge(b, c, q.swapped[1], s), ca = edge(c, a, q.swapped[2], s);
  const Floats bd = edge(b, d, q.swapped[3], s), dc = edge(d, c, q.swapped[4], s);
  const Ints diagonal = leftOf(bc, q.swapped[1]);
  const Mask in0 = inside(leftOf(ab, q.swapped[0]), diagonal, leftOf(ca, q.swapped[2]), turnsRight(a, b, c), facing);
  const Mask in1 =
      inside(leftOf(bd, q.swapped[3]), hn::Not(diagonal), leftOf(dc, q.swapped[4]), turnsRight(b, d, c), facing);
  const Floats p = hn::IfThenElse(in0, bc, dc), r = hn::IfThenElse(in0, ca, hn::Neg(bc)),
               t = hn::IfThenElse(in0, ab, bd);
  const Floats pd = hn::IfThenElse(in0, a.d, b.d), rd = hn::IfThenElse(in0, b.d, d.d);
  const Floats weighted = hn::Add(hn::Add(hn::Mul(p, pd), hn::Mul(r, rd)), hn::Mul(t, c.d)),
               sum = hn::Add(hn::Add(p, r), t);
  depth = hn::Min(hn::Max(hn::Div(weighted, sum), all(q.dMin)), all(q.dMax));
  // NaN, from vertices as far out as floats go, has a sign.
  return hn::And(hn::Or(in0, in1), hn::Eq(sum, sum));
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace tomales
HWY_AFTER_NAMESPACE();
