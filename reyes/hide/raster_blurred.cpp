// Micropolygons that move or are out of focus: every sample meets the vertices where they are at its time through its point
// of the lens. A box round many micropolygons, at that time and through that point, is no larger than when it is still; so
// the samples of a bucket are sieved through the boxes of the grid, of its quarters, of their quarters, down to
// micropolygons, and few are left that miss.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "reyes/hide/raster_blurred.cpp"
#include "reyes/base/vector.h"  // Includes this file again for each target.

#include "reyes/hide/blur_bounds.h"
#include "reyes/hide/raster.h"
#include "reyes/hide/sieve.h"

HWY_BEFORE_NAMESPACE();
namespace tomales {
namespace HWY_NAMESPACE {
namespace {

/// Part of the shutter between two motion keys.
struct Interval {
  float begin, end;
};

/// Samples as vectors.
struct SampleVector {
  Floats x, y, t, lensX, lensY;
};

/// What spreads a grid over the picture. Each kind has its own loops, so that none pays for another.
template <bool kMovesT, bool kDefocusesT>
struct Blur {
  static constexpr bool kMoves = kMovesT, kDefocuses = kDefocusesT;
};

template <class B>
HWY_INLINE SampleVector loadSamples(const SampleList& s, size_t i) {
  SampleVector v;
  v.x = load(s.x + i), v.y = load(s.y + i);
  v.t = B::kMoves ? load(s.t + i) : all(0);
  v.lensX = B::kDefocuses ? load(s.lensX + i) : all(0);
  v.lensY = B::kDefocuses ? load(s.lensY + i) : all(0);
  return v;
}

/// A BlurBox, ready to be asked.
template <class B>
struct Box {
  Floats x, y, d, xStep, yStep, dStep, xReach, yReach;

  Box(const BlurBox& b, float focus)
      : x(all(b.x)), y(all(b.y)), d(all(b.d - focus)), xStep(all(b.xStep)), yStep(all(b.yStep)), dStep(all(b.dStep)),
        xReach(all(b.xReach)), yReach(all(b.yReach)) {}

  HWY_INLINE Mask holds(const SampleVector& s) const {
    Floats cx = x, cy = y, cd = d;
    if constexpr (B::kMoves) {
      cx = hn::Add(cx, hn::Mul(xStep, s.t)), cy = hn::Add(cy, hn::Mul(yStep, s.t));
      if constexpr (B::kDefocuses) cd = hn::Add(cd, hn::Mul(dStep, s.t));
    }
    if constexpr (B::kDefocuses) cx = hn::Add(cx, hn::Mul(s.lensX, cd)), cy = hn::Add(cy, hn::Mul(s.lensY, cd));
    return hn::And(hn::Le(hn::Abs(hn::Sub(s.x, cx)), xReach), hn::Le(hn::Abs(hn::Sub(s.y, cy)), yReach));
  }
};

/// Appends the lanes of a mask to a list; writes up to a vector beyond its end.
template <class B>
HWY_INLINE void keep(const SampleVector& s, hn::Vec<decltype(kU)> lane, Mask mask, SampleList& to) {
  const size_t n = to.count;
  hn::StoreU(hn::Compress(s.x, mask), kF, to.x + n);
  hn::StoreU(hn::Compress(s.y, mask), kF, to.y + n);
  if constexpr (B::kMoves) hn::StoreU(hn::Compress(s.t, mask), kF, to.t + n);
  if constexpr (B::kDefocuses) {
    hn::StoreU(hn::Compress(s.lensX, mask), kF, to.lensX + n);
    hn::StoreU(hn::Compress(s.lensY, mask), kF, to.lensY + n);
  }
  hn::StoreU(hn::Compress(lane, hn::RebindMask(kU, mask)), kU, to.lane + n);
  to.count += hn::CountTrue(kF, mask);
}

/// Those samples of a list that a box holds.
template <class B>
HWY_INLINE void sieve(const Box<B>& box, const SampleList& from, SampleList& to) {
  const size_t width = hn::Lanes(kF);
  for (size_t i = 0; i < from.count; i += width) {
    const SampleVector s = loadSamples<B>(from, i);
    const Mask in = hn::And(box.holds(s), hn::FirstN(kF, from.count - i));
    keep<B>(s, hn::LoadU(kU, from.lane + i), in, to);
  }
}

/// Those samples of the bucket that a box holds, whose time is in the segment and that see nothing nearer yet.
template <class B>
HWY_INLINE void sieveBucket(const SampleBuffer& out, const PixelRect& pixels, const Interval& when, const Box<B>& box,
                            float dMin, SampleList& to) {
  const size_t width = hn::Lanes(kF), lanes = static_cast<size_t>(out.lanes);
  const Floats begin = all(when.begin), end = all(when.end), inverse = all(1.0f / (when.end - when.begin));
  for (int y = pixels.y0; y < pixels.y1; ++y) {
    const size_t first = out.pixelIndex(pixels.x0, y) * lanes, last = first + static_cast<size_t>(pixels.width()) * lanes;
    for (size_t i = first; i < last; i += width) {
      const Mask open = hn::Ge(hn::Load(kF, out.depth.data() + i), all(dMin));
      SampleVector s;
      s.x = hn::Load(kF, out.x.data() + i), s.y = hn::Load(kF, out.y.data() + i);
      const Floats time = hn::Load(kF, out.time.data() + i);
      s.t = hn::Mul(hn::Sub(time, begin), inverse);
      s.lensX = hn::Load(kF, out.lensX.data() + i), s.lensY = hn::Load(kF, out.lensY.data() + i);
      Mask in = hn::And(open, box.holds(s));
      if constexpr (B::kMoves) in = hn::And(in, hn::And(hn::Ge(time, begin), hn::Lt(time, end)));
      if (!hn::AllFalse(kF, in)) keep<B>(s, hn::Iota(kU, static_cast<uint32_t>(i)), in, to);
    }
  }
}

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

/// Twice the area of (p, q, sample), seen from the canonical end, positive if the sample is on the left of pq.
HWY_INLINE Floats edge(const SeenVertex& p, const SeenVertex& q, bool swapped, const SampleVector& s) {
  const SeenVertex& origin = swapped ? q : p;
  return hn::Sub(hn::Mul(hn::Sub(q.x, p.x), hn::Sub(s.y, origin.y)), hn::Mul(hn::Sub(q.y, p.y), hn::Sub(s.x, origin.x)));
}

/// `side`: 1 if the inside of pq is on its left, -1 on its right. Zero belongs to the right seen from the canonical end.
HWY_INLINE Mask inside(Floats value, bool swapped, Floats side) {
  const Floats limit = hn::IfThenElse(hn::Gt(swapped ? hn::Neg(side) : side, hn::Zero(kF)), hn::Zero(kF), all(-kTiny));
  return hn::Gt(hn::Mul(value, side), limit);
}

HWY_INLINE Floats sideOf(const SeenVertex& p, const SeenVertex& q, const SeenVertex& r) {
  const Floats area = hn::Sub(hn::Mul(hn::Sub(q.x, p.x), hn::Sub(r.y, p.y)), hn::Mul(hn::Sub(q.y, p.y), hn::Sub(r.x, p.x)));
  return hn::IfThenElse(hn::Lt(area, hn::Zero(kF)), all(-1), all(1));
}

/// Which samples the quad covers, and their depth keys. facing: RasterGrid::facing, there and then.
template <class B>
HWY_INLINE Mask covers(const BlurredQuad<B>& q, const SampleVector& s, Floats focus, Floats facing, Floats& depth) {
  const SeenVertex a = seen(q, 0, s, focus), b = seen(q, 1, s, focus), c = seen(q, 2, s, focus), d = seen(q, 3, s, focus);
  const Floats ab = edge(a, b, q.swapped[0], s), bc = edge(b, c, q.swapped[1], s), ca = edge(c, a, q.swapped[2], s);
  const Floats bd = edge(b, d, q.swapped[3], s), dc = edge(d, c, q.swapped[4], s);
  const Floats side0 = sideOf(a, b, c), side1 = sideOf(b, d, c);
  const auto faces = [facing](Floats side) { return hn::Ge(hn::Mul(facing, side), hn::Zero(kF)); };
  const Mask in0 = hn::And(hn::And(inside(ab, q.swapped[0], side0), inside(bc, q.swapped[1], side0)),
                           hn::And(inside(ca, q.swapped[2], side0), faces(side0)));
  const Mask in1 = hn::And(hn::And(inside(bd, q.swapped[3], side1), inside(dc, q.swapped[4], side1)),
                           hn::And(inside(hn::Neg(bc), !q.swapped[1], side1), faces(side1)));
  const Floats p = hn::IfThenElse(in0, bc, dc), r = hn::IfThenElse(in0, ca, hn::Neg(bc)), t = hn::IfThenElse(in0, ab, bd);
  const Floats pd = hn::IfThenElse(in0, a.d, b.d), rd = hn::IfThenElse(in0, b.d, d.d);
  const Floats weighted = hn::Add(hn::Add(hn::Mul(p, pd), hn::Mul(r, rd)), hn::Mul(t, c.d));
  depth = hn::Min(hn::Max(hn::Div(weighted, hn::Add(hn::Add(p, r), t)), all(q.dMin)), all(q.dMax));
  return hn::Or(in0, in1);
}

/// Descends the boxes of one grid between two motion keys.
template <class B>
class Descent {
 public:
  Descent(const RasterJob& job, int key) : job_(job), bounds_(*job.raster.blur), key_(key), focus_(job.camera.focusKey()) {}

  /// In bands of pixel rows, so that lists stay short in large buckets.
  void run(const Interval& when) {
    const PixelRect pixels = job_.out.touched(job_.raster.bound.lo, job_.raster.bound.hi);
    const int rowLanes = std::max(1, pixels.width() * job_.out.lanes), rows = std::max(1, kMostLanes / rowLanes);
    for (int y = pixels.y0; y < pixels.y1; y += rows)
      runBand(when, {pixels.x0, y, pixels.x1, std::min(y + rows, pixels.y1)});
  }

 private:
  static constexpr int kMostLanes = 1 << 16;

  void runBand(const Interval& when, const PixelRect& pixels) {
    const size_t top = bounds_.levels.size() - 1, most = static_cast<size_t>(pixels.width() * pixels.height() * job_.out.lanes);
    const BlurBox& box = bounds_.box(key_, bounds_.levels[top], 0, 0);
    stack_ = &SieveStack::ofThread(bounds_.levels.size(), most);
    SampleList list = stack_->push(most);
    sieveBucket<B>(job_.out, pixels, when, Box<B>(box, focus_), job_.raster.inSolid ? job_.raster.dMin : box.dMin, list);
    descend(top, 0, 0, list);
    stack_->pop(most);
  }

  void descend(size_t level, int i, int j, const SampleList& samples) {
    if (samples.count == 0) return;
    if (level == 0) return meet(i, j, samples);
    const BlurBounds::Level& fine = bounds_.levels[level - 1];
    for (int y = 2 * j; y < std::min(2 * j + 2, fine.rows); ++y)
      for (int x = 2 * i; x < std::min(2 * i + 2, fine.columns); ++x) {
        SampleList kept = stack_->push(samples.count);
        sieve<B>(Box<B>(bounds_.box(key_, fine, x, y), focus_), samples, kept);
        descend(level - 1, x, y, kept);
        stack_->pop(samples.count);
      }
  }

  void meet(int i, int j, const SampleList& samples) {
    const Grid& g = *job_.raster.grid;
    const int a = j * (g.nu + 1) + i;
    const Kept kept = keptOf(job_, j * g.nu + i);
    if (kept == Kept::None) return;
    const BlurredQuad<B> quad(job_.raster, key_, a);
    const uint32_t cell = job_.firstCell + static_cast<uint32_t>(j * g.nu + i);
    for (size_t k = 0; k < samples.count; k += hn::Lanes(kF)) {
      Floats depth;
      const Mask in = hn::And(covers(quad, loadSamples<B>(samples, k), all(focus_), all(job_.raster.facing), depth), hn::FirstN(kF, samples.count - k));
      HWY_ALIGN float depths[kLanes];
      hn::Store(depth, kF, depths);
      for (uint64_t left = bitsOf(in); left; left &= left - 1) {
        const size_t s = static_cast<size_t>(std::countr_zero(left));
        if (kept == Kept::All || keepsSample(job_, cell, samples.lane[k + s])) give(samples.lane[k + s], depths[s], cell);
      }
    }
    job_.out.filmsOf(job_.raster).flush();
  }

  void give(uint32_t lane, float depth, uint32_t cell) {
    SampleBuffer& out = job_.out;
    float& before = out.depth[lane];
    if (depth > before && !job_.raster.inSolid) return;
    const uint32_t pixel = out.pixelOf[lane / kLanes];
    if (!job_.raster.opaque || job_.raster.inSolid) {
      const uint32_t s = lane - pixel * static_cast<uint32_t>(out.lanes);
      return out.filmsOf(job_.raster).add(out.wordOf(pixel, s), s % 64, cell, depth);
    }
    if (depth == before) return settleTies(job_, lane, 1, cell);
    before = depth, out.cell[lane] = cell, out.nearer[pixel] = 1;
  }

  const RasterJob& job_;
  const BlurBounds& bounds_;
  const int key_;
  const float focus_;
  SieveStack* stack_ = nullptr;
};

void rasterize(const RasterJob& job) {
  const bool moves = job.raster.grid->keyCount > 1;
  for (int key = 0; key + 1 < std::max(2, job.raster.grid->keyCount); ++key) {
    const size_t k = static_cast<size_t>(key);
    job.out.filmsOf(job.raster).beginGrid();  // A cell's films are of one interval, whatever hides it.
    const Interval when = moves ? Interval{job.keyTimes[k], job.keyTimes[k + 1]} : Interval{0, 1};
    if (!moves)
      Descent<Blur<false, true>>(job, key).run(when);
    else if (job.raster.defocused)
      Descent<Blur<true, true>>(job, key).run(when);
    else
      Descent<Blur<true, false>>(job, key).run(when);
  }
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace tomales
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tomales {
HWY_EXPORT(rasterize);
void rasterizeBlurred(const RasterJob& job) { HWY_DYNAMIC_DISPATCH(rasterize)(job); }
}  // namespace tomales
#endif
