// Micropolygons that move or are out of focus: every sample meets the vertices where they are at its time through its point
// of the lens. A box round many micropolygons, at that time and through that point, is no larger than when it is still; so
// the samples of a bucket are sieved through the boxes of the grid, of its quarters, of their quarters, down to
// micropolygons, and few are left that miss.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "reyes/hide/raster_blurred.cpp"
#include "reyes/base/vector.h"  // Includes this file again for each target.

#include <bit>

#include "reyes/hide/blur_bounds.h"
#include "reyes/hide/blurred_quad.h"
#include "reyes/hide/sieve.h"

HWY_BEFORE_NAMESPACE();
namespace tomales {
namespace HWY_NAMESPACE {
namespace {

/// Part of the shutter between two motion keys.
struct Interval {
  float begin, end;
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
  for (int y = pixels.y0; y < pixels.y1; ++y)
    for (size_t pixel = out.pixelIndex(pixels.x0, y), last = pixel + static_cast<size_t>(pixels.width());
         pixel < last; ++pixel) {
      if (out.far[pixel] < dMin) continue;
      for (size_t i = pixel * lanes; i < (pixel + 1) * lanes; i += width) {
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
    sieveBucket<B>(job_.out, pixels, when, Box<B>(box, focus_),
                   job_.raster.inSolid ? job_.raster.dMin : bounds_.dMin[static_cast<size_t>(key_)], list);
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
      const Mask in =
          hn::And(covers(quad, loadSamples<B>(samples, k), all(focus_), job_.raster.facing, depth),
                  hn::FirstN(kF, samples.count - k));
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
