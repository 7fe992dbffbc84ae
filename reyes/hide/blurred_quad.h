// Micropolygons that move or are out of focus, and which samples they cover. Private to the hider; included
// once for each vector width, after reyes/base/vector.h.
#include "reyes/hide/raster.h"

HWY_BEFORE_NAMESPACE();
namespace tomales {
namespace HWY_NAMESPACE {
namespace {

/// Samples as vectors.
struct SampleVector {
  Floats x, y, t, lensX, lensY;
};

/// What spreads a grid over the picture. Each kind has its own loops, so that none pays for another.
template <bool kMovesT, bool kDefocusesT>
struct Blur {
  static constexpr bool kMoves = kMovesT, kDefocuses = kDefocusesT;
};

/// The corners a b c d of a micropolygon at two successive motion keys; one if it is still.
template <class B>
struct BlurredQuad {
  static constexpr int kKeys = B::kMoves ? 2 : 1;
  float x[kKeys][4], y[kKeys][4], d[kKeys][4];
  bool swapped[5];  ///< Of ab, bc, ca, bd, dc: the second end is the canonical one.
  float dMin = kInfinity, dMax = -kInfinity;

  BlurredQuad(const RasterGrid& r, int key, int a) {
    const int row = r.grid->nu + 1;
    const int corner[4] = {a, a + 1, a + row, a + row + 1};
    for (int k = 0; k < kKeys; ++k)
      for (int c = 0; c < 4; ++c) {
        const size_t v = static_cast<size_t>((key + k) * r.grid->stride() + corner[c]);
        x[k][c] = r.x[v], y[k][c] = r.y[v], d[k][c] = r.d[v];
        dMin = std::min(dMin, r.d[v]), dMax = std::max(dMax, r.d[v]);
      }
    const int ends[5][2] = {{0, 1}, {1, 2}, {2, 0}, {1, 3}, {3, 2}};
    for (int e = 0; e < 5; ++e) swapped[e] = before(ends[e][1], ends[e][0]);
  }

  /// The order of edge ends must be the same for all samples, so it is that of the first thing in which they
  /// differ; ends that differ in depth alone part when they are out of focus.
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

/// Where a vertex is at the time of a sample, through its point of the lens.
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
    v.x = hn::Add(v.x, hn::Mul(s.lensX, fromFocus)), v.y = hn::Add(v.y, hn::Mul(s.lensY, fromFocus));
  }
  return v;
}

/// Twice the area of (p, q, sample), seen from the canonical end, positive if the sample is on the left of
/// pq.
HWY_INLINE Floats edge(const SeenVertex& p, const SeenVertex& q, bool swapped, const SampleVector& s) {
  const SeenVertex& origin = swapped ? q : p;
  return hn::Sub(hn::Mul(hn::Sub(q.x, p.x), hn::Sub(s.y, origin.y)),
                 hn::Mul(hn::Sub(q.y, p.y), hn::Sub(s.x, origin.x)));
}

/// `side`: 1 if the inside of pq is on its left, -1 on its right. Zero belongs to the right seen from the
/// canonical end.
HWY_INLINE Mask inside(Floats value, bool swapped, Floats side) {
  const Floats limit =
      hn::IfThenElse(hn::Gt(swapped ? hn::Neg(side) : side, hn::Zero(kF)), hn::Zero(kF), all(-kTiny));
  return hn::Gt(hn::Mul(value, side), limit);
}

HWY_INLINE Floats sideOf(const SeenVertex& p, const SeenVertex& q, const SeenVertex& r) {
  const Floats area =
      hn::Sub(hn::Mul(hn::Sub(q.x, p.x), hn::Sub(r.y, p.y)), hn::Mul(hn::Sub(q.y, p.y), hn::Sub(r.x, p.x)));
  return hn::IfThenElse(hn::Lt(area, hn::Zero(kF)), all(-1), all(1));
}

/// Which samples the quad covers, and their depth keys. facing: RasterGrid::facing, there and then.
template <class B>
HWY_INLINE Mask covers(const BlurredQuad<B>& q, const SampleVector& s, Floats focus, Floats facing,
                       Floats& depth) {
  const SeenVertex a = seen(q, 0, s, focus), b = seen(q, 1, s, focus), c = seen(q, 2, s, focus),
                   d = seen(q, 3, s, focus);
  const Floats ab = edge(a, b, q.swapped[0], s), bc = edge(b, c, q.swapped[1], s),
               ca = edge(c, a, q.swapped[2], s);
  const Floats bd = edge(b, d, q.swapped[3], s), dc = edge(d, c, q.swapped[4], s);
  const Floats side0 = sideOf(a, b, c), side1 = sideOf(b, d, c);
  const auto faces = [facing](Floats side) { return hn::Ge(hn::Mul(facing, side), hn::Zero(kF)); };
  const Mask in0 = hn::And(hn::And(inside(ab, q.swapped[0], side0), inside(bc, q.swapped[1], side0)),
                           hn::And(inside(ca, q.swapped[2], side0), faces(side0)));
  const Mask in1 = hn::And(hn::And(inside(bd, q.swapped[3], side1), inside(dc, q.swapped[4], side1)),
                           hn::And(inside(hn::Neg(bc), !q.swapped[1], side1), faces(side1)));
  const Floats p = hn::IfThenElse(in0, bc, dc), r = hn::IfThenElse(in0, ca, hn::Neg(bc)),
               t = hn::IfThenElse(in0, ab, bd);
  const Floats pd = hn::IfThenElse(in0, a.d, b.d), rd = hn::IfThenElse(in0, b.d, d.d);
  const Floats weighted = hn::Add(hn::Add(hn::Mul(p, pd), hn::Mul(r, rd)), hn::Mul(t, c.d));
  depth = hn::Min(hn::Max(hn::Div(weighted, hn::Add(hn::Add(p, r), t)), all(q.dMin)), all(q.dMax));
  return hn::Or(in0, in1);
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace tomales
HWY_AFTER_NAMESPACE();
