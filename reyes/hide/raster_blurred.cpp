// Micropolygons that move or are out of focus: every sample meets the vertices where they are at its time
// through its point of the lens.
#include "reyes/hide/raster.h"

namespace tomales {
namespace {

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
  float order[5];  ///< Of ab, bc, ca, bd, dc: 1 if the first end is the canonical one, -1 if the second is.
  vec2 lo{kInfinity}, hi{-kInfinity};
  float dMin = kInfinity, dMax = -kInfinity;

  TOMALES_KERNEL BlurredQuad(const RasterGrid& r, const Camera& camera, int key, int a) {
    const int row = r.grid->nu + 1;
    const int corner[4] = {a, a + 1, a + row, a + row + 1};
    for (int k = 0; k < kKeys; ++k)
      for (int c = 0; c < 4; ++c) {
        const size_t v = static_cast<size_t>((key + k) * r.grid->stride() + corner[c]);
        x[k][c] = r.x[v], y[k][c] = r.y[v], d[k][c] = r.d[v];
        const vec2 at(r.x[v], r.y[v]), blur = B::kDefocuses ? glm::abs(camera.defocus(r.d[v])) : vec2(0);
        lo = glm::min(lo, at - blur), hi = glm::max(hi, at + blur);
        dMin = std::min(dMin, r.d[v]), dMax = std::max(dMax, r.d[v]);
      }
    const int ends[5][2] = {{0, 1}, {1, 2}, {2, 0}, {1, 3}, {3, 2}};
    for (int e = 0; e < 5; ++e) order[e] = before(ends[e][1], ends[e][0]) ? -1.0f : 1.0f;
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

/// Part of the shutter between two motion keys.
struct Interval {
  float begin, end;
};

struct SeenVertex {
  float x, y, d;
};

/// Twice the area of (p, q, sample), seen from the canonical end, positive if the sample is on the left of
/// pq.
TOMALES_KERNEL inline float edge(const SeenVertex& p, const SeenVertex& q, float order, float x, float y) {
  const float ox = order > 0 ? p.x : q.x, oy = order > 0 ? p.y : q.y;
  return (q.x - p.x) * (y - oy) - (q.y - p.y) * (x - ox);
}

/// `side`: 1 if the inside of pq is on its left, -1 on its right. Zero belongs to the right seen from the
/// canonical end.
TOMALES_KERNEL inline bool inside(float value, float order, float side) {
  return value * side > (order * side > 0 ? 0.0f : -kTiny);
}

TOMALES_KERNEL inline float sideOf(const SeenVertex& p, const SeenVertex& q, const SeenVertex& r) {
  return (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x) < 0 ? -1.0f : 1.0f;
}

/// Depth keys where the quad covers kLanes samples, from `at` on in the pattern, of the pixel at (x0, y0).
template <class B>
TOMALES_KERNEL inline void coverBlurred(const BlurredQuad<B>& q, const Interval& when, const Camera& camera,
                                        const SampleBuffer& samples, float x0, float y0, size_t first,
                                        LaneDepths& hit) {
  const float *x = samples.x + first, *y = samples.y + first, *time = samples.time + first;
  const float *lensX = samples.lensX + first, *lensY = samples.lensY + first;
  const float inverse = 1.0f / (when.end - when.begin), focus = camera.focusKey();
  const vec2 lens = camera.lens();
  for (int s = 0; s < kLanes; ++s) {
    const float px = x0 + x[s], py = y0 + y[s];
    const float t = (time[s] - when.begin) * inverse;
    const float lx = lensX[s] * lens.x, ly = lensY[s] * lens.y;
    const auto at = [&](int c) TOMALES_KERNEL {
      SeenVertex v{q.x[0][c], q.y[0][c], q.d[0][c]};
      if constexpr (B::kMoves)
        v = {v.x + (q.x[1][c] - v.x) * t, v.y + (q.y[1][c] - v.y) * t, v.d + (q.d[1][c] - v.d) * t};
      if constexpr (B::kDefocuses) v.x += lx * (v.d - focus), v.y += ly * (v.d - focus);
      return v;
    };
    const SeenVertex a = at(0), b = at(1), c = at(2), d = at(3);
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
    const bool now = (!B::kMoves) | ((time[s] >= when.begin) & (time[s] < when.end));
    hit.d[s] = now & (in0 | in1) ? depth : kInfinity;
  }
}

template <class B>
TOMALES_KERNEL inline void rasterizeBetween(const RasterJob& job, int key, const Interval& when) {
  const RasterGrid& r = job.raster;
  const Grid& g = *r.grid;
  for (int cell = 0; cell < g.cellCount(); ++cell) {
    const int a = cell / g.nu * (g.nu + 1) + cell % g.nu;
    if (r.sides == 1 && turnedAway(job, a)) continue;
    const Kept kept = keptOf(job, cell);
    if (kept == Kept::None) continue;
    const BlurredQuad<B> q(r, job.camera, key, a);
    forPixels(job, q.lo, q.hi, q.dMin, job.firstCell + static_cast<uint32_t>(cell),
              [&](int x, int y, size_t at, LaneDepths& hit) TOMALES_KERNEL {
                coverBlurred(q, when, job.camera, job.out, static_cast<float>(x), static_cast<float>(y), at,
                             hit);
                if (kept == Kept::Part)
                  cutAway(job, job.firstCell + static_cast<uint32_t>(cell), x, y, at, hit);
              });
  }
}

template <class B>
TOMALES_KERNEL inline void rasterizeMoving(const RasterJob& job) {
  for (int key = 0; key + 1 < job.raster.grid->keyCount; ++key)
    rasterizeBetween<B>(job, key,
                        {job.keyTimes[static_cast<size_t>(key)], job.keyTimes[static_cast<size_t>(key) + 1]});
}

TOMALES_HOT void rasterizeDefocused(const RasterJob& job) {
  rasterizeBetween<Blur<false, true>>(job, 0, {0, 1});
}
TOMALES_HOT void rasterizeInMotion(const RasterJob& job) { rasterizeMoving<Blur<true, false>>(job); }
TOMALES_HOT void rasterizeDefocusedInMotion(const RasterJob& job) { rasterizeMoving<Blur<true, true>>(job); }

}  // namespace

void rasterizeBlurred(const RasterJob& job) {
  if (job.raster.grid->keyCount == 1)
    rasterizeDefocused(job);
  else if (job.raster.defocused)
    rasterizeDefocusedInMotion(job);
  else
    rasterizeInMotion(job);
}

}  // namespace tomales
