// Private to the hider: coverage of samples by micropolygons of still, sharp grids. It is included once for each vector
// width, after reyes/base/vector.h.
#include "reyes/hide/raster.h"

HWY_BEFORE_NAMESPACE();
namespace tomales {
namespace HWY_NAMESPACE {
namespace {

constexpr hn::RebindToSigned<decltype(kF)> kI;  // NOLINT(misc-definitions-in-headers): no header of others
using Ints = hn::Vec<decltype(kI)>;

/// Adds the products of the upper halves and of the lower halves.
HWY_INLINE Ints products(Ints a, Ints b) {
#if HWY_TARGET == HWY_SCALAR
  const auto lower = [](Ints v) { return hn::ShiftRight<16>(hn::ShiftLeft<16>(v)); };
  return hn::Add(hn::Mul(hn::ShiftRight<16>(a), hn::ShiftRight<16>(b)), hn::Mul(lower(a), lower(b)));
#else
  constexpr hn::Repartition<int16_t, decltype(kI)> kHalves;
  Ints odd = hn::Zero(kI);
  const Ints even =
      hn::ReorderWidenMulAccumulate(kI, hn::BitCast(kHalves, a), hn::BitCast(kHalves, b), hn::Zero(kI), odd);
  return hn::RearrangeToOddPlusEven(even, odd);
#endif
}

/// kLanes micropolygons abcd that follow each other in the vertex order of a grid.
struct alignas(64) Corners {
  float x[4][kLanes], y[4][kLanes], d[4][kLanes];
  /// Lattice coordinates from SampleBuffer::origin; meaningless for corners that are too far for these.
  int32_t latticeX[4][kLanes], latticeY[4][kLanes];
  float xMin[kLanes], xMax[kLanes], yMin[kLanes], yMax[kLanes], dMin[kLanes], dMax[kLanes];
  int32_t cell[kLanes];                                    ///< Numbers of the cells.
  int32_t x0[kLanes], y0[kLanes], x1[kLanes], y1[kLanes];  ///< Pixels of the bucket that they touch.
};

/// Tells whether the inside of a triangle is on the left of its edges.
inline bool turnsLeft(const Corners& q, int i, int a, int b, int c) {
  return (q.x[b][i] - q.x[a][i]) * (q.y[c][i] - q.y[a][i]) - (q.y[b][i] - q.y[a][i]) * (q.x[c][i] - q.x[a][i]) > 0;
}

// The edges of kLanes micropolygons, in two kinds. Edge::inside answers with the sign of a lane, negative if the sample
// is inside: the processor has more units for operations on vectors than on masks.

/// A sample is inside where dx * (y - oy) - dy * (x - ox) > limit.
struct FloatEdges {
  float ox[kLanes], oy[kLanes], dx[kLanes], dy[kLanes], limit[kLanes];

  struct At {
    Floats x, y;
    HWY_INLINE At(const SampleBuffer& samples, size_t lane)
        : x(hn::Load(kF, samples.x.data() + lane)), y(hn::Load(kF, samples.y.data() + lane)) {}
  };
  struct Edge {
    Floats ox, oy, dx, dy, limit;
    HWY_INLINE Edge(const FloatEdges& e, int i)
        : ox(all(e.ox[i])), oy(all(e.oy[i])), dx(all(e.dx[i])), dy(all(e.dy[i])), limit(all(e.limit[i])) {}
    HWY_INLINE Ints inside(const At& at) const {
      const Mask holds = hn::Gt(hn::Sub(hn::Mul(dx, hn::Sub(at.y, oy)), hn::Mul(dy, hn::Sub(at.x, ox))), limit);
      return hn::BitCast(kI, hn::VecFromMask(kF, holds));
    }
  };

  /// Sets the lanes from g on to the edge from corner p to q, with the inside on the left where `left` holds, and on
  /// the right elsewhere.
  HWY_INLINE void set(size_t g, const Corners& c, int p, int q, Mask left) {
    const Floats px = hn::Load(kF, c.x[p] + g), py = hn::Load(kF, c.y[p] + g), qx = hn::Load(kF, c.x[q] + g),
                 qy = hn::Load(kF, c.y[q] + g);
    const Mask swapped = hn::Or(hn::Lt(qx, px), hn::And(hn::Eq(qx, px), hn::Lt(qy, py)));
    const Floats x = hn::Sub(qx, px), y = hn::Sub(qy, py);
    hn::Store(hn::IfThenElse(swapped, qx, px), kF, ox + g);
    hn::Store(hn::IfThenElse(swapped, qy, py), kF, oy + g);
    hn::Store(hn::IfThenElse(left, x, hn::Neg(x)), kF, dx + g);
    hn::Store(hn::IfThenElse(left, y, hn::Neg(y)), kF, dy + g);
    const Floats least = hn::IfThenElse(hn::Xor(swapped, left), hn::Zero(kF), all(-kTiny));
    hn::Store(least, kF, limit + g);
  }
  /// Sets one lane to the line from p to q, as set() does, unless it has no inside.
  void setLine(int i, const vec2& p, const vec2& q, bool left) {
    if (limit[i] == FLT_MAX) return;
    const bool swapped = q.x < p.x || (q.x == p.x && q.y < p.y);
    const vec2 along = left ? q - p : p - q, origin = swapped ? q : p;
    ox[i] = origin.x;
    oy[i] = origin.y;
    dx[i] = along.x;
    dy[i] = along.y;
    limit[i] = swapped != left ? 0.0f : -kTiny;
  }
  /// Gives the edges in a mask no inside.
  HWY_INLINE void close(size_t g, Mask closed) {
    hn::Store(hn::IfThenElse(closed, all(FLT_MAX), hn::Load(kF, limit + g)), kF, limit + g);
  }
};

/// The same edges on the lattice, where they are exact: one multiplication of pairs tests a vector of samples. A sample
/// is inside where dx * y - dy * x > limit.
struct SubpixelEdges {
  int32_t pair[kLanes], limit[kLanes];

  struct At {
    Ints xy;
    HWY_INLINE At(const SampleBuffer& samples, size_t lane) : xy(hn::Load(kI, samples.xy.data() + lane)) {}
  };
  struct Edge {
    Ints pair, limit;
    HWY_INLINE Edge(const SubpixelEdges& e, int i) : pair(hn::Set(kI, e.pair[i])), limit(hn::Set(kI, e.limit[i])) {}
    HWY_INLINE Ints inside(const At& at) const { return hn::Sub(limit, products(pair, at.xy)); }
  };

  HWY_INLINE void set(size_t g, const Corners& c, int p, int q, Mask left) {
    const Ints px = hn::Load(kI, c.latticeX[p] + g), py = hn::Load(kI, c.latticeY[p] + g);
    const Ints qx = hn::Load(kI, c.latticeX[q] + g), qy = hn::Load(kI, c.latticeY[q] + g);
    const auto onLeft = hn::RebindMask(kI, left),
               swapped = hn::Or(hn::Lt(qx, px), hn::And(hn::Eq(qx, px), hn::Lt(qy, py)));
    const Ints x = hn::Sub(qx, px), y = hn::Sub(qy, py);
    const Ints dx = hn::IfThenElse(onLeft, x, hn::Neg(x)), dy = hn::IfThenElse(onLeft, y, hn::Neg(y));
    hn::Store(hn::Or(hn::ShiftLeft<16>(dx), hn::And(hn::Neg(dy), hn::Set(kI, 0xffff))), kI, pair + g);
    const Ints here = hn::Sub(hn::Mul(dx, py), hn::Mul(dy, px));
    const Ints least = hn::IfThenElse(hn::Xor(swapped, onLeft), here, hn::Sub(here, hn::Set(kI, 1)));
    hn::Store(least, kI, limit + g);
  }
  HWY_INLINE void close(size_t g, Mask closed) {
    // Values lie within 2^28, so that no difference leaves 32 bits.
    hn::Store(hn::IfThenElse(hn::RebindMask(kI, closed), hn::Set(kI, 1 << 30), hn::Load(kI, limit + g)), kI, limit + g);
  }

  /// Greatest length of an edge. Up to it floats are exact too, as far as a pixel beyond the cell, so that the choice
  /// of the kind changes no bit.
  static constexpr float kMost_px = 3.5f;
};

/// The triangles abc and bdc of kLanes micropolygons.
template <class Edges>
struct alignas(64) Triangles {
  Edges ab, bc, ca, bd, dc;
  int32_t flipped[kLanes];  ///< -1 if abc and bdc are on opposite sides of bc; 0 if the quad is folded there.
  float gx0[kLanes], gy0[kLanes], gx1[kLanes], gy1[kLanes];  ///< Depth gradients of abc and bdc.
  float depthError[kLanes];                                  ///< The error of depth keys, depthErrorBound().

  /// facing: RasterGrid::facing.
  HWY_INLINE void set(const Corners& q, float facing) {
    for (size_t g = 0; g < kLanes; g += hn::Lanes(kF)) set(q, facing, g);
  }

 private:
  static HWY_INLINE Floats depthErrorBound(Floats slope, Floats depth) {
    return hn::Add(hn::Add(hn::Div(slope, all(kSubpixels)), hn::Mul(all(kInterpolatedDepthError), hn::Abs(depth))),
                   all(kTiny));
  }

  /// Returns twice the signed area of a triangle, from two of its sides.
  static HWY_INLINE Floats area(Floats ux, Floats uy, Floats vx, Floats vy) {
    return hn::Sub(hn::Mul(ux, vy), hn::Mul(uy, vx));
  }

  HWY_INLINE void set(const Corners& q, float facing, size_t g) {
    const Floats ax = hn::Load(kF, q.x[0] + g), bx = hn::Load(kF, q.x[1] + g), cx = hn::Load(kF, q.x[2] + g),
                 dx = hn::Load(kF, q.x[3] + g);
    const Floats ay = hn::Load(kF, q.y[0] + g), by = hn::Load(kF, q.y[1] + g), cy = hn::Load(kF, q.y[2] + g),
                 dy = hn::Load(kF, q.y[3] + g);
    const Floats az = hn::Load(kF, q.d[0] + g), bz = hn::Load(kF, q.d[1] + g), cz = hn::Load(kF, q.d[2] + g),
                 dz = hn::Load(kF, q.d[3] + g);
    const Floats abx = hn::Sub(bx, ax), aby = hn::Sub(by, ay), abz = hn::Sub(bz, az), acx = hn::Sub(cx, ax),
                 acy = hn::Sub(cy, ay), acz = hn::Sub(cz, az);
    const Floats bdx = hn::Sub(dx, bx), bdy = hn::Sub(dy, by), bdz = hn::Sub(dz, bz), bcx = hn::Sub(cx, bx),
                 bcy = hn::Sub(cy, by), bcz = hn::Sub(cz, bz);
    const Floats zero = hn::Zero(kF), area0 = area(abx, aby, acx, acy), area1 = area(bdx, bdy, bcx, bcy);
    const Mask left0 = hn::Gt(area0, zero), left1 = hn::Gt(area1, zero), flat0 = hn::Eq(area0, zero),
               flat1 = hn::Eq(area1, zero);
    const Floats side = all(facing);
    const Mask away0 = hn::Lt(hn::IfThenElse(left0, side, hn::Neg(side)), zero),
               away1 = hn::Lt(hn::IfThenElse(left1, side, hn::Neg(side)), zero);
    ab.set(g, q, 0, 1, left0);
    bc.set(g, q, 1, 2, left0);
    ca.set(g, q, 2, 0, left0);
    bd.set(g, q, 1, 3, left1);
    dc.set(g, q, 3, 2, left1);
    hn::Store(hn::BitCast(kI, hn::VecFromMask(kF, hn::Not(hn::Xor(left0, left1)))), kI, flipped + g);
    // A triangle without area has no inside, and one that turns away is not seen.
    ab.close(g, hn::Or(flat0, away0));
    bd.close(g, hn::Or(flat1, away1));
    const Floats one = all(1.0f), inverse0 = hn::Div(one, hn::IfThenElse(flat0, one, area0)),
                 inverse1 = hn::Div(one, hn::IfThenElse(flat1, one, area1));
    const Floats x0 = hn::Mul(hn::Sub(hn::Mul(abz, acy), hn::Mul(acz, aby)), inverse0),
                 y0 = hn::Mul(hn::Sub(hn::Mul(acz, abx), hn::Mul(abz, acx)), inverse0);
    const Floats x1 = hn::Mul(hn::Sub(hn::Mul(bdz, bcy), hn::Mul(bcz, bdy)), inverse1),
                 y1 = hn::Mul(hn::Sub(hn::Mul(bcz, bdx), hn::Mul(bdz, bcx)), inverse1);
    hn::Store(x0, kF, gx0 + g);
    hn::Store(y0, kF, gy0 + g);
    hn::Store(x1, kF, gx1 + g);
    hn::Store(y1, kF, gy1 + g);
    const Floats slope = hn::Max(hn::Add(hn::Abs(x0), hn::Abs(y0)), hn::Add(hn::Abs(x1), hn::Abs(y1)));
    hn::Store(depthErrorBound(slope, hn::Load(kF, q.dMin + g)), kF, depthError + g);
  }
};

/// One micropolygon, ready to be tested against samples.
template <class Edges>
class Quad {
 public:
  HWY_INLINE Quad(const Corners& q, const Triangles<Edges>& t, int i)
      : ab_(t.ab, i),
        bc_(t.bc, i),
        ca_(t.ca, i),
        bd_(t.bd, i),
        dc_(t.dc, i),
        flipped_(hn::Set(kI, t.flipped[i])),
        bx_(all(q.x[1][i])),
        by_(all(q.y[1][i])),
        bDepth_(all(q.d[1][i])),
        dMin_(all(q.dMin[i])),
        dMax_(all(q.dMax[i])),
        gx0_(all(t.gx0[i])),
        gy0_(all(t.gy0[i])),
        gx1_(all(t.gx1[i])),
        gy1_(all(t.gy1[i])),
        depthError_(t.depthError[i]) {}

  struct Covered {
    Mask mask, first;  ///< The samples covered by either triangle; those covered by abc.
  };
  HWY_INLINE Covered covers(const SampleBuffer& samples, size_t lane) const {
    const typename Edges::At at(samples, lane);
    const Ints diagonal = bc_.inside(at);
    const Ints first = hn::And(hn::And(ab_.inside(at), ca_.inside(at)), diagonal);
    const Ints second = hn::And(hn::And(bd_.inside(at), dc_.inside(at)), hn::Xor(diagonal, flipped_));
    return {negative(hn::Or(first, second)), negative(first)};
  }
  HWY_INLINE Floats depth(Floats x, Floats y, const Covered& in) const {
    const Floats gx = hn::IfThenElse(in.first, gx0_, gx1_), gy = hn::IfThenElse(in.first, gy0_, gy1_);
    const Floats d = hn::Add(hn::Add(bDepth_, hn::Mul(gx, hn::Sub(x, bx_))), hn::Mul(gy, hn::Sub(y, by_)));
    // The depth stays within that of the cell, or culling by dMin would depend on rounding.
    return hn::Min(hn::Max(d, dMin_), dMax_);
  }
  float depthError() const { return depthError_; }

 private:
  static HWY_INLINE Mask negative(Ints v) { return hn::RebindMask(kF, hn::Lt(v, hn::Zero(kI))); }

  typename Edges::Edge ab_, bc_, ca_, bd_, dc_;
  Ints flipped_;
  Floats bx_, by_, bDepth_, dMin_, dMax_, gx0_, gy0_, gx1_, gy1_;
  float depthError_;
};

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace tomales
HWY_AFTER_NAMESPACE();
