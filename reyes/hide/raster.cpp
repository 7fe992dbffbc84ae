#include "reyes/hide/raster.h"

namespace tomales {
namespace {

/// Coefficients of kLanes edges: inside where dx * (y - oy) - dy * (x - ox) > limit.
struct EdgeBlock {
  float ox[kLanes], oy[kLanes], dx[kLanes], dy[kLanes], limit[kLanes];

  /// From p to q with the inside on the left if `side` is 1, on the right if -1.
  TOMALES_KERNEL void set(int i, float px, float py, float qx, float qy, float side) {
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

TOMALES_KERNEL inline void loadCorners(float to[4][kLanes], const float* from, int row) {
  std::copy_n(from, kLanes, to[0]);
  std::copy_n(from + 1, kLanes, to[1]);
  std::copy_n(from + row, kLanes, to[2]);
  std::copy_n(from + row + 1, kLanes, to[3]);
}

TOMALES_KERNEL inline void setBounds(const float v[4][kLanes], float* lo, float* hi) {
  for (int i = 0; i < kLanes; ++i) {
    const float lo01 = v[0][i] < v[1][i] ? v[0][i] : v[1][i], lo23 = v[2][i] < v[3][i] ? v[2][i] : v[3][i];
    const float hi01 = v[0][i] < v[1][i] ? v[1][i] : v[0][i], hi23 = v[2][i] < v[3][i] ? v[3][i] : v[2][i];
    lo[i] = lo01 < lo23 ? lo01 : lo23;
    hi[i] = hi01 > hi23 ? hi01 : hi23;
  }
}

TOMALES_KERNEL inline void setTriangles(QuadBlock& q) {
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
    // A triangle without area has no inside.
    q.ab.limit[i] = area0 == 0 ? FLT_MAX : q.ab.limit[i];
    q.bd.limit[i] = area1 == 0 ? FLT_MAX : q.bd.limit[i];
    const float inverse0 = 1.0f / (area0 == 0 ? 1.0f : area0), inverse1 = 1.0f / (area1 == 0 ? 1.0f : area1);
    q.gx0[i] = ((bd - ad) * (cy - ay) - (cd - ad) * (by - ay)) * inverse0;
    q.gy0[i] = ((cd - ad) * (bx - ax) - (bd - ad) * (cx - ax)) * inverse0;
    q.gx1[i] = ((dd - bd) * (cy - by) - (cd - bd) * (dy - by)) * inverse1;
    q.gy1[i] = ((cd - bd) * (dx - bx) - (dd - bd) * (cx - bx)) * inverse1;
  }
}

TOMALES_KERNEL inline void setUp(QuadBlock& q, const RasterGrid& r, int first, int row) {
  loadCorners(q.x, r.x.data() + first, row);
  loadCorners(q.y, r.y.data() + first, row);
  loadCorners(q.d, r.d.data() + first, row);
  setBounds(q.x, q.xMin, q.xMax);
  setBounds(q.y, q.yMin, q.yMax);
  setBounds(q.d, q.dMin, q.dMax);
  setTriangles(q);
}

struct Edge {
  float ox, oy, dx, dy, limit;
  Edge(const EdgeBlock& b, int i) : ox(b.ox[i]), oy(b.oy[i]), dx(b.dx[i]), dy(b.dy[i]), limit(b.limit[i]) {}
  TOMALES_KERNEL float operator()(float x, float y) const { return dx * (y - oy) - dy * (x - ox); }
};

/// Depth keys where quad i of the block covers the samples (x0 + x, y0 + y).
TOMALES_KERNEL inline void cover(const QuadBlock& q, int i, float x0, float y0, const float* x,
                                 const float* y, LaneDepths& hit) {
  const Edge ab(q.ab, i), ca(q.ca, i), bd(q.bd, i), dc(q.dc, i), bc(q.bc, i);
  const float fold = q.fold[i], foldLimit = q.foldLimit[i];
  const float bx = q.x[1][i], by = q.y[1][i], bDepth = q.d[1][i], dMin = q.dMin[i], dMax = q.dMax[i];
  const float gx0 = q.gx0[i], gy0 = q.gy0[i], gx1 = q.gx1[i], gy1 = q.gy1[i];
  for (int s = 0; s < kLanes; ++s) {
    const float px = x0 + x[s], py = y0 + y[s];
    const float diagonal = bc(px, py);
    const bool in0 = (ab(px, py) > ab.limit) & (ca(px, py) > ca.limit) & (diagonal > bc.limit);
    const bool in1 = (bd(px, py) > bd.limit) & (dc(px, py) > dc.limit) & (fold * diagonal > foldLimit);
    const float gx = in0 ? gx0 : gx1, gy = in0 ? gy0 : gy1;
    float d = bDepth + gx * (px - bx) + gy * (py - by);
    d = d > dMin ? d : dMin;  // Never outside the cell, or culling by dMin would depend on rounding.
    d = d < dMax ? d : dMax;
    hit.d[s] = in0 | in1 ? d : kInfinity;
  }
}

}  // namespace

TOMALES_HOT void rasterizeStill(const RasterJob& job) {
  const RasterGrid& r = job.raster;
  const Grid& g = *r.grid;
  const int row = g.nu + 1, end = g.nv * row;
  const PixelRect& rect = job.out.rect;
  const float left = static_cast<float>(rect.x0), right = static_cast<float>(rect.x1);
  const float top = static_cast<float>(rect.y0), bottom = static_cast<float>(rect.y1);
  QuadBlock q;
  for (int k = 0; k < end; k += kLanes) {
    setUp(q, r, k, row);
    for (int i = 0; i < std::min(kLanes, end - k); ++i) {
      const int a = k + i, u = a % row;
      if (u == g.nu) continue;
      if (!(q.xMin[i] < right && q.xMax[i] >= left && q.yMin[i] < bottom && q.yMax[i] >= top)) continue;
      if (r.sides == 1 && turnedAway(job, a)) continue;
      const Kept kept = keptOf(job, a / row * g.nu + u);
      if (kept == Kept::None) continue;
      const uint32_t cell = job.firstCell + static_cast<uint32_t>(a / row * g.nu + u);
      forPixels(job, {q.xMin[i], q.yMin[i]}, {q.xMax[i], q.yMax[i]}, q.dMin[i], cell,
                [&](int x, int y, size_t at, LaneDepths& hit) TOMALES_KERNEL {
                  cover(q, i, static_cast<float>(x), static_cast<float>(y), job.out.x + at, job.out.y + at,
                        hit);
                  if (kept == Kept::Part) cutAway(job, cell, x, y, at, hit);
                });
    }
  }
}

}  // namespace tomales
