// Micropolygons that stand still and are in focus, against the samples of the pixels that they touch: kLanes samples of a
// pixel at a time. Compiled for several vector widths and chosen when first called (docs/decisions/0011); the operations are
// the same in all of them, and none is fused, so the bits are too.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "reyes/hide/raster_still.cpp"
#include "reyes/base/vector.h"  // Includes this file again for each target.

#include <bit>
#include <cstring>

#include "reyes/hide/claim.h"

HWY_BEFORE_NAMESPACE();
namespace tomales {
namespace HWY_NAMESPACE {
namespace {

/// Coefficients of kLanes edges: inside where dx * (y - oy) - dy * (x - ox) > limit.
struct EdgeBlock {
  float ox[kLanes], oy[kLanes], dx[kLanes], dy[kLanes], limit[kLanes];

  /// From p to q with the inside on the left if `side` is 1, on the right if -1.
  HWY_INLINE void set(int i, float px, float py, float qx, float qy, float side) {
    const bool swapped = (qx < px) | ((qx == px) & (qy < py));
    ox[i] = swapped ? qx : px;
    oy[i] = swapped ? qy : py;
    dx[i] = side * (qx - px);
    dy[i] = side * (qy - py);
    limit[i] = (swapped ? -side : side) > 0 ? 0.0f : -kTiny;
  }
};

/// kLanes micropolygons abcd that follow each other in the vertex order of a grid. That at the last vertex of
/// a row is no cell.
struct alignas(64) QuadBlock {
  float x[4][kLanes], y[4][kLanes], d[4][kLanes];  ///< Corners
  EdgeBlock ab, ca, bd, dc, bc;
  float fold[kLanes], foldLimit[kLanes];  ///< The diagonal's value, seen from triangle bdc.
  float gx0[kLanes], gy0[kLanes], gx1[kLanes], gy1[kLanes];  ///< Depth gradients of abc, bdc.
  float xMin[kLanes], xMax[kLanes], yMin[kLanes], yMax[kLanes], dMin[kLanes], dMax[kLanes];
};

HWY_INLINE void loadCorners(float to[4][kLanes], const float* from, int row) {
  std::copy_n(from, kLanes, to[0]);
  std::copy_n(from + 1, kLanes, to[1]);
  std::copy_n(from + row, kLanes, to[2]);
  std::copy_n(from + row + 1, kLanes, to[3]);
}

HWY_INLINE void setBounds(const float v[4][kLanes], float* lo, float* hi) {
  for (int i = 0; i < kLanes; ++i) {
    const float lo01 = v[0][i] < v[1][i] ? v[0][i] : v[1][i], lo23 = v[2][i] < v[3][i] ? v[2][i] : v[3][i];
    const float hi01 = v[0][i] < v[1][i] ? v[1][i] : v[0][i], hi23 = v[2][i] < v[3][i] ? v[3][i] : v[2][i];
    lo[i] = lo01 < lo23 ? lo01 : lo23;
    hi[i] = hi01 > hi23 ? hi01 : hi23;
  }
}

/// facing: RasterGrid::facing
HWY_INLINE void setTriangles(QuadBlock& q, float facing) {
  for (int i = 0; i < kLanes; ++i) {
    const float ax = q.x[0][i], bx = q.x[1][i], cx = q.x[2][i], dx = q.x[3][i];
    const float ay = q.y[0][i], by = q.y[1][i], cy = q.y[2][i], dy = q.y[3][i];
    const float ad = q.d[0][i], bd = q.d[1][i], cd = q.d[2][i], dd = q.d[3][i];
    const float area0 = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax);
    const float area1 = (dx - bx) * (cy - by) - (dy - by) * (cx - bx);
    const float side0 = area0 > 0 ? 1.0f : -1.0f, side1 = area1 > 0 ? 1.0f : -1.0f;
    q.ab.set(i, ax, ay, bx, by, side0);
    q.bc.set(i, bx, by, cx, cy, side0);
    q.ca.set(i, cx, cy, ax, ay, side0);
    q.bd.set(i, bx, by, dx, dy, side1);
    q.dc.set(i, dx, dy, cx, cy, side1);
    q.fold[i] = -side0 * side1;
    q.foldLimit[i] = (q.bc.limit[i] < 0 ? -1.0f : 1.0f) * q.fold[i] > 0 ? 0.0f : -kTiny;
    // A triangle without area has no inside, and one that turns away is not seen.
    q.ab.limit[i] = (area0 == 0) | (facing * side0 < 0) ? FLT_MAX : q.ab.limit[i];
    q.bd.limit[i] = (area1 == 0) | (facing * side1 < 0) ? FLT_MAX : q.bd.limit[i];
    const float inverse0 = 1.0f / (area0 == 0 ? 1.0f : area0), inverse1 = 1.0f / (area1 == 0 ? 1.0f : area1);
    q.gx0[i] = ((bd - ad) * (cy - ay) - (cd - ad) * (by - ay)) * inverse0;
    q.gy0[i] = ((cd - ad) * (bx - ax) - (bd - ad) * (cx - ax)) * inverse0;
    q.gx1[i] = ((dd - bd) * (cy - by) - (cd - bd) * (dy - by)) * inverse1;
    q.gy1[i] = ((cd - bd) * (dx - bx) - (dd - bd) * (cx - bx)) * inverse1;
  }
}

/// Corners and bounds of the micropolygons from `first` on, and which of them touch the bucket; if any does, their edges too.
HWY_INLINE uint64_t setUp(QuadBlock& q, const RasterGrid& r, int first, int row, const PixelRect& bucket) {
  loadCorners(q.x, r.x.data() + first, row);
  loadCorners(q.y, r.y.data() + first, row);
  setBounds(q.x, q.xMin, q.xMax);
  setBounds(q.y, q.yMin, q.yMax);
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
  setTriangles(q, r.facing);
  return touching;
}

struct Edge {
  Floats ox, oy, dx, dy, limit;
  Edge(const EdgeBlock& b, int i)
      : ox(all(b.ox[i])), oy(all(b.oy[i])), dx(all(b.dx[i])), dy(all(b.dy[i])), limit(all(b.limit[i])) {}
  HWY_INLINE Floats at(Floats x, Floats y) const {
    return hn::Sub(hn::Mul(dx, hn::Sub(y, oy)), hn::Mul(dy, hn::Sub(x, ox)));
  }
  HWY_INLINE Mask holds(Floats x, Floats y) const { return hn::Gt(at(x, y), limit); }
};

/// One micropolygon, ready to be asked about samples.
class Quad {
 public:
  Quad(const QuadBlock& q, int i)
      : ab_(q.ab, i), ca_(q.ca, i), bd_(q.bd, i), dc_(q.dc, i), bc_(q.bc, i), fold_(all(q.fold[i])),
        foldLimit_(all(q.foldLimit[i])), bx_(all(q.x[1][i])), by_(all(q.y[1][i])), bDepth_(all(q.d[1][i])),
        dMin_(all(q.dMin[i])), dMax_(all(q.dMax[i])), gx0_(all(q.gx0[i])), gy0_(all(q.gy0[i])), gx1_(all(q.gx1[i])),
        gy1_(all(q.gy1[i])) {
    const float slope0 = std::abs(q.gx0[i]) + std::abs(q.gy0[i]), slope1 = std::abs(q.gx1[i]) + std::abs(q.gy1[i]);
    vague_ = vagueDepth(slope0 > slope1 ? slope0 : slope1, q.dMin[i]);
  }

  /// Which samples are covered, and their depth keys.
  HWY_INLINE Mask covers(Floats x, Floats y, Floats& depth) const {
    const Floats diagonal = bc_.at(x, y);
    const Mask in0 = hn::And(hn::And(ab_.holds(x, y), ca_.holds(x, y)), hn::Gt(diagonal, bc_.limit));
    const Mask in1 =
        hn::And(hn::And(bd_.holds(x, y), dc_.holds(x, y)), hn::Gt(hn::Mul(fold_, diagonal), foldLimit_));
    const Floats gx = hn::IfThenElse(in0, gx0_, gx1_), gy = hn::IfThenElse(in0, gy0_, gy1_);
    const Floats d =
        hn::Add(hn::Add(bDepth_, hn::Mul(gx, hn::Sub(x, bx_))), hn::Mul(gy, hn::Sub(y, by_)));
    // Never outside the cell, or culling by dMin would depend on rounding.
    depth = hn::Min(hn::Max(d, dMin_), dMax_);
    return hn::Or(in0, in1);
  }
  float vague() const { return vague_; }

 private:
  float vague_;
  Edge ab_, ca_, bd_, dc_, bc_;
  Floats fold_, foldLimit_, bx_, by_, bDepth_, dMin_, dMax_, gx0_, gy0_, gx1_, gy1_;
};

/// The micropolygons whose first vertices are those from `first` to before `end`.
void rasterizeRun(const RasterJob& job, int first, int end, QuadBlock& q) {
  const RasterGrid& r = job.raster;
  const Grid& g = *r.grid;
  const int row = g.nu + 1;
  for (int k = first; k < end; k += kLanes) {
    uint64_t left = setUp(q, r, k, row, job.out.rect);
    for (; left; left &= left - 1) {
      const int i = std::countr_zero(left), a = k + i, v = a / row, u = a - v * row;
      if (a >= end) break;
      if (u == g.nu) continue;
      const int index = v * g.nu + u;
      if (!g.isCell(index)) continue;
      const Kept kept = keptOf(job, index);
      if (kept == Kept::None) continue;
      const uint32_t cell = job.firstCell + static_cast<uint32_t>(index);
      const PixelRect pixels = job.out.touched({q.xMin[i], q.yMin[i]}, {q.xMax[i], q.yMax[i]});
      const auto quad = [&] { return Quad(q, i); };
      if (r.opaque && !r.inSolid)
        sampleCell<true>(job, pixels, q.dMin[i], cell, kept, quad);
      else
        sampleCell<false>(job, pixels, r.inSolid ? r.dMin : q.dMin[i], cell, kept, quad);
    }
  }
}

/// Pieces that other buckets see are passed over, and so are those that are hidden here.
void rasterize(const RasterJob& job) {
  const Grid& g = *job.raster.grid;
  const auto& pieces = job.raster.ofPiece;
  const int ofPiece = g.verticesOfPiece(), withoutCells = g.nu + 1;
  const vec2 lo(job.out.rect.x0, job.out.rect.y0), hi(job.out.rect.x1, job.out.rect.y1);
  const auto seen = [&](size_t p) {
    const RasterExtent& e = pieces[p];
    const bool touches = (e.bound.lo.x < hi.x) & (e.bound.hi.x >= lo.x) & (e.bound.lo.y < hi.y) & (e.bound.hi.y >= lo.y);
    return touches && !job.out.hides(e.bound, e.dMin);
  };
  QuadBlock q;
  if (pieces.empty()) return rasterizeRun(job, 0, ofPiece - withoutCells, q);
  for (size_t p = 0; p < pieces.size(); ++p) {
    const size_t first = p;
    while (p < pieces.size() && seen(p)) ++p;
    if (p > first) rasterizeRun(job, static_cast<int>(first) * ofPiece, static_cast<int>(p) * ofPiece - withoutCells, q);
  }
}

/// Is one of eight flags set?
HWY_INLINE bool anyOfEight(const uint8_t* flags) {
  uint64_t eight;
  std::memcpy(&eight, flags, sizeof eight);
  return eight != 0;
}

void settlePixels(SampleBuffer& s, const PixelRect& pixels) {
  const size_t lanes = static_cast<size_t>(s.lanes);
  for (int y = pixels.y0; y < pixels.y1; ++y)
    for (int x = pixels.x0; x < pixels.x1;) {
      const size_t pixel = s.pixelIndex(x, y);
      // Of a stack's bound a bucket often sees little.
      if (x + 8 <= pixels.x1 && !anyOfEight(&s.nearer[pixel])) {
        x += 8;
        continue;
      }
      ++x;
      if (!s.nearer[pixel]) continue;
      Floats most = all(-kInfinity);
      for (size_t g = 0; g < lanes; g += hn::Lanes(kF)) most = hn::Max(most, hn::Load(kF, s.depth.data() + pixel * lanes + g));
      s.far[pixel] = hn::GetLane(hn::MaxOfLanes(kF, most));
      s.nearer[pixel] = 0;
    }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace tomales
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tomales {
HWY_EXPORT(rasterize);
HWY_EXPORT(settlePixels);
void rasterizeStill(const RasterJob& job) { HWY_DYNAMIC_DISPATCH(rasterize)(job); }
void SampleBuffer::settle(const PixelRect& pixels) { HWY_DYNAMIC_DISPATCH(settlePixels)(*this, pixels); }
}  // namespace tomales
#endif
