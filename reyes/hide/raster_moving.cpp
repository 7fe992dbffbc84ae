// Moving micropolygons: every sample meets the vertices where they are at its time.
#include "reyes/hide/raster.h"

namespace tomales {
namespace {

/// The corners a b c d of a micropolygon at two successive motion keys.
struct MovingQuad {
  float x[2][4], y[2][4], d[2][4];
  float order[5];  ///< Of ab, bc, ca, bd, dc: 1 if the first end is the canonical one, -1 if the second is.
  vec2 lo{kInfinity}, hi{-kInfinity};
  float dMin = kInfinity, dMax = -kInfinity;

  MovingQuad(const RasterGrid& r, int key, int a) {
    const int row = r.grid->nu + 1;
    const int corner[4] = {a, a + 1, a + row, a + row + 1};
    for (int k = 0; k < 2; ++k)
      for (int c = 0; c < 4; ++c) {
        const size_t v = static_cast<size_t>((key + k) * r.grid->stride() + corner[c]);
        x[k][c] = r.x[v], y[k][c] = r.y[v], d[k][c] = r.d[v];
        lo = glm::min(lo, vec2(r.x[v], r.y[v])), hi = glm::max(hi, vec2(r.x[v], r.y[v]));
        dMin = std::min(dMin, r.d[v]), dMax = std::max(dMax, r.d[v]);
      }
    const int ends[5][2] = {{0, 1}, {1, 2}, {2, 0}, {1, 3}, {3, 2}};
    for (int e = 0; e < 5; ++e) order[e] = before(ends[e][1], ends[e][0]) ? -1.0f : 1.0f;
  }

  /// The order of edge ends must not change while they move, so it is that of the first key at which they
  /// differ.
  bool before(int p, int q) const {
    const float a[4] = {x[0][p], y[0][p], x[1][p], y[1][p]}, b[4] = {x[0][q], y[0][q], x[1][q], y[1][q]};
    return std::lexicographical_compare(a, a + 4, b, b + 4);
  }
};

/// Part of the shutter between two motion keys.
struct Interval {
  float begin, end;
};

struct MovingVertex {
  float x, y, d;
};

/// Twice the area of (p, q, sample), seen from the canonical end, positive if the sample is on the left of
/// pq.
TOMALES_KERNEL inline float edge(const MovingVertex& p, const MovingVertex& q, float order, float x,
                                 float y) {
  const float ox = order > 0 ? p.x : q.x, oy = order > 0 ? p.y : q.y;
  return (q.x - p.x) * (y - oy) - (q.y - p.y) * (x - ox);
}

/// `side`: 1 if the inside of pq is on its left, -1 on its right. Zero belongs to the right seen from the
/// canonical end.
TOMALES_KERNEL inline bool inside(float value, float order, float side) {
  return value * side > (order * side > 0 ? 0.0f : -kTiny);
}

TOMALES_KERNEL inline float sideOf(const MovingVertex& p, const MovingVertex& q, const MovingVertex& r) {
  return (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x) < 0 ? -1.0f : 1.0f;
}

TOMALES_KERNEL inline void coverMoving(const MovingQuad& q, const Interval& when, float x0, float y0,
                                       const float* x, const float* y, const float* time, LaneDepths& hit) {
  const float inverse = 1.0f / (when.end - when.begin);
  for (int s = 0; s < kLanes; ++s) {
    const float px = x0 + x[s], py = y0 + y[s];
    const float t = (time[s] - when.begin) * inverse;
    const auto at = [&](int c) TOMALES_KERNEL {
      return MovingVertex{q.x[0][c] + (q.x[1][c] - q.x[0][c]) * t, q.y[0][c] + (q.y[1][c] - q.y[0][c]) * t,
                          q.d[0][c] + (q.d[1][c] - q.d[0][c]) * t};
    };
    const MovingVertex a = at(0), b = at(1), c = at(2), d = at(3);
    const float ab = edge(a, b, q.order[0], px, py), bc = edge(b, c, q.order[1], px, py);
    const float ca = edge(c, a, q.order[2], px, py), bd = edge(b, d, q.order[3], px, py);
    const float dc = edge(d, c, q.order[4], px, py);
    const float side0 = sideOf(a, b, c), side1 = sideOf(b, d, c);
    const bool in0 =
        inside(ab, q.order[0], side0) & inside(bc, q.order[1], side0) & inside(ca, q.order[2], side0);
    const bool in1 =
        inside(bd, q.order[3], side1) & inside(dc, q.order[4], side1) & inside(-bc, -q.order[1], side1);
    const float d0 = (bc * a.d + ca * b.d + ab * c.d) / (ab + bc + ca);
    const float d1 = (dc * b.d - bc * d.d + bd * c.d) / (bd + dc - bc);
    float depth = in0 ? d0 : d1;
    depth = depth > q.dMin ? depth : q.dMin;
    depth = depth < q.dMax ? depth : q.dMax;
    const bool now = (time[s] >= when.begin) & (time[s] < when.end);
    hit.d[s] = now & (in0 | in1) ? depth : kInfinity;
  }
}

}  // namespace

TOMALES_HOT void rasterizeMoving(const RasterJob& job) {
  const RasterGrid& r = job.raster;
  const Grid& g = *r.grid;
  for (int key = 0; key + 1 < g.keyCount; ++key) {
    const Interval when{job.keyTimes[static_cast<size_t>(key)], job.keyTimes[static_cast<size_t>(key) + 1]};
    for (int cell = 0; cell < g.cellCount(); ++cell) {
      const int a = cell / g.nu * (g.nu + 1) + cell % g.nu;
      if (r.sides == 1 && turnedAway(job, a)) continue;
      const MovingQuad q(r, key, a);
      forPixels(job, q.lo, q.hi, q.dMin, job.firstCell + static_cast<uint32_t>(cell),
                [&](int x, int y, size_t at, LaneDepths& hit) TOMALES_KERNEL {
                  coverMoving(q, when, static_cast<float>(x), static_cast<float>(y), job.out.x + at,
                              job.out.y + at, job.out.time + at, hit);
                });
    }
  }
}

}  // namespace tomales
